// Small vector functions. In: (v, -), (unit vector n, -).
// Out: (v normalised, or (7, 7, 7) if it has no direction, -), (a vector perpendicular to n, -).
#include "lib/maths/math.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i * 2u >= uint(inputs.length())) return;
    outputs[i * 2u] = vec4(safeNormalize(inputs[i * 2u].xyz, vec3(7.0)), 0.0);
    outputs[i * 2u + 1u] = vec4(anyPerpendicular(inputs[i * 2u + 1u].xyz), 0.0);
}
