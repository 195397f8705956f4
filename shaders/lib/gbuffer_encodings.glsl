// How the packed channels of the G-buffer keep their values: encoder and decoder of an encoding stand side by side.
#pragma once
#include "lib/octahedral.glsl"
#include "lib/surface.glsl"

// Colours in 0..1 as their square root, so that equal steps are closer to equal ratios: one word, red and green 11 bits, blue
// 10. A word and not a normalised format, because OpenGL lets a driver round those either way (4.5 core, section 2.3.5.2) and
// llvmpipe is up to a whole step off. The steps are the largest multiples of 5, for then 1 and the 0.04 of a common
// dielectric (0.2 squared) come back exactly, and a scene that needs no specular channel looks the same to the last bit with one.
const vec3 kSquareRootSteps = vec3(2045.0, 2045.0, 1020.0);

uint encodeSquareRoot(vec3 color)
{
    uvec3 code = uvec3(sqrt(clamp(color, 0.0, 1.0)) * kSquareRootSteps + 0.5);
    return code.r | (code.g << 11) | (code.b << 22);
}

vec3 decodeSquareRoot(uint stored)
{
    precise vec3 code = vec3(stored & 2047u, (stored >> 11) & 2047u, stored >> 22);
    precise vec3 color = (code * code) / (kSquareRootSteps * kSquareRootSteps);
    return color;
}

// In fp32: alpha, model, ior or F90, metallic; blinn_phong's exponent stands for its ior, a microfacet model's masking for its
// metallic.
vec4 exactMicrosurface(Surface surface)
{
    vec4 stored = vec4(surface.alpha, float(surface.model), surface.iorOrF90, surface.metallic);
#if HAS_BLINN_PHONG
    if (surface.model == MODEL_BLINN_PHONG) stored.z = surface.exponent;
#endif
#if HAS_MASKING_OPTIONS
    if (isMicrofacet(surface.model)) stored.w = float(surface.masking);
#endif
    return stored;
}

void readExactMicrosurface(vec4 stored, inout Surface surface)
{
    surface.alpha = stored.x;
    surface.model = surfaceModel(uint(stored.y));
    surface.iorOrF90 = stored.z;
    surface.metallic = stored.w;
#if HAS_BLINN_PHONG
    if (surface.model == MODEL_BLINN_PHONG) {
        surface.exponent = stored.z;
        surface.iorOrF90 = 1.0;
    }
#endif
#if HAS_MASKING_OPTIONS
    if (isMicrofacet(surface.model)) {
        surface.masking = uint(stored.w);
        surface.metallic = 0.0;
    }
#endif
}

// A float >= 0 by the 22 bits below its sign: exponent 8, mantissa 14.
uint encodeFloat22(float x)
{
    return (floatBitsToUint(clamp(x, 0.0, 1e38)) + 256u) >> 9;
}

float decodeFloat22(uint stored)
{
    return uintBitsToFloat(stored << 9);
}

uint encodeRoughness(float alpha, float steps)
{
    return uint(clamp(sqrt(alpha), 0.0, 1.0) * steps + 0.5);
}

float decodeRoughness(uint stored, float steps)
{
    float roughness = float(stored) / steps;
    return max(roughness * roughness, ALPHA_MIN);
}

// One word: model 3 bits, metallic 7, ior or F90 11, perceptual roughness 11. The ior is stored as (ior - 1)/(ior + 1), the
// square root of the reflectance it causes, on a scale that has ior 1 exactly; F90 lies in 0..1. The microfacet models are never
// metallic and keep their masking there; blinn_phong's exponent takes the 22 bits of what it lacks.
uint encodeMicrosurface(Surface surface)
{
    float contrast = (surface.iorOrF90 - 1.0) / (surface.iorOrF90 + 1.0);
    float fresnel = isMicrofacet(surface.model) ? 0.5 + 0.5 * contrast : surface.iorOrF90;
    uint roughness = encodeRoughness(surface.alpha, 2047.0);
    uint metallic = uint(clamp(surface.metallic, 0.0, 1.0) * 127.0 + 0.5);
#if HAS_MASKING_OPTIONS
    if (isMicrofacet(surface.model)) metallic = surface.masking;
#endif
#if HAS_BLINN_PHONG
    if (surface.model == MODEL_BLINN_PHONG) return (surface.model << 29) | encodeFloat22(surface.exponent);
#endif
    return (surface.model << 29) | (metallic << 22) | (uint(clamp(fresnel, 0.0, 1.0) * 2046.0 + 0.5) << 11) | roughness;
}

