// Reflectance of a surface with a thin film: light reflected by the film's two sides interferes (docs/iridescence.md).
#pragma once
#include "lib/reflectance/brdf.glsl"

// Number of summed interference terms: light reflected back and forth m times has the phase of m path differences.
const int kFilmWaves = 4;

// Linear sRGB from CIE XYZ. Source: IEC 61966-2-1.
const mat3 kRgbFromXyz = mat3(3.2404542, -0.9692660, 0.0556434,
                              -1.5371385, 1.8760108, -0.2040259,
                              -0.4985314, 0.0415560, 1.0572252);

// Colour of a reflectance of cos(2 pi way / wavelength), with `way` the path difference: 1 by channel for a way of 0,
// since a constant spectrum has no colour. The eye's sensitivities are Gaussians of the wave number, x two of them; so
// are their Fourier transforms. Source: Belcour and Barla 2017, supplemental code.
vec3 colorOfWave(float wayMicrometres)
{
    const vec4 kWaveNumbers = vec4(1.6810, 2.2399, 1.7953, 2.2084); // x, x, y, z, in 1/micrometre
    const vec4 kHalfVariances = vec4(4.3278e-3, 4.5282e-3, 9.3046e-3, 6.6121e-3);
    const float kShareOfSecond = 0.1537978; // weight in x: height times width
    precise vec4 cycles = wayMicrometres * kWaveNumbers;
    precise vec4 turns = cycles - floor(cycles + 0.5); // drivers' cosines are accurate for small angles
    precise float frequency = 2.0 * kPi * wayMicrometres;
    precise vec4 waves = cos(2.0 * kPi * turns) * exp(-(frequency * frequency) * kHalfVariances);
    precise vec3 xyz = vec3(waves.x + kShareOfSecond * (waves.y - waves.x), waves.z, waves.w);
    precise vec3 color = (kRgbFromXyz * xyz) / (kRgbFromXyz * vec3(1.0));
    return color;
}

// Reflectance with the film; f0: at normal incidence without it; `cosine`: that of the angle of incidence, > 0.
vec3 filmReflectance(vec3 f0, float cosine, float ior, float thicknessMicrometres)
{
    precise float inverse = 1.0 / ior;
    precise float inside2 = 1.0 - inverse * inverse * (1.0 - cosine * cosine);
    precise float inside = sqrt(max(inside2, 0.0)); // cosine of the angle in the film
    precise float above = (ior - 1.0) / (ior + 1.0);
    float outer = fresnelSchlick(vec3(above * above), vec3(1.0 - above * above), cosine).x;
    // Amplitude (n2 - n3) / (n2 + n3) for the index n3 = (1 + sqrt(f0)) / (1 - sqrt(f0)), which may be infinite.
    precise vec3 root = sqrt(clamp(f0, vec3(0.0), vec3(1.0)));
    precise vec3 slow = ior * (1.0 - root);
    precise vec3 below = (slow - (1.0 + root)) / (slow + (1.0 + root));
    vec3 inner = fresnelSchlick(below * below, 1.0 - below * below, min(inside, 1.0));
    precise float passed = 1.0 - outer;
    precise vec3 both = outer * inner;
    precise vec3 returned = (passed * passed) * inner / max(1.0 - both, vec3(1e-6));
    // Reflection at a denser medium shifts the phase by half a wave; also if the indices differ by rounding only.
    precise vec3 ratio = sqrt(both) * (2.0 * vec3(greaterThan(below, vec3(1e-5))) - 1.0);
    precise float way = 2.0 * ior * thicknessMicrometres * inside;
    precise vec3 reflected = vec3(outer) + returned;
    precise vec3 amplitude = returned - passed;
    for (int m = 1; m <= kFilmWaves; ++m) {
        amplitude *= ratio;
        reflected += 2.0 * amplitude * colorOfWave(float(m) * way);
    }
    return clamp(reflected, vec3(0.0), vec3(1.0)); // some of these colours are outside sRGB
}
