// How far a lit normal must face the viewer. Normals are interpolated and read from maps, so that they may turn away from a
// viewer whom the triangle faces; every specular term would be 0 there, and the picture black. lib/material/material_frame.glsl
// bends them.
#pragma once
#include "lib/surface/camera.glsl"

// 0.9 degrees from the horizon: more than the 0.48 by which the coarsest layout of the G-buffer may turn a normal
// (docs/numerics.md). A power of two, which the reference has to the bit.
const float kLeastFacing = 1.0 / 64.0;

// Where the triangle itself is seen as obliquely, half of its own cosine, so that a flat surface keeps every bit up to its
// horizon: rounding leaves its cosine within far less. Where it has none (NaN), as without area, the whole.
float leastFacing(float facetCosine)
{
    return facetCosine < 2.0 * kLeastFacing ? 0.5 * facetCosine : kLeastFacing;
}

// The cosine between the triangle's normal and the viewer's direction. Depth is linear over a triangle in the picture, so its
// changes to the next pixels tell the plane: with a pixel's steps `right` and `up` across the view axis, and s metres of
// distance for each of depth over those of a step, along the ray, the normal is
// cross(right + s change.x ray, up + s change.y ray).
float facetCosineOf(vec2 pixel, float depth, vec2 depthChange, vec3 toViewer)
{
    vec4 lens = view.aheadFromDepth;
    vec2 spread = raySpread();
    // In steps of a pixel, of any size.
    precise float stepMetres = max(max(abs(view.rayDxLS.x), abs(view.rayDxLS.y)), abs(view.rayDxLS.z));
    precise vec3 right = view.rayDxLS.xyz / stepMetres;
    precise vec3 up = view.rayDyLS.xyz / stepMetres;
    precise vec3 ray = view.forwardLS.xyz + spread.y * acrossOfPixel(pixel);
    precise float below = lens.z + lens.w * depth;
    precise float ahead = (lens.x + lens.y * depth) / below;
    precise float aheadChange = (lens.y * lens.z - lens.x * lens.w) / (below * below); // for a change of depth
    precise vec2 slope = aheadChange / ((spread.x + spread.y * ahead) * stepMetres) * depthChange;
    precise vec3 flatPart = cross(right, up);
    precise vec3 normal = flatPart + slope.y * cross(right, ray) + slope.x * cross(ray, up);
    precise float cosine = abs(dot(flatPart, toViewer)) / sqrt(dot(normal, normal));
    return cosine;
}
