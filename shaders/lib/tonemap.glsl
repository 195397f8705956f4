// Tone maps from linear Rec. 709 radiance to linear display values 0..1, and the sRGB transfer function.
#pragma once
#include "shared/display.h"

// Leaves colours below 0.76 as they are (less the 4 % a dielectric reflects) and bends the rest towards white.
// Source: Khronos Group 2024, "PBR Neutral Tone Mapper".
vec3 toneMapKhronosNeutral(vec3 color)
{
    const float kShoulder = 0.8 - 0.04;
    const float kDesaturation = 0.15;
    float darkest = min(color.r, min(color.g, color.b));
    float toe = darkest < 0.08 ? darkest - 6.25 * darkest * darkest : 0.04;
    vec3 lifted = color - toe;
    float peak = max(lifted.r, max(lifted.g, lifted.b));
    if (peak < kShoulder) return lifted;
    float room = 1.0 - kShoulder;
    float bentPeak = 1.0 - room * room / (peak + room - kShoulder);
    float towardsWhite = 1.0 - 1.0 / (kDesaturation * (peak - bentPeak) + 1.0);
    return mix(lifted * (bentPeak / peak), vec3(bentPeak), towardsWhite);
}

// The ACES reference and output transforms for sRGB displays as a rational fit. Source: Stephen Hill 2017, fit published with
// "A Closer Look at ACES" (MJP, BakingLab); the matrices are sRGB -> AP1-like and back, rows first.
vec3 toneMapAces(vec3 color)
{
    const mat3 kIn = mat3(0.59719, 0.07600, 0.02840, 0.35458, 0.90834, 0.13383, 0.04823, 0.01566, 0.83777);
    const mat3 kOut = mat3(1.60475, -0.10208, -0.00327, -0.53108, 1.10813, -0.07276, -0.07367, -0.00605, 1.07602);
    vec3 c = kIn * color;
    vec3 fitted = (c * (c + 0.0245786) - 0.000090537) / (c * (0.983729 * c + 0.4329510) + 0.238081);
    return clamp(kOut * fitted, 0.0, 1.0);
}

// AgX by Troy Sobotka, base look, with the sixth-order fit of its curve by Benjamin Wrensch 2023, "Minimal AgX
// Implementation". The curve yields display code values of a 2.2 power display; they are linearised at the end.
vec3 toneMapAgx(vec3 color)
{
    const mat3 kInset = mat3(0.842479062253094, 0.0423282422610123, 0.0423756549057051,
                             0.0784335999999992, 0.878468636469772, 0.0784336,
                             0.0792237451477643, 0.0791661274605434, 0.879142973793104);
    const float kDarkestEV = -12.47393;
    const float kBrightestEV = 4.026069;
    vec3 stops = log2(max(kInset * color, vec3(exp2(kDarkestEV))));
    vec3 x = clamp((stops - kDarkestEV) / (kBrightestEV - kDarkestEV), 0.0, 1.0);
    vec3 curve = -0.00232 + x * (0.1191 + x * (0.4298 + x * (-6.868 + x * (31.96 + x * (-40.14 + x * 15.5)))));
    return pow(clamp(inverse(kInset) * curve, 0.0, 1.0), vec3(2.2));
}

vec3 toneMapped(vec3 color, uint curve)
{
    vec3 c = max(color, vec3(0.0));
    if (curve == TONEMAP_KHRONOS_NEUTRAL) return toneMapKhronosNeutral(c);
    if (curve == TONEMAP_ACES) return toneMapAces(c);
    if (curve == TONEMAP_AGX) return toneMapAgx(c);
    return c;
}

// Linear 0..1 to sRGB code values. Source: IEC 61966-2-1.
vec3 encodeSrgb(vec3 linear)
{
    vec3 c = clamp(linear, 0.0, 1.0);
    return mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, lessThanEqual(c, vec3(0.0031308)));
}
