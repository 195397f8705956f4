// The normal of the triangle that is rasterised, in lighting space and away from the viewer: the mesh's own, carried as
// normals of vertices are. Differences of gl_FragCoord.z between pixels would tell it only where a rasteriser finds
// depths from vertices that are not snapped to parts of a pixel.
#pragma once
#include "lib/surface/camera.glsl"

// Three numbers a triangle of the scene's index buffer: unit, out of the front of the mesh in its own space.
layout(std430, binding = STORAGE_TRIANGLE_NORMALS) readonly buffer TriangleNormals
{
    float triangleNormalsOS[];
};
layout(location = 9) flat in uint firstTriangle; // of the draw

// `normalFromObject` as passes/geometry.vert has its rows.
vec3 rasterisedFacetNormal(mat3 normalFromObject, bool frontFacing)
{
    uint first = 3u * (firstTriangle + uint(gl_PrimitiveID));
    vec3 normalOS = vec3(triangleNormalsOS[first], triangleNormalsOS[first + 1u], triangleNormalsOS[first + 2u]);
    precise vec3 turned = normalFromObject * normalOS;
    if (frontFacing) turned = -turned;
    precise vec3 scaled = turned / max(max(abs(turned.x), abs(turned.y)), max(abs(turned.z), 1e-37));
    precise float length2 = dot(scaled, scaled);
    // A triangle without area, of which rounding leaves some.
    if (!(length2 >= 1.0 && length2 <= 3.5)) return view.forwardLS.xyz;
    return scaled * inversesqrt(length2);
}
