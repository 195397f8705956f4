// Packs the fields of channels end to end into words, and quantises values to integer fields. Words are used instead of
// normalised formats, because OpenGL lets a driver round those either way (4.5 core, section 2.3.5.2), and llvmpipe is
// up to a whole step off.
#pragma once
#include "lib/gbuffer/gbuffer_dither.glsl"
#include "shared/normals.h"

const int kGBufferWords = GBUFFER_WORDS > 0 ? GBUFFER_WORDS : 1;
uint gbufferWords[kGBufferWords];
int gbufferBit; // first bit of the next field

// The second word of a field that crosses a word boundary. Clamped, because NVIDIA's compiler refuses an index beyond
// the array even where it is never reached.
int wordAfter(int word)
{
    return min(word + 1, kGBufferWords - 1);
}

void putField(uint value, int width)
{
    int word = gbufferBit >> 5, bit = gbufferBit & 31;
    gbufferWords[word] |= value << bit;
    if (bit + width > 32) gbufferWords[wordAfter(word)] |= value >> (32 - bit);
    gbufferBit += width;
}

uint takeField(int width)
{
    int word = gbufferBit >> 5, bit = gbufferBit & 31;
    uint value = gbufferWords[word] >> bit;
    if (bit + width > 32) value |= gbufferWords[wordAfter(word)] << (32 - bit);
    gbufferBit += width;
    return value & ((1u << width) - 1u);
}

uint largestCode(int width)
{
    return (1u << width) - 1u;
}

// Quantises 0..1 in equal steps; both ends are exact. `field`: a number DITHER_*.
uint encodeShare(float x, uint steps, int field)
{
    precise float position = clamp(x, 0.0, 1.0) * float(steps);
    uint below = min(uint(position), steps - 1u);
    return below + ditheredUp(position - float(below), field, steps);
}

// Both ends are exact, also on drivers whose division is not (GLSL 4.50, section 4.7.1).
float decodeShare(uint code, uint steps)
{
    precise float x = code == steps ? 1.0 : float(code) / float(steps);
    return x;
}

// Inverse of decodeSigned() (shared/normals.h).
uint encodeSigned(float x, int width, int field)
{
    return encodeShare(0.5 * x + 0.5, largestCode(width) - 1u, field);
}

// Stores the highest bits of a float >= 0 below its sign: 8 bits of exponent, then mantissa.
uint encodeFloat(float x, int width, int field)
{
    int dropped = 31 - width;
    uint threshold = uint(ditherThreshold(field) * float(1u << dropped));
    return (floatBitsToUint(clamp(x, 0.0, 1e38)) + threshold) >> dropped;
}

float decodeFloat(uint code, int width)
{
    return uintBitsToFloat(code << (31 - width));
}
