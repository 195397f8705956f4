// Sampling of the visible microfacets of a GGX lobe.
#pragma once
#include "lib/reflectance/brdf.glsl"

vec3 aroundNormal(vec3 direction, vec3 normal, vec3 tangent)
{
    precise vec3 turned = direction.x * tangent + direction.y * cross(normal, tangent) + direction.z * normal;
    return turned;
}

// Reflection of the viewer's ray at a sampled visible microfacet. Source: Heitz 2018, "Sampling the GGX Distribution of
// Visible Normals", listing 1.
vec3 visibleReflection(vec2 point, vec2 alpha, vec3 toViewer, vec3 normal, vec3 tangent)
{
    precise vec3 bitangent = cross(normal, tangent);
    precise vec3 viewer = vec3(dot(toViewer, tangent), dot(toViewer, bitangent), dot(toViewer, normal));
    vec3 stretched = safeNormalize(vec3(alpha * viewer.xy, viewer.z), vec3(0.0, 0.0, 1.0));
    precise float across2 = dot(stretched.xy, stretched.xy);
    vec3 first = vec3(1.0, 0.0, 0.0);
    if (across2 > 0.0) first = safeNormalize(vec3(-stretched.y, stretched.x, 0.0), first);
    precise vec3 second = cross(stretched, first);
    precise float radius = sqrt(point.x);
    precise float angle = 2.0 * kPi * point.y;
    precise float x = radius * cos(angle);
    precise float rim = sqrt(max(1.0 - x * x, 0.0));
    precise float share = 0.5 * (1.0 + stretched.z);
    precise float y = (1.0 - share) * rim + share * (radius * sin(angle));
    precise vec3 facet = x * first + y * second + sqrt(max(1.0 - x * x - y * y, 0.0)) * stretched;
    precise vec3 back = vec3(alpha * facet.xy, max(facet.z, 1e-6));
    vec3 half_ = aroundNormal(safeNormalize(back, vec3(0.0, 0.0, 1.0)), normal, tangent);
    precise vec3 reflected = 2.0 * dot(toViewer, half_) * half_ - toViewer;
    return safeNormalize(reflected, normal);
}
