// A material's constants and textures at a fragment. Every value is factor x texel; an empty slot samples white, which
// keeps the factor to the last bit. Textures are fetched outside any branch on per-pixel values, with implicit
// derivatives, by the same call in every pass: explicit gradients would give other texels.
#pragma once
#include "shared/slots.h"
#include "shared/hook.h"
#include "shared/material.h"
#include "shared/views.h"
#include "lib/material/texture_filter.glsl"

#if MATERIAL_FROM_TABLE
MaterialConstants material; // lib/material/material_table.glsl reads it
#else
layout(std140, binding = UNIFORM_MATERIAL) uniform MaterialBlock
{
    MaterialConstants material;
};
#endif

layout(binding = TEXTURE_SLOT_BASE_COLOR) uniform sampler2D baseColorTexture;
layout(binding = TEXTURE_SLOT_NORMAL) uniform sampler2D normalTexture;
layout(binding = TEXTURE_SLOT_METALLIC_ROUGHNESS) uniform sampler2D metallicRoughnessTexture;
layout(binding = TEXTURE_SLOT_EMISSIVE) uniform sampler2D emissiveTexture;
layout(binding = TEXTURE_SLOT_SPECULAR_FACTOR) uniform sampler2D specularFactorTexture;
layout(binding = TEXTURE_SLOT_SPECULAR_COLOR) uniform sampler2D specularColorTexture;
layout(binding = TEXTURE_SLOT_IOR) uniform sampler2D iorTexture;
layout(binding = TEXTURE_SLOT_ANISOTROPY) uniform sampler2D anisotropyTexture;
layout(binding = TEXTURE_SLOT_CLEARCOAT) uniform sampler2D clearcoatTexture;
layout(binding = TEXTURE_SLOT_CLEARCOAT_ROUGHNESS) uniform sampler2D clearcoatRoughnessTexture;
layout(binding = TEXTURE_SLOT_CLEARCOAT_NORMAL) uniform sampler2D clearcoatNormalTexture;
layout(binding = TEXTURE_SLOT_SHEEN_COLOR) uniform sampler2D sheenColorTexture;
layout(binding = TEXTURE_SLOT_SHEEN_ROUGHNESS) uniform sampler2D sheenRoughnessTexture;
layout(binding = TEXTURE_SLOT_OCCLUSION) uniform sampler2D occlusionTexture;
layout(binding = TEXTURE_SLOT_TRANSMISSION) uniform sampler2D transmissionTexture;
layout(binding = TEXTURE_SLOT_THICKNESS) uniform sampler2D thicknessTexture;
layout(binding = TEXTURE_SLOT_IRIDESCENCE) uniform sampler2D iridescenceTexture;
layout(binding = TEXTURE_SLOT_IRIDESCENCE_THICKNESS) uniform sampler2D iridescenceThicknessTexture;

// Interpolated attributes of a fragment.
struct Fragment {
    vec3 normalLS;      // not unit
    vec4 tangentLS;     // xyz not unit, w handedness with the node's mirroring
    TexCoord texCoord[2];
#if FILTER_EXACT && HAS_MIXED_FILTERS
    dmat2 texCoordChange[2]; // change per pixel: first column to the right, second up
#endif
    vec4 color;
    mat3 normalFromObject; // cofactor matrix of the node, with its mirroring
    bool frontFacing;
    vec3 toViewerLS;    // unit; 0 without a viewer, as in an atlas
    float leastFacing;  // minimum cosine between shading normals and it; 0 without a viewer
#if HOOKED
    vec3 positionOS;
    int instance; // index of the mesh instance in the scene
#endif
#if HAS_SHADOWS
    vec3 facetNormalLS; // of the triangle; unit, away from the viewer
#endif
#if HAS_SHADOW_LIFT
    uint liftCode;      // shadow lift (lib/shadow/shadow_lift.glsl)
#endif
#if VIEW == VIEW_NORMAL_OBJECT
    mat3 objectFromNormal; // transposed LS-from-object: transforms normals back, up to their length
#endif
};

