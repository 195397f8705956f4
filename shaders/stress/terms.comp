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
    HalfSum h = halfSumAlong(a.xyz, b.xyz);
    precise float alpha2 = a.w * a.w;
    float lengthLight = smithLength(alpha2, b.w), lengthView = smithLength(alpha2, c.x);
    outputs[record * 2] =
        vec4(distributionGgx(alpha2, ggxScale(alpha2), h), visibilitySeparable(b.w, lengthLight, c.x, lengthView),
             visibilityCorrelated(b.w, lengthLight, c.x, lengthView), fresnelDielectric(c.y, c.z));
    outputs[record * 2 + 1] = vec4(fresnelSchlick(vec3(c.w), vec3(1.0 - c.w), c.z), 0.0);
}
