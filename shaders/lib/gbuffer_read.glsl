// Reads a surface from the channels of the G-buffer; included by lib/gbuffer.glsl.
#pragma once
#ifdef GBUFFER_MATERIAL_NUMBER
#include "lib/material_table.glsl"
#endif

#ifdef GBUFFER_EXACT_CHANNELS
layout(binding = TEXTURE_UNIT_GBUFFER) uniform sampler2D exactChannels[GBUFFER_EXACT_CHANNELS];
#endif
#ifdef GBUFFER_WORDS
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
#endif

Surface surfaceFromGBuffer(ivec2 pixel)
{
    Surface surface;
    setNeutralValues(surface);
#ifdef GBUFFER_WORDS
    fetchWords(pixel);
#endif
#ifdef GBUFFER_ALBEDO
#if GBUFFER_ALBEDO_PACKED
    gbufferBit = GBUFFER_ALBEDO;
    surface.albedo = takeRoots(ivec4(GBUFFER_ALBEDO_WIDTHS));
#else
    vec4 albedo = texelFetch(exactChannels[GBUFFER_ALBEDO], pixel, 0);
    surface.albedo = albedo.rgb;
#ifdef GBUFFER_SPARE_COMPONENTS
    surface.metallic = albedo.a;
#endif
#endif
#endif
#ifdef GBUFFER_NORMAL
#if GBUFFER_NORMAL_PACKED
    gbufferBit = GBUFFER_NORMAL;
    surface.normalLS = decodeOctahedral(takeOctahedral(ivec4(GBUFFER_NORMAL_WIDTHS)));
#else
    vec4 normal = texelFetch(exactChannels[GBUFFER_NORMAL], pixel, 0);
    surface.normalLS = normal.xyz;
#ifdef GBUFFER_MATERIAL_NUMBER
    setTabledValues(int(normal.w), surface);
#endif
#ifdef GBUFFER_SPARE_COMPONENTS
    surface.alpha = normal.w;
#endif
#endif
#endif
#ifdef GBUFFER_MICROSURFACE
#if GBUFFER_MICROSURFACE_PACKED
    gbufferBit = GBUFFER_MICROSURFACE;
    takeMicrosurface(ivec4(GBUFFER_MICROSURFACE_WIDTHS), surface);
#else
    readExactMicrosurface(texelFetch(exactChannels[GBUFFER_MICROSURFACE], pixel, 0), surface);
#endif
#endif
#ifndef GBUFFER_MATERIAL_NUMBER
    surface.specular = defaultSpecular(surface.model);
#endif
#ifdef GBUFFER_SPECULAR
#if GBUFFER_SPECULAR_PACKED
    gbufferBit = GBUFFER_SPECULAR;
    surface.specular = takeRoots(ivec4(GBUFFER_SPECULAR_WIDTHS));
#else
    surface.specular = texelFetch(exactChannels[GBUFFER_SPECULAR], pixel, 0).rgb;
#endif
#endif
#ifdef GBUFFER_EMISSION
#if GBUFFER_EMISSION_PACKED
    gbufferBit = GBUFFER_EMISSION;
    surface.emission = takeRadiance(ivec4(GBUFFER_EMISSION_WIDTHS));
#else
    surface.emission = texelFetch(exactChannels[GBUFFER_EMISSION], pixel, 0).rgb;
#endif
#endif
#ifdef GBUFFER_TANGENT
#if GBUFFER_TANGENT_PACKED
    gbufferBit = GBUFFER_TANGENT;
    takeTangent(ivec4(GBUFFER_TANGENT_WIDTHS), surface);
#else
    vec4 tangent = texelFetch(exactChannels[GBUFFER_TANGENT], pixel, 0);
    surface.tangentLS = tangent.xyz;
    surface.alphaBitangent = tangent.w;
#endif
#endif
#ifdef GBUFFER_CLEARCOAT
#if GBUFFER_CLEARCOAT_PACKED
    gbufferBit = GBUFFER_CLEARCOAT;
    takeClearcoat(ivec4(GBUFFER_CLEARCOAT_WIDTHS), surface);
#else
    vec4 clearcoat = texelFetch(exactChannels[GBUFFER_CLEARCOAT], pixel, 0);
    surface.coatNormalCode = clearcoat.xy;
    surface.coatFactor = clearcoat.z;
    surface.coatAlpha = clearcoat.w;
#endif
#endif
#ifdef GBUFFER_SHEEN
#if GBUFFER_SHEEN_PACKED
    gbufferBit = GBUFFER_SHEEN;
    takeSheen(ivec4(GBUFFER_SHEEN_WIDTHS), surface);
#else
    vec4 sheen = texelFetch(exactChannels[GBUFFER_SHEEN], pixel, 0);
    surface.sheenColor = sheen.rgb;
    surface.sheenAlpha = sheen.a;
#endif
#endif
#ifdef GBUFFER_NORMAL_TEXEL
#if GBUFFER_NORMAL_TEXEL_PACKED
    gbufferBit = GBUFFER_NORMAL_TEXEL;
    surface.normalTexel = takeTexel(ivec4(GBUFFER_NORMAL_TEXEL_WIDTHS));
#else
    surface.normalTexel = texelFetch(exactChannels[GBUFFER_NORMAL_TEXEL], pixel, 0).rgb;
#endif
#endif
    return surface;
}
