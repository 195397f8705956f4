// Displays a face of the shadow atlas (shared/shadow_maps.h).
#include "shared/slots.h"
#include "shared/shadow_maps.h"

layout(std140, binding = UNIFORM_PASS) uniform ShownFaceBlock
{
    ShownFaceConstants shown;
};
layout(binding = TEXTURE_UNIT_SHADOWS) uniform sampler2D shadowAtlas;
layout(location = 0) out vec4 radiance;

// Faces narrower than this, in pixels, get no rim, which would hide them.
const float kNarrowestRimmed = 8.0;

ivec2 texelAt(vec2 pixel)
{
    precise vec2 texel = (pixel - shown.picture.xy) * shown.picture.z;
    return ivec2(floor(texel)) + ivec2(shown.picture.w, 0);
}

bool isInFace(ivec2 texel)
{
    ivec2 within = texel - ivec2(shown.face.xy);
    return all(greaterThanEqual(within, ivec2(0))) && all(lessThan(within, ivec2(shown.face.z)));
}

bool isAtRim(vec2 pixel)
{
    return shown.face.z >= kNarrowestRimmed * shown.picture.z &&
           !(isInFace(texelAt(pixel - 1.0)) && isInFace(texelAt(pixel + 1.0)));
}

// From 1 at the light to 1/4 at its range; 0 without a caster.
float nearness(float depth)
{
    if (depth == 0.0) return 0.0;
    precise float reached = shown.depths.x > 0.0 ? shown.depths.x / depth : 1.0 - depth;
    return 1.0 / (1.0 + 3.0 * reached);
}

void main()
{
    ivec2 texel = texelAt(gl_FragCoord.xy);
    if (!isInFace(texel)) discard;
    float depth = texelFetch(shadowAtlas, texel, 0).r;
    radiance = vec4(depth, nearness(depth), isAtRim(gl_FragCoord.xy) ? -shown.face.w : shown.face.w, 1.0);
}
