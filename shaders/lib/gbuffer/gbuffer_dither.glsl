// Dithers packed fields: a threshold per pixel and field selects one of two codes, so that the mean over pixels is the
// value, though each pixel is up to a step off. Thresholds are the fractional part of x sqrt(p) + y sqrt(q); each field
// has its own primes p and q, so that means of products are right too. By Weyl's theorem the mean converges with the
// inverse of the number of pixels. Of the primes below 1500 these keep similar thresholds farthest apart: |v|^2 times
// the distance of v . (sqrt(p), sqrt(q)) from an integer is above 0.17 for v up to 32 pixels.
#pragma once

// Rounds to the nearest code, for directions: their error only rotates a highlight, and noise would break it up.
#define DITHER_NOT -1
#define DITHER_ALBEDO 0 // three components
#define DITHER_NORMAL 3 // two components
#define DITHER_ALPHA 5  // both alphas of a lobe alike, so that isotropic lobes stay isotropic; exponent
#define DITHER_F90 6    // or index of refraction
#define DITHER_METALLIC 7
#define DITHER_SPECULAR 8  // three components
#define DITHER_EMISSION 11 // three components
#define DITHER_COAT 14
#define DITHER_COAT_ALPHA 15
#define DITHER_SHEEN 16 // three components
#define DITHER_SHEEN_ALPHA 19
#define DITHER_TEXEL 20 // three components
#define DITHER_FIELDS 23

// Fractional parts of sqrt(p) and sqrt(q), times 2^32.
const uvec2 kDitherSteps[DITHER_FIELDS] = uvec2[](
    uvec2(0x41CAB35Cu, 0x6738AABBu), // 977, 1399
    uvec2(0x510E527Fu, 0x6D1826CAu), // 11, 71
    uvec2(0x5166FE45u, 0x92AFCC0Au), // 641, 1061
    uvec2(0x5815A7BEu, 0x788D9812u), // 107, 461
    uvec2(0x87ABB9F2u, 0xA32AADFCu), // 157, 607
    uvec2(0xC463A2FCu, 0x57587F03u), // 163, 1249
    uvec2(0xC3C7558Eu, 0xA3ACFA2Au), // 1009, 1493
    uvec2(0x75A9F91Du, 0xAE79842Fu), // 239, 349
    uvec2(0x4970E489u, 0x9D3B47A9u), // 691, 877
    uvec2(0x9613114Du, 0x50A4AD7Eu), // 761, 919
    uvec2(0x5876DCAEu, 0x326551BCu), // 1321, 1459
    uvec2(0xAE5F9156u, 0x764AB842u), // 59, 271
    uvec2(0x86305019u, 0xA0C06A13u), // 241, 347
    uvec2(0x43AB9FB6u, 0x6D7B3939u), // 233, 503
    uvec2(0xB5BD559Eu, 0xD1A949AEu), // 661, 1283
    uvec2(0xC854E23Fu, 0x5D9D3DA7u), // 887, 1181
    uvec2(0x6F196331u, 0xD1FD8A33u), // 89, 191
    uvec2(0xC2B2B755u, 0x67856563u), // 431, 751
    uvec2(0xA4B06BE1u, 0xC6913AE6u), // 277, 1427
    uvec2(0x8A326F61u, 0xCD577F24u), // 1193, 1429
    uvec2(0x49C7D9BDu, 0x63560208u), // 151, 547
    uvec2(0xCD89620Fu, 0xB7882899u), // 773, 1499
    uvec2(0xB71EF1A2u, 0x9A8AD2BCu)  // 883, 1063
);

uvec2 ditheredPixel; // the pixel being stored

// In 0..1, excluding both ends.
float ditherThreshold(int field)
{
    if (field == DITHER_NOT) return 0.5;
    uint fraction = ditheredPixel.x * kDitherSteps[field].x + ditheredPixel.y * kDitherSteps[field].y;
    return (float(fraction >> 9) + 0.5) * (1.0 / 8388608.0);
}

// Returns 0 or 1, with the mean `share` over pixels. A share within rounding of 0 or 1, by an error that grows with the
// field's number of steps, is not dithered: values that lie on a step keep it.
uint ditheredUp(float share, int field, uint steps)
{
    float rounding = float(steps) * (1.0 / 4194304.0);
    return share + mix(rounding, 1.0 - rounding, ditherThreshold(field)) >= 1.0 ? 1u : 0u;
}
