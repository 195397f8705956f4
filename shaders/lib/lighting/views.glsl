// Output of a pixel: the shaded surface, or a debug view of the table kViews (renderer/frame/DebugViews.cpp), whose
// number is VIEW. Forward and deferred both end here, so every view exists in both.
#pragma once
#include "shared/face_colors.h"
#include "shared/views.h"

#if VIEW == VIEW_LIGHTS
#define VISIT_COUNTS 1
#endif
#if VIEW == VIEW_CASCADES
#define SHOWS_FACES 1
#endif
#include "lib/lighting/lighting.glsl"

// D, G or F of light lighting.lights.y, as rgb; 0 if the light does not reach the point. blinn_phong: D is the
// highlight, and the others are 0. Layered materials: those of the lowest lobe.
vec3 specularFactorView(Surface surface, Viewpoint viewpoint)
{
    vec3 shown = vec3(0.0);
#if HAS_GLOSSY_MODELS
    Incident incident;
    if (!IS_GLOSSY(surface.model)) return shown;
    if (int(lighting.lights.y) >= int(lighting.lights.x)) return shown;
    if (!incidentLight(int(lighting.lights.y), viewpoint.positionLS, incident)) return shown;
    precise float nl = dot(surface.normalLS, incident.toLightLS);
    if (!(nl > 0.0)) return shown;
    SeenSurface seen = seenSurface(surface, viewpoint.toViewerLS);
    SpecularTerms terms = reflection(seen, directionsOn(seen, incident.toLightLS, nl)).terms;
#if VIEW == VIEW_DISTRIBUTION
    shown = vec3(terms.d);
#elif VIEW == VIEW_GEOMETRY
    precise float nv = dot(surface.normalLS, viewpoint.toViewerLS);
    precise float g = terms.v * (4.0 * nl * nv);
    shown = vec3(g);
#else
    shown = terms.f;
#endif
#endif
    return shown;
}

// Shadow factor of light lighting.lights.y.
vec3 shadowView(Surface surface, Viewpoint viewpoint)
{
#if HAS_SHADOWS
    if (lighting.lights.y < lighting.lights.x) return vec3(shadowFactor(int(lighting.lights.y), surface, viewpoint));
#endif
    return vec3(1.0);
}

#if VIEW == VIEW_CASCADES
// Colours of the shadow-map faces that were looked up for that light: darker in shadow, and at grazing angles.
vec3 cascadesView(Surface surface, Viewpoint viewpoint)
{
    precise float facing = abs(dot(surface.normalLS, viewpoint.toViewerLS));
    precise vec3 brightness = (0.4 + 0.6 * shadowView(surface, viewpoint)) * (0.4 + 0.6 * facing);
    precise vec3 color = noFaceColor();
#if HAS_SHADOW_MAPS
    color = answeringFaces.rgb + (1.0 - answeringFaces.a) * noFaceColor();
#endif
    return brightness * color;
}
#endif

#if VIEW == VIEW_MOVED_TOO_FAR
// The flag colour that materialBaseColor() returned: darker at grazing angles.
vec3 movedTooFarView(Surface surface, Viewpoint viewpoint)
{
    precise float facing = abs(dot(surface.normalLS, viewpoint.toViewerLS));
    precise vec3 shown = (0.4 + 0.6 * facing) * (IS_UNLIT(surface.model) ? surface.emission : surface.albedo);
    return shown;
}
#endif

vec3 viewedRadiance(Surface surface, Viewpoint viewpoint, vec2 pixel)
{
#if VIEW == VIEW_FINAL
    return shadeSurface(surface, viewpoint, pixel);
#elif VIEW == VIEW_DIFFUSE
    return IS_UNLIT(surface.model) ? surface.emission : surface.albedo;
#elif VIEW == VIEW_NORMAL_TEXEL
    return surface.normalTexel;
#elif VIEW == VIEW_NORMAL
    return mat3(view.worldFromLS) * surface.normalLS;
#elif VIEW == VIEW_NORMAL_VIEW
    // Rays step along the view's x and y axes from pixel to pixel.
    return vec3(dot(surface.normalLS, normalize(view.rayDxLS.xyz)), dot(surface.normalLS, normalize(view.rayDyLS.xyz)),
                -dot(surface.normalLS, view.forwardLS.xyz));
#elif VIEW == VIEW_NORMAL_OBJECT
    return surface.normalTexel * 2.0 - 1.0; // set at rasterisation (lib/material/material.glsl)
#elif VIEW == VIEW_LIGHTS
    vec3 passed = vec3(0.0);
    return lightsOnSurface(vec3(0.0), seenSurface(surface, viewpoint.toViewerLS), viewpoint, pixel, passed); // counted
#elif VIEW == VIEW_SHADOW
    return shadowView(surface, viewpoint);
#elif VIEW == VIEW_CASCADES
    return cascadesView(surface, viewpoint);
#elif VIEW == VIEW_MOVED_TOO_FAR
    return movedTooFarView(surface, viewpoint);
#elif VIEW == VIEW_DEPTH
    return vec3(view.eyeLS.w + dot(viewpoint.positionLS, view.forwardLS.xyz));
#else
    return specularFactorView(surface, viewpoint);
#endif
}
