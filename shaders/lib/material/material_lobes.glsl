// Optional lobes of a material: anisotropy, clear coat, sheen.
#pragma once
#include "lib/material/material_frame.glsl"
#include "lib/maths/octahedral.glsl"
#include "lib/surface/surface.glsl"

#if HAS_TANGENT_FRAME
// `direction`: in tangent space, of any length.
vec3 surfaceTangent(Fragment fragment, vec3 normalLS, vec2 direction)
{
    vec3 vertexNormal = safeNormalize(fragment.normalLS, vec3(0.0, 0.0, 1.0));
    vec3 turned = fromTangentSpace(fragment, vertexNormal, vec3(direction, 0.0));
    precise vec3 across = turned - normalLS * dot(normalLS, turned);
    // If it points along the normal, only rounding would be left.
    vec3 tangent = safeNormalize(dot(across, across) > 1e-8 * dot(turned, turned) ? across : vec3(0.0), anyPerpendicular(normalLS));
    return tangent;
}

// Source: KHR_materials_anisotropy.
void setAnisotropy(Fragment fragment, inout Surface surface)
{
    vec4 texel = vec4(1.0);
#if HAS_ANISOTROPY_TEXTURE
    texel = sampleSlot(anisotropyTexture, TEXTURE_SLOT_ANISOTROPY, fragment);
#endif
    vec2 direction = vec2(1.0, 0.0);
    surface.alphaBitangent = surface.alpha;
    if (HAS_TWO_ALPHAS(surface.model)) {
        precise float alpha = max(material.anisotropy.x * texel.r, ALPHA_MIN);
        surface.alphaBitangent = alpha;
    }
#if HAS_ANISOTROPY
    if (HAS_ANISOTROPY_STRENGTH(surface.model)) {
        if (materialFlag(MATERIAL_FLAG_ANISOTROPY_TEXTURE)) {
            precise vec2 mapped = texel.rg * 2.0 - 1.0;
            // An 8-bit texel cannot represent 0; below its step there is no direction.
            if (dot(mapped, mapped) > 1e-4) direction = mapped;
        }
        precise float strength = material.anisotropy.x * texel.b;
        precise float along = surface.alpha + (1.0 - surface.alpha) * (strength * strength);
        surface.alpha = along;
    }
#endif
    surface.tangentLS = surfaceTangent(fragment, surface.normalLS, turnedTexel(direction, material.anisotropy.yzw));
}
#endif

#if HAS_CLEARCOAT
// Source: KHR_materials_clearcoat. Without a normal map for the coat it has the mesh's normal, independent of the
// normal map below it.
void setClearcoat(Fragment fragment, inout Surface surface)
{
    precise float factor = material.clearcoat.x;
    precise float roughness = material.clearcoat.y;
    vec3 normalLS = safeNormalize(fragment.normalLS, vec3(0.0, 0.0, 1.0));
#if HAS_CLEARCOAT_TEXTURE
    factor *= sampleSlot(clearcoatTexture, TEXTURE_SLOT_CLEARCOAT, fragment).r;
#endif
#if HAS_CLEARCOAT_ROUGHNESS_TEXTURE
    roughness *= sampleSlot(clearcoatRoughnessTexture, TEXTURE_SLOT_CLEARCOAT_ROUGHNESS, fragment).g;
#endif
#if HAS_CLEARCOAT_NORMAL_TEXTURE
    vec3 texel = sampleSlot(clearcoatNormalTexture, TEXTURE_SLOT_CLEARCOAT_NORMAL, fragment).rgb;
    if (materialFlag(MATERIAL_FLAG_CLEARCOAT_NORMAL_MAP))
        normalLS = tangentSpaceNormal(fragment, normalLS, texel, material.clearcoat.z, material.clearcoatTurn.xyz);
#endif
    surface.coatNormalCode = encodeOctahedral(bentToViewer(fragment, facing(fragment, normalLS)));
    surface.coatFactor = HAS_LAYERS(surface.model) ? factor : 0.0;
    precise float alpha = max(roughness * roughness, ALPHA_MIN);
    surface.coatAlpha = alpha;
}
#endif

#if HAS_SHEEN
// Source: KHR_materials_sheen.
void setSheen(Fragment fragment, inout Surface surface)
{
    precise vec3 color = material.sheen.rgb;
    precise float roughness = material.sheen.a;
#if HAS_SHEEN_COLOR_TEXTURE
    color *= sampleSlot(sheenColorTexture, TEXTURE_SLOT_SHEEN_COLOR, fragment).rgb;
#endif
#if HAS_SHEEN_ROUGHNESS_TEXTURE
    roughness *= sampleSlot(sheenRoughnessTexture, TEXTURE_SLOT_SHEEN_ROUGHNESS, fragment).a;
#endif
    surface.sheenColor = HAS_LAYERS(surface.model) ? color : vec3(0.0);
    precise float alpha = max(roughness * roughness, ALPHA_MIN);
    surface.sheenAlpha = alpha;
}
#endif
