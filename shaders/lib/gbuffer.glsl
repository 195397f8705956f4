// The G-buffer's channels: how a surface is stored in them and read back.
// Which channels exist, at which attachment and in which encoding comes from the table kGBufferChannels
// (renderer/frame/GBufferLayout.h) as defines: GBUFFER_<NAME> is the attachment, GBUFFER_<NAME>_PACKED its encoding.
// GBUFFER_SPARE_COMPONENTS: metallic and alpha are the fourth components of albedo and normal.
// GBUFFER_WRITE declares the channels as outputs, otherwise they are textures.
#pragma once
#include "shared/slots.h"
#include "lib/surface.glsl"
#include "lib/gbuffer_encodings.glsl"

// ---- Writing ----------------------------------------------------------------------------------------------------------

#ifdef GBUFFER_WRITE

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
    microsurfaceChannel = vec4(surface.alpha, float(surface.model), surface.iorOrF90, surface.metallic);
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
#ifdef GBUFFER_NORMAL_TEXEL
    normalTexelChannel = vec4(surface.normalTexel, 0.0);
#endif
}

#else // ---- Reading ---------------------------------------------------------------------------------------------------

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
    vec4 microsurface = texelFetch(microsurfaceChannel, pixel, 0);
    surface.alpha = microsurface.x;
    surface.model = surfaceModel(uint(microsurface.y));
    surface.iorOrF90 = microsurface.z;
    surface.metallic = microsurface.w;
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
#ifdef GBUFFER_NORMAL_TEXEL
    surface.normalTexel = texelFetch(normalTexelChannel, pixel, 0).rgb;
#endif
    return surface;
}

#endif
