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

// Makes a surface one that reflects what enters it to all sides alike, without layers. enteredMaterial() of
// renderer/frame/MaterialFeatures.cpp says the same of its material, by which code that this leaves unused is left out.
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
    unspread = vec4(kept, 1.0);
}
