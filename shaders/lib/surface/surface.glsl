// The surface properties that lighting needs at a point, from a rasterised material (lib/material/material.glsl) or from the
// G-buffer (lib/gbuffer/gbuffer.glsl).
#pragma once
#include "shared/models.h"
#include "shared/occlusion.h"
#include "shared/subsurface.h"
#include "lib/maths/normal_code.glsl"
#include "lib/surface/facet.glsl"

// Whether light may pass through surfaces: the transparent pass draws those, and none is ever stored.
#ifndef BLENDED
#define BLENDED 0
#endif
#define HAS_PASSING_LIGHT (HAS_TRANSMISSION && BLENDED)

struct Surface {
    uint model;        // MODEL_*
#if !HAS_VARYING_MATERIALS
    uint material;     // its number
#endif
    vec3 albedo;       // k_d, or base colour of metallic_roughness
    float metallic;    // metallic_roughness
    float alpha;       // GGX alpha, >= ALPHA_MIN; along the tangent where the lobe is anisotropic
    vec3 specular;     // k_s, or the dielectric F0 of metallic_roughness
    float iorOrF90;    // index of refraction of microfacet, or the dielectric F90 of metallic_roughness
    vec3 emission;     // radiance that needs no light; all of single_color
    NormalCode normalCode; // of surfaces that are rasterised
    vec3 normalLS;     // unit; of a drawn surface what the code says, of a stored one what its channel does
#if HAS_SUBSURFACE_ROWS
    uint subsurface;   // row of its constants (shared/subsurface.h); 0 where it has none
#endif
#if HAS_SHADOWS
    uint facetCode;    // of surfaces that are rasterised
    vec3 facetNormalLS; // what it says: the normal of the triangle, unit, away from the viewer
#endif
#if HAS_SHADOW_LIFT
    uint liftCode;     // how far above it shadows are asked for (lib/shadow/shadow_lift.glsl)
#endif
#if HAS_OCCLUSION_TEXTURE
    uint openCode;     // the share of the environment's light that arrives, of OPEN_BITS
#endif
    vec3 normalTexel;  // the normal map's texel as stored, for the view that shows it; for the view
                       // normal_object that normal, coded the same way
    float parameter;   // the one of models that HAS_PARAMETER, >= 0: p of blinn_phong
#if HAS_MASKING_OPTIONS
    uint masking;      // MASKING_*, of the microfacet models
#endif
#if HAS_TANGENT_FRAME
    vec3 tangentLS;         // unit, at right angles to the normal; its sign does not matter
    float alphaBitangent;   // GGX alpha along cross(normal, tangent), >= ALPHA_MIN
#endif
#if HAS_CLEARCOAT
    vec2 coatNormalCode; // the coat's own normal in lighting space, octahedral: all techniques decode the stored code
    float coatFactor;    // 0 where there is no coat
    float coatAlpha;     // GGX alpha, >= ALPHA_MIN
#endif
#if HAS_SHEEN
    vec3 sheenColor;   // black where there is no sheen
    float sheenAlpha;  // alpha of the Charlie distribution, >= ALPHA_MIN
#endif
#if HAS_PASSING_LIGHT
    float transmission; // 0..1, share of what enters that passes
    vec3 passing;       // share of white light that passes, before surface and layers reflect and the body absorbs
    vec3 leftByBody;    // what a body leaves of white light that goes as far as it is thick
    float passingIor;   // index of refraction below the surface
    float passingAlpha; // GGX alpha of the transmitting microfacets, >= ALPHA_MIN, which means smooth
    float bodyMetres;   // how thick the body below the surface is; 0 where there is none
#endif
};

// Where the surface is; never stored, always rebuilt from depth (lib/surface/camera.glsl).
struct Viewpoint {
    vec3 positionLS;
    vec3 toViewerLS; // unit
    float depth;     // as stored in the depth buffer
    vec2 pixel;      // window coordinates of its centre
};

// All techniques light the stored code of a share.
const uint OPEN_MOST = (1u << OPEN_BITS) - 1u;

uint encodeOpen(float share)
{
    precise float code = clamp(share, 0.0, 1.0) * float(OPEN_MOST) + 0.5;
    return uint(code);
}

float decodeOpen(uint code)
{
    precise float share = float(code) / float(OPEN_MOST);
    return share;
}

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
#if HAS_GLOSSY_MODELS
    if (HAS_DIELECTRIC_F0(model)) return vec3(0.04);
#endif
    return vec3(1.0);
}

// Members that only some scenes have, where nothing sets them.
void setNeutralLobes(inout Surface surface)
{
#if !HAS_VARYING_MATERIALS
    surface.material = 0u;
#endif
#if HAS_SUBSURFACE_ROWS
    surface.subsurface = 0u;
#endif
#if HAS_MASKING_OPTIONS
    surface.masking = MASKING_WALTER;
#endif
#if HAS_OCCLUSION_TEXTURE
    surface.openCode = OPEN_MOST;
#endif
#if HAS_TANGENT_FRAME
    surface.tangentLS = vec3(1.0, 0.0, 0.0);
    surface.alphaBitangent = 1.0;
#endif
#if HAS_CLEARCOAT
    surface.coatNormalCode = vec2(0.0);
    surface.coatFactor = 0.0;
    surface.coatAlpha = 1.0;
#endif
#if HAS_SHEEN
    surface.sheenColor = vec3(0.0);
    surface.sheenAlpha = 1.0;
#endif
#if HAS_PASSING_LIGHT
    surface.transmission = 0.0;
    surface.passing = vec3(0.0);
    surface.leftByBody = vec3(1.0);
    surface.passingIor = 1.0;
    surface.passingAlpha = ALPHA_MIN;
    surface.bodyMetres = 0.0;
#endif
}

// A surface of which nothing is known; the first model is unlit.
void setNeutralValues(inout Surface surface)
{
    surface.specular = vec3(0.0);
    surface.model = surfaceModel(0u);
    surface.albedo = vec3(0.0);
    surface.metallic = 0.0;
    surface.alpha = 1.0;
    surface.iorOrF90 = 1.0;
    surface.parameter = 0.0;
    surface.emission = vec3(0.0);
    surface.normalCode = NormalCode(uvec2(NORMAL_NO_SHARE), 2u);
    surface.normalLS = vec3(0.0, 0.0, 1.0);
    surface.normalTexel = vec3(0.5, 0.5, 1.0);
#if HAS_SHADOWS
    surface.facetCode = 0u;
    surface.facetNormalLS = vec3(0.0, 0.0, 1.0);
#endif
#if HAS_SHADOW_LIFT
    surface.liftCode = 0u;
#endif
    setNeutralLobes(surface);
}
