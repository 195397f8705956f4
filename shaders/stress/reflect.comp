// BRDF times cosine of a material, by the renderer's path from material to radiance. In: (normal, 0), (tangent,
// handedness), (to light, 0), (to viewer, 0). Out: (BRDF times cosine, n.l).
#include "records.glsl"
#include "lib/lighting/lighting.glsl"
#include "lib/material/material.glsl"

void main()
{
    int record = recordIndex(4);
    if (record < 0) return;
    Fragment fragment = plainFragment();
    fragment.normalLS = inputs[record * 4].xyz;
    fragment.tangentLS = inputs[record * 4 + 1];
    Surface surface = surfaceFromMaterial(fragment, materialBaseColor(fragment));
    vec3 toLight = inputs[record * 4 + 2].xyz;
    vec3 brdfCosine = layeredBrdfCosine(seenSurface(surface, inputs[record * 4 + 3].xyz), toLight);
    outputs[record] = vec4(brdfCosine, dot(surface.normalLS, toLight));
}
