#pragma once
// Tone maps from linear Rec. 709 radiance to linear display values 0..1, and the sRGB transfer function.
#include "display.h"

SHARED_BEGIN

// Keeps colours below 0.76 (less the 4 % that a dielectric reflects) and compresses the rest towards white.
SHARED_FUNCTION vec3 toneMapKhronosNeutral(vec3 color) {
    const float kShoulder = 0.8f - 0.04f;
    const float kDesaturation = 0.15f;
    float darkest = min(color.r, min(color.g, color.b));
    float toe = darkest < 0.08f ? darkest - 6.25f * darkest * darkest : 0.04f;
    vec3 lifted = color - toe;
    float peak = max(lifted.r, max(lifted.g, lifted.b));
    if (peak < kShoulder) return lifted;
    float room = 1.0f - kShoulder;
    float bentPeak = 1.0f - room * room / (peak + room - kShoulder);
    float towardsWhite = 1.0f - 1.0f / (kDesaturation * (peak - bentPeak) + 1.0f);
    return mix(lifted * (bentPeak / peak), vec3(bentPeak), towardsWhite);
}

// The ACES reference and output transforms for sRGB displays as a rational fit. Source: Stephen Hill 2017, fit
// published with "A Closer Look at ACES" (MJP, BakingLab); the matrices are sRGB -> AP1-like and back, rows first.
SHARED_FUNCTION vec3 toneMapAces(vec3 color) {
    const mat3 kIn = mat3(0.59719f, 0.07600f, 0.02840f, 0.35458f, 0.90834f, 0.13383f, 0.04823f, 0.01566f, 0.83777f);
    const mat3 kOut =
        mat3(1.60475f, -0.10208f, -0.00327f, -0.53108f, 1.10813f, -0.07276f, -0.07367f, -0.00605f, 1.07602f);
    vec3 c = kIn * color;
    vec3 fitted = (c * (c + 0.0245786f) - 0.000090537f) / (c * (0.983729f * c + 0.4329510f) + 0.238081f);
    return clamp(kOut * fitted, 0.0f, 1.0f);
}

// AgX by Troy Sobotka, base look, with the sixth-order fit of its curve by Benjamin Wrensch 2023, "Minimal AgX
// Implementation". The curve yields display code values of a 2.2 power display; they are linearised at the end.
SHARED_FUNCTION vec3 toneMapAgx(vec3 color) {
    const mat3 kInset =
        mat3(0.842479062253094f, 0.0423282422610123f, 0.0423756549057051f, 0.0784335999999992f, 0.878468636469772f,
             0.0784336f, 0.0792237451477643f, 0.0791661274605434f, 0.879142973793104f);
    const float kDarkestEV = -12.47393f;
    const float kBrightestEV = 4.026069f;
    vec3 stops = log2(max(kInset * color, vec3(exp2(kDarkestEV))));
    vec3 x = clamp((stops - kDarkestEV) / (kBrightestEV - kDarkestEV), 0.0f, 1.0f);
    vec3 curve = -0.00232f + x * (0.1191f + x * (0.4298f + x * (-6.868f + x * (31.96f + x * (-40.14f + x * 15.5f)))));
    return pow(clamp(inverse(kInset) * curve, 0.0f, 1.0f), vec3(2.2f));
}

SHARED_FUNCTION vec3 toneMapped(vec3 color, uint curve) {
    vec3 c = max(color, vec3(0.0f));
    if (curve == TONEMAP_NONE) return c;
    c = min(c, vec3(1e9f)); // larger values would overflow to NaN when squared
    if (curve == TONEMAP_KHRONOS_NEUTRAL) return toneMapKhronosNeutral(c);
    if (curve == TONEMAP_ACES) return toneMapAces(c);
    return toneMapAgx(c);
}

// Linear 0..1 to sRGB code values. Source: IEC 61966-2-1.
SHARED_FUNCTION vec3 encodeSrgb(vec3 linear) {
    vec3 c = clamp(linear, 0.0f, 1.0f);
    return mix(1.055f * pow(c, vec3(1.0f / 2.4f)) - 0.055f, 12.92f * c, lessThanEqual(c, vec3(0.0031308f)));
}

SHARED_END
