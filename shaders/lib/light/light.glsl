// One light: reading it, and its irradiance at a point. The windows (range, cone) belong to the light and are the same
// in every technique, also where nothing is culled.
#pragma once
#include "lib/light/light_store.glsl"

// Light as it arrives at a point.
struct Incident {
    vec3 toLightLS; // unit
    vec3 intensity; // irradiance at normal incidence, L of the shading formulas; 0 where the light does not reach
};

// The light that arrives at positionLS from light `index`. False where its range or cone makes it exactly 0.
bool incidentLight(int index, vec3 positionLS, out Incident incident)
{
    vec4 place = lightTexel(index, 0);
    vec4 color = lightTexel(index, 1);
    int kind = int(color.w);
    incident.toLightLS = place.xyz;
    incident.intensity = color.rgb;
#if HAS_DIRECTIONAL_LIGHTS
    if (kind == LIGHT_DIRECTIONAL) return true;
#endif
#if HAS_POINT_LIGHTS || HAS_SPOT_LIGHTS
    precise vec3 toLight = place.xyz - positionLS;
    precise float distance2 = dot(toLight, toLight);
    precise float reach = distance2 * place.w;
    if (!(reach < 1.0)) return false;
    precise float window = 1.0 - reach * reach;
    precise float falloff = (window * window) / max(distance2, 1e-4);
#if HAS_ATTENUATION_LIGHTS || HAS_SPOT_LIGHTS
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
    // At the light itself no direction is better than another; this one gives no NaN.
    precise vec3 direction = distance2 > 0.0 ? toLight / sqrt(distance2) : vec3(0.0);
#if HAS_SPOT_LIGHTS
    if ((kind & LIGHT_SPOT) != 0) {
        vec4 axis = lightShapeTexel(index, 0);
        precise vec3 beside = direction + axis.xyz;
        precise float apart = (kind & LIGHT_BROAD) != 0 ? dot(direction, axis.xyz) : dot(beside, beside);
        precise float cone = clamp(attenuation.w - axis.w * apart, 0.0, 1.0);
        if (!(cone > 0.0)) return false;
        falloff *= cone * cone;
    }
#endif
    precise vec3 intensity = color.rgb * falloff;
    incident.toLightLS = direction;
    incident.intensity = intensity;
    return true;
#else
    return false;
#endif
}
