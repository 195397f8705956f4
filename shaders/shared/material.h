#pragma once
// A material's constants; one range of the material buffer, bound for each batch of draws.
#include "interop.h"
#include "slots.h"

#define MATERIAL_FLAG_NORMAL_MAP 1u
#define MATERIAL_FLAG_OBJECT_SPACE_NORMAL 2u
#define MATERIAL_FLAG_ALPHA_MASK 4u
#define MATERIAL_FLAG_DOUBLE_SIDED 8u
#define MATERIAL_FLAG_IOR_TEXTURE 16u
#define MATERIAL_FLAG_ANISOTROPY_TEXTURE 32u
#define MATERIAL_FLAG_CLEARCOAT_NORMAL_MAP 64u
#define MATERIAL_FLAG_HOOKED 128u
#define MATERIAL_FLAG_CLOSED 256u // a body whose meshes are all closed

// RGBA32UI texels per material in the table of all materials, which lighting reads if pixels store only a material
// number: the members before uvRow0. The maximum is what a pixel's 11 bits can index; it takes a third of the 65536
// texels that OpenGL 4.5 guarantees.
#define MATERIAL_TEXELS 9
#define MATERIAL_TABLE_MOST 2048

// Flags added to a slot's wrap modes for --filter exact: the texture holds sRGB code values, which the shader decodes;
// the filter is nearest for magnification; for minification; magnification extends to half a level, not 0.
#define TEXTURE_MODE_SRGB 16
#define TEXTURE_MODE_MAGNIFIES_NEAREST 32
#define TEXTURE_MODE_MINIFIES_NEAREST 64
#define TEXTURE_MODE_HALF_LEVEL 128

SHARED_BEGIN

struct MaterialConstants {
    vec4 baseColor;    // rgb base colour, k_d or the colour; a opacity
    vec4 emissive;     // rgb radiance; a alpha cutoff
    vec4 microsurface; // x metallic, y scenes::MaterialModelInfo::roughness (perceptual roughness, alpha,
                       // exponent), z ior, w normal-map scale
    vec4 specular;     // rgb k_s, or the tint of the dielectric F0; a specular factor
    vec4 mixed;        // x F0 of the ior, computed in double so that ior 1.5 gives 0.04 to the last bit; y row of its
                       // subsurface (subsurface.h), 0 without one; z power of the albedo applied before diffusion; w
                       // occlusion strength
    vec4 anisotropy;   // x strength, or alpha along the bitangent (microfacet_anisotropic); y z direction of its
                       // texture's x axis, along tangent and bitangent; w -1 if the texture mirrors y, else 1
    vec4 clearcoat;    // x factor, y perceptual roughness, z normal-map scale
    vec4 sheen;        // rgb colour, a perceptual roughness
    uvec4 kind;        // x model, y flags, z masking, w number of the material
    vec4 uvRow0[TEXTURE_SLOT_COUNT]; // x y z: u' = x u + y v + z; w texture-coordinate set
    vec4 uvRow1[TEXTURE_SLOT_COUNT]; // x y z: v' = x u + y v + z; w for --filter exact: wrap modes, u + 4 v,
                                     // and TEXTURE_MODE_*
    vec4 clearcoatTurn;              // x y z as y z w of anisotropy, for the coat's normal map
    vec4 transmission;               // x transmitted fraction of entering light, 0 if the model transmits none; y 1 if
                                     // opacity is coverage (alpha blending); z thickness of the body in metres
    vec4 attenuation;                // rgb natural logarithm of the body's transmittance over its thickness; a half the
                                     // spread of its indices of refraction, relative to their excess over 1, 0 without
                                     // dispersion
    vec4 film; // x iridescence factor, 0 if none; y index of refraction; z thickness in micrometres where its texture
               // is 1 or absent; w where the texture is 0
};

SHARED_END
