// The picture that bodies of glass look up: rgb of what covers the pixel, times a, the share that it covers. What is seen
// where nothing was drawn is left out.
#include "shared/slots.h"

#if SAMPLES > 1
layout(binding = TEXTURE_UNIT_RADIANCE) uniform sampler2DMS radianceImage;
#else
layout(binding = TEXTURE_UNIT_RADIANCE) uniform sampler2D radianceImage;
#endif
layout(location = 0) out vec4 behind;

vec4 covered(vec4 radiance)
{
    return radiance.a > 0.0 ? vec4(radiance.rgb * radiance.a, radiance.a) : vec4(0.0);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
#if SAMPLES > 1
    precise vec4 sum = covered(texelFetch(radianceImage, pixel, 0));
    for (int i = 1; i < SAMPLES; ++i) sum += covered(texelFetch(radianceImage, pixel, i));
    precise vec4 mean = sum * (1.0 / float(SAMPLES));
    behind = mean;
#else
    behind = covered(texelFetch(radianceImage, pixel, 0));
#endif
}
