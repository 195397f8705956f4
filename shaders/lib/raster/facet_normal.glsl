// Geometric normal of the rasterised triangle, in lighting space and away from the viewer, from an attribute of the
// triangle's last vertex. Differences of gl_FragCoord.z between pixels would give it only on rasterisers that compute
// depths from unsnapped vertices, and gl_PrimitiveID makes Mesa's llvmpipe reassemble every triangle, which costs more
// than half as much as drawing it.
#pragma once
#include "lib/surface/camera.glsl"

// Points out of the mesh's front, of any length. The last vertex is the provoking one, OpenGL's default.
layout(location = 9) flat in vec3 facetNormalLS;

vec3 rasterisedFacetNormal(bool frontFacing)
{
    precise vec3 turned = frontFacing ? -facetNormalLS : facetNormalLS;
    precise vec3 scaled = turned / max(max(abs(turned.x), abs(turned.y)), max(abs(turned.z), 1e-37));
    precise float length2 = dot(scaled, scaled);
    // A degenerate triangle: rounding may leave fragments of it.
    if (!(length2 >= 1.0 && length2 <= 3.5)) return view.forwardLS.xyz;
    return scaled * inversesqrt(length2);
}
