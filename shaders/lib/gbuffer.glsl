// The G-buffer's channels: how a surface is stored in them and read back. Encoder and decoder of a channel stand side by side.
// Which channels exist, at which attachment and in which encoding comes from the table kGBufferChannels
// (renderer/frame/GBufferLayout.h) as defines: GBUFFER_<NAME> is the attachment, GBUFFER_<NAME>_PACKED its encoding.
// GBUFFER_WRITE declares the channels as outputs, otherwise they are textures.
#pragma once
#include "shared/slots.h"
#include "lib/surface.glsl"
#include "lib/math.glsl"

// ---- Encodings ------------------------------------------------------------------------------------------------------

float signNotZero(float x) { return x >= 0.0 ? 1.0 : -1.0; }

// Unit vector to the octahedral square -1..1. Source: Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors".
vec2 encodeOctahedral(vec3 n)
{
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * vec2(signNotZero(p.x), signNotZero(p.y));
}

vec3 decodeOctahedral(vec2 p)
{
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(signNotZero(n.x), signNotZero(n.y));
    return normalize(n);
}

// Colours in 0..1 as their square root in 10 bits, so that equal steps are closer to equal ratios. Rounded here and stored a
// quarter of a step higher, since OpenGL lets a driver round either way (4.5 core, section 2.3.5.2) and some truncate.
vec3 encodeSquareRoot(vec3 color) { return (floor(sqrt(clamp(color, 0.0, 1.0)) * 1023.0 + 0.5) + 0.25) / 1023.0; }
vec3 decodeSquareRoot(vec3 stored) { return stored * stored; }

// One word: model 3 bits, metallic 7, ior or F90 11, perceptual roughness 11. The ior is stored as (ior - 1)/(ior + 1), the
// square root of the reflectance it causes, on a scale that has ior 1 exactly; F90 lies in 0..1.
uint encodeMicrosurface(Surface surface)
{
    float contrast = (surface.iorOrF90 - 1.0) / (surface.iorOrF90 + 1.0);
    float fresnel = surface.model == MODEL_MICROFACET ? 0.5 + 0.5 * contrast : surface.iorOrF90;
    uint roughness = uint(clamp(sqrt(surface.alpha), 0.0, 1.0) * 2047.0 + 0.5);
    uint metallic = uint(clamp(surface.metallic, 0.0, 1.0) * 127.0 + 0.5);
    return (surface.model << 29) | (metallic << 22) | (uint(clamp(fresnel, 0.0, 1.0) * 2046.0 + 0.5) << 11) | roughness;
}

void decodeMicrosurface(uint stored, inout Surface surface)
{
    surface.model = surfaceModel(stored >> 29);
    surface.metallic = float((stored >> 22) & 127u) / 127.0;
    float fresnel = float((stored >> 11) & 2047u) / 2046.0;
    float contrast = 2.0 * fresnel - 1.0;
    surface.iorOrF90 = surface.model == MODEL_MICROFACET ? (1.0 + contrast) / max(1.0 - contrast, 1e-4) : fresnel;
    float roughness = float(stored & 2047u) / 2047.0;
    surface.alpha = max(roughness * roughness, ALPHA_MIN);
}

// Shared-exponent RGB, 9 bits a colour and 5 for the exponent. Source: OpenGL 4.5 core specification, section 8.25.
uint encodeSharedExponent(vec3 color)
{
    vec3 c = clamp(color, 0.0, 65408.0);
    float largest = max(max(c.r, c.g), c.b);
    int exponent = max(-16, int(floor(log2(max(largest, 1e-30))))) + 16;
    if (uint(largest * exp2(float(24 - exponent)) + 0.5) == 512u) exponent += 1;
    uvec3 mantissa = uvec3(c * exp2(float(24 - exponent)) + 0.5);
    return mantissa.r | (mantissa.g << 9) | (mantissa.b << 18) | (uint(exponent) << 27);
}

vec3 decodeSharedExponent(uint stored)
{
    float scale = exp2(float(int(stored >> 27) - 24));
    return vec3(stored & 511u, (stored >> 9) & 511u, (stored >> 18) & 511u) * scale;
}

// ---- Writing ----------------------------------------------------------------------------------------------------------

#ifdef GBUFFER_WRITE

#ifdef GBUFFER_ALBEDO
layout(location = GBUFFER_ALBEDO) out vec4 albedoChannel;
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
layout(location = GBUFFER_SPECULAR) out vec4 specularChannel;
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
    albedoChannel = vec4(encodeSquareRoot(surface.albedo), 0.0);
#else
    albedoChannel = vec4(surface.albedo, 0.0);
#endif
#endif
#ifdef GBUFFER_NORMAL
#if GBUFFER_NORMAL_PACKED
    normalChannel = vec4(encodeOctahedral(surface.normalLS), 0.0, 0.0);
#else
    normalChannel = vec4(surface.normalLS, 0.0);
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
    specularChannel = vec4(encodeSquareRoot(surface.specular), 0.0);
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
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_ALBEDO) uniform sampler2D albedoChannel;
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
layout(binding = TEXTURE_UNIT_GBUFFER + GBUFFER_SPECULAR) uniform sampler2D specularChannel;
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
    surface.albedo = texelFetch(albedoChannel, pixel, 0).rgb;
#if GBUFFER_ALBEDO_PACKED
    surface.albedo = decodeSquareRoot(surface.albedo);
#endif
#endif
#ifdef GBUFFER_NORMAL
#if GBUFFER_NORMAL_PACKED
    surface.normalLS = decodeOctahedral(texelFetch(normalChannel, pixel, 0).xy);
#else
    surface.normalLS = texelFetch(normalChannel, pixel, 0).xyz;
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
    surface.specular = texelFetch(specularChannel, pixel, 0).rgb;
#if GBUFFER_SPECULAR_PACKED
    surface.specular = decodeSquareRoot(surface.specular);
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
