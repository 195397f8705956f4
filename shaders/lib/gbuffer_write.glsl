// Stores a surface in the channels of the G-buffer; included by lib/gbuffer.glsl.
#pragma once

#ifdef GBUFFER_EXACT_CHANNELS
layout(location = 0) out vec4 exactChannels[GBUFFER_EXACT_CHANNELS];
#endif
#ifdef GBUFFER_WORDS
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
#endif

void writeGBuffer(Surface surface)
{
#ifdef GBUFFER_WORDS
    for (int word = 0; word < GBUFFER_WORDS; ++word) gbufferWords[word] = 0u;
    ditheredPixel = uvec2(gl_FragCoord.xy);
#endif
#ifdef GBUFFER_ALBEDO
#if GBUFFER_ALBEDO_PACKED
    gbufferBit = GBUFFER_ALBEDO;
    putRoots(surface.albedo, ivec4(GBUFFER_ALBEDO_WIDTHS), DITHER_ALBEDO);
#else
    exactChannels[GBUFFER_ALBEDO] = vec4(surface.albedo, surface.metallic);
#endif
#endif
#ifdef GBUFFER_NORMAL
#if GBUFFER_NORMAL_PACKED
    gbufferBit = GBUFFER_NORMAL;
    putOctahedral(encodeOctahedral(surface.normalLS), ivec4(GBUFFER_NORMAL_WIDTHS), DITHER_NORMAL);
#else
#ifdef GBUFFER_MATERIAL_NUMBER
    float fourth = float(surface.material);
#else
    float fourth = surface.alpha;
#endif
    exactChannels[GBUFFER_NORMAL] = vec4(surface.normalLS, fourth);
#endif
#endif
#ifdef GBUFFER_MICROSURFACE
#if GBUFFER_MICROSURFACE_PACKED
    gbufferBit = GBUFFER_MICROSURFACE;
    putMicrosurface(surface, ivec4(GBUFFER_MICROSURFACE_WIDTHS));
#else
    exactChannels[GBUFFER_MICROSURFACE] = exactMicrosurface(surface);
#endif
#endif
#ifdef GBUFFER_SPECULAR
#if GBUFFER_SPECULAR_PACKED
    gbufferBit = GBUFFER_SPECULAR;
    putRoots(surface.specular, ivec4(GBUFFER_SPECULAR_WIDTHS), DITHER_SPECULAR);
#else
    exactChannels[GBUFFER_SPECULAR] = vec4(surface.specular, 0.0);
#endif
#endif
#ifdef GBUFFER_EMISSION
#if GBUFFER_EMISSION_PACKED
    gbufferBit = GBUFFER_EMISSION;
    putRadiance(surface.emission, ivec4(GBUFFER_EMISSION_WIDTHS));
#else
    exactChannels[GBUFFER_EMISSION] = vec4(surface.emission, 0.0);
#endif
#endif
#ifdef GBUFFER_TANGENT
#if GBUFFER_TANGENT_PACKED
    gbufferBit = GBUFFER_TANGENT;
    putTangent(surface, ivec4(GBUFFER_TANGENT_WIDTHS));
#else
    exactChannels[GBUFFER_TANGENT] = vec4(surface.tangentLS, surface.alphaBitangent);
#endif
#endif
#ifdef GBUFFER_CLEARCOAT
#if GBUFFER_CLEARCOAT_PACKED
    gbufferBit = GBUFFER_CLEARCOAT;
    putClearcoat(surface, ivec4(GBUFFER_CLEARCOAT_WIDTHS));
#else
    exactChannels[GBUFFER_CLEARCOAT] = vec4(surface.coatNormalCode, surface.coatFactor, surface.coatAlpha);
#endif
#endif
#ifdef GBUFFER_SHEEN
#if GBUFFER_SHEEN_PACKED
    gbufferBit = GBUFFER_SHEEN;
    putSheen(surface, ivec4(GBUFFER_SHEEN_WIDTHS));
#else
    exactChannels[GBUFFER_SHEEN] = vec4(surface.sheenColor, surface.sheenAlpha);
#endif
#endif
#ifdef GBUFFER_NORMAL_TEXEL
#if GBUFFER_NORMAL_TEXEL_PACKED
    gbufferBit = GBUFFER_NORMAL_TEXEL;
    putTexel(surface.normalTexel, ivec4(GBUFFER_NORMAL_TEXEL_WIDTHS));
#else
    exactChannels[GBUFFER_NORMAL_TEXEL] = vec4(surface.normalTexel, 0.0);
#endif
#endif
#ifdef GBUFFER_WORDS
    storeWords();
#endif
}
