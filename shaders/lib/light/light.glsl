// Irradiance of one light at a point. The windows (range, cone) belong to the light and are the same in every
// technique, with or without culling.
#pragma once
#include "lib/light/light_store.glsl"
#include "shared/light_pictures.h"
#if HAS_LIGHT_PICTURES
#include "lib/light/light_picture.glsl"
#endif
#include "lib/maths/math.glsl"

// Incident light at a point.
struct Incident {
    vec3 toLightLS;  // unit
    vec3 irradiance; // at normal incidence, L of the shading formulas; 0 if the light does not reach the point
};

// ---- One function per type with a position: the fraction of its light emitted in a direction; 0 is exactly none.

#if HAS_SPOT_LIGHTS
// The cone of KHR_lights_punctual, in the form of LightShapeTexels.
float spotShare(int kind, vec3 toLightLS, LightShapeTexels shape)
{
    precise vec3 beside = toLightLS + shape.axis.xyz;
    precise float apart = (kind & LIGHT_BROAD) != 0 ? dot(toLightLS, shape.axis.xyz) : dot(beside, beside);
    precise float cone = clamp(shape.attenuation.w - shape.axis.w * apart, 0.0, 1.0);
    precise float share = cone * cone;
    return share;
}
#endif

#if HAS_AREA_LIGHTS
// In place of a fraction: projected area of an area light in a direction, in m^2, as of a small source at its centre.
float areaFacing(int type, vec3 toLightLS, LightShapeTexels shape)
{
    if (type == LIGHT_SPHERE) {
        precise float disk = kPi * shape.axis.w * shape.axis.w;
        return disk;
    }
    precise float along = dot(toLightLS, shape.axis.xyz);
    if (type == LIGHT_TUBE) {
        precise float halfLength2 = dot(shape.axis.xyz, shape.axis.xyz);
        precise float across = length(cross(toLightLS, shape.axis.xyz));
        precise float ends = kPi * shape.axis.w * abs(along) / sqrt(max(halfLength2, 1e-36));
        precise float facing = shape.axis.w * (4.0 * across + ends);
        return facing;
    }
    float areaShare = type == LIGHT_DISK ? kPi : 4.0;
#if HAS_POLYGON_LIGHTS
    if (type == LIGHT_POLYGON) areaShare = shape.axis.w;
#endif
    precise vec3 faces = cross(shape.axis.xyz, shape.attenuation.xyz) * areaShare;
    precise float facing = -dot(faces, toLightLS);
    return shinesFromBothSides(shape.attenuation.w) ? abs(facing) : max(facing, 0.0);
}
#endif

#if HAS_LIGHT_SHAPES
// Emitted fraction by the light's type; 1 for a point light.
float shareTowards(int index, int kind, vec3 toLightLS, vec4 attenuation)
{
    int type = kind & LIGHT_TYPE_MASK;
#if HAS_SPOT_LIGHTS
    if (type == LIGHT_SPOT) return spotShare(kind, toLightLS, LightShapeTexels(lightShapeTexel(index, 0), attenuation));
#endif
#if HAS_AREA_LIGHTS
    if (IS_AREA_LIGHT(type)) return areaFacing(type, toLightLS, LightShapeTexels(lightShapeTexel(index, 0), attenuation));
#endif
    return 1.0;
}
#endif

// ---- Incident light: constant without a position, else by falloff, range and type.

// Incident light at positionLS from light `index`. False if its range or type makes it exactly 0.
bool incidentLight(int index, vec3 positionLS, out Incident incident)
{
    vec4 place = lightTexel(index, 0);
    vec4 color = lightTexel(index, 1);
    int kind = int(color.w);
    incident.toLightLS = place.xyz;
    incident.irradiance = color.rgb;
#if HAS_DIRECTIONAL_LIGHTS
    if ((kind & LIGHT_TYPE_MASK) == LIGHT_DIRECTIONAL) return true;
#endif
#if HAS_PLACED_LIGHTS
    precise vec3 toLight = place.xyz - positionLS;
    precise float distance2 = dot(toLight, toLight);
    precise float reach = distance2 * place.w;
    bool reaches = reach < 1.0;
    precise float window = 1.0 - reach * reach;
    // At the light itself the direction is undefined; the minimum distance yields a zero vector, and no NaN.
    precise float held2 = max(distance2, 1e-37);
    precise float inverse2 = 1.0 / held2;
    precise float falloff = (window * window) * min(inverse2, 1e4);
#if HAS_LIGHT_SHAPES
    vec4 attenuation = vec4(0.0);
    if (kind != LIGHT_POINT) attenuation = lightShapeTexel(index, 1);
#endif
#if HAS_ATTENUATION_LIGHTS
    if ((kind & LIGHT_ATTENUATION) != 0) {
        precise float distance = sqrt(distance2);
        precise float denominator = attenuation.x + attenuation.y * distance + attenuation.z * distance2;
        falloff = (window * window) / max(denominator, 1e-4);
    }
#endif
    precise vec3 direction = toLight * (sqrt(held2) * inverse2);
#if HAS_LIGHT_SHAPES
    float share = shareTowards(index, kind, direction, attenuation);
    bool shines = share > 0.0;
#if HAS_AREA_LIGHTS
    // From within its plane a two-sided flat light has no projected area, and yet fills half of all directions if it
    // contains the point.
    if (IS_AREA_LIGHT(kind & LIGHT_TYPE_MASK)) shines = shines || shinesFromBothSides(attenuation.w);
#endif
    reaches = reaches && shines;
#if HAS_AREA_LIGHTS
    // At most the irradiance by a hemisphere of its radiance.
    if (IS_AREA_LIGHT(kind & LIGHT_TYPE_MASK)) {
        precise float seenShare = share / (held2 + share * kInversePi);
        share = 1.0;
        falloff = (window * window) * seenShare;
    }
#endif
    falloff *= share;
#endif
    precise vec3 irradiance = color.rgb * falloff;
#if HAS_LIGHT_PICTURES
    int picture = IS_AREA_LIGHT(kind & LIGHT_TYPE_MASK) ? lightPictureOf(attenuation.w) : -1;
    if (picture >= 0) irradiance *= lightPictureMean(picture);
#endif
    incident.toLightLS = direction;
    incident.irradiance = irradiance;
    return reaches;
#else
    return false;
#endif
}
