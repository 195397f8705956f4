// The microfacet terms for given cosines. In: (n, alpha), (h, n.l), (n.v, ior, cosine of Fresnel, f0).
// Out: (D, separable V, correlated V, dielectric F), (Schlick F with F90 = 1, 0, 0, 0).
#include "lib/brdf.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i * 3u >= uint(inputs.length())) return;
    vec4 a = inputs[i * 3u];
    vec4 b = inputs[i * 3u + 1u];
    vec4 c = inputs[i * 3u + 2u];
    outputs[i * 2u] = vec4(distributionGgx(a.w, a.xyz, b.xyz), visibilitySeparable(a.w, b.w, c.x),
                           visibilityCorrelated(a.w, b.w, c.x), fresnelDielectric(c.y, c.z));
    outputs[i * 2u + 1u] = vec4(fresnelSchlick(vec3(c.w), 1.0, c.z), 0.0);
}
