// Reads a surface from the channels of the G-buffer; included by lib/gbuffer/gbuffer.glsl.
#pragma once
#ifdef GBUFFER_MATERIAL_NUMBER
#include "lib/material/material_table.glsl"
#endif

#if GBUFFER_EXACT_CHANNELS > 0
layout(binding = TEXTURE_UNIT_GBUFFER) uniform sampler2D exactChannels[GBUFFER_EXACT_CHANNELS];
#endif
#if GBUFFER_WORDS >= 4
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_WORD_TEXTURE) uniform usampler2D firstWords;
#endif
#if GBUFFER_WORDS >= 8
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_WORD_TEXTURE + 1) uniform usampler2D secondWords;
#endif
#if (GBUFFER_WORDS & 2) != 0
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_WORD_TEXTURE + GBUFFER_WORDS / 4) uniform usampler2D pairOfWords;
#endif
#if (GBUFFER_WORDS & 1) != 0
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_WORD_TEXTURE + GBUFFER_WORDS / 4 + (GBUFFER_WORDS & 2) / 2) uniform usampler2D lastWord;
#endif

#ifdef GBUFFER_MARKS
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_MARKS) uniform usampler2D marks;
#endif

void fetchWords(ivec2 pixel)
{
#if GBUFFER_WORDS >= 4
    uvec4 firstWordsTexel = texelFetch(firstWords, pixel, 0);
    for (int i = 0; i < 4; ++i) gbufferWords[i] = firstWordsTexel[i];
#endif
#if GBUFFER_WORDS >= 8
    uvec4 secondWordsTexel = texelFetch(secondWords, pixel, 0);
    for (int i = 0; i < 4; ++i) gbufferWords[4 + i] = secondWordsTexel[i];
#endif
#if (GBUFFER_WORDS & 2) != 0
    uvec2 pairOfWordsTexel = texelFetch(pairOfWords, pixel, 0).rg;
    gbufferWords[GBUFFER_WORDS & ~3] = pairOfWordsTexel.x;
    gbufferWords[(GBUFFER_WORDS & ~3) + 1] = pairOfWordsTexel.y;
#endif
#if (GBUFFER_WORDS & 1) != 0
    gbufferWords[GBUFFER_WORDS - 1] = texelFetch(lastWord, pixel, 0).r;
#endif
}

Surface surfaceFromGBuffer(ivec2 pixel)
{
    Surface surface;
    setNeutralValues(surface);
    surface.specular = defaultSpecular(surface.model);
    fetchWords(pixel);
#define EXACT_CHANNEL(put, take, attachment) take(kExact, texelFetch(exactChannels[attachment], pixel, 0), surface);
#define PACKED_CHANNEL(put, take, bit, widths) gbufferBit = bit; take(Encoding(true, widths), vec4(0.0), surface);
    GBUFFER_CHANNELS
#ifdef GBUFFER_MARKS
    uvec2 markWords = texelFetch(marks, pixel, 0).rg;
#define MARK(code, take, bit, bits) take((markWords[(bit) / 32] >> ((bit) % 32)) & ((1u << (bits)) - 1u), surface);
    GBUFFER_MARK_LIST
#endif
#ifdef GBUFFER_MATERIAL_NUMBER
    setTabledValues(int(surface.material), surface);
#endif
    return surface;
}
