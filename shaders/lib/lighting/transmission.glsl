// Light transmitted through a surface to the viewer (docs/glass.md). Source: KHR_materials_transmission, _volume,
// _dispersion.
#pragma once
#include "lib/lighting/lighting.glsl"
#include "lib/material/material.glsl"
#include "shared/refraction.h"
#if HAS_PASSING_LOBES
#include "lib/reflectance/lobes.glsl"
#endif
#if (HAS_VOLUME || HAS_SCATTERING_SHEETS) && (HAS_SCENE_BEHIND || HAS_BACK_FACES)
#include "lib/lighting/scene_behind.glsl"
#endif
#if HAS_ENVIRONMENT && ENVIRONMENT_LIGHT == ENVIRONMENT_SAMPLED
#include "lib/maths/random.glsl"
#endif

// Reflectance of the surface's lobe under uniform illumination: Fresnel's factor for a mirror, the table for a rough
// lobe. 0 if the shading normal points away from the viewer, so that all light is transmitted.
vec3 reflectedEvenly(SeenSurface seen)
{
    if (!(seen.nv > 0.0)) return vec3(0.0);
    precise vec3 mirrored = fresnelSchlick(seen.f0, seen.fresnelRise, min(seen.nv, 1.0));
#if HAS_PASSING_LOBES
    float ofMirror = mirrorShare(lobeAlpha(seen.surface));
    vec2 lobe = lobeShares(seen);
    precise vec3 scattered = seen.f0 * lobe.x + seen.fresnelRise * lobe.y;
    precise vec3 blended = scattered * (1.0 - ofMirror) + mirrored * ofMirror;
    return blended;
#else
    return mirrored;
#endif
}

// Transmitted fraction of radiance from behind, by channel: what surface and layers do not reflect, tinted.
vec3 passedShare(SeenSurface seen)
{
    precise vec3 share = seen.surface.passing * max(vec3(1.0) - reflectedEvenly(seen), vec3(0.0));
#if HAS_SHEEN
    if (strongestSheen(seen.surface) > 0.0) share *= viewerShareUnderSheen(seen);
#endif
#if HAS_CLEARCOAT
    if (seen.surface.coatFactor > 0.0) share *= 1.0 - seen.coatWeight;
#endif
    return share;
}

// Whether bodies show anything but what lies straight behind them. Scattering sheets blur what lies straight behind.
#define BODIES_BEND (HAS_VOLUME && (HAS_ENVIRONMENT || HAS_SCENE_BEHIND))

#if BODIES_BEND || HAS_SCATTERING_SHEETS
#if HAS_ENVIRONMENT
// The environment around a direction, averaged as in its filtered map: over a GGX lobe seen along its axis, weighted by
// the cosine.
vec3 surroundingsAlong(vec3 direction, float alpha, vec2 pixel)
{
#if ENVIRONMENT_LIGHT == ENVIRONMENT_SAMPLED
    if (alpha <= ALPHA_MIN) return mapRadiance(mapDirection(direction)).rgb;
    uvec3 random = hashOf(uvec3(uvec2(pixel), 0x85ebca6bu));
    vec3 tangent = anyPerpendicular(direction);
    precise vec3 sum = vec3(0.0);
    precise float weights = 0.0;
    for (int k = 0; k < ENVIRONMENT_SAMPLES; ++k) {
        vec3 toLight = visibleReflection(evenPoint(random.xy, k), vec2(alpha), direction, direction, tangent);
        precise float weight = max(dot(toLight, direction), 0.0);
        sum += weight * mapRadiance(mapDirection(toLight)).rgb;
        weights += weight;
    }
    precise vec3 mean = sum / max(weights, 1e-6);
    return mean;
#else
    return filteredLight(direction, direction, alpha);
#endif
}
#endif

// The continuation of a ray behind the surface.
struct BentRay {
    vec3 originLS;
    vec3 directionLS;   // unit
    float insideMetres; // through the body to a back face; below 0 if none is hit, and the body's thickness applies
    float alpha;        // of the GGX lobe that blurs around the ray; ALPHA_MIN: none
};

// Alpha of the lobe around a transmitted ray, from the deflections by the surface's microfacets.
float spreadOf(Surface surface, vec2 turns)
{
    return surface.passingAlpha > ALPHA_MIN ? passingAlpha(surface.passingAlpha, turns, ALPHA_MIN) : ALPHA_MIN;
}

