// A surface from a material as it is rasterised. Every value is factor x texel; an empty slot samples white, and factor x 1
// is the factor to the last bit. Textures are fetched outside any branch on per-pixel values, with implicit derivatives,
// by the same call in every pass: explicit gradients would give other texels.
#pragma once
#include "shared/slots.h"
#include "shared/material.h"
#include "lib/math.glsl"
#include "lib/surface.glsl"
#include "lib/texture_filter.glsl"

layout(std140, binding = UNIFORM_MATERIAL) uniform MaterialBlock
{
    MaterialConstants material;
};

layout(binding = TEXTURE_SLOT_BASE_COLOR) uniform sampler2D baseColorTexture;
layout(binding = TEXTURE_SLOT_NORMAL) uniform sampler2D normalTexture;
layout(binding = TEXTURE_SLOT_METALLIC_ROUGHNESS) uniform sampler2D metallicRoughnessTexture;
layout(binding = TEXTURE_SLOT_EMISSIVE) uniform sampler2D emissiveTexture;
layout(binding = TEXTURE_SLOT_SPECULAR_FACTOR) uniform sampler2D specularFactorTexture;
layout(binding = TEXTURE_SLOT_SPECULAR_COLOR) uniform sampler2D specularColorTexture;
layout(binding = TEXTURE_SLOT_IOR) uniform sampler2D iorTexture;

// What the rasteriser interpolates over a triangle.
struct Fragment {
    vec3 normalLS;      // not unit
    vec4 tangentLS;     // xyz not unit, w handedness with the node's mirroring
    TexCoord texCoord[2];
    vec4 color;
    mat3 normalFromObject; // cofactor matrix of the node, with its mirroring
    bool frontFacing;
};

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

vec4 sampleSlot(sampler2D image, int slot, Fragment fragment)
{
    return sampleFiltered(image, slotCoordinate(fragment, slot), int(material.uvRow1[slot].w));
}

// rgb colour, a opacity.
vec4 materialBaseColor(Fragment fragment)
{
    precise vec4 color = material.baseColor;
#if HAS_BASE_COLOR_TEXTURE
    color *= sampleSlot(baseColorTexture, TEXTURE_SLOT_BASE_COLOR, fragment);
#endif
#if HAS_VERTEX_COLOR
    color *= fragment.color;
#endif
    return color;
}

// True where an alpha-masked material has a hole.
bool materialCutOut(vec4 baseColor)
{
#if HAS_ALPHA_MASK
    return (material.kind.y & MATERIAL_FLAG_ALPHA_MASK) != 0u && baseColor.a < material.emissive.a;
#else
    return false;
#endif
}

vec3 materialNormal(Fragment fragment, vec3 texel)
{
    vec3 vertexNormal = safeNormalize(fragment.normalLS, vec3(0.0, 0.0, 1.0));
    vec3 normal = vertexNormal;
#if HAS_NORMAL_TEXTURE
    if ((material.kind.y & MATERIAL_FLAG_NORMAL_MAP) != 0u) {
        precise vec3 mapped = texel * 2.0 - 1.0;
        if ((material.kind.y & MATERIAL_FLAG_OBJECT_SPACE_NORMAL) != 0u) {
#if HAS_OBJECT_SPACE_NORMALS
            precise vec3 turned = fragment.normalFromObject * mapped;
            normal = safeNormalize(turned, vertexNormal);
#endif
        } else {
#if HAS_TANGENT_SPACE_NORMALS
            vec3 tangent = safeNormalize(fragment.tangentLS.xyz, vec3(0.0));
            precise vec3 bitangent = cross(vertexNormal, tangent) * fragment.tangentLS.w;
            precise vec3 turned = (mapped.x * material.microsurface.w) * tangent
                                  + (mapped.y * material.microsurface.w) * bitangent + mapped.z * vertexNormal;
            normal = safeNormalize(turned, vertexNormal);
#endif
        }
    }
#endif
#if HAS_DOUBLE_SIDED
    if ((material.kind.y & MATERIAL_FLAG_DOUBLE_SIDED) != 0u && !fragment.frontFacing) normal = -normal;
#endif
    return normal;
}

