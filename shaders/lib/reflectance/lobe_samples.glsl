// Samples of a surface's reflection by the cosine, by its lobe and by its coat, and their densities.
#pragma once
#include "lib/reflectance/reflectance.glsl"
#include "lib/reflectance/visible_facets.glsl"

vec3 cosineDirection(vec2 point, vec3 normal, vec3 tangent)
{
    precise float radius = sqrt(point.x);
    precise float angle = 2.0 * kPi * point.y;
    precise vec3 direction = vec3(radius * cos(angle), radius * sin(angle), sqrt(max(1.0 - point.x, 0.0)));
    return aroundNormal(direction, normal, tangent);
}

#if HAS_GGX_MODELS || HAS_CLEARCOAT
// Density of visibleReflection(), 1/sr: G1(v) D / (4 n.v); `viewerLength`: that of Smith's G1 for n.v.
float visibleDensity(float distribution, float nv, float viewerLength)
{
    precise float density = distribution / (2.0 * (nv + viewerLength));
    return density;
}
#endif

#if HAS_BLINN_PHONG
// The half vector's cosine to the normal is a power of a random number; density (p + 2) / 2 pi (n.h)^(p + 1).
vec3 blinnReflection(vec2 point, float exponent, vec3 toViewer, vec3 normal, vec3 tangent)
{
    precise float cosine = pow(max(point.x, 1e-9), 1.0 / (exponent + 2.0));
    precise float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    precise float angle = 2.0 * kPi * point.y;
    precise vec3 local = vec3(sine * cos(angle), sine * sin(angle), cosine);
    vec3 half_ = aroundNormal(local, normal, tangent);
    precise float along = dot(toViewer, half_);
    if (!(along > 0.0)) return vec3(0.0); // seen from behind
    precise vec3 reflected = 2.0 * along * half_ - toViewer;
    return safeNormalize(reflected, normal);
}

float blinnDensity(float exponent, HalfSum h)
{
    precise float ofHalf = (exponent + 2.0) * (0.5 * kInversePi) * blinnPhongLobe(exponent + 1.0, h);
    precise float density = ofHalf / (4.0 * max(halfCosine(h), 1e-6));
    return density;
}
#endif

vec3 lobeDirection(vec2 point, SeenSurface seen, vec3 tangent)
{
    vec3 normal = seen.surface.normalLS;
#if HAS_BLINN_PHONG
    if (seen.surface.model == MODEL_BLINN_PHONG)
        return blinnReflection(point, seen.surface.parameter, seen.toViewer, normal, tangent);
#endif
#if HAS_GGX_MODELS
    vec2 alpha = vec2(seen.surface.alpha);
#if HAS_TANGENT_FRAME
    if (isAnisotropic(seen.surface)) alpha.y = seen.surface.alphaBitangent;
#endif
    return visibleReflection(point, alpha, seen.toViewer, normal, tangent);
#else
    return normal;
#endif
}

#if HAS_CLEARCOAT && !SPECULAR_OFF
// A sample of the coat's lobe.
vec3 coatDirection(vec2 point, SeenSurface seen)
{
    return visibleReflection(point, vec2(seen.surface.coatAlpha), seen.toViewer, seen.coatNormalLS,
                             anyPerpendicular(seen.coatNormalLS));
}
#endif

// The tangent along which anisotropic lobes are sampled; any in the plane for others.
vec3 sampledTangent(SeenSurface seen)
{
#if HAS_TANGENT_FRAME
    if (isAnisotropic(seen.surface)) return seen.surface.tangentLS;
#endif
    return anyPerpendicular(seen.surface.normalLS);
}

// Sum of the densities of one sample each of the cosine, the lobe and the coat in a direction, 1/sr.
float surfaceDensity(SeenSurface seen, vec3 toLight)
{
    precise float density = max(dot(seen.surface.normalLS, toLight), 0.0) * kInversePi;
    if (hasLobe(seen)) {
        HalfSum h = halfSum(seen.surface.normalLS, toLight, seen.toViewer);
        if (h.length2 > 0.0 && h.along > 0.0) {
#if HAS_BLINN_PHONG
            if (seen.surface.model == MODEL_BLINN_PHONG) density += blinnDensity(seen.surface.parameter, h);
#endif
#if HAS_GGX_MODELS
            if (IS_MICROFACET(seen.surface.model) || HAS_METALLIC(seen.surface.model))
                density += visibleDensity(lobeDistribution(seen, h), seen.nv, seen.viewerLength);
#endif
        }
    }
#if HAS_CLEARCOAT && !SPECULAR_OFF
    if (seen.surface.coatFactor > 0.0 && seen.coatNv > 0.0) {
        HalfSum h = halfSum(seen.coatNormalLS, toLight, seen.toViewer);
        precise float alpha2 = seen.surface.coatAlpha * seen.surface.coatAlpha;
        if (h.length2 > 0.0)
            density += visibleDensity(distributionGgx(alpha2, ggxScale(alpha2), h), seen.coatNv,
                                      smithLength(alpha2, seen.coatNv));
    }
#endif
    return density;
}
