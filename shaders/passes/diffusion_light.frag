// Lights the texels of an object as a Lambertian surface: computes the light that enters. Pixels reflect the undiffused
// fraction of the frame's lights, but not of light transmitted through the object: the texels keep that fraction here.
#include "lib/raster/rasterised.glsl"
#include "lib/lighting/lighting.glsl"
#include "shared/diffusion.h"

layout(std140, binding = UNIFORM_PASS) uniform DiffusionLightBlock
{
    DiffusionLightConstants constants;
};

layout(location = 15) in vec3 positionLS;
layout(location = 0) out vec4 entering;
layout(location = 1) out vec4 undiffused;

// Makes a surface Lambertian, without layers. enteredMaterial() of renderer/frame/MaterialFeatures.cpp does the same to
// its material, so that code which becomes unused is left out.
void takeEnteredValues(inout Surface surface)
{
    surface.model = MODEL_LAMBERT;
    surface.albedo = powerOf(surface.albedo, material.mixed.z);
    surface.emission = vec3(0.0);
#if HAS_CLEARCOAT
    surface.coatFactor = 0.0;
#endif
}

void main()
{
    Fragment fragment = rasterisedFragment();
#if HAS_SHADOW_LIFT
    fragment.liftCode = encodeLift(rasterisedLift(positionLS, fragment.normalLS, vec2(0.0)), positionLS);
#endif
    Surface surface = surfaceFromMaterial(fragment, materialBaseColor(fragment));
    takeEnteredValues(surface);
    Viewpoint viewpoint;
    viewpoint.positionLS = positionLS;
    viewpoint.toViewerLS = surface.normalLS;
    viewpoint.depth = 0.5;
    viewpoint.pixel = gl_FragCoord.xy;
    vec3 passed = vec3(0.0);
    precise vec3 light = shadeSurface(surface, viewpoint, gl_FragCoord.xy, passed);
    entering = vec4(light, 1.0);
    precise vec3 kept = constants.inTexels.rgb * light;
#if HAS_SHADOWS && HAS_SUBSURFACE_PASSAGE
    kept += constants.inPixels.rgb * passed;
#endif
    undiffused = vec4(kept, 1.0);
}
