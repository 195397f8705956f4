// Single terms of the lobes with a direction, an exponent or fibres. In: (n, alpha along the tangent), (h, alpha along
// the bitangent), (tangent, exponent), (direction, cosine).
// Out: (anisotropic D, isotropic D, Smith length of the direction, alpha along h), (Blinn-Phong's highlight, Charlie's
// D, Charlie's V for n.l = n.v = cosine, albedo of a white sheen at the cosine).
#include "lib/reflectance/sheen.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i * 4u >= uint(inputs.length())) return;
    vec4 a = inputs[i * 4u];
    vec4 b = inputs[i * 4u + 1u];
    vec4 c = inputs[i * 4u + 2u];
    vec4 d = inputs[i * 4u + 3u];
    vec2 alpha = vec2(a.w, b.w);
    HalfSum h = halfSumAlong(a.xyz, b.xyz);
    outputs[i * 2u] =
        vec4(distributionGgxAnisotropic(alpha, a.xyz, c.xyz, h), distributionGgx(a.w * a.w, ggxScale(a.w * a.w), h),
             smithLengthAnisotropic(alpha, a.xyz, c.xyz, d.xyz), sqrt(alpha2Along(alpha, a.xyz, c.xyz, h)));
    outputs[i * 2u + 1u] = vec4(blinnPhongLobe(c.w, h), distributionCharlie(a.w, h),
                                visibilityCharlie(a.w, d.w, d.w), sheenAlbedo(a.w, d.w));
}
