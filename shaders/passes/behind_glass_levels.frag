// Coarser levels of the image that bodies of glass look up, stacked in one texture: means over squares of pixels, at
// the image's edges over their pixels inside.
#include "shared/slots.h"
#include "shared/refraction.h"

layout(binding = TEXTURE_UNIT_RADIANCE) uniform sampler2D behindPicture;
layout(location = 0) out vec4 behindLevels;

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy), size = textureSize(behindPicture, 0);
    int level = 1;
    while (level < BEHIND_COARSEST && texel.y >= behindRow(size.y, level + 1)) ++level;
    ivec2 begin = ivec2(texel.x, texel.y - behindRow(size.y, level)) * (1 << level);
    ivec2 end = min(begin + (1 << level), size);
    precise vec4 sum = vec4(0.0);
    for (int y = begin.y; y < end.y; ++y) {
        precise vec4 row = vec4(0.0);
        for (int x = begin.x; x < end.x; ++x) row += texelFetch(behindPicture, ivec2(x, y), 0);
        sum += row;
    }
    // Texels beside a level are empty.
    ivec2 sides = max(end - begin, ivec2(0));
    precise vec4 mean = sum / float(max(sides.x * sides.y, 1));
    behindLevels = mean;
}
