// The mean of a pixel's samples, summed in ascending order.
#include "shared/slots.h"

layout(binding = TEXTURE_UNIT_RADIANCE) uniform sampler2DMS radianceImage;
layout(location = 0) out vec4 resolved;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    precise vec4 sum = texelFetch(radianceImage, pixel, 0);
    for (int i = 1; i < SAMPLES; ++i) sum += texelFetch(radianceImage, pixel, i);
    precise vec4 mean = sum * (1.0 / float(SAMPLES));
    resolved = mean;
}
