// Evaluates a material: as it is rasterised, or from its constants alone if pixels store its number.
#pragma once
#include "lib/material/hook.glsl"
#include "lib/material/material_frame.glsl"
#include "lib/material/material_lobes.glsl"
#include "lib/surface/surface.glsl"

#if HAS_PASSING_LIGHT
// Beer's law: transmittance of the body for a path of `thicknesses` times its thickness; exactly 1 in channels that the
// body does not absorb.
vec3 leftByBody(float thicknesses)
{
    if (!(thicknesses > 0.0)) return vec3(1.0);
    vec3 logarithm = material.attenuation.rgb;
    precise vec3 left = exp(logarithm * thicknesses);
    return mix(left, vec3(1.0), equal(logarithm, vec3(0.0)));
}

// Source: KHR_materials_transmission and _volume.
void setPassing(Fragment fragment, vec3 baseColor, float metallic, float ior, inout Surface surface)
{
    precise float transmission = material.transmission.x;
#if HAS_TRANSMISSION_TEXTURE
    transmission *= sampleSlot(transmissionTexture, TEXTURE_SLOT_TRANSMISSION, fragment).r;
#endif
    float thicknesses = 1.0;
#if HAS_THICKNESS_TEXTURE
    thicknesses = sampleSlot(thicknessTexture, TEXTURE_SLOT_THICKNESS, fragment).g;
#endif
    precise float bodyMetres = material.transmission.z * thicknesses;
    precise float share = transmission * (1.0 - metallic);
    precise vec3 passing = baseColor * share;
    surface.transmission = transmission;
    surface.passing = passing;
    surface.leftByBody = leftByBody(thicknesses);
    surface.passingIor = ior;
    surface.passingAlpha = ior == 1.0 ? ALPHA_MIN : surface.alpha; // without refraction there is no blur
    surface.bodyMetres = bodyMetres;
}
#endif

// Sets all of a surface except directions: values that are constant over the surface if the scene has no varying
// materials.
void setMaterialValues(Fragment fragment, vec4 baseColor, inout Surface surface)
{
    surface.model = surfaceModel(material.kind.x);
#if !HAS_VARYING_MATERIALS
    surface.material = material.kind.w;
#endif
#if HAS_SUBSURFACE_ROWS
    surface.subsurface = uint(material.mixed.y);
#endif
    surface.albedo = baseColor.rgb;
#if HAS_MICROSURFACES
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
    if (HAS_METALLIC(surface.model)) {
        precise float alpha = max(roughnessMetallic.x * roughnessMetallic.x, ALPHA_MIN);
        surface.alpha = alpha;
        surface.metallic = roughnessMetallic.y;
        surface.iorOrF90 = specularFactor;
#if HAS_SPECULAR
        precise float reflectance = material.mixed.x;
#if HAS_IOR_TEXTURE
        if ((material.kind.y & MATERIAL_FLAG_IOR_TEXTURE) != 0u) {
            precise float contrast = (ior - 1.0) / (ior + 1.0);
            reflectance = contrast * contrast;
        }
#endif
        // KHR_materials_specular: the dielectric F0 is tinted, clamped to 1, then scaled.
        precise vec3 f0 = min(specularColor * reflectance, vec3(1.0)) * specularFactor;
        surface.specular = f0;
#endif
#if HAS_PASSING_LIGHT
        setPassing(fragment, baseColor.rgb, roughnessMetallic.y, ior, surface);
#endif
    }
    if (IS_MICROFACET(surface.model)) {
        surface.alpha = max(roughnessMetallic.x, ALPHA_MIN);
        surface.iorOrF90 = ior;
#if HAS_SPECULAR
        surface.specular = specularColor;
#endif
#if HAS_MASKING_OPTIONS
        surface.masking = material.kind.z;
#endif
    }
    if (HAS_PARAMETER(surface.model)) {
        surface.parameter = max(roughnessMetallic.x, 0.0);
#if HAS_SPECULAR
        surface.specular = specularColor;
#endif
    }
#if HAS_SHEEN
    setSheen(fragment, surface);
#endif
#else
    surface.specular = vec3(0.0);
#endif

#if HAS_OCCLUSION_TEXTURE
    float texel = sampleSlot(occlusionTexture, TEXTURE_SLOT_OCCLUSION, fragment).r;
    precise float open = 1.0 + material.mixed.w * (texel - 1.0);
    surface.openCode = encodeOpen(open);
#endif

#if HAS_EMISSION
    precise vec3 emission = material.emissive.rgb;
#if HAS_EMISSIVE_TEXTURE
    emission *= sampleSlot(emissiveTexture, TEXTURE_SLOT_EMISSIVE, fragment).rgb;
#endif
    if (IS_UNLIT(surface.model)) emission += baseColor.rgb;
    surface.emission = emission;
#endif
}

Surface surfaceFromMaterial(Fragment fragment, vec4 baseColor)
{
    Surface surface;
    setNeutralValues(surface);
    setMaterialValues(fragment, baseColor, surface);
    takeHook(fragment, surface);

#if HAS_NORMAL_TEXTURE
    vec3 normalTexel = sampleSlot(normalTexture, TEXTURE_SLOT_NORMAL, fragment).rgb;
    if ((material.kind.y & MATERIAL_FLAG_NORMAL_MAP) != 0u) surface.normalTexel = normalTexel;
#endif
    surface.normalCode = encodeNormal(bentToViewer(fragment, materialNormal(fragment, surface.normalTexel)));
    surface.normalLS = decodeNormal(surface.normalCode);
#if HAS_SHADOWS
    surface.facetCode = encodeFacet(fragment.facetNormalLS);
    surface.facetNormalLS = decodeFacet(surface.facetCode);
#endif
#if HAS_SHADOW_LIFT
    surface.liftCode = fragment.liftCode;
#endif
#if VIEW == VIEW_NORMAL_OBJECT
    surface.normalTexel = objectNormal(fragment, surface.normalLS) * 0.5 + 0.5;
#endif
#if HAS_TANGENT_FRAME
    setAnisotropy(fragment, surface);
#endif
#if HAS_CLEARCOAT
    setClearcoat(fragment, surface);
#endif
    return surface;
}
