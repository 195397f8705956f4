// The channels that are stored in fp32 and hold more than one value of a surface.
#pragma once
#include "lib/surface.glsl"

// In fp32: alpha, model, ior or F90, metallic; blinn_phong's exponent stands for its ior, a microfacet model's masking for its
// metallic.
vec4 exactMicrosurface(Surface surface)
{
    vec4 stored = vec4(surface.alpha, float(surface.model), surface.iorOrF90, surface.metallic);
#if HAS_BLINN_PHONG
    if (surface.model == MODEL_BLINN_PHONG) stored.z = surface.exponent;
#endif
#if HAS_MASKING_OPTIONS
    if (isMicrofacet(surface.model)) stored.w = float(surface.masking);
#endif
    return stored;
}

void readExactMicrosurface(vec4 stored, inout Surface surface)
{
    surface.alpha = stored.x;
    surface.model = surfaceModel(uint(stored.y));
    surface.iorOrF90 = stored.z;
    surface.metallic = stored.w;
#if HAS_BLINN_PHONG
    if (surface.model == MODEL_BLINN_PHONG) {
        surface.exponent = stored.z;
        surface.iorOrF90 = 1.0;
    }
#endif
#if HAS_MASKING_OPTIONS
    if (isMicrofacet(surface.model)) {
        surface.masking = uint(stored.w);
        surface.metallic = 0.0;
    }
#endif
}
