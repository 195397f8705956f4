// Microfacet terms, each in a form that keeps its digits in fp32 (bounds in docs/numerics.md). Everything is `precise`,
// so that no compiler contracts one technique's copy differently from another's.
#pragma once
#include "lib/maths/math.glsl"

// The sum l + v of the unit vectors to a light and to a viewer, split along the unit normal n. Its direction is the
// half vector h; terms divide by its squared length where they need h.
struct HalfSum {
    vec3 across;   // the part perpendicular to n; as accurate as n x h: both err by the last digit of the sum
    float across2; // |across|^2 = |n x h|^2 length2
    float along;   // n.(l + v); n.l + n.v would add their rounding to |l + v|, which is small where l is near -v
    float length2; // 0 where l = -v
};

HalfSum halfSum(vec3 n, vec3 toLight, vec3 toViewer)
{
    precise vec3 sum = toLight + toViewer;
    precise float along = dot(n, sum);
    precise vec3 across = sum - n * along;
    precise float across2 = dot(across, across);
    precise float length2 = across2 + along * along;
    return HalfSum(across, across2, along, length2);
}

// The same for a half vector: both directions are h.
HalfSum halfSumAlong(vec3 n, vec3 h)
{
    return halfSum(n, h, h);
}

// l.h = v.h, half the sum's length; more than 1 by its rounding at most.
float halfCosine(HalfSum h)
{
    precise float cosine = 0.5 * sqrt(h.length2);
    return cosine;
}

// GGX distribution of normals. Source: Walter 2007, "Microfacet Models for Refraction through Rough Surfaces", eq. 33,
// rewritten as alpha^2 / (pi t^2) with t = alpha^2 (n.h)^2 + |n x h|^2: 1 - (n.h)^2 would cancel near the peak.
// `alpha2`: alpha squared; `scale`: ggxScale().
float distributionGgx(float alpha2, float scale, HalfSum h)
{
    if (!(h.along > 0.0)) return 0.0;
    precise float inverse = h.length2 / (alpha2 * (h.along * h.along) + h.across2); // 1 / t
    precise float d = scale * (inverse * inverse);
    return d;
}

// The factor alpha^2 / pi of the distribution, the same for every light.
float ggxScale(float alpha2)
{
    precise float scale = alpha2 * kInversePi;
    return scale;
}

// The same with alpha x along the unit tangent and alpha y along the bitangent. Source: Burley 2012, "Physically-Based
// Shading at Disney", appendix B.1; Heitz 2014, eq. 84. Equal alphas give distributionGgx to rounding.
float distributionGgxAnisotropic(vec2 alpha, vec3 n, vec3 tangent, HalfSum h)
{
    if (!(h.along > 0.0)) return 0.0;
    precise vec2 slope = vec2(dot(h.across, tangent), dot(h.across, cross(n, tangent))) / alpha;
    precise float inverse = h.length2 / (h.along * h.along + dot(slope, slope));
    precise float d = (inverse * inverse) / (kPi * (alpha.x * alpha.y));
    return d;
}

// sqrt(alpha^2 + (1 - alpha^2) c^2), the length that Smith's masking-shadowing compares with the cosine c.
float smithLength(float alpha2, float cosine)
{
    precise float q = sqrt(alpha2 + (1.0 - alpha2) * (cosine * cosine));
    return q;
}

// The same for an anisotropic lobe, with the alpha along the direction's projection on the surface: its components t
// and b along tangent and bitangent give alpha^2 (1 - c^2) = (alpha x t)^2 + (alpha y b)^2. Source: Heitz 2014, eq. 80.
float smithLengthAnisotropic(vec2 alpha, vec3 n, vec3 tangent, vec3 direction)
{
    precise float cosine = dot(n, direction);
    precise vec2 stretched = alpha * vec2(dot(tangent, direction), dot(cross(n, tangent), direction));
    precise float q = sqrt(cosine * cosine + dot(stretched, stretched));
    return q;
}

// alpha^2 along the projection of the microfacet normal h, as Walter's masking-shadowing uses for the anisotropic lobe.
// Where h = n the projection has no direction, and the result is the mean of both squares.
float alpha2Along(vec2 alpha, vec3 n, vec3 tangent, HalfSum h)
{
    // An angle of 1e-15 is far below the rounding of h, and its square still far above the smallest fp32 number.
    const float kNoDirection = 1e-30;
    precise vec2 parts = vec2(dot(h.across, tangent), dot(h.across, cross(n, tangent)));
    precise float length2 = dot(parts, parts);
    precise vec2 share = length2 > kNoDirection * h.length2 ? (parts * parts) / length2 : vec2(0.5);
    precise float alpha2 = dot(alpha * alpha, share);
    return alpha2;
}

// G / (4 n.l n.v) for separable Smith masking-shadowing, G = G1(l) G1(v), from the lengths of both directions. Source:
// Walter 2007, eq. 23 and 34; the cosines of G1's numerator cancel against the denominator, so grazing directions
// divide by nothing small. Needs both cosines > 0.
float visibilitySeparable(float cosineLight, float lengthLight, float cosineView, float lengthView)
{
    precise float v = 1.0 / ((cosineLight + lengthLight) * (cosineView + lengthView));
    return v;
}

