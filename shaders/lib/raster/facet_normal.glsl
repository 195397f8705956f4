// The normal of the triangle that is rasterised, in lighting space and away from the viewer: the mesh's own, which the
// triangle's last vertex carries. Differences of gl_FragCoord.z between pixels would tell it only where a rasteriser finds
// depths from vertices that are not snapped to parts of a pixel, and gl_PrimitiveID makes Mesa's llvmpipe assemble every
// triangle anew, which costs more than half of what drawing it does.
#pragma once
#include "lib/surface/camera.glsl"

// Out of the front of the mesh, of any length. The last vertex provokes, as everywhere in OpenGL without a word.
layout(location = 9) flat in vec3 facetNormalLS;

vec3 rasterisedFacetNormal(bool frontFacing)
{
    precise vec3 turned = frontFacing ? -facetNormalLS : facetNormalLS;
    precise vec3 scaled = turned / max(max(abs(turned.x), abs(turned.y)), max(abs(turned.z), 1e-37));
    precise float length2 = dot(scaled, scaled);
    // A triangle without area, of which rounding leaves some.
    if (!(length2 >= 1.0 && length2 <= 3.5)) return view.forwardLS.xyz;
    return scaled * inversesqrt(length2);
}
