// Tone maps and the transfer function of displays. In: linear radiance, TONEMAP_*. Out: (tone-mapped linear value, 0),
// (sRGB code without a tone map, 0).
#include "shared/tonemap.h"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(inputs.length())) return;
    outputs[2u * i] = vec4(toneMapped(inputs[i].rgb, uint(inputs[i].a)), 0.0);
    outputs[2u * i + 1u] = vec4(encodeSrgb(inputs[i].rgb), 0.0);
}
