// Minimum cosine between shading normal and viewer. Interpolated and mapped normals may point away from a viewer whom
// the triangle faces; every specular term would be 0 there, and the image black. lib/material/material_frame.glsl bends
// such normals.
#pragma once
#include "lib/surface/camera.glsl"

// 0.9 degrees above the horizon: more than the 0.48 degrees by which the coarsest G-buffer layout may turn a normal
// (docs/numerics.md). A power of two, so that the reference has the same value to the bit.
const float kLeastFacing = 1.0 / 64.0;

// At such a grazing angle of the triangle, half of its cosine, so that flat surfaces keep every bit of their normals up
// to the horizon: the cosine's rounding error is far smaller. kLeastFacing for NaN (a triangle without area).
float leastFacing(float facetCosine)
{
    return facetCosine < 2.0 * kLeastFacing ? 0.5 * facetCosine : kLeastFacing;
}

// Cosine between the triangle's normal and the viewer's direction. Depth is linear over a triangle in the image, so its
// changes to the next pixels determine the plane: with a pixel's steps `right` and `up` across the view axis, and s the
// change of distance per change of depth, in units of such a step, the normal is
// cross(right + s change.x ray, up + s change.y ray).
float facetCosineOf(vec2 pixel, float depth, vec2 depthChange, vec3 toViewer)
{
    vec4 lens = view.aheadFromDepth;
    vec2 spread = raySpread();
    // Scaled by the pixel's step, which may be of any size.
    precise float stepMetres = max(max(abs(view.rayDxLS.x), abs(view.rayDxLS.y)), abs(view.rayDxLS.z));
    precise vec3 right = view.rayDxLS.xyz / stepMetres;
    precise vec3 up = view.rayDyLS.xyz / stepMetres;
    precise vec3 ray = view.forwardLS.xyz + spread.y * acrossOfPixel(pixel);
    precise float below = lens.z + lens.w * depth;
    precise float ahead = (lens.x + lens.y * depth) / below;
    precise float aheadChange = (lens.y * lens.z - lens.x * lens.w) / (below * below); // per change of depth
    precise vec2 slope = aheadChange / ((spread.x + spread.y * ahead) * stepMetres) * depthChange;
    precise vec3 flatPart = cross(right, up);
    precise vec3 normal = flatPart + slope.y * cross(right, ray) + slope.x * cross(ray, up);
    precise float cosine = abs(dot(flatPart, toViewer)) / sqrt(dot(normal, normal));
    return cosine;
}
