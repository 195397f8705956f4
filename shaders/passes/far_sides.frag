// Back faces of bodies of glass: the shading normal and the depth.
#include "lib/raster/rasterised.glsl"
#include "lib/raster/coverage.glsl"

layout(location = 0) out vec4 farSide;

void main()
{
    Fragment fragment = rasterisedFragment();
    vec3 texel = vec3(0.5, 0.5, 1.0);
#if HAS_NORMAL_TEXTURE
    vec3 normalTexel = sampleSlot(normalTexture, TEXTURE_SLOT_NORMAL, fragment).rgb;
    if (materialFlag(MATERIAL_FLAG_NORMAL_MAP)) texel = normalTexel;
#endif
    if (coversNothing(materialBaseColor(fragment))) discard;
    farSide = vec4(safeNormalize(materialNormal(fragment, texel), vec3(0.0, 0.0, 1.0)), gl_FragCoord.z);
}
