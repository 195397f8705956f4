// Subsurface scattering as far as it is computed per light (scenes/Subsurface.h, docs/skin.md): wrapped and transmitted
// light.
#pragma once
#include "shared/slots.h"
#include "shared/subsurface.h"
#include "lib/surface/surface.glsl"

#if HAS_SUBSURFACE_ROWS
layout(std140, binding = UNIFORM_SUBSURFACE) uniform SubsurfaceBlock
{
    SubsurfaceConstants subsurfaces[SUBSURFACE_MOST];
};
#endif

// The part of an albedo applied before diffusion, or after it. The powers 0 and 1 are exact.
vec3 powerOf(vec3 albedo, float power)
{
    if (power == 0.0) return vec3(1.0);
    if (power == 1.0) return albedo;
    return pow(max(albedo, vec3(0.0)), vec3(power));
}

#if HAS_SUBSURFACE_PASSAGE
bool letsLightThrough(Surface surface)
{
    return subsurfaces[surface.subsurface].absorption.a != 0.0;
}

// Transmittance, by channel, after this way inside.
vec3 shareAfter(Surface surface, float metres)
{
    precise vec3 share = exp(-subsurfaces[surface.subsurface].absorption.rgb * metres);
    return share;
}
#endif

#if HAS_SUBSURFACE_WRAP
// Excess of (n.l + w) / (1 + w), at least 0, over n.l, at least 0. Over all directions of light that adds w pi to the
// pi of a cosine. Source: Green 2004, "Real-Time Approximations to Subsurface Scattering", GPU Gems, chapter 16; with a
// w for each channel, the tint shows where n.l is low.
vec3 wrappedExcess(Surface surface, float cosine)
{
    vec3 wrap = subsurfaces[surface.subsurface].wrap.rgb;
    precise float lit = clamp(cosine, 0.0, 1.0);
    precise vec3 excess = (cosine < 0.0 ? max(cosine + wrap, vec3(0.0)) : wrap * (1.0 - lit)) / (1.0 + wrap);
    return excess;
}

// Height in metres above the surface at which shadow look-ups of wrapped light start. On a body of that radius the way
// to a light below the horizon then misses the body, up to a wrap of 0.85; other casters in the way hide the light.
float liftMetres(Surface surface, float cosine)
{
    vec4 wrap = subsurfaces[surface.subsurface].wrap;
    if (wrap.rgb == vec3(0.0)) return 0.0;
    precise float metres = wrap.a * max(SUBSURFACE_LIFT_COSINE - cosine, 0.0);
    return metres;
}

bool wrapsLight(Surface surface)
{
    return subsurfaces[surface.subsurface].wrap.rgb != vec3(0.0);
}
#endif
