// Shows a channel of the G-buffer as it is stored. Words, STORED_WORDS of them, come apart into four equal parts, the lowest
// bits first, each as a share of its largest value; fp32 tells all of them apart. Components that a format lacks are 0, and
// the fourth 1.
#include "shared/slots.h"

#if STORED_WORDS > 0
layout(binding = TEXTURE_UNIT_GBUFFER) uniform usampler2D channel;
#else
layout(binding = TEXTURE_UNIT_GBUFFER) uniform sampler2D channel;
#endif
layout(binding = TEXTURE_UNIT_DEPTH) uniform sampler2D depthChannel;
layout(location = 0) out vec4 shown;

vec4 storedTexel(ivec2 pixel)
{
#if STORED_WORDS == 0
    return texelFetch(channel, pixel, 0);
#elif STORED_WORDS == 1
    uint word = texelFetch(channel, pixel, 0).r;
    return vec4(uvec4(word, word >> 8, word >> 16, word >> 24) & 0xFFu) / 255.0;
#else
    uvec2 words = texelFetch(channel, pixel, 0).rg;
    return vec4(uvec4(words.x, words.x >> 16, words.y, words.y >> 16) & 0xFFFFu) / 65535.0;
#endif
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    // Reverse-Z; 0 where nothing was drawn, and nothing stored.
    if (texelFetch(depthChannel, pixel, 0).r == 0.0) discard;
    vec4 texel = storedTexel(pixel);
#if SHOWS_FOURTH
    shown = vec4(texel.aaa, 1.0);
#else
    shown = vec4(texel.rgb, 1.0);
#endif
}
