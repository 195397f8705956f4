// Lights the texels of an object, as a surface that reflects to all sides alike: what enters it. Pixels are lit by the
// frame's lights as far as light does not spread, but not by what passes through the object: that share stays here.
#include "lib/raster/rasterised.glsl"
#include "lib/lighting/lighting.glsl"
#include "shared/diffusion.h"

layout(std140, binding = UNIFORM_PASS) uniform DiffusionLightBlock
{
    DiffusionLightConstants constants;
};

layout(location = 15) in vec3 positionLS;
layout(location = 0) out vec4 entering;
layout(location = 1) out vec4 unspread;

vec3 albedoBeforeSpreading(vec3 albedo)
{
    float power = material.mixed.z;
    if (power == 0.0) return vec3(1.0);
    if (power == 1.0) return albedo;
    return pow(max(albedo, vec3(0.0)), vec3(power));
}

void main()
{
    Fragment fragment = rasterisedFragment();
    Surface surface = surfaceFromMaterial(fragment, materialBaseColor(fragment));
    surface.model = MODEL_LAMBERT;
    surface.albedo = albedoBeforeSpreading(surface.albedo);
    surface.emission = vec3(0.0);
#if HAS_CLEARCOAT
    surface.coatFactor = 0.0;
#endif
#if HAS_SHEEN
    surface.sheenColor = vec3(0.0);
#endif
    Viewpoint viewpoint;
    viewpoint.positionLS = positionLS;
    viewpoint.toViewerLS = surface.normalLS;
    viewpoint.depth = 0.5;
    viewpoint.pixel = gl_FragCoord.xy;
    precise vec3 light = shadeSurface(surface, viewpoint, gl_FragCoord.xy);
    entering = vec4(light, 1.0);
    precise vec3 kept = constants.inTexels.rgb * light;
#if HAS_SHADOWS && HAS_SUBSURFACE_PASSAGE
    kept += constants.inPixels.rgb * passedLight;
#endif
    unspread = vec4(kept, 1.0);
}
