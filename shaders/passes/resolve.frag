// Resolves a pixel's samples: the mean of radiance, summed in ascending order, or the maxima of nearest and negated
// farthest depths.
#include "shared/slots.h"

layout(binding = TEXTURE_UNIT_SAMPLES) uniform sampler2DMS samples;
layout(location = 0) out vec4 resolved;

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    precise vec4 found = texelFetch(samples, pixel, 0);
#if RESOLVES_DEPTHS
    for (int i = 1; i < SAMPLES; ++i) found = max(found, texelFetch(samples, pixel, i));
    resolved = found;
#else
    for (int i = 1; i < SAMPLES; ++i) found += texelFetch(samples, pixel, i);
    precise vec4 mean = found * (1.0 / float(SAMPLES));
    resolved = mean;
#endif
}