// The same through two parallel sides: the far one transmits the deflection by the near one and adds an equal one.
float spreadOfSides(Surface surface, float ior, float cosOutside, float cosInside)
{
    if (!(ior > 0.0)) return spreadOf(surface, vec2(1.0));
    vec2 turns = turnsOfLeaving(ior, cosOutside, cosInside);
    return spreadOf(surface, vec2(turnsTogether(turns.x, turns.x), turnsTogether(turns.y, turns.y)));
}

// Radiance along a ray times the transmittance `kept`, by channel: surfaces in the image, and beyond them the
// environment, or the background if none lights the scene.
vec3 lightAlong(BentRay ray, vec3 kept, Viewpoint viewpoint, vec2 pixel)
{
#if HAS_SCENE_BEHIND
    vec4 met = sceneBehind(ray.originLS, ray.directionLS, viewpoint.depth, ray.alpha);
    precise vec3 shown = kept * met.rgb;
    if (met.a >= 1.0) return shown;
    precise float rest = 1.0 - met.a;
#endif
#if HAS_ENVIRONMENT
    precise vec3 around = kept * surroundingsAlong(ray.directionLS, ray.alpha, pixel) * environmentIntensity();
#else
    precise vec3 around = kept * view.background.rgb;
#endif
#if HAS_SCENE_BEHIND
    precise vec3 both = shown + rest * around;
    return both;
#else
    return around;
#endif
}
#endif

#if BODIES_BEND
// The viewer's ray, refracted at the surface by Snell's law; 0 at total internal reflection. An ior of 0 means infinite
// and bends all light onto the normal. Source: KHR_materials_ior; GLSL 4.50, refract(), which does not specify its
// rounding.
vec3 refractedDirection(vec3 normal, vec3 toViewer, float ior)
{
    precise float along = dot(normal, toViewer);
    vec3 outward = along < 0.0 ? -normal : normal;
    precise float cosine = min(abs(along), 1.0);
    precise float inverse = ior > 0.0 ? 1.0 / ior : 0.0;
    precise float cosine2 = 1.0 - inverse * inverse * (1.0 - cosine * cosine);
    if (!(cosine2 >= 0.0)) return vec3(0.0);
    precise vec3 direction = (inverse * cosine - sqrt(cosine2)) * outward - inverse * toViewer;
    return safeNormalize(direction, -outward);
}

#if HAS_DISPERSION
// Indices of refraction of red, green and blue: green has the material's, and red does not fall below 1 if that is
// above 1. An ior of 0 (infinite) has no dispersion. Source: KHR_materials_dispersion.
vec3 iorByChannel(float ior)
{
    precise float spread = max(ior - 1.0, 0.0) * material.attenuation.a;
    precise float red = max(ior - spread, min(ior, 1.0));
    precise float blue = ior + spread;
    return vec3(red, ior, blue);
}
#endif

#if HAS_BACK_FACES
// Normal of a far side at a screen position, interpolated between pixels that have one; `other` if none does.
vec3 farSideNormal(vec2 place, vec3 other)
{
    precise vec2 corner = place - 0.5;
    ivec2 low = ivec2(floor(corner));
    precise vec2 share = corner - vec2(low);
    precise vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 offset = ivec2(i & 1, i >> 1);
        vec4 side = texelFetch(farSides, clamp(low + offset, ivec2(0), ivec2(view.sizePixels.xy) - 1), 0);
        precise float weight = (offset.x == 1 ? share.x : 1.0 - share.x) * (offset.y == 1 ? share.y : 1.0 - share.y);
        if (side.w > 0.0) sum += weight * side.xyz;
    }
    return safeNormalize(sum, other);
}

// Direction of a ray after it meets the far side of a body from inside, by Snell's law; at total internal reflection
// the reflected direction, which then leaves unbent.
vec3 leavingDirection(vec3 bent, vec3 outward, float ior)
{
    precise float cosine = dot(outward, bent);
    precise vec3 across = bent - cosine * outward;
    precise float sine2 = ior * ior * dot(across, across);
    precise vec3 reflected = bent - 2.0 * cosine * outward;
    precise vec3 refracted = ior * across + sqrt(max(1.0 - sine2, 0.0)) * outward;
    // An ior of 0 means infinite.
    bool isReflected = !(sine2 <= 1.0) || (ior <= 0.0 && across != vec3(0.0));
    return safeNormalize(isReflected ? reflected : refracted, bent);
}
#endif

