// Encodes directions of any length as surface normals, and decodes them. In: (direction, -). Out: (normal, -).
#include "lib/maths/normal_code.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(inputs.length())) return;
    NormalCode code = encodeNormal(inputs[i].xyz);
    code.shares &= (1u << NORMAL_SHARE_BITS) - 1u;
    outputs[i] = vec4(decodeNormal(code), 0.0);
}