Surface surfaceFromMaterial(Fragment fragment, vec4 baseColor)
{
    Surface surface;
    surface.model = surfaceModel(material.kind.x);
    surface.albedo = baseColor.rgb;
    surface.metallic = 0.0;
    surface.alpha = 1.0;
    surface.iorOrF90 = 1.0;
    surface.emission = vec3(0.0);

    surface.normalTexel = vec3(0.5, 0.5, 1.0);
#if HAS_NORMAL_TEXTURE
    vec3 normalTexel = sampleSlot(normalTexture, TEXTURE_SLOT_NORMAL, fragment).rgb;
    if ((material.kind.y & MATERIAL_FLAG_NORMAL_MAP) != 0u) surface.normalTexel = normalTexel;
#endif
    surface.normalLS = materialNormal(fragment, surface.normalTexel);

#if HAS_METALLIC_ROUGHNESS || HAS_MICROFACET
    precise vec2 roughnessMetallic = material.microsurface.yx;
#if HAS_METALLIC_ROUGHNESS_TEXTURE
    roughnessMetallic *= sampleSlot(metallicRoughnessTexture, TEXTURE_SLOT_METALLIC_ROUGHNESS, fragment).gb;
#endif
    precise float specularFactor = material.specular.a;
    precise vec3 specularColor = material.specular.rgb;
#if HAS_SPECULAR_FACTOR_TEXTURE
    specularFactor *= sampleSlot(specularFactorTexture, TEXTURE_SLOT_SPECULAR_FACTOR, fragment).a;
#endif
#if HAS_SPECULAR_COLOR_TEXTURE
    specularColor *= sampleSlot(specularColorTexture, TEXTURE_SLOT_SPECULAR_COLOR, fragment).rgb;
#endif
    precise float ior = material.microsurface.z;
#if HAS_IOR_TEXTURE
    ior *= sampleSlot(iorTexture, TEXTURE_SLOT_IOR, fragment).r;
#endif
    surface.specular = defaultSpecular(surface.model);
#if HAS_METALLIC_ROUGHNESS
    if (surface.model == MODEL_METALLIC_ROUGHNESS) {
        precise float alpha = max(roughnessMetallic.x * roughnessMetallic.x, ALPHA_MIN);
        surface.alpha = alpha;
        surface.metallic = roughnessMetallic.y;
        surface.iorOrF90 = specularFactor;
#if HAS_SPECULAR
        precise float reflectance = material.dielectric.x;
#if HAS_IOR_TEXTURE
        if ((material.kind.y & MATERIAL_FLAG_IOR_TEXTURE) != 0u) {
            precise float contrast = (ior - 1.0) / (ior + 1.0);
            reflectance = contrast * contrast;
        }
#endif
        // KHR_materials_specular: the dielectric F0 is tinted, held to 1, then scaled.
        precise vec3 f0 = min(specularColor * reflectance, vec3(1.0)) * specularFactor;
        surface.specular = f0;
#endif
    }
#endif
#if HAS_MICROFACET
    if (surface.model == MODEL_MICROFACET) {
        surface.alpha = max(roughnessMetallic.x, ALPHA_MIN);
        surface.iorOrF90 = ior;
#if HAS_SPECULAR
        surface.specular = specularColor;
#endif
    }
#endif
#else
    surface.specular = vec3(0.0);
#endif

#if HAS_EMISSION
    precise vec3 emission = material.emissive.rgb;
#if HAS_EMISSIVE_TEXTURE
    emission *= sampleSlot(emissiveTexture, TEXTURE_SLOT_EMISSIVE, fragment).rgb;
#endif
#if HAS_SINGLE_COLOR
    if (surface.model == MODEL_SINGLE_COLOR) emission += baseColor.rgb;
#endif
    surface.emission = emission;
#endif
    return surface;
}
