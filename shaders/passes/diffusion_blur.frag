// Diffuses light along one axis of the atlas, by a Gaussian whose width is in metres on the surface. The weights are
// the Gaussian times the length of a tap's step, normalised: uniform light stays uniform to the last digits, and a
// stretched texture changes nothing. Taps end where the surface does not continue in the chart. Interpolation between
// texels already diffuses light, by a tent as wide as the texels here and along this axis: a level adds only what its
// Gaussian's variance lacks.
#include "shared/slots.h"
#include "shared/diffusion.h"

layout(std140, binding = UNIFORM_PASS) uniform DiffusionBlurBlock
{
    DiffusionBlurConstants constants;
};

layout(binding = TEXTURE_UNIT_DIFFUSION_STEPS) uniform sampler2D steps;
layout(binding = TEXTURE_UNIT_DIFFUSION_LIGHT) uniform sampler2D light;

layout(location = 0) out vec4 diffused;
#if SUMS
layout(location = 1) out vec4 sum;
#endif

// A texel of the atlas: its light, and the length of its step; 0 outside the chart.
struct Tap {
    vec3 light;
    float stepMetres;
};

Tap tapAt(ivec2 texel, float chart)
{
    Tap tap = Tap(vec3(0.0), 0.0);
    if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, textureSize(steps, 0)))) return tap;
    vec4 own = texelFetch(steps, texel, 0);
    if (abs(own.w) != chart) return tap;
    tap.light = texelFetch(light, texel, 0).rgb;
    tap.stepMetres = constants.gaussian.y == 0.0 ? own.x : own.y;
    return tap;
}

// Along v, rows are sheared like the texture, so that a tap lies between two texels.
Tap tapBeside(ivec2 texel, int offset, float shear, float chart)
{
    if (constants.gaussian.y == 0.0) return tapAt(texel + ivec2(offset, 0), chart);
    precise float aside = shear * float(offset);
    float left = floor(aside);
    Tap a = tapAt(texel + ivec2(int(left), offset), chart);
    precise float share = aside - left;
    if (share == 0.0) return a;
    Tap b = tapAt(texel + ivec2(int(left) + 1, offset), chart);
    if (a.stepMetres == 0.0) return b;
    if (b.stepMetres == 0.0) return a;
    return Tap(mix(a.light, b.light, share), mix(a.stepMetres, b.stepMetres, share));
}

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 own = texelFetch(steps, at, 0);
#if SUMS
    // Texels outside charts are filled again.
    if (own.w <= 0.0) discard;
#else
    if (own.w == 0.0) discard;
#endif
    float chart = abs(own.w);
    Tap middle = tapAt(at, chart);
    float stepMetres = middle.stepMetres;
    // Sheared rows also diffuse light along u, as far as the square of the shear is finite.
    float askew = constants.gaussian.y == 0.0 ? min(abs(own.z), 1e6) : 0.0;
    precise float shown = constants.weight.w * (stepMetres * stepMetres) * (1.0 + askew * askew);
    float before = max(constants.gaussian.z, shown);
    precise float variance = max(constants.gaussian.x, shown) - before;
    precise vec3 lit = middle.light * stepMetres;
    precise float weights = stepMetres;
    precise float narrow = variance / max(stepMetres * stepMetres, 1e-37);
    bool isNarrow = narrow < DIFFUSION_NARROW;
    precise float perStep = sqrt(narrow);
    bool isSmooth = constants.gaussian.x <= DIFFUSION_WIDENING * DIFFUSION_WIDENING * before;
    bool isFine = !isSmooth && DIFFUSION_REACH * perStep <= float(DIFFUSION_MOST_FINE_TAPS);
    int apart = isNarrow || isFine ? 1 : int(clamp(DIFFUSION_TAP_SHARE * perStep + 0.5, 1.0, 16384.0));
    int taps = isNarrow ? 1 : int(ceil(DIFFUSION_REACH * perStep / float(apart)));
    for (int side = -1; side <= 1; side += 2) {
        precise float metres = 0.0;
        float last = stepMetres;
        for (int i = 1; i <= taps; ++i) {
            Tap tap = tapBeside(at, side * i * apart, own.z, chart);
            if (tap.stepMetres == 0.0) break;
            metres += 0.5 * float(apart) * (last + tap.stepMetres);
            last = tap.stepMetres;
            precise float weight = isNarrow ? 0.5 * narrow / (1.0 - narrow) : exp(-0.5 * metres * metres / variance);
            weight *= tap.stepMetres;
            lit += weight * tap.light;
            weights += weight;
        }
    }
    precise vec3 result = lit / max(weights, 1e-37);
    diffused = vec4(result, 1.0);
#if SUMS
    sum = vec4(constants.weight.rgb * result, 1.0);
#endif
}