void decodeMicrosurface(uint stored, inout Surface surface)
{
    surface.model = surfaceModel(stored >> 29);
#if HAS_BLINN_PHONG
    if (surface.model == MODEL_BLINN_PHONG) {
        surface.exponent = decodeFloat22(stored & 0x3fffffu);
        return;
    }
#endif
    surface.metallic = float((stored >> 22) & 127u) / 127.0;
#if HAS_MASKING_OPTIONS
    if (isMicrofacet(surface.model)) {
        surface.masking = (stored >> 22) & 127u;
        surface.metallic = 0.0;
    }
#endif
    float fresnel = float((stored >> 11) & 2047u) / 2046.0;
    float contrast = 2.0 * fresnel - 1.0;
    surface.iorOrF90 = isMicrofacet(surface.model) ? (1.0 + contrast) / max(1.0 - contrast, 1e-4) : fresnel;
    surface.alpha = decodeRoughness(stored & 2047u, 2047.0);
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

// -1..1 in 16 bits, 0 exactly.
uint encodeSigned16(float x)
{
    return uint((clamp(x, -1.0, 1.0) * 0.5 + 0.5) * 65534.0 + 0.5);
}

float decodeSigned16(uint stored)
{
    return float(stored & 65535u) / 32767.0 - 1.0;
}

#if HAS_TANGENT_FRAME
// Two directions at right angles to n, which turn smoothly with it: the first is also at right angles to the coordinate axis of
// that number, which must not be near n.
void axisFrame(vec3 n, uint axis, out vec3 first, out vec3 second)
{
    vec3 across = axis == 0u ? vec3(0.0, -n.z, n.y) : axis == 1u ? vec3(n.z, 0.0, -n.x) : vec3(-n.y, n.x, 0.0);
    first = across / length(across);
    second = cross(n, first);
}

// One word: axis 2 bits, tangent 16, perceptual roughness along the bitangent 11. The tangent has no sign, so it is a point p
// on half of a diamond, (p, 1 - |p|) in the frame of the axis farthest from the normal; the decoder has a normal that is off by
// its own packing and must be told the axis.
uint encodeTangent(Surface surface)
{
    vec3 n = abs(surface.normalLS);
    uint axis = n.x <= n.y && n.x <= n.z ? 0u : n.y <= n.z ? 1u : 2u;
    vec3 first, second;
    axisFrame(surface.normalLS, axis, first, second);
    vec2 direction = vec2(dot(surface.tangentLS, first), dot(surface.tangentLS, second));
    if (direction.y < 0.0) direction = -direction;
    uint point = encodeSigned16(direction.x / (abs(direction.x) + direction.y));
    return (axis << 27) | (point << 11) | encodeRoughness(surface.alphaBitangent, 2047.0);
}

void decodeTangent(uint stored, inout Surface surface)
{
    vec3 first, second;
    axisFrame(surface.normalLS, (stored >> 27) & 3u, first, second);
    float point = decodeSigned16(stored >> 11);
    surface.tangentLS = normalize(point * first + (1.0 - abs(point)) * second);
    surface.alphaBitangent = decodeRoughness(stored & 2047u, 2047.0);
}
#endif

#if HAS_CLEARCOAT
// Two words: octahedral normal 16 16; factor 16, perceptual roughness 16.
uvec2 encodeClearcoat(Surface surface)
{
    uint normal = encodeSigned16(surface.coatNormalCode.x) | (encodeSigned16(surface.coatNormalCode.y) << 16);
    uint factor = uint(clamp(surface.coatFactor, 0.0, 1.0) * 65535.0 + 0.5);
    return uvec2(normal, factor | (encodeRoughness(surface.coatAlpha, 65535.0) << 16));
}

void decodeClearcoat(uvec2 stored, inout Surface surface)
{
    surface.coatNormalCode = vec2(decodeSigned16(stored.x), decodeSigned16(stored.x >> 16));
    surface.coatFactor = float(stored.y & 65535u) / 65535.0;
    surface.coatAlpha = decodeRoughness(stored.y >> 16, 65535.0);
}
#endif

#if HAS_SHEEN
// One word, 8 bits each: square roots of the colours, perceptual roughness.
uint encodeSheen(Surface surface)
{
    uvec3 color = uvec3(sqrt(clamp(surface.sheenColor, 0.0, 1.0)) * 255.0 + 0.5);
    return color.r | (color.g << 8) | (color.b << 16) | (encodeRoughness(surface.sheenAlpha, 255.0) << 24);
}

void decodeSheen(uint stored, inout Surface surface)
{
    vec3 root = vec3(stored & 255u, (stored >> 8) & 255u, (stored >> 16) & 255u) / 255.0;
    surface.sheenColor = root * root;
    surface.sheenAlpha = decodeRoughness(stored >> 24, 255.0);
}
#endif
