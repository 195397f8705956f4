// Reads a surface from the channels of the G-buffer; included by lib/gbuffer.glsl.
#pragma once

#if defined(GBUFFER_ALBEDO) && !GBUFFER_ALBEDO_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_ALBEDO) uniform sampler2D albedoChannel;
#endif
#if defined(GBUFFER_NORMAL) && !GBUFFER_NORMAL_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_NORMAL) uniform sampler2D normalChannel;
#endif
#if defined(GBUFFER_MICROSURFACE) && !GBUFFER_MICROSURFACE_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_MICROSURFACE) uniform sampler2D microsurfaceChannel;
#endif
#if defined(GBUFFER_SPECULAR) && !GBUFFER_SPECULAR_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_SPECULAR) uniform sampler2D specularChannel;
#endif
#if defined(GBUFFER_EMISSION) && !GBUFFER_EMISSION_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_EMISSION) uniform sampler2D emissionChannel;
#endif
#if defined(GBUFFER_TANGENT) && !GBUFFER_TANGENT_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_TANGENT) uniform sampler2D tangentChannel;
#endif
#if defined(GBUFFER_CLEARCOAT) && !GBUFFER_CLEARCOAT_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_CLEARCOAT) uniform sampler2D clearcoatChannel;
#endif
#if defined(GBUFFER_SHEEN) && !GBUFFER_SHEEN_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_SHEEN) uniform sampler2D sheenChannel;
#endif
#if defined(GBUFFER_NORMAL_TEXEL) && !GBUFFER_NORMAL_TEXEL_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_NORMAL_TEXEL) uniform sampler2D normalTexelChannel;
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
    uvec4 pairOfWordsTexel = texelFetch(pairOfWords, pixel, 0);
    for (int i = 0; i < 2; ++i) gbufferWords[GBUFFER_WORDS / 4 * 4 + i] = pairOfWordsTexel[i];
#endif
#if (GBUFFER_WORDS & 1) != 0
    gbufferWords[GBUFFER_WORDS - 1] = texelFetch(lastWord, pixel, 0).r;
#endif
}
#endif

Surface surfaceFromGBuffer(ivec2 pixel)
{
    Surface surface;
    surface.model = surfaceModel(MODEL_SINGLE_COLOR);
    surface.albedo = vec3(0.0);
    surface.metallic = 0.0;
    surface.alpha = 1.0;
    surface.iorOrF90 = 1.0;
    surface.emission = vec3(0.0);
    surface.normalLS = vec3(0.0, 0.0, 1.0);
    surface.normalTexel = vec3(0.5, 0.5, 1.0);
    setNeutralLobes(surface);
#ifdef GBUFFER_WORDS
    fetchWords(pixel);
#endif
#ifdef GBUFFER_ALBEDO
#if GBUFFER_ALBEDO_PACKED
    gbufferBit = GBUFFER_ALBEDO;
    surface.albedo = takeRoots(ivec4(GBUFFER_ALBEDO_WIDTHS));
#else
    vec4 albedo = texelFetch(albedoChannel, pixel, 0);
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
    vec4 normal = texelFetch(normalChannel, pixel, 0);
    surface.normalLS = normal.xyz;
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
    readExactMicrosurface(texelFetch(microsurfaceChannel, pixel, 0), surface);
#endif
#endif
    surface.specular = defaultSpecular(surface.model);
#ifdef GBUFFER_SPECULAR
#if GBUFFER_SPECULAR_PACKED
    gbufferBit = GBUFFER_SPECULAR;
    surface.specular = takeRoots(ivec4(GBUFFER_SPECULAR_WIDTHS));
#else
    surface.specular = texelFetch(specularChannel, pixel, 0).rgb;
#endif
#endif
#ifdef GBUFFER_EMISSION
#if GBUFFER_EMISSION_PACKED
    gbufferBit = GBUFFER_EMISSION;
    surface.emission = takeRadiance(ivec4(GBUFFER_EMISSION_WIDTHS));
#else
    surface.emission = texelFetch(emissionChannel, pixel, 0).rgb;
#endif
#endif
#ifdef GBUFFER_TANGENT
#if GBUFFER_TANGENT_PACKED
    gbufferBit = GBUFFER_TANGENT;
    takeTangent(ivec4(GBUFFER_TANGENT_WIDTHS), surface);
#else
    vec4 tangent = texelFetch(tangentChannel, pixel, 0);
    surface.tangentLS = tangent.xyz;
    surface.alphaBitangent = tangent.w;
#endif
#endif
#ifdef GBUFFER_CLEARCOAT
#if GBUFFER_CLEARCOAT_PACKED
    gbufferBit = GBUFFER_CLEARCOAT;
    takeClearcoat(ivec4(GBUFFER_CLEARCOAT_WIDTHS), surface);
#else
    vec4 clearcoat = texelFetch(clearcoatChannel, pixel, 0);
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
    vec4 sheen = texelFetch(sheenChannel, pixel, 0);
    surface.sheenColor = sheen.rgb;
    surface.sheenAlpha = sheen.a;
#endif
#endif
#ifdef GBUFFER_NORMAL_TEXEL
#if GBUFFER_NORMAL_TEXEL_PACKED
    gbufferBit = GBUFFER_NORMAL_TEXEL;
    surface.normalTexel = takeTexel(ivec4(GBUFFER_NORMAL_TEXEL_WIDTHS));
#else
    surface.normalTexel = texelFetch(normalTexelChannel, pixel, 0).rgb;
#endif
#endif
    return surface;
}
