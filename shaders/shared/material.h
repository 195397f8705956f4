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

// RGBA32UI texels of a material in the table of all of them, which lighting reads where pixels hold only their
// material's number: what lies before uvRow0. As many materials as a pixel's 11 bits can name, a third of the 65536
// texels that OpenGL 4.5 guarantees.
#define MATERIAL_TEXELS 9
#define MATERIAL_TABLE_MOST 2048

// Added to a slot's wrap modes for --filter exact: its texture holds sRGB code values, which the shader decodes; its
// sampler takes the nearest texel where it magnifies, and where it minifies; it magnifies up to half a level, not 0.
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
                       // subsurface (subsurface.h), 0 without one; z the power of the albedo before light spreads; w
                       // occlusion's strength
    vec4 anisotropy;   // x strength, or alpha along the bitangent (microfacet_anisotropic); y z
                     // direction of its texture's x axis, along tangent and bitangent; w -1 where it mirrors y against
                     // that, else 1
    vec4 clearcoat;                  // x factor, y perceptual roughness, z normal-map scale
    vec4 sheen;                      // rgb colour, a perceptual roughness
    uvec4 kind;                      // x model, y flags, z masking, w number of the material
    vec4 uvRow0[TEXTURE_SLOT_COUNT]; // x y z: u' = x u + y v + z; w texture-coordinate set
    vec4 uvRow1[TEXTURE_SLOT_COUNT]; // x y z: v' = x u + y v + z; w for --filter exact: wrap modes, u + 4 v,
                                     // and TEXTURE_MODE_*
    vec4 clearcoatTurn;              // x y z: of the coat's normal map, as y z w of anisotropy
    vec4 transmission;               // x share of what enters that passes, 0 where the model lets none through; y 1
                                     // where opacity covers, as of alpha-blended ones; z metres of the body below
    vec4 attenuation;                // rgb natural logarithm of what the body leaves of white light that goes as far as
                                     // it is thick; a half the spread of its indices of refraction over what they are
                                     // above 1, 0 where all colours bend alike
    vec4 film; // x share, 0 where there is none; y index of refraction; z thickness in micrometres where its texture
               // is 1 or there is none; w where the texture is 0
};

SHARED_END
