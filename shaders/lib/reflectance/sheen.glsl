// Sheen of cloth, as in KHR_materials_sheen. Source: Conty Estevez and Kulla 2017, "Production Friendly Microfacet
// Sheen BRDF": the distribution "Charlie" and fits of its masking-shadowing. alpha is the square of the perceptual
// roughness.
#pragma once
#include "lib/reflectance/brdf.glsl"

// (2 + 1/alpha) sin^(1/alpha) / 2 pi of the angle between n and h, 1/sr.
float distributionCharlie(float alpha, HalfSum h)
{
    precise float sine = min(sqrt(h.across2 / h.length2), 1.0);
    precise float cosine2 = min((h.along * h.along) / h.length2, 1.0);
    precise float inverse = 1.0 / alpha;
    precise float d = (2.0 + inverse) * powerNearOne(sine, cosine2, inverse) / (2.0 * kPi);
    return d;
}

// The fit L of table 1 of the source, between its rows for alpha 1 (first) and 0.
float charlieFit(float x, float alpha)
{
    precise float w = (1.0 - alpha) * (1.0 - alpha);
    precise float a = 21.5473 + (25.3245 - 21.5473) * w;
    precise float b = 3.82987 + (3.32435 - 3.82987) * w;
    precise float c = 0.19823 + (0.16801 - 0.19823) * w;
    precise float d = -1.97760 + (-1.27393 + 1.97760) * w;
    precise float e = -4.32054 + (-4.85967 + 4.32054) * w;
    precise float power = x > 0.0 ? exp(c * log(x)) : 0.0;
    precise float l = a / (1.0 + b * power) + d * x + e;
    return l;
}

float charlieLambda(float alpha, float cosine)
{
    precise float near = charlieFit(min(cosine, 0.5), alpha);
    precise float far = 2.0 * charlieFit(0.5, alpha) - charlieFit(max(1.0 - cosine, 0.0), alpha);
    precise float lambda = exp(cosine < 0.5 ? near : far);
    return lambda;
}

// G / (4 n.l n.v). Both cosines are clamped to 1e-6: below, the fits are invalid and D G / (4 n.l n.v) leaves fp32.
float visibilityCharlie(float alpha, float cosineLight, float cosineView)
{
    precise float masking = 1.0 + charlieLambda(alpha, cosineLight) + charlieLambda(alpha, cosineView);
    precise float v = 1.0 / (masking * (4.0 * max(cosineLight, 1e-6) * max(cosineView, 1e-6)));
    return v;
}

// Directional albedo of a white sheen, at most 1: a fit of the integral of the two functions above, made for this
// engine. ln E is a polynomial in x = n.l / r and r, the perceptual roughness; wrong by at most 0.035 for r from 0.05
// on (Sheen.theFittedAlbedoIsNearTheIntegral).
float sheenAlbedo(float alpha, float cosine)
{
    precise float r = max(sqrt(alpha), 0.05);
    precise float x = min(cosine / r, 5.0);
    precise float c0 = 0.91988 + r * (-5.00894 + r * (6.4925 + r * (-1.28465 + r * -1.16741)));
    precise float c1 = 0.184121 + r * (-10.31 + r * (16.0261 + r * (-8.39721 + r * -0.622238)));
    precise float c2 = -0.138722 + r * (-8.60875 + r * (46.7629 + r * (-71.9604 + r * 37.6528)));
    precise float c3 = -0.227684 + r * (6.143 + r * (-19.9518 + r * (30.9158 + r * -21.028)));
    precise float c4 = 0.0428847 + r * (-0.844431 + r * (2.72363 + r * (-10.4857 + r * 10.4773)));
    precise float logarithm = c0 + x * (c1 + x * (c2 + x * (c3 + x * c4)));
    precise float albedo = min(exp(logarithm), 1.0);
    return albedo;
}
