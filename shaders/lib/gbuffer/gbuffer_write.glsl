// Stores a surface in the channels of the G-buffer; included by lib/gbuffer/gbuffer.glsl.
#pragma once

#if GBUFFER_EXACT_CHANNELS > 0
layout(location = 0) out vec4 exactChannels[GBUFFER_EXACT_CHANNELS];
#endif
#if GBUFFER_WORDS >= 4
layout(location = GBUFFER_WORD_TEXTURE) out uvec4 firstWords;
#endif
#if GBUFFER_WORDS >= 8
layout(location = GBUFFER_WORD_TEXTURE + 1) out uvec4 secondWords;
#endif
#if (GBUFFER_WORDS & 2) != 0
layout(location = GBUFFER_WORD_TEXTURE + GBUFFER_WORDS / 4) out uvec2 pairOfWords;
#endif
#if (GBUFFER_WORDS & 1) != 0
layout(location = GBUFFER_WORD_TEXTURE + GBUFFER_WORDS / 4 + (GBUFFER_WORDS & 2) / 2) out uint lastWord;
#endif

#ifdef GBUFFER_MARKS
layout(location = GBUFFER_MARKS) out uvec2 marks; // the second is unused if one word suffices
#endif

void storeWords()
{
#if GBUFFER_WORDS >= 4
    for (int i = 0; i < 4; ++i) firstWords[i] = gbufferWords[i];
#endif
#if GBUFFER_WORDS >= 8
    for (int i = 0; i < 4; ++i) secondWords[i] = gbufferWords[4 + i];
#endif
#if (GBUFFER_WORDS & 2) != 0
    for (int i = 0; i < 2; ++i) pairOfWords[i] = gbufferWords[GBUFFER_WORDS / 4 * 4 + i];
#endif
#if (GBUFFER_WORDS & 1) != 0
    lastWord = gbufferWords[GBUFFER_WORDS - 1];
#endif
}

void writeGBuffer(Surface surface)
{
    for (int word = 0; word < GBUFFER_WORDS; ++word) gbufferWords[word] = 0u;
    ditheredPixel = uvec2(gl_FragCoord.xy);
    vec4 noTexel;
#define EXACT_CHANNEL(put, take, attachment) put(kExact, surface, exactChannels[attachment]);
#define PACKED_CHANNEL(put, take, bit, widths) gbufferBit = bit; put(Encoding(true, widths), surface, noTexel);
    GBUFFER_CHANNELS
    storeWords();
#ifdef GBUFFER_MARKS
    uvec2 markWords = uvec2(0u);
#define MARK(code, take, bit, bits) markWords[(bit) / 32] |= code(surface) << ((bit) % 32);
    GBUFFER_MARK_LIST
    marks = markWords;
#endif
}
