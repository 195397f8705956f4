// How the packed channels of the G-buffer keep their values: encoder and decoder of an encoding stand side by side. Widths are
// those of the fields in channelTable() (renderer/frame/GBufferLayout.cpp); bounds of the errors are derived in docs/numerics.md.
#pragma once
#include "lib/octahedral.glsl"
#include "lib/surface.glsl"
#include "lib/gbuffer_words.glsl"

// Colours in 0..1 as their square root, so that equal steps are closer to equal ratios. The steps are the largest multiples of 5
// that fit, for then 1 and the 0.04 of a common dielectric (0.2 squared) come back exactly, and a scene that needs no specular
// channel looks the same to the last bit with one.
uint rootSteps(int width)
{
    return largestCode(width) / 5u * 5u;
}

// The mean over pixels is that of the value, not of its root.
uint encodeRoot(float value, uint steps, int field)
{
    precise float held = clamp(value, 0.0, 1.0);
    precise float position = sqrt(held) * float(steps);
    uint below = min(uint(position), steps - 1u);
    precise float square = float(below * below);
    precise float share = (held * float(steps * steps) - square) / float(2u * below + 1u);
    return below + ditheredUp(share, field, steps);
}

void putRoots(vec3 color, ivec4 widths, int field)
{
    for (int i = 0; i < 3; ++i) putField(encodeRoot(color[i], rootSteps(widths[i]), field + i), widths[i]);
}

vec3 takeRoots(ivec4 widths)
{
    precise vec3 color;
    for (int i = 0; i < 3; ++i) {
        uint steps = rootSteps(widths[i]);
        precise float code = float(takeField(widths[i]));
        color[i] = (code * code) / float(steps * steps);
    }
    return color;
}

// The field is that of the first coordinate; DITHER_NOT rounds both to the nearest.
void putOctahedral(vec2 code, ivec4 widths, int field)
{
    putField(encodeSigned(code.x, widths.x, field), widths.x);
    putField(encodeSigned(code.y, widths.y, field == DITHER_NOT ? field : field + 1), widths.y);
}

vec2 takeOctahedral(ivec4 widths)
{
    vec2 code;
    for (int i = 0; i < 2; ++i) code[i] = decodeSigned(takeField(widths[i]), widths[i]);
    return code;
}

// Alpha as its fourth root, from that of ALPHA_MIN to 1: a step is 0.3 to 2 % of alpha in 9 bits, and finest where highlights
// are wide enough to be seen. Square roots are exact enough to be the same everywhere; a logarithm is not.
const float kLeastRoot = 0.17782794; // the fourth root of ALPHA_MIN

float decodeAlpha(uint code, int width)
{
    uint steps = largestCode(width);
    precise float root = 1.0 - (1.0 - kLeastRoot) * (float(steps - code) / float(steps));
    precise float alpha = (root * root) * (root * root);
    return max(alpha, ALPHA_MIN);
}

// The mean over pixels is that of alpha, not of its root.
uint encodeAlpha(float alpha, int width, int field)
{
    uint steps = largestCode(width);
    precise float position = clamp(1.0 - (1.0 - sqrt(sqrt(alpha))) / (1.0 - kLeastRoot), 0.0, 1.0) * float(steps);
    uint below = min(uint(position), steps - 1u);
    precise float first = decodeAlpha(below, width);
    precise float share = (alpha - first) / (decodeAlpha(below + 1u, width) - first);
    return below + ditheredUp(share, field, steps);
}

// Model and masking: the models, then each microfacet model with every masking but the first. That the field holds all of them
// is asserted beside its width.
#define OTHER_MASKINGS (MASKING_COUNT - 1u)

uint encodeKind(Surface surface)
{
    uint kind = surface.model;
#if HAS_MASKING_OPTIONS
    if (IS_MICROFACET(surface.model) && surface.masking != MASKING_WALTER)
        kind = MODEL_COUNT + OTHER_MASKINGS * (surface.model - MODEL_FIRST_MICROFACET) + (surface.masking - 1u);
#endif
    return kind;
}

void decodeKind(uint kind, inout Surface surface)
{
    uint masked = max(kind, MODEL_COUNT) - MODEL_COUNT;
    surface.model = surfaceModel(kind < MODEL_COUNT ? kind : MODEL_FIRST_MICROFACET + masked / OTHER_MASKINGS);
#if HAS_MASKING_OPTIONS
    surface.masking = kind < MODEL_COUNT ? MASKING_WALTER : 1u + masked % OTHER_MASKINGS;
#endif
}

// The index of refraction as (ior - 1)/(ior + 1), the square root of the reflectance it causes, in -1..1. The steps are a multiple
// of 10, so that ior 1 and 1.5 (0 and 0.2) are on one.
uint iorSteps(int width)
{
    return largestCode(width) / 10u * 10u;
}

// The mean over pixels is that of the reflectance.
uint encodeIor(float ior, int width, int field)
{
    int middle = int(iorSteps(width)) / 2;
    precise float position = (ior - 1.0) / (ior + 1.0) * float(middle);
    int below = clamp(int(floor(position)), -middle, middle - 1);
    precise float share = (position * position - float(below * below)) / float(2 * below + 1);
    return uint(below + middle) + ditheredUp(share, field, iorSteps(width));
}

