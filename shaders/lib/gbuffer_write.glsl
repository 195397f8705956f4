// Stores a surface in the channels of the G-buffer; included by lib/gbuffer.glsl.
#pragma once

#ifdef GBUFFER_ALBEDO
#if GBUFFER_ALBEDO_PACKED
layout(location = GBUFFER_ALBEDO) out uvec4 albedoChannel;
#else
layout(location = GBUFFER_ALBEDO) out vec4 albedoChannel;
#endif
#endif
#ifdef GBUFFER_NORMAL
layout(location = GBUFFER_NORMAL) out vec4 normalChannel;
#endif
#ifdef GBUFFER_MICROSURFACE
#if GBUFFER_MICROSURFACE_PACKED
layout(location = GBUFFER_MICROSURFACE) out uvec4 microsurfaceChannel;
#else
layout(location = GBUFFER_MICROSURFACE) out vec4 microsurfaceChannel;
#endif
#endif
#ifdef GBUFFER_SPECULAR
#if GBUFFER_SPECULAR_PACKED
layout(location = GBUFFER_SPECULAR) out uvec4 specularChannel;
#else
layout(location = GBUFFER_SPECULAR) out vec4 specularChannel;
#endif
#endif
#ifdef GBUFFER_EMISSION
#if GBUFFER_EMISSION_PACKED
layout(location = GBUFFER_EMISSION) out uvec4 emissionChannel;
#else
layout(location = GBUFFER_EMISSION) out vec4 emissionChannel;
#endif
#endif
#ifdef GBUFFER_TANGENT
#if GBUFFER_TANGENT_PACKED
layout(location = GBUFFER_TANGENT) out uvec4 tangentChannel;
#else
layout(location = GBUFFER_TANGENT) out vec4 tangentChannel;
#endif
#endif
#ifdef GBUFFER_CLEARCOAT
#if GBUFFER_CLEARCOAT_PACKED
layout(location = GBUFFER_CLEARCOAT) out uvec4 clearcoatChannel;
#else
layout(location = GBUFFER_CLEARCOAT) out vec4 clearcoatChannel;
#endif
#endif
#ifdef GBUFFER_SHEEN
#if GBUFFER_SHEEN_PACKED
layout(location = GBUFFER_SHEEN) out uvec4 sheenChannel;
#else
layout(location = GBUFFER_SHEEN) out vec4 sheenChannel;
#endif
#endif
#ifdef GBUFFER_NORMAL_TEXEL
layout(location = GBUFFER_NORMAL_TEXEL) out vec4 normalTexelChannel;
#endif

void writeGBuffer(Surface surface)
{
#ifdef GBUFFER_ALBEDO
#if GBUFFER_ALBEDO_PACKED
    albedoChannel = uvec4(encodeSquareRoot(surface.albedo), 0u, 0u, 0u);
#else
    albedoChannel = vec4(surface.albedo, surface.metallic);
#endif
#endif
#ifdef GBUFFER_NORMAL
#if GBUFFER_NORMAL_PACKED
    normalChannel = vec4(encodeOctahedral(surface.normalLS), 0.0, 0.0);
#else
    normalChannel = vec4(surface.normalLS, surface.alpha);
#endif
#endif
#ifdef GBUFFER_MICROSURFACE
#if GBUFFER_MICROSURFACE_PACKED
    microsurfaceChannel = uvec4(encodeMicrosurface(surface), 0u, 0u, 0u);
#else
    microsurfaceChannel = exactMicrosurface(surface);
#endif
#endif
#ifdef GBUFFER_SPECULAR
#if GBUFFER_SPECULAR_PACKED
    specularChannel = uvec4(encodeSquareRoot(surface.specular), 0u, 0u, 0u);
#else
    specularChannel = vec4(surface.specular, 0.0);
#endif
#endif
#ifdef GBUFFER_EMISSION
#if GBUFFER_EMISSION_PACKED
    emissionChannel = uvec4(encodeSharedExponent(surface.emission), 0u, 0u, 0u);
#else
    emissionChannel = vec4(surface.emission, 0.0);
#endif
#endif
#ifdef GBUFFER_TANGENT
#if GBUFFER_TANGENT_PACKED
    tangentChannel = uvec4(encodeTangent(surface), 0u, 0u, 0u);
#else
    tangentChannel = vec4(surface.tangentLS, surface.alphaBitangent);
#endif
#endif
#ifdef GBUFFER_CLEARCOAT
#if GBUFFER_CLEARCOAT_PACKED
    clearcoatChannel = uvec4(encodeClearcoat(surface), 0u, 0u);
#else
    clearcoatChannel = vec4(surface.coatNormalCode, surface.coatFactor, surface.coatAlpha);
#endif
#endif
#ifdef GBUFFER_SHEEN
#if GBUFFER_SHEEN_PACKED
    sheenChannel = uvec4(encodeSheen(surface), 0u, 0u, 0u);
#else
    sheenChannel = vec4(surface.sheenColor, surface.sheenAlpha);
#endif
#endif
#ifdef GBUFFER_NORMAL_TEXEL
    normalTexelChannel = vec4(surface.normalTexel, 0.0);
#endif
}