// G / (4 n.l n.v) where G1 depends on the angle to the half vector instead of the normal, as in a well-known course
// handout. Gains energy at grazing angles. Nothing cancels the cosines here; n.v is clamped to 1e-6 as in the handout,
// n.l to a value that only keeps D G / (4 n.l n.v) finite. cosineHalf is l.h = v.h.
float visibilityHalfVector(float alpha2, float cosineLight, float cosineView, float cosineHalf)
{
    if (!(cosineHalf > 0.0)) return 0.0;
    precise float g1 = 2.0 * cosineHalf / (cosineHalf + smithLength(alpha2, cosineHalf));
    precise float v = g1 * g1 / (4.0 * max(cosineLight, 1e-20) * max(cosineView, 1e-6));
    return v;
}

// As visibilitySeparable, for height-correlated Smith masking-shadowing. Source: Heitz 2014, "Understanding
// the Masking-Shadowing Function in Microfacet-Based BRDFs", eq. 99. Needs both cosines > 0.
float visibilityCorrelated(float cosineLight, float lengthLight, float cosineView, float lengthView)
{
    precise float v = 0.5 / (cosineLight * lengthView + cosineView * lengthLight);
    return v;
}

// The rounding error of x * x, exactly. Source: Dekker 1971, "A Floating-Point Technique for Extending the Available
// Precision" (with Veltkamp's splitting: 4097 = 2^12 + 1). No fma(), which drivers may round twice.
float squareRemainder(float x, float square)
{
    precise float t = 4097.0 * x;
    precise float high = t - (t - x);
    precise float low = x - high;
    precise float remainder = ((high * high - square) + 2.0 * high * low) + low * low;
    return remainder;
}

// Fresnel reflectance of a smooth dielectric for unpolarised light; ior is n2/n1, cosine that between light and half
// vector. Source: Cook and Torrance 1982; g - c is computed as (ior - 1)(ior + 1) / (g + c), accurate near ior = 1.
// Into a thinner medium g^2 = c^2 + ior^2 - 1 cancels at the critical angle, where F falls like its root.
float fresnelDielectric(float ior, float cosine)
{
    precise float c = abs(cosine);
    precise float contrast = (ior - 1.0) * (ior + 1.0);
    if (contrast == 0.0) return 0.0;
    precise float c2 = c * c;
    precise float g2 = contrast + c2;
    if (ior < 1.0) {
        precise float ior2 = ior * ior;
        // Near the critical angle the larger is at least a half, so both differences are exact.
        precise float rounded = (max(c2, ior2) - 1.0) + min(c2, ior2);
        g2 = rounded + (squareRemainder(c, c2) + squareRemainder(ior, ior2));
    }
    if (g2 < 0.0) return 1.0; // total internal reflection
    precise float sum = sqrt(g2) + c;
    precise float difference = contrast / sum;
    precise float a = difference / sum;
    precise float b = (c * sum - 1.0) / (c * difference + 1.0);
    precise float f = 0.5 * (a * a) * (1.0 + b * b);
    return f;
}

// Schlick's approximation from f0 to f90 = f0 + rise. Source: Schlick 1994, "An Inexpensive BRDF Model for
// Physically-based Rendering".
vec3 fresnelSchlick(vec3 f0, vec3 rise, float cosine)
{
    precise float m = 1.0 - cosine;
    precise float m2 = m * m;
    precise float m5 = m2 * m2 * m;
    precise vec3 f = f0 + rise * m5;
    return f;
}

// x^exponent for x in 0..1, given 1 - x^2 with more digits than x has: ln x = -atanh(r) with r = (1 - x^2)/(1 + x^2),
// whose series needs five terms where x is near 1 (the next is below 1e-9 of the sum). 0^0 = 1.
float powerNearOne(float x, float oneMinusX2, float exponent)
{
    if (!(exponent > 0.0)) return 1.0;
    if (!(x > 0.0)) return 0.0;
    precise float r = oneMinusX2 / (2.0 - oneMinusX2);
    precise float r2 = r * r;
    precise float series = r * (1.0 + r2 * (1.0 / 3.0 + r2 * (1.0 / 5.0 + r2 * (1.0 / 7.0 + r2 * (1.0 / 9.0)))));
    precise float logarithm = oneMinusX2 < 0.25 ? -series : log(x);
    precise float power = exp(exponent * logarithm);
    return power;
}

// Blinn-Phong highlight (n.h)^p. Source: Blinn 1977, "Models of Light Reflection for Computer Synthesized Pictures". 1
// - (n.h)^2 = |n x h|^2 keeps the digits that a large exponent multiplies.
float blinnPhongLobe(float exponent, HalfSum h)
{
    precise float cosine = clamp(h.along / sqrt(h.length2), 0.0, 1.0);
    precise float lobe = powerNearOne(cosine, min(h.across2 / h.length2, 1.0), exponent);
    return lobe;
}