float decodeIor(uint code, int width)
{
    int middle = int(iorSteps(width)) / 2;
    precise float contrast = float(int(code) - middle) / float(middle);
    precise float ior = (1.0 + contrast) / max(1.0 - contrast, 1e-4);
    return ior;
}

// A microfacet model has an index of refraction where metallic_roughness has F90 and metallic; the one parameter of a model
// takes the room of alpha too.
void putMicrosurface(Surface surface, ivec4 widths)
{
    putField(encodeKind(surface), widths.x);
    int tail = widths.z + widths.w;
    if (HAS_PARAMETER(surface.model)) {
        putField(encodeFloat(surface.parameter, widths.y + tail, DITHER_ALPHA), widths.y + tail);
        return;
    }
    putField(encodeAlpha(surface.alpha, widths.y, DITHER_ALPHA), widths.y);
    uint code;
    if (IS_MICROFACET(surface.model)) {
        code = encodeIor(surface.iorOrF90, tail, DITHER_F90);
    } else {
        code = encodeShare(surface.iorOrF90, largestCode(widths.z), DITHER_F90) |
               (encodeShare(surface.metallic, largestCode(widths.w), DITHER_METALLIC) << widths.z);
    }
    putField(code, tail);
}

void takeMicrosurface(ivec4 widths, inout Surface surface)
{
    decodeKind(takeField(widths.x), surface);
    int tail = widths.z + widths.w;
    uint code = takeField(widths.y + tail);
    if (HAS_PARAMETER(surface.model)) {
        surface.parameter = decodeFloat(code, widths.y + tail);
        return;
    }
    surface.alpha = decodeAlpha(code & largestCode(widths.y), widths.y);
    code >>= widths.y;
    if (IS_MICROFACET(surface.model)) {
        surface.iorOrF90 = decodeIor(code, tail);
    } else {
        surface.iorOrF90 = decodeShare(code & largestCode(widths.z), largestCode(widths.z));
        surface.metallic = decodeShare(code >> widths.z, largestCode(widths.w));
    }
}

// 2^n for -126 <= n <= 127, exactly, which exp2 need not be.
float powerOfTwo(int n)
{
    return uintBitsToFloat(uint(n + 127) << 23);
}

// The largest exponent of a field: 2^68 in 7 bits; 2^36 in 6, brighter than any surface in cd/m^2.
int topExponent(int width)
{
    return (1 << (width - 1)) + 4;
}

// x 2^n in two factors, neither of which leaves fp32.
float timesPowerOfTwo(float x, int n)
{
    precise float scaled = x * powerOfTwo(n / 2);
    precise float result = scaled * powerOfTwo(n - n / 2);
    return result;
}

uint encodeRadiance(float value, int exponent, int width, int field)
{
    return encodeShare(timesPowerOfTwo(value, -exponent), 1u << width, field);
}

uvec3 encodeRadiances(vec3 color, int exponent, int width)
{
    return uvec3(encodeRadiance(color.r, exponent, width, DITHER_EMISSION), encodeRadiance(color.g, exponent, width, DITHER_EMISSION + 1),
                 encodeRadiance(color.b, exponent, width, DITHER_EMISSION + 2));
}

// Radiance with one exponent for its three colours: each is below 2^exponent, and an integer times 2^(exponent - its width).
// Widths: exponent, red, green and blue, which are equal.
void putRadiance(vec3 color, ivec4 widths)
{
    vec3 c = clamp(color, 0.0, 3.4e38);
    float largest = max(max(c.r, c.g), c.b);
    int top = topExponent(widths.x), bottom = top - int(largestCode(widths.x));
    int exponent = clamp(int(floatBitsToUint(largest) >> 23) - 126, bottom, top);
    uvec3 code = encodeRadiances(c, exponent, widths.y);
    // A colour that is rounded up to the next power of two takes all three there; with the thresholds as they are it is
    // that power, so the mean stays.
    if (any(greaterThan(code, uvec3(largestCode(widths.y)))) && exponent < top) {
        exponent += 1;
        code = encodeRadiances(c, exponent, widths.y);
    }
    putField(uint(exponent - bottom), widths.x);
    code = min(code, uvec3(largestCode(widths.y)));
    putField(code.r, widths.y);
    putField(code.g, widths.y);
    putField(code.b, widths.y);
}

vec3 takeRadiance(ivec4 widths)
{
    int exponent = int(takeField(widths.x)) + topExponent(widths.x) - int(largestCode(widths.x));
    vec3 color;
    for (int i = 0; i < 3; ++i) color[i] = timesPowerOfTwo(float(takeField(widths.y)), exponent - widths.y);
    return color;
}

void putTexel(vec3 texel, ivec4 widths)
{
    for (int i = 0; i < 3; ++i) putField(encodeShare(texel[i], largestCode(widths[i]), DITHER_TEXEL + i), widths[i]);
}

vec3 takeTexel(ivec4 widths)
{
    vec3 texel;
    for (int i = 0; i < 3; ++i) texel[i] = decodeShare(takeField(widths[i]), largestCode(widths[i]));
    return texel;
}
