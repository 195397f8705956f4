// Thin-film iridescence at rasterisation (docs/iridescence.md): replaces f0 by the one whose Schlick curve passes
// through the film's reflectance towards the viewer, so that lighting and the G-buffer need no film parameters.
#pragma once
#include "lib/material/material_values.glsl"
#include "lib/surface/camera.glsl"
#include "lib/surface/surface.glsl"
#if HAS_IRIDESCENCE
#include "lib/material/material.glsl"
#include "lib/reflectance/film.glsl"
#include "lib/reflectance/reflectance.glsl"

// At smaller cosines Schlick's curve is nearly 1 for every f0, so that none would match.
const float kFilmLeastCosine = 0.1;

void coverWithFilm(Fragment fragment, inout Surface surface)
{
    if (!(material.film.x > 0.0) || !HAS_METALLIC(surface.model)) return;
    precise float share = material.film.x;
#if HAS_IRIDESCENCE_TEXTURE
    share *= sampleSlot(iridescenceTexture, TEXTURE_SLOT_IRIDESCENCE, fragment).r;
#endif
    precise float thickness = material.film.z;
#if HAS_IRIDESCENCE_THICKNESS_TEXTURE
    float texel = sampleSlot(iridescenceThicknessTexture, TEXTURE_SLOT_IRIDESCENCE_THICKNESS, fragment).g;
    thickness += (1.0 - texel) * (material.film.w - material.film.z);
#endif
    if (!(thickness > 0.0)) share = 0.0; // no film here
    SeenSurface seen = seenSurface(surface, viewpointFromDepth(gl_FragCoord.xy, 0.5).toViewerLS);
    float cosine = clamp(seen.nv, kFilmLeastCosine, 1.0);
    vec3 bare = fresnelSchlick(seen.f0, seen.fresnelRise, cosine);
    vec3 film = filmReflectance(seen.f0, cosine, material.film.y, thickness);
    precise vec3 covered = bare + share * (film - bare);
    float rise = fresnelSchlick(vec3(0.0), vec3(1.0), cosine).x;
    precise float f90 = surface.iorOrF90 + (1.0 - surface.iorOrF90) * surface.metallic;
    precise vec3 f0 = clamp((covered - f90 * rise) / (1.0 - rise), vec3(0.0), vec3(1.0));
    precise vec3 albedo = surface.albedo * (1.0 - surface.metallic);
    surface.specular = f0;
    surface.iorOrF90 = f90;
    surface.albedo = albedo;
    surface.metallic = 0.0; // included in f0 and albedo
}
#else
void coverWithFilm(Fragment fragment, inout Surface surface)
{
}
#endif
