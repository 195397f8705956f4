// Surface properties for lighting at a point, from a rasterised material (lib/material/material.glsl) or from the
// G-buffer (lib/gbuffer/gbuffer.glsl).
#pragma once
#include "shared/models.h"
#include "shared/occlusion.h"
#include "shared/subsurface.h"
#include "lib/maths/normal_code.glsl"
#include "lib/surface/facet.glsl"

// Whether surfaces may transmit light: only in the transparent pass, whose surfaces are never stored in the G-buffer.
#ifndef BLENDED
#define BLENDED 0
#endif
#define HAS_PASSING_LIGHT (HAS_TRANSMISSION && BLENDED)

struct Surface {
    uint model;        // MODEL_*
#if !HAS_VARYING_MATERIALS
    uint material;     // number of its material
#endif
    vec3 albedo;       // k_d, or base colour of metallic_roughness
    float metallic;    // metallic_roughness
    float alpha;       // GGX alpha, >= ALPHA_MIN; along the tangent where the lobe is anisotropic
    vec3 specular;     // k_s, or the dielectric F0 of metallic_roughness
    float iorOrF90;    // index of refraction of microfacet, or the dielectric F90 of metallic_roughness
    vec3 emission;     // radiance that needs no light; all of single_color
    NormalCode normalCode; // of rasterised surfaces
    vec3 normalLS;     // unit; decoded from normalCode, or from the G-buffer channel
#if HAS_SUBSURFACE_ROWS
    uint subsurface;   // row of its constants (shared/subsurface.h); 0 for none
#endif
#if HAS_SHADOWS
    uint facetCode;    // of rasterised surfaces
    vec3 facetNormalLS; // decoded geometric normal, unit, away from the viewer
#endif
#if HAS_SHADOW_LIFT
    uint liftCode;     // shadow lift (lib/shadow/shadow_lift.glsl)
#endif
#if HAS_OCCLUSION_TEXTURE
    uint openCode;     // fraction of the environment's light that reaches it, in OPEN_BITS
#endif
    vec3 normalTexel;  // normal-map texel as stored, for the view that shows it; in the view normal_object the
                       // object-space normal, coded the same way
    float parameter;   // parameter of models with HAS_PARAMETER, >= 0: p of blinn_phong
#if HAS_MASKING_OPTIONS
    uint masking;      // MASKING_*, of the microfacet models
#endif
#if HAS_TANGENT_FRAME
    vec3 tangentLS;         // unit, at right angles to the normal; its sign does not matter
    float alphaBitangent;   // GGX alpha along cross(normal, tangent), >= ALPHA_MIN
#endif
#if HAS_CLEARCOAT
    vec2 coatNormalCode; // the coat's normal in lighting space, octahedral; all techniques decode it
    float coatFactor;    // 0 without a coat
    float coatAlpha;     // GGX alpha, >= ALPHA_MIN
#endif
#if HAS_SHEEN
    vec3 sheenColor;   // black without a sheen
    float sheenAlpha;  // alpha of the Charlie distribution, >= ALPHA_MIN
#endif
#if HAS_PASSING_LIGHT
    float transmission; // 0..1, transmitted fraction of the light that enters
    vec3 passing;       // transmitted fraction of white light, without reflection and absorption
    vec3 leftByBody;    // transmittance of the body over its thickness
    float passingIor;   // index of refraction below the surface
    float passingAlpha; // GGX alpha of the transmitting microfacets, >= ALPHA_MIN, which means smooth
    float bodyMetres;   // thickness of the body below the surface; 0 for none
#endif
};

// Position of the surface; never stored, always reconstructed from depth (lib/surface/camera.glsl).
struct Viewpoint {
    vec3 positionLS;
    vec3 toViewerLS; // unit
    float depth;     // as stored in the depth buffer
    vec2 pixel;      // window coordinates of the shaded position
};

// All techniques shade with the decoded fraction.
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

// The scene's only model if it has one, else the stored one.
uint surfaceModel(uint stored)
{
#ifdef SOLE_MODEL
    return SOLE_MODEL;
#else
    return stored;
#endif
}

// Specular colour unless a material changes it: k_s = 1, or F0 of ior 1.5.
vec3 defaultSpecular(uint model)
{
#if HAS_GLOSSY_MODELS
    if (HAS_DIELECTRIC_F0(model)) return vec3(0.04);
#endif
    return vec3(1.0);
}

// Sets members that only some scenes have to neutral values.
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

// Sets all members to neutral values; the first model is unlit.
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
