// Reads a surface from the channels of the G-buffer; included by lib/gbuffer.glsl.
#pragma once

#ifdef GBUFFER_ALBEDO
#if GBUFFER_ALBEDO_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_ALBEDO) uniform usampler2D albedoChannel;
#else
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_ALBEDO) uniform sampler2D albedoChannel;
#endif
#endif
#ifdef GBUFFER_NORMAL
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_NORMAL) uniform sampler2D normalChannel;
#endif
#ifdef GBUFFER_MICROSURFACE
#if GBUFFER_MICROSURFACE_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_MICROSURFACE) uniform usampler2D microsurfaceChannel;
#else
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_MICROSURFACE) uniform sampler2D microsurfaceChannel;
#endif
#endif
#ifdef GBUFFER_SPECULAR
#if GBUFFER_SPECULAR_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_SPECULAR) uniform usampler2D specularChannel;
#else
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_SPECULAR) uniform sampler2D specularChannel;
#endif
#endif
#ifdef GBUFFER_EMISSION
#if GBUFFER_EMISSION_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_EMISSION) uniform usampler2D emissionChannel;
#else
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_EMISSION) uniform sampler2D emissionChannel;
#endif
#endif
#ifdef GBUFFER_TANGENT
#if GBUFFER_TANGENT_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_TANGENT) uniform usampler2D tangentChannel;
#else
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_TANGENT) uniform sampler2D tangentChannel;
#endif
#endif
#ifdef GBUFFER_CLEARCOAT
#if GBUFFER_CLEARCOAT_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_CLEARCOAT) uniform usampler2D clearcoatChannel;
#else
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_CLEARCOAT) uniform sampler2D clearcoatChannel;
#endif
#endif
#ifdef GBUFFER_SHEEN
#if GBUFFER_SHEEN_PACKED
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_SHEEN) uniform usampler2D sheenChannel;
#else
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_SHEEN) uniform sampler2D sheenChannel;
#endif
#endif
#ifdef GBUFFER_NORMAL_TEXEL
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_NORMAL_TEXEL) uniform sampler2D normalTexelChannel;
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
#ifdef GBUFFER_ALBEDO
#if GBUFFER_ALBEDO_PACKED
    surface.albedo = decodeSquareRoot(texelFetch(albedoChannel, pixel, 0).r);
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
    surface.normalLS = decodeOctahedral(texelFetch(normalChannel, pixel, 0).xy);
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
    decodeMicrosurface(texelFetch(microsurfaceChannel, pixel, 0).r, surface);
#else
    readExactMicrosurface(texelFetch(microsurfaceChannel, pixel, 0), surface);
#endif
#endif
    surface.specular = defaultSpecular(surface.model);
#ifdef GBUFFER_SPECULAR
#if GBUFFER_SPECULAR_PACKED
    surface.specular = decodeSquareRoot(texelFetch(specularChannel, pixel, 0).r);
#else
    surface.specular = texelFetch(specularChannel, pixel, 0).rgb;
#endif
#endif
#ifdef GBUFFER_EMISSION
#if GBUFFER_EMISSION_PACKED
    surface.emission = decodeSharedExponent(texelFetch(emissionChannel, pixel, 0).r);
#else
    surface.emission = texelFetch(emissionChannel, pixel, 0).rgb;
#endif
#endif
#ifdef GBUFFER_TANGENT
#if GBUFFER_TANGENT_PACKED
    decodeTangent(texelFetch(tangentChannel, pixel, 0).r, surface);
#else
    vec4 tangent = texelFetch(tangentChannel, pixel, 0);
    surface.tangentLS = tangent.xyz;
    surface.alphaBitangent = tangent.w;
#endif
#endif
#ifdef GBUFFER_CLEARCOAT
#if GBUFFER_CLEARCOAT_PACKED
    decodeClearcoat(texelFetch(clearcoatChannel, pixel, 0).rg, surface);
#else
    vec4 clearcoat = texelFetch(clearcoatChannel, pixel, 0);
    surface.coatNormalCode = clearcoat.xy;
    surface.coatFactor = clearcoat.z;
    surface.coatAlpha = clearcoat.w;
#endif
#endif
#ifdef GBUFFER_SHEEN
#if GBUFFER_SHEEN_PACKED
    decodeSheen(texelFetch(sheenChannel, pixel, 0).r, surface);
#else
    vec4 sheen = texelFetch(sheenChannel, pixel, 0);
    surface.sheenColor = sheen.rgb;
    surface.sheenAlpha = sheen.a;
#endif
#endif
#ifdef GBUFFER_NORMAL_TEXEL
    surface.normalTexel = texelFetch(normalTexelChannel, pixel, 0).rgb;
#endif
    return surface;
}
