// The sum of two images of linear radiance.
#include "shared/slots.h"

layout(binding = TEXTURE_UNIT_RADIANCE) uniform sampler2D radianceImageA;
layout(binding = TEXTURE_UNIT_DEPTH) uniform sampler2D radianceImageB;
layout(location = 0) out vec4 sum;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    sum = texelFetch(radianceImageA, pixel, 0) + texelFetch(radianceImageB, pixel, 0);
}
