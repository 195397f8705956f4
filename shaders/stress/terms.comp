// The microfacet terms for given directions and cosines. In: (n, alpha), (h, n.l), (n.v, ior, cosine of Fresnel, f0).
// Out: (D, separable V, correlated V, dielectric F), (Schlick F with F90 = 1, 0, 0, 0).
#include "records.glsl"
#include "lib/reflectance/brdf.glsl"

void main()
{
    int record = recordIndex(3);
    if (record < 0) return;
    vec4 a = inputs[record * 3];
    vec4 b = inputs[record * 3 + 1];
    vec4 c = inputs[record * 3 + 2];
    outputs[record * 2] = vec4(distributionGgx(a.w, a.xyz, b.xyz), visibilitySeparable(a.w, b.w, c.x),
                               visibilityCorrelated(a.w, b.w, c.x), fresnelDielectric(c.y, c.z));
    outputs[record * 2 + 1] = vec4(fresnelSchlick(vec3(c.w), 1.0, c.z), 0.0);
}