#if HAS_BACK_FACES
// Tangent plane of a far side where a ray meets it.
struct FarSide {
    vec3 positionLS;
    vec3 outwardLS; // unit
};

// Exit direction of a ray beside the one that meets `side`: its normal is read at the pixel of its intersection with
// the far side's tangent plane.
vec3 leavingBeside(FarSide side, vec3 originLS, vec3 bent, float ior)
{
    precise float toPlane = dot(side.positionLS - originLS, side.outwardLS);
    precise vec3 metLS = originLS + (toPlane / max(dot(bent, side.outwardLS), 1e-3)) * bent;
    precise vec4 clip = view.clipFromLS * vec4(metLS, 1.0);
    precise vec2 place = (clip.xy / clip.w + 1.0) * (0.5 * vec2(view.sizePixels.xy));
    bool isSeen = clip.w > 0.0 && all(greaterThanEqual(place, vec2(0.0))) && all(lessThan(place, vec2(view.sizePixels.xy)));
    vec3 normal = isSeen ? farSideNormal(place, side.outwardLS) : side.outwardLS;
    return leavingDirection(bent, dot(normal, bent) < 0.0 ? -normal : normal, ior);
}

// Alpha of the lobe around a ray that leaves a body, by the microfacets of both sides: the near side's lobe as the far
// side focuses or scatters it, by rays through the lobe's edges, and the far side's lobe.
float spreadThrough(Surface surface, Viewpoint viewpoint, vec3 bent, FarSide side, vec3 leaving, float ior, vec2 entering)
{
    if (!(surface.passingAlpha > ALPHA_MIN)) return ALPHA_MIN;
    if (!(ior > 0.0)) return spreadOf(surface, entering);
    precise float cosInside = dot(side.outwardLS, bent), cosOutside = dot(side.outwardLS, leaving);
    bool isReflected = cosOutside * cosInside < 0.0;
    vec2 own = isReflected ? vec2(2.0 * cosInside, 2.0) : turnsOfLeaving(ior, cosOutside, cosInside);
    vec3 across = safeNormalize(cross(surface.normalLS, bent), anyPerpendicular(bent)), along = cross(bent, across);
    vec2 turns;
    for (int i = 0; i < 2; ++i) {
        precise vec3 aside = (surface.passingAlpha * entering[i]) * (i == 0 ? across : along);
        vec3 left = leavingBeside(side, viewpoint.positionLS, safeNormalize(bent - aside, bent), ior);
        vec3 right = leavingBeside(side, viewpoint.positionLS, safeNormalize(bent + aside, bent), ior);
        precise float carried = 0.5 * length(right - left) / surface.passingAlpha;
        turns[i] = turnsTogether(carried, own[i]);
    }
    return spreadOf(surface, turns);
}
#endif

// Continues a bent ray. A far side parallel to the near one bends it back into the viewer's direction, displaced,
// unless it hits a surface before. A drawn far side bends it where the ray meets that. Else it goes on as it is.
BentRay rayThroughBody(Surface surface, Viewpoint viewpoint, vec3 bent, float ior)
{
    precise float cosOutside = abs(dot(viewpoint.toViewerLS, surface.normalLS)), cosInside = abs(dot(bent, surface.normalLS));
    vec2 entering = turnsOfEntering(ior, cosOutside, cosInside);
#if HAS_PARALLEL_SIDES
    // With an index below 1, rays beyond the critical angle run along the surface without end.
    precise float cosine = max(cosInside, 1e-3);
    precise vec3 farSide = viewpoint.positionLS + (surface.bodyMetres / cosine) * bent;
#if HAS_SCENE_BEHIND
    ScreenRay inside = screenRayTo(viewpoint.positionLS, vec4(farSide, 1.0));
    if (screenHit(kOpaqueLayer, inside, viewpoint.depth).isMet)
        return BentRay(viewpoint.positionLS, bent, -1.0, spreadOf(surface, entering));
#endif
    return BentRay(farSide, -viewpoint.toViewerLS, -1.0, spreadOfSides(surface, ior, cosOutside, cosInside));
#else
#if HAS_BACK_FACES
    bool hasBack = true;
#if BACK_FACES_OF_CLOSED
    hasBack = materialFlag(MATERIAL_FLAG_CLOSED);
#endif
    ScreenHit hit;
    hit.isMet = false;
    if (hasBack) hit = screenHit(kFarLayer, screenRay(viewpoint.positionLS, bent), viewpoint.depth);
    if (hit.isMet) {
        vec3 normal = farSideNormal(hit.place.xy, texelFetch(farSides, hit.pixel, 0).xyz);
        FarSide side = FarSide(viewpointFromDepth(hit.place.xy, hit.place.z).positionLS, dot(normal, bent) < 0.0 ? -normal : normal);
        precise float insideMetres = length(side.positionLS - viewpoint.positionLS);
        vec3 leaving = leavingDirection(bent, side.outwardLS, ior);
        // A reflected ray continues inside, in total at least as far as through the body's thickness.
        precise float throughMetres = surface.bodyMetres / max(cosInside, 1e-3);
        if (dot(leaving, side.outwardLS) < 0.0) insideMetres = max(insideMetres, throughMetres);
        float alpha = spreadThrough(surface, viewpoint, bent, side, leaving, ior, entering);
        return BentRay(side.positionLS, leaving, insideMetres, alpha);
    }
#endif
    return BentRay(viewpoint.positionLS, bent, -1.0, spreadOf(surface, entering));
#endif
}

