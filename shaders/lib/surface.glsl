// What lighting needs to know of a point, wherever it comes from: a material as it is rasterised (lib/material.glsl) or the
// G-buffer (lib/gbuffer.glsl).
#pragma once
#include "shared/models.h"

struct Surface {
    uint model;        // MODEL_*
    vec3 albedo;       // k_d, or base colour of metallic_roughness
    float metallic;    // metallic_roughness
    float alpha;       // GGX alpha, >= ALPHA_MIN
    vec3 specular;     // k_s, or the dielectric F0 of metallic_roughness
    float iorOrF90;    // index of refraction of microfacet, or the dielectric F90 of metallic_roughness
    vec3 emission;     // radiance that needs no light; all of single_color
    vec3 normalLS;     // unit
    vec3 normalTexel;  // the normal map's texel as stored, for the view that shows it
};

// Where the surface is; never stored, always rebuilt from depth (lib/camera.glsl).
struct Viewpoint {
    vec3 positionLS;
    vec3 toViewerLS; // unit
    float depth;     // as stored in the depth buffer
};

// The model of every surface when the scene uses only one, else the stored one.
uint surfaceModel(uint stored)
{
#ifdef SOLE_MODEL
    return SOLE_MODEL;
#else
    return stored;
#endif
}

// The dielectric lobe where no material changes it: k_s = 1, or F0 of ior 1.5.
vec3 defaultSpecular(uint model)
{
    return model == MODEL_MICROFACET ? vec3(1.0) : vec3(0.04);
}
