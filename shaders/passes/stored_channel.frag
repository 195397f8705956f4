// Displays a channel of the G-buffer as stored: the components of an fp32 channel (STORED_PACKED 0), or the fields of a
// packed one, each relative to its largest code; fp32 distinguishes all codes. Fields that a channel lacks are 0.
#include "lib/gbuffer/gbuffer.glsl"

layout(binding = TEXTURE_UNIT_DEPTH) uniform sampler2D depthChannel;
#if !STORED_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + STORED_CHANNEL) uniform sampler2D storedChannel;
#endif
layout(location = 0) out vec4 shown;

vec4 storedTexel(ivec2 pixel)
{
#if STORED_PACKED
    fetchWords(pixel);
    gbufferBit = STORED_CHANNEL;
    ivec4 widths = ivec4(STORED_WIDTHS);
    vec4 shares = vec4(0.0);
    for (int i = 0; i < 4 && widths[i] > 0; ++i)
        shares[i] = float(takeField(widths[i])) / float(largestCode(widths[i]));
    return shares;
#else
    return texelFetch(storedChannel, pixel, 0);
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
