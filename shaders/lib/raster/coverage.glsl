// Sample coverage of alpha-masked materials. The prepass and shading use the same function, so that both keep the same
// samples. Source: B. Golus 2017, "Anti-aliased Alpha Test: The Esoteric Alpha To Coverage".
#pragma once
#include "lib/material/material.glsl"

#if HAS_ALPHA_MASK && SAMPLES > 1
// Sharpens alpha around the cutoff until its edge is one pixel wide, whatever the texture's magnification; the result
// is the covered fraction of the pixel, rounded to whole samples. Sets the lowest bits instead of leaving the choice to
// the driver's alpha-to-coverage. Call in uniform control flow, because of the derivative.
int maskedSamples(vec4 baseColor)
{
    precise float cutoff = material.emissive.a;
    precise float above = baseColor.a - cutoff;
    precise float width = fwidth(baseColor.a);
    precise float share = width > 0.0 ? clamp(above / width + 0.5, 0.0, 1.0) : (above >= 0.0 ? 1.0 : 0.0);
    precise float samples = floor(share * float(SAMPLES) + 0.5);
    bool whole = (material.kind.y & MATERIAL_FLAG_ALPHA_MASK) == 0u || cutoff <= 0.0;
    return whole ? ~0 : (1 << int(samples)) - 1;
}

// True if the fragment covers no sample; otherwise gl_SampleMask holds the covered samples.
bool coversNothing(vec4 baseColor)
{
    int samples = maskedSamples(baseColor);
    gl_SampleMask[0] = samples;
    return samples == 0;
}
#else
bool coversNothing(vec4 baseColor)
{
    return materialCutOut(baseColor);
}
#endif
