// Encoders and decoders of the packed channels of the G-buffer. Widths are those of the fields in channelTable()
// (renderer/frame/GBufferTables.cpp); docs/numerics.md derives the error bounds.
#pragma once
#include "lib/maths/octahedral.glsl"
#include "lib/surface/surface.glsl"
#include "lib/gbuffer/gbuffer_words.glsl"

// Colours in 0..1 are stored as square roots, so that equal steps are closer to equal ratios. The number of steps is
// the largest multiple of 5 that fits: then 1 and the 0.04 of a common dielectric (0.2 squared) are exact, and a scene
// that needs no specular channel looks the same to the last bit with one.
uint rootSteps(int width)
{
    return largestCode(width) / 5u * 5u;
}

// Dithering keeps the mean of the value, not of its root.
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

// `field`: dither field of the first coordinate; DITHER_NOT rounds both to the nearest.
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

// Alpha is stored as its fourth root, from that of ALPHA_MIN to 1: in 11 bits a step is 0.16 to 0.9 % of alpha, finest
// for wide highlights. Peaks vary as 1 / alpha^2, tails as alpha^2. Square roots are portable, logarithms are not.
const float kLeastRoot = 0.17782794; // the fourth root of ALPHA_MIN

float decodeAlpha(uint code, int width)
{
    uint steps = largestCode(width);
    precise float root = 1.0 - (1.0 - kLeastRoot) * (float(steps - code) / float(steps));
    precise float alpha = (root * root) * (root * root);
    return max(alpha, ALPHA_MIN);
}

// Dithering keeps the mean of alpha, not of its root: a bias would be the same in the whole tail of a highlight.
uint encodeAlpha(float alpha, int width, int field)
{
    uint steps = largestCode(width);
    precise float position = clamp(1.0 - (1.0 - sqrt(sqrt(alpha))) / (1.0 - kLeastRoot), 0.0, 1.0) * float(steps);
    uint below = min(uint(position), steps - 1u);
    precise float first = decodeAlpha(below, width);
    precise float share = (alpha - first) / (decodeAlpha(below + 1u, width) - first);
    return below + ditheredUp(share, field, steps);
}

// Code of model and masking-shadowing option: the models, then each microfacet model with every option but the first. A
// static_assert beside the field's width checks that all fit.
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

// The index of refraction is stored as (ior - 1)/(ior + 1) in -1..1, whose magnitude is the square root of its
// reflectance. The number of steps is a multiple of 10, so that ior 1 and 1.5 (0 and 0.2) are exact.
uint iorSteps(int width)
{
    return largestCode(width) / 10u * 10u;
}

// Dithering keeps the mean of the reflectance.
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

// 2^n for -126 <= n <= 127; exact, unlike exp2.
float powerOfTwo(int n)
{
    return uintBitsToFloat(uint(n + 127) << 23);
}

// The largest exponent of a field: 2^68 in 7 bits; 2^36 in 6, brighter than any surface in cd/m^2.
int topExponent(int width)
{
    return (1 << (width - 1)) + 4;
}

// x 2^n by two factors, so that none leaves fp32's range.
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

// Radiance with a shared exponent: each channel is below 2^exponent and an integer times 2^(exponent - its width).
// Widths: exponent, red, green and blue; the last three are equal.
void putRadiance(vec3 color, ivec4 widths)
{
    vec3 c = clamp(color, 0.0, 3.4e38);
    float largest = max(max(c.r, c.g), c.b);
    int top = topExponent(widths.x), bottom = top - int(largestCode(widths.x));
    int exponent = clamp(int(floatBitsToUint(largest) >> 23) - 126, bottom, top);
    uvec3 code = encodeRadiances(c, exponent, widths.y);
    // A channel rounded up to the next power of two raises the shared exponent. With the same thresholds it is encoded
    // as that power, so the mean is kept.
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

// Two unit vectors at right angles to n that vary smoothly with it. The first is also at right angles to the coordinate
// axis `axis`, which must not be near n.
void axisFrame(vec3 n, uint axis, out vec3 first, out vec3 second)
{
    vec3 across = axis == 0u ? vec3(0.0, -n.z, n.y) : axis == 1u ? vec3(n.z, 0.0, -n.x) : vec3(-n.y, n.x, 0.0);
    first = across / length(across);
    second = cross(n, first);
}

// Stores a direction at right angles to the normal, whose sign does not matter, as a point p on half of a diamond:
// (p, 1 - |p|) in the frame of the coordinate axis farthest from the normal. The axis is stored, since the decoder's
// normal has a quantisation error. Widths: axis and point.
void putDirectionAcross(vec3 normal, vec3 across, ivec4 widths)
{
    vec3 n = abs(normal);
    uint axis = n.x <= n.y && n.x <= n.z ? 0u : n.y <= n.z ? 1u : 2u;
    vec3 first, second;
    axisFrame(normal, axis, first, second);
    vec2 direction = vec2(dot(across, first), dot(across, second));
    if (direction.y < 0.0) direction = -direction;
    putField(axis, widths.x);
    putField(encodeSigned(direction.x / (abs(direction.x) + direction.y), widths.y, DITHER_NOT), widths.y);
}

vec3 takeDirectionAcross(vec3 normal, ivec4 widths)
{
    vec3 first, second;
    axisFrame(normal, takeField(widths.x), first, second);
    float point = decodeSigned(takeField(widths.y), widths.y);
    return normalize(point * first + (1.0 - abs(point)) * second);
}
