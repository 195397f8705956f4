// Diffused irradiance of subsurface scattering, computed before the surface is drawn (docs/skin.md). The surface emits
// it, and reflects the frame's lights by its highlights and by the fraction of light that is not diffused.
#pragma once
#include "lib/surface/camera.glsl"
#include "lib/surface/surface.glsl"
#if HAS_SUBSURFACE_DIFFUSION
#include "shared/diffusion.h"
#include "lib/material/material.glsl"
#include "lib/reflectance/reflectance.glsl"

// One cell per object, with texels of light around every chart (DiffusionAtlas of renderer/frame/Diffusion.h).
layout(binding = IMAGE_UNIT_DIFFUSED_LIGHT, rgba32f) readonly uniform image2D diffusionAtlas;

#if FILTER_EXACT
layout(location = 19) flat in int diffusionNumber; // atlas cell + 1; 0: the object has none
#else
layout(location = 14) flat in int diffusionNumber;
#endif

// rgb fraction of light that leaves where it enters, a texels around the area of the coordinates 0 to 1.
vec4 diffusionCellValues(int cell)
{
    return imageLoad(diffusionAtlas, ivec2(cell % DIFFUSION_CELL_COLUMNS,
                                          DIFFUSION_CELL_ROWS * DIFFUSION_CELL_TEXELS + cell / DIFFUSION_CELL_COLUMNS));
}

// Bilinear over the texels that hold light; alpha is 0 if none does, as on a chart smaller than a texel.
vec4 diffusedLightAt(vec2 texCoord, int cell, float border)
{
    ivec2 corner = ivec2(cell % DIFFUSION_CELL_COLUMNS, cell / DIFFUSION_CELL_COLUMNS) * DIFFUSION_CELL_TEXELS;
    precise vec2 place = PLACE_IN_UV_ATLAS(texCoord, border, float(DIFFUSION_CELL_TEXELS)) - 0.5;
    vec2 low = floor(place);
    precise vec2 share = place - low;
    ivec2 most = ivec2(DIFFUSION_CELL_TEXELS - 1);
    ivec2 a = corner + clamp(ivec2(low), ivec2(0), most);
    ivec2 b = corner + clamp(ivec2(low) + 1, ivec2(0), most);
    precise vec4 lower = mix(imageLoad(diffusionAtlas, a), imageLoad(diffusionAtlas, ivec2(b.x, a.y)), share.x);
    precise vec4 upper = mix(imageLoad(diffusionAtlas, ivec2(a.x, b.y)), imageLoad(diffusionAtlas, b), share.x);
    precise vec4 light = mix(lower, upper, share.y);
    if (light.a == 0.0) return vec4(0.0);
    precise vec3 known = light.rgb / light.a;
    return vec4(known, 1.0);
}

// Adds the diffused light to the surface's emission, and makes F0 of metallic_roughness that of a dielectric.
// addMaterial() of renderer/frame/MaterialFeatures.cpp adds both to the scene's features, so that G-buffers store them.
void takeDiffusedLight(Fragment fragment, inout Surface surface)
{
    if (diffusionNumber == 0 || IS_UNLIT(surface.model)) return;
    // The fraction of leaving light that goes to the viewer does not depend on its path: it equals the fraction that
    // enters from the viewer's mirrored direction.
    vec3 toViewer = viewpointFromDepth(gl_FragCoord.xy, 0.5).toViewerLS;
    SeenSurface seen = seenSurface(surface, toViewer);
    vec3 after = powerOf(surface.albedo, 1.0 - material.mixed.z);
    seen.surface.albedo = after;
#if HAS_GGX_MODELS
    precise vec3 diffuse = after * ((1.0 - surface.metallic) * kInversePi);
    seen.diffuse = diffuse;
#endif
    precise float nv = max(seen.nv, 0.0);
    precise vec3 mirrored = 2.0 * seen.nv * surface.normalLS - toViewer;
    precise vec3 diffuseBrdf = reflection(seen, directionsOn(seen, mirrored, nv)).diffuse;
    vec4 cell = diffusionCellValues(diffusionNumber - 1);
    vec4 light = diffusedLightAt(vec2(fragment.texCoord[0]), diffusionNumber - 1, cell.a);
    precise vec3 emission = surface.emission + diffuseBrdf * light.rgb;
    surface.emission = emission;
    precise vec3 inPixels = surface.albedo * (light.a == 0.0 ? vec3(1.0) : cell.rgb);
#if HAS_GGX_MODELS
    if (HAS_METALLIC(surface.model)) {
        surface.specular = seen.f0;
        precise float f90 = surface.iorOrF90 + (1.0 - surface.iorOrF90) * surface.metallic;
        surface.iorOrF90 = f90;
        inPixels *= 1.0 - surface.metallic;
        surface.metallic = 0.0;
    }
#endif
    surface.albedo = inPixels;
#if HAS_SUBSURFACE_ROWS
    surface.subsurface = 0u;
#endif
}
#else
void takeDiffusedLight(Fragment fragment, inout Surface surface)
{
}
#endif
