// Lobes for area lights: matrices that linearly transform each lobe to a clamped cosine (docs/area-lights.md). Source:
// Heitz, Dupuy, Hill, Neubelt 2016, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines".
#pragma once
#include "lib/reflectance/even_light.glsl"
#include "shared/lobe_shapes.h"
#include "shared/slots.h"

layout(binding = TEXTURE_UNIT_LOBE_SHAPES) uniform sampler2D lobeShapes;

struct AreaLobe {
    mat3 surfaceFromLS; // z is the normal, x the viewer's projection
    mat3 cosineFromSurface;
    float perAbove; // 1 over the fraction of the lobe above the surface
};

mat3 surfaceAxes(vec3 normal, vec3 toViewer, float nv, out float sineView)
{
    precise vec3 projected = toViewer - nv * normal;
    precise float sine = length(projected);
    sineView = sine;
    // Orthogonalised again: the rounding residue of the normal in a short projection would shear the axes.
    precise vec3 unit = projected / max(sine, 1e-18);
    precise vec3 level = unit - dot(unit, normal) * normal;
    vec3 x = sine > 1e-6 ? safeNormalize(level, anyPerpendicular(normal)) : anyPerpendicular(normal);
    precise vec3 y = cross(normal, x);
    return transpose(mat3(x, y, normal));
}

AreaLobe areaLobe(vec3 normal, vec3 toViewer, float nv, float alpha)
{
    float sineView;
    mat3 axes = surfaceAxes(normal, toViewer, nv, sineView);
    float heldAlpha = max(alpha, LOBE_SHAPES_SMALLEST_ALPHA);
    float heldCosine = max(nv, LOBE_SHAPES_SMALLEST_COSINE);
    precise vec2 place = sqrt(clamp(vec2(heldCosine, heldAlpha), 0.0, 1.0)) * float(LOBE_SHAPES_SIDE - 1) + 0.5;
    precise vec2 texel = place / float(LOBE_SHAPES_SIDE);
    vec4 numbers = textureLod(lobeShapes, texel, 0.0);
    mat3 inverse = inverseOfShape(numbers, heldAlpha, heldCosine, sineView);
    precise float perAbove = 1.0 / shareAbove(inverse);
    return AreaLobe(axes, inverse, perAbove);
}

#if HAS_TANGENT_FRAME
// areaLobe() of an anisotropic lobe. Its slopes are distributed over an ellipse along the tangent; in the frame of the
// viewer's plane that is a distribution with the alpha along the plane, stretched across it and sheared.
AreaLobe stretchedLobe(SeenSurface seen)
{
    float sineView;
    mat3 axes = surfaceAxes(seen.surface.normalLS, seen.toViewer, seen.nv, sineView);
    precise vec2 tangent = (axes * seen.surface.tangentLS).xy;
    vec2 alpha = max(vec2(seen.surface.alpha, seen.surface.alphaBitangent), LOBE_SHAPES_SMALLEST_ALPHA);
    precise vec2 share = tangent * tangent / max(dot(tangent, tangent), 1e-18);
    precise float along2 = alpha.x * alpha.x * share.x + alpha.y * alpha.y * share.y;
    precise float both = (alpha.x * alpha.x - alpha.y * alpha.y) * tangent.x * tangent.y / max(dot(tangent, tangent), 1e-18);
    AreaLobe lobe = areaLobe(seen.surface.normalLS, seen.toViewer, seen.nv, sqrt(along2));
    precise float narrower = along2 / (alpha.x * alpha.y);
    // Only the component across the viewer's plane is stretched: as much of the lobe stays above the surface.
    lobe.cosineFromSurface = stretchedAcross(lobe.cosineFromSurface, narrower, both / along2);
    return lobe;
}
#endif
