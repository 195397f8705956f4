// Amplified difference of two images as display code values; magenta where one of them is not finite.
#include "shared/slots.h"
#include "shared/display.h"
#include "shared/tonemap.h"

layout(std140, binding = UNIFORM_PASS) uniform DisplayBlock
{
    DisplayConstants display; // exposure.x: the amplification, exposure included
};
layout(binding = TEXTURE_UNIT_RADIANCE) uniform sampler2D radianceImageA;
layout(binding = TEXTURE_UNIT_DEPTH) uniform sampler2D radianceImageB;
layout(location = 0) out vec4 code;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 a = texelFetch(radianceImageA, pixel, 0).rgb;
    vec3 b = texelFetch(radianceImageB, pixel, 0).rgb;
    bool isNumber = !any(isnan(a)) && !any(isnan(b)) && !any(isinf(a)) && !any(isinf(b));
    vec3 difference = clamp(abs(a - b) * display.exposure.x, 0.0, 1.0);
    code = vec4(isNumber ? encodeSrgb(difference) : vec3(1.0, 0.0, 1.0), 1.0);
}
