// Decodes sRGB codes by the arithmetic of the filter "exact". In: (code, -). Out: (linear value, 0).
#include "lib/material/texture_filter.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(inputs.length())) return;
    outputs[i] = vec4(decodeSrgb(inputs[i].rgb), 0.0);
}
