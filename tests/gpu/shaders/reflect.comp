// One light direction on one surface. In: (albedo, metallic), (normal, alpha), (specular, ior or F90), (l, model),
// (v, intensity).
// Out: (reflected share, n.l), (d, v, F.g, 0), (share times intensity, 0).
#include "lib/lighting.glsl"

layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };
layout(std430, binding = 1) writeonly buffer Outputs { vec4 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i * 5u >= uint(inputs.length())) return;
    vec4 albedo = inputs[i * 5u];
    vec4 normal = inputs[i * 5u + 1u];
    vec4 specular = inputs[i * 5u + 2u];
    vec4 light = inputs[i * 5u + 3u];
    vec4 viewer = inputs[i * 5u + 4u];
    Surface surface;
    surface.model = uint(light.w);
    surface.albedo = albedo.rgb;
    surface.metallic = albedo.w;
    surface.alpha = normal.w;
    surface.specular = specular.rgb;
    surface.iorOrF90 = specular.w;
    surface.emission = vec3(0.0);
    surface.normalLS = normal.xyz;
    surface.normalTexel = vec3(0.5, 0.5, 1.0);
    setNeutralLobes(surface);
    precise float nl = dot(surface.normalLS, light.xyz);
    SpecularTerms terms = specularTerms(surface, light.xyz, viewer.xyz, nl);
    precise vec3 share = reflectedShare(surface, light.xyz, viewer.xyz);
    precise vec3 lit = share * viewer.w;
    outputs[i * 3u] = vec4(share, nl);
    outputs[i * 3u + 1u] = vec4(terms.d, terms.v, terms.f.g, 0.0);
    outputs[i * 3u + 2u] = vec4(lit, 0.0);
}
