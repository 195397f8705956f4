// The normal of the triangle that is rasterised, in lighting space. Depth is linear over the picture, so its change from
// pixel to pixel is that of the triangle's plane.
#pragma once
#include "lib/surface/camera.glsl"

vec3 rasterisedFacetNormal()
{
    vec2 change = vec2(dFdxFine(gl_FragCoord.z), dFdyFine(gl_FragCoord.z));
    vec2 place = gl_FragCoord.xy - view.rayFromPixel.zw;
    // Towards the viewer's right, up and ahead. A plane is where the product of this with a pixel's ray is as depth and a
    // constant, which go with 1/distance; of parallel rays it is where the distance ahead is linear.
    precise vec3 normal = vec3(change, gl_FragCoord.z + view.aheadFromDepth.z - dot(change, place));
#if HAS_ORTHOGRAPHIC_CAMERA
    if (view.forwardLS.w != 0.0) normal = vec3(-change * view.aheadFromDepth.y, 1.0);
#endif
    normal.xy /= view.rayFromPixel.xy;
    precise vec3 turned = normal.x * view.rayDxLS.xyz / view.rayFromPixel.x
                          + normal.y * view.rayDyLS.xyz / view.rayFromPixel.y + normal.z * view.forwardLS.xyz;
    // Depths of far scenes are small; a triangle that pixels show edge-on may be of any steepness.
    precise vec3 scaled = turned / max(max(abs(turned.x), abs(turned.y)), max(abs(turned.z), 1e-37));
    precise float length2 = dot(scaled, scaled);
    if (!(length2 >= 1.0 && length2 <= 3.5)) return view.forwardLS.xyz;
    return scaled * inversesqrt(length2);
}