// A fragment without interpolated attributes.
Fragment plainFragment()
{
    Fragment fragment;
    fragment.normalLS = vec3(0.0, 0.0, 1.0);
#if HAS_SHADOWS
    fragment.facetNormalLS = vec3(0.0, 0.0, 1.0);
#endif
#if HAS_SHADOW_LIFT
    fragment.liftCode = 0u;
#endif
    fragment.tangentLS = vec4(0.0);
    fragment.texCoord[0] = TexCoord(0.0);
    fragment.texCoord[1] = TexCoord(0.0);
#if FILTER_EXACT && HAS_MIXED_FILTERS
    fragment.texCoordChange[0] = dmat2(0.0);
    fragment.texCoordChange[1] = dmat2(0.0);
#endif
    fragment.color = vec4(1.0);
    fragment.normalFromObject = mat3(1.0);
    fragment.frontFacing = true;
    fragment.toViewerLS = vec3(0.0);
    fragment.leastFacing = 0.0;
#if HOOKED
    fragment.positionOS = vec3(0.0);
    fragment.instance = 0;
#endif
#if VIEW == VIEW_NORMAL_OBJECT
    fragment.objectFromNormal = mat3(1.0);
#endif
    return fragment;
}

TexCoord slotCoordinate(Fragment fragment, int slot)
{
    vec4 row0 = material.uvRow0[slot];
    vec4 row1 = material.uvRow1[slot];
    TexCoord uv = fragment.texCoord[0];
#if HAS_TEXCOORD1
    if (row0.w > 0.5) uv = fragment.texCoord[1];
#endif
#if HAS_TEXTURE_TRANSFORM
    precise TexCoord moved = TexCoord(row0.x * uv.x + row0.y * uv.y + row0.z, row1.x * uv.x + row1.y * uv.y + row1.z);
    uv = moved;
#endif
    return uv;
}

// Whether the slot's sampler uses nearest filtering here.
bool slotUsesNearest(sampler2D image, int slot, Fragment fragment, int modes)
{
#if FILTER_EXACT && HAS_MIXED_FILTERS
    dmat2 change = fragment.texCoordChange[0];
#if HAS_TEXCOORD1
    if (material.uvRow0[slot].w > 0.5) change = fragment.texCoordChange[1];
#endif
#if HAS_TEXTURE_TRANSFORM
    dmat2 moved = dmat2(material.uvRow0[slot].x, material.uvRow1[slot].x, material.uvRow0[slot].y, material.uvRow1[slot].y);
    change = moved * change;
#endif
    return usesNearest(image, change, modes);
#else
    return (modes & TEXTURE_MODE_MAGNIFIES_NEAREST) != 0;
#endif
}

vec4 sampleSlot(sampler2D image, int slot, Fragment fragment)
{
    int modes = int(material.uvRow1[slot].w);
    return sampleFiltered(image, slotCoordinate(fragment, slot), modes, slotUsesNearest(image, slot, fragment, modes));
}

// rgb colour, a opacity.
vec4 materialBaseColor(Fragment fragment)
{
    precise vec4 color = material.baseColor;
#if HAS_BASE_COLOR_TEXTURE
    color *= sampleSlot(baseColorTexture, TEXTURE_SLOT_BASE_COLOR, fragment);
#endif
#if HAS_VERTEX_COLOR
#if VIEW == VIEW_MOVED_TOO_FAR
    color.a *= min(fragment.color.a, 1.0);
#else
    color *= fragment.color;
#endif
#endif
#if VIEW == VIEW_MOVED_TOO_FAR
    color.rgb = vec3(0.4);
#if HAS_VERTEX_COLOR
    // Opacities above 1 are flags of engine::HookedScene, 1 apart.
    precise float tooFar = clamp(fragment.color.a - (HOOK_MARK_TOO_FAR - 1.0), 0.0, 1.0);
    precise float nowhere = clamp(fragment.color.a - (HOOK_MARK_NOWHERE - 1.0), 0.0, 1.0);
    color.rgb += tooFar * (vec3(0.9, 0.0, 0.9) - color.rgb);
    color.rgb += nowhere * (vec3(0.0, 0.9, 0.9) - color.rgb);
#endif
#endif
    return color;
}

// True where an alpha-masked material is cut out.
bool materialCutOut(vec4 baseColor)
{
#if HAS_ALPHA_MASK
    return (material.kind.y & MATERIAL_FLAG_ALPHA_MASK) != 0u && baseColor.a < material.emissive.a;
#else
    return false;
#endif
}
