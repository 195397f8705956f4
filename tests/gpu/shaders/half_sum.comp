// D for directions to a light and a viewer. In: (n, alpha), (l, 0), (v, 0). Out: (D, |l + v|, 0, 0).
#include "lib/reflectance/brdf.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i * 3u >= uint(inputs.length())) return;
    vec4 n = inputs[i * 3u];
    HalfSum h = halfSum(n.xyz, inputs[i * 3u + 1u].xyz, inputs[i * 3u + 2u].xyz);
    outputs[i] = vec4(distributionGgx(n.w * n.w, ggxScale(n.w * n.w), h), sqrt(h.length2), 0.0, 0.0);
}
