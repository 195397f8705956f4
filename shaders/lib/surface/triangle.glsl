// Interpolation over a fragment's triangle in double precision, with inputs from passes/triangle.geom. Rasterisers
// interpolate in fp32 from a corner of the window, which loses as many digits as a value changes over the image: a
// hundredth of a texel where a pixel spans hundreds of texels, and more on slivers. Only --filter exact pays for this.
#pragma once
#include "lib/surface/camera.glsl"

layout(location = 10) flat in vec3 triangleLS[3];
#if HAS_TEXCOORDS
layout(location = 13) flat in vec4 triangleTexCoords[3]; // xy first set, zw second
#endif
#if !DEPTH_ONLY
layout(location = 16) flat in vec3 triangleNormalLS[3];
#endif

// Ray through a pixel position.
struct PixelRay {
    dvec3 originLS; // intersection with the plane across the view axis through the origin of lighting space
    dvec3 directionLS;
};

PixelRay pixelRay(vec2 pixel)
{
    dvec3 across = double(pixel.x - view.rayFromPixel.z) * dvec3(view.rayDxLS.xyz)
                   + double(pixel.y - view.rayFromPixel.w) * dvec3(view.rayDyLS.xyz);
    dvec2 spread = dvec2(raySpread());
    return PixelRay(spread.x * across, dvec3(view.forwardLS.xyz) + spread.y * across);
}

// Barycentric weights of the intersection of a pixel's ray with the triangle's plane, by Cramer's rule.
dvec3 triangleWeights(vec2 pixel)
{
    PixelRay ray = pixelRay(pixel);
    dvec3 edge1 = dvec3(triangleLS[1]) - dvec3(triangleLS[0]);
    dvec3 edge2 = dvec3(triangleLS[2]) - dvec3(triangleLS[0]);
    double slope = dot(cross(edge1, edge2), ray.directionLS);
    if (slope == 0.0) return dvec3(1.0, 0.0, 0.0); // exactly edge-on: no intersection
    dvec3 moment = cross(ray.directionLS, dvec3(triangleLS[0]) - ray.originLS);
    double weight1 = -dot(edge2, moment) / slope;
    double weight2 = dot(edge1, moment) / slope;
    return dvec3(1.0 - weight1 - weight2, weight1, weight2);
}

#if !DEPTH_ONLY
// Cosine between the triangle's normal and the pixel's ray; NaN for a triangle without area.
float triangleCosine(vec2 pixel)
{
    dvec3 direction = pixelRay(pixel).directionLS;
    dvec3 area = cross(dvec3(triangleLS[1]) - dvec3(triangleLS[0]), dvec3(triangleLS[2]) - dvec3(triangleLS[0]));
    double slope = dot(area, direction);
    return sqrt(float(slope * slope / (dot(area, area) * dot(direction, direction))));
}
#endif

#if HAS_MIXED_FILTERS
// Change of the weights to the next pixel, by the quotient rule. `acrossChange`: change of the ray across the view
// axis, at one metre ahead of the eye (orthographic: at any depth).
dvec3 triangleWeightsChange(vec2 pixel, dvec3 weights, dvec3 acrossChange)
{
    PixelRay ray = pixelRay(pixel);
    dvec2 spread = dvec2(raySpread());
    dvec3 edge1 = dvec3(triangleLS[1]) - dvec3(triangleLS[0]);
    dvec3 edge2 = dvec3(triangleLS[2]) - dvec3(triangleLS[0]);
    dvec3 area = cross(edge1, edge2);
    double slope = dot(area, ray.directionLS);
    if (slope == 0.0) return dvec3(0.0);
    dvec3 momentChange = spread.y * cross(acrossChange, dvec3(triangleLS[0]) - ray.originLS)
                         - spread.x * cross(ray.directionLS, acrossChange);
    double slopeChange = spread.y * dot(area, acrossChange);
    double change1 = (-dot(edge2, momentChange) - weights.y * slopeChange) / slope;
    double change2 = (dot(edge1, momentChange) - weights.z * slopeChange) / slope;
    return dvec3(-change1 - change2, change1, change2);
}
#endif

#if HAS_TEXCOORDS
// Both texture-coordinate sets.
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
