// Identifies a fragment's triangle: object and triangle for opaque surfaces; a hash of both for transparent ones,
// summed by blending. The image is exact while numbers stay below 2^24, where fp32 holds every integer.
#include "lib/raster/rasterised.glsl"
#include "lib/raster/coverage.glsl"

layout(location = 9) flat in float drawnObject; // 1 + index of the mesh instance in the scene
layout(location = 0) out vec4 ids;

#if BLENDED
// Below 2^16, so that 256 surfaces add up exactly. The same formula as reference::transparentId.
float transparentId(uint object, uint triangle)
{
    uint mixed = object * 0x9E3779B1u + triangle * 0x85EBCA6Bu;
    return float((mixed ^ (mixed >> 15)) * 0xC2B2AE35u >> 16);
}
#endif

void main()
{
    if (coversNothing(materialBaseColor(rasterisedFragment()))) discard;
#if BLENDED
    ids = vec4(0.0, 0.0, transparentId(uint(drawnObject), uint(gl_PrimitiveID)), 1.0);
#else
    ids = vec4(drawnObject, float(gl_PrimitiveID), 0.0, 1.0);
#endif
}
