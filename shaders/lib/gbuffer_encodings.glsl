// How the packed channels of the G-buffer keep their values: encoder and decoder of an encoding stand side by side.
#pragma once
#include "lib/surface.glsl"

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
