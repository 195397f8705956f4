// The channels that are stored in fp32 and hold more than one value of a surface.
#pragma once
#include "lib/surface.glsl"

// In fp32: alpha, model, ior or F90, metallic; the one parameter of a model stands for its ior, a microfacet model's masking for its
// metallic.
vec4 exactMicrosurface(Surface surface)
{
    vec4 stored = vec4(surface.alpha, float(surface.model), surface.iorOrF90, surface.metallic);
    if (HAS_PARAMETER(surface.model)) stored.z = surface.parameter;
#if HAS_MASKING_OPTIONS
    if (IS_MICROFACET(surface.model)) stored.w = float(surface.masking);
#endif
    return stored;
}

void readExactMicrosurface(vec4 stored, inout Surface surface)
{
    surface.alpha = stored.x;
    surface.model = surfaceModel(uint(stored.y));
    surface.iorOrF90 = stored.z;
    surface.metallic = stored.w;
    if (HAS_PARAMETER(surface.model)) {
        surface.parameter = stored.z;
        surface.iorOrF90 = 1.0;
    }
#if HAS_MASKING_OPTIONS
    if (IS_MICROFACET(surface.model)) {
        surface.masking = uint(stored.w);
        surface.metallic = 0.0;
    }
#endif
}
