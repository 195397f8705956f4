// What a fragment's triangle holds at the pixel's centre, in double precision (passes/triangle.geom hands it over).
// Rasterisers interpolate in fp32 from a corner of the window, which loses as many digits as a value changes over the
// picture: where a pixel spans hundreds of texels, a hundredth of a texel, and more on slivers. Only --filter exact pays
// for this.
#pragma once
#include "lib/camera.glsl"

layout(location = 10) flat in vec3 triangleLS[3];
#if HAS_TEXTURES
layout(location = 13) flat in vec4 triangleTexCoords[3]; // xy the first set, zw the second
#endif
#if !DEPTH_ONLY
layout(location = 16) flat in vec3 triangleNormalLS[3];
#endif

// Weights of the triangle's corners where the ray through the pixel's centre meets its plane, by Cramer's rule.
dvec3 triangleWeights(vec2 pixel)
{
    dvec3 across = double(pixel.x - frame.lensVS.z) * dvec3(frame.rayDxLS.xyz)
                   + double(pixel.y - frame.lensVS.w) * dvec3(frame.rayDyLS.xyz);
    // Where the ray meets the plane through the origin of lighting space.
    dvec3 origin = double(raySpread().x) * across;
    dvec3 direction = dvec3(frame.forwardLS.xyz) + double(raySpread().y) * across;
    dvec3 corner = dvec3(triangleLS[0]) - origin;
    dvec3 edge1 = dvec3(triangleLS[1]) - dvec3(triangleLS[0]);
    dvec3 edge2 = dvec3(triangleLS[2]) - dvec3(triangleLS[0]);
    double slope = dot(cross(edge1, edge2), direction);
    if (slope == 0.0) return dvec3(1.0, 0.0, 0.0); // seen exactly edge-on: nothing to be met
    dvec3 moment = cross(direction, corner);
    double weight1 = -dot(edge2, moment) / slope;
    double weight2 = dot(edge1, moment) / slope;
    return dvec3(1.0 - weight1 - weight2, weight1, weight2);
}

#if HAS_MIXED_FILTERS
// Change of those weights to the next pixel, along a change of the pixel's ray: the quotient rule on Cramer's.
dvec3 triangleWeightsChange(vec2 pixel, dvec3 weights, dvec3 rayChange)
{
    dvec3 ray = dvec3(frame.rayOriginLS.xyz) + double(pixel.x) * dvec3(frame.rayDxLS.xyz)
                + double(pixel.y) * dvec3(frame.rayDyLS.xyz);
    bool parallelRays = frame.forwardLS.w != 0.0;
    dvec3 direction = parallelRays ? dvec3(frame.forwardLS.xyz) : ray;
    dvec3 edge1 = dvec3(triangleLS[1]) - dvec3(triangleLS[0]);
    dvec3 edge2 = dvec3(triangleLS[2]) - dvec3(triangleLS[0]);
    dvec3 area = cross(edge1, edge2);
    double slope = dot(area, direction);
    if (slope == 0.0) return dvec3(0.0);
    dvec3 across = parallelRays ? cross(rayChange, direction) : cross(rayChange, dvec3(triangleLS[0]));
    double slopeChange = parallelRays ? 0.0 : dot(area, rayChange);
    double change1 = (-dot(edge2, across) - weights.y * slopeChange) / slope;
    double change2 = (dot(edge1, across) - weights.z * slopeChange) / slope;
    return dvec3(-change1 - change2, change1, change2);
}
#endif

#if HAS_TEXTURES
// Both sets.
dvec4 triangleTexCoord(dvec3 weights)
{
    return weights.x * dvec4(triangleTexCoords[0]) + weights.y * dvec4(triangleTexCoords[1])
           + weights.z * dvec4(triangleTexCoords[2]);
}
#endif

#if !DEPTH_ONLY
// Not unit.
vec3 triangleNormal(dvec3 weights)
{
    return vec3(weights.x * dvec3(triangleNormalLS[0]) + weights.y * dvec3(triangleNormalLS[1])
                + weights.z * dvec3(triangleNormalLS[2]));
}
#endif
