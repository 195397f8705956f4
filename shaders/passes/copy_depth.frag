// Copies a depth buffer, sample by sample.
#include "shared/slots.h"

#if SAMPLES > 1
layout(binding = TEXTURE_UNIT_DEPTH) uniform sampler2DMS depthChannel;
#else
layout(binding = TEXTURE_UNIT_DEPTH) uniform sampler2D depthChannel;
#endif

void main()
{
#if SAMPLES > 1
    gl_FragDepth = texelFetch(depthChannel, ivec2(gl_FragCoord.xy), gl_SampleID).r;
#else
    gl_FragDepth = texelFetch(depthChannel, ivec2(gl_FragCoord.xy), 0).r;
#endif
}
