// Encodes and decodes normals of triangles. In: (unit normal, -). Out: (stored normal, -).
#include "lib/surface/facet.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(inputs.length())) return;
    outputs[i] = vec4(decodeFacet(encodeFacet(inputs[i].xyz)), 0.0);
}