// Light through a body that bends it by one index of refraction; `share`: transmitted fraction of the surface, by
// channel. Black at total internal reflection.
vec3 lightThroughBody(Surface surface, Viewpoint viewpoint, vec3 share, float ior, vec2 pixel)
{
    vec3 bent = refractedDirection(surface.normalLS, viewpoint.toViewerLS, ior);
    if (bent == vec3(0.0)) return vec3(0.0);
    BentRay ray = rayThroughBody(surface, viewpoint, bent, ior);
    vec3 left = surface.leftByBody;
#if HAS_BACK_FACES
    if (ray.insideMetres >= 0.0) left = leftByBody(ray.insideMetres / material.transmission.z);
#endif
    precise vec3 kept = share * left;
    return lightAlong(ray, kept, viewpoint, pixel);
}

// The same with dispersion. A single loop, so that a program contains the path of a ray once.
vec3 lightThroughBody(Surface surface, Viewpoint viewpoint, vec3 share, vec2 pixel)
{
#if HAS_DISPERSION
    bool bendsApart = material.attenuation.a > 0.0;
    vec3 iors = bendsApart ? iorByChannel(surface.passingIor) : vec3(surface.passingIor), light = vec3(0.0);
    for (int c = 0; c < (bendsApart ? 3 : 1); ++c) {
        vec3 own = lightThroughBody(surface, viewpoint, share, iors[c], pixel);
        if (bendsApart)
            light[c] = own[c];
        else
            light = own;
    }
    return light;
#else
    return lightThroughBody(surface, viewpoint, share, surface.passingIor, pixel);
#endif
}
#endif

// Light through a surface: radiance from refracted or blurred rays, and the fraction of the radiance behind it that is
// transmitted, by channel.
struct ThroughSurface {
    vec3 radiance;
    vec3 kept;
};

ThroughSurface lightThrough(Surface surface, Viewpoint viewpoint, vec2 pixel)
{
    SeenSurface seen = seenSurface(surface, viewpoint.toViewerLS);
    vec3 share = passedShare(seen);
#if BODIES_BEND
    if (material.transmission.z > 0.0)
        return ThroughSurface(lightThroughBody(surface, viewpoint, share, pixel), vec3(0.0));
#endif
#if HAS_SCATTERING_SHEETS
    if (surface.passingAlpha > ALPHA_MIN) {
        float ior = surface.passingIor;
        precise float cosOutside = min(abs(seen.nv), 1.0);
        precise float cosInside = sqrt(max(1.0 - (1.0 - cosOutside * cosOutside) / max(ior * ior, 1e-6), 0.0));
        BentRay straight = BentRay(viewpoint.positionLS, -viewpoint.toViewerLS, -1.0, spreadOfSides(surface, ior, cosOutside, cosInside));
        return ThroughSurface(lightAlong(straight, share, viewpoint, pixel), vec3(0.0)); // sheets absorb nothing
    }
#endif
    precise vec3 kept = share * surface.leftByBody;
    return ThroughSurface(vec3(0.0), kept);
}
