// The light of areas on a surface: what a clamped cosine sees of an outline, in the frame that linearly transforms it to
// a lobe (docs/area-lights.md). Source: Heitz, Dupuy, Hill, Neubelt 2016, "Real-Time Polygonal-Light Shading with
// Linearly Transformed Cosines".
#pragma once
#include "lib/light/area_outline.glsl"
#include "lib/light/light_store.glsl"
#include "lib/reflectance/even_light.glsl"
#include "shared/lobe_shapes.h"

layout(binding = TEXTURE_UNIT_LOBE_SHAPES) uniform sampler2D lobeShapes;

// ---- Edges ----------------------------------------------------------------------------------------------------------

// acos(x) / sqrt(1 - x^2), to 5e-7 for x from 0 to 1 (Chebyshev's interpolation).
float angleOverSine(float x)
{
    precise float inX = 0.13848964 - 0.027354032 * x;
    inX = inX * x - 0.32747101;
    inX = inX * x + 0.51150869;
    inX = inX * x - 0.64950423;
    inX = inX * x + 0.7834481;
    inX = inX * x - 0.9999133;
    inX = inX * x + 1.5707957;
    return inX;
}

// The angle between two directions, times the height of the unit normal of their plane: a part of Lambert's formula for
// the irradiance of a polygon (Lambert 1760, "Photometria").
float edgePart(vec3 a, vec3 b)
{
    precise vec3 across = cross(a, b - a); // of nearly equal vectors the products would cancel
    precise float lengths = sqrt(dot(a, a) * dot(b, b));
    if (!(lengths > 0.0)) return 0.0;
    precise float cosine = clamp(dot(a, b) / lengths, -1.0, 1.0);
    precise float acute = angleOverSine(abs(cosine)) * (across.z / lengths);
    if (cosine >= 0.0) return acute;
    // The height itself, since the sine of nearly opposite directions has no digits left in the cosine.
    precise float height = across.z / max(length(across), 1e-18);
    precise float obtuse = kPi * height - acute;
    return obtuse;
}

// Cuts an outline where it goes below a plane, and closes it there.
struct Cut {
    vec3 left, entered; // where it went below, and where it came up first
    bool isBelow;       // it went below and has not come up
    bool hasEntered;    // it came up before it first went below
};
const Cut kNoCut = Cut(vec3(0.0), vec3(0.0), false, false);

// The part of an edge above z = 0; false where there is none.
bool cutEdge(inout vec3 a, inout vec3 b, inout Cut cut, out bool comesUp)
{
    bool aIsAbove = a.z > 0.0, bIsAbove = b.z > 0.0;
    comesUp = false;
    if (!aIsAbove && !bIsAbove) return false;
    if (aIsAbove == bIsAbove) return true;
    precise float share = a.z / (a.z - b.z);
    precise vec3 crossing = vec3(a.xy + share * (b.xy - a.xy), 0.0);
    if (aIsAbove) {
        b = crossing;
        cut.left = crossing;
        cut.isBelow = true;
    } else {
        a = crossing;
        comesUp = true;
        if (!cut.isBelow) {
            cut.entered = crossing;
            cut.hasEntered = true;
        }
    }
    return true;
}

// ---- Lobes ----------------------------------------------------------------------------------------------------------

struct AreaLobe {
    mat3 surfaceFromLS; // to axes of which z is the normal and x the viewer's projection
    mat3 cosineFromSurface;
    float perAbove; // 1 over the share of the lobe above the surface
};

mat3 surfaceAxes(vec3 normal, vec3 toViewer, float nv, out float sineView)
{
    precise vec3 projected = toViewer - nv * normal;
    precise float sine = length(projected);
    sineView = sine;
    // What rounding leaves of the normal in a short projection would shear the axes.
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
// The same of a lobe with two alphas. The slopes of its facets lie around an ellipse along the tangent; in the frame of
// the viewer's plane that is an ellipse along the plane, stretched across it and sheared.
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
    lobe.cosineFromSurface = stretchedAcross(lobe.cosineFromSurface, narrower, both / along2);
    precise float perAbove = 1.0 / shareAbove(lobe.cosineFromSurface);
    lobe.perAbove = perAbove;
    return lobe;
}
#endif

// What a lobe sees of an outline, 1 where it fills the hemisphere.
float shareSeen(Outline outline, AreaLobe lobe)
{
    precise mat3 cosineFromLS = lobe.cosineFromSurface * lobe.surfaceFromLS;
    precise vec3 middle = cosineFromLS * outline.middle;
    precise vec3 right = cosineFromLS * outline.right, up = cosineFromLS * outline.up,
                 toEnds = cosineFromLS * outline.toEnds;
    precise float size2 = max(max(dot(right, right), dot(up, up)), dot(toEnds, toEnds));
    precise float distance2 = dot(middle, middle);
    if (size2 < 4e-6 * distance2) {
        // So small that the lobe is the same all over it, and that parts of its edges would cancel.
        precise vec3 onSurface = lobe.surfaceFromLS * outline.middle;
        if (!(onSurface.z > 0.0 && middle.z > 0.0)) return 0.0;
        precise float facing = abs(dot(outline.middle, outline.faces)) * determinant(lobe.cosineFromSurface);
        precise float share = (middle.z / distance2) * (facing / distance2) * kInversePi * lobe.perAbove;
        return share;
    }
    precise float sum = 0.0;
    Cut horizon = kNoCut, base = kNoCut;
    precise vec3 a = lobe.surfaceFromLS * outlineVertex(outline, 0);
    // One more round than edges: what closes the outline along the horizon.
    for (int edge = 0; edge <= outline.edges; ++edge) {
        vec3 from = a, to = a;
        bool isThere, comesUp = false;
        if (edge < outline.edges) {
            precise vec3 b = lobe.surfaceFromLS * outlineVertex(outline, edge + 1);
            to = b;
            a = b;
            isThere = cutEdge(from, to, horizon, comesUp);
        } else {
            isThere = horizon.isBelow && horizon.hasEntered;
            from = horizon.left;
            to = horizon.entered;
        }
        // Where the outline comes up again, the line along the horizon comes first.
        bool closes = comesUp && horizon.isBelow;
        for (int part = closes ? 0 : 1; part < 2; ++part) {
            if (!isThere) continue;
            precise vec3 start = lobe.cosineFromSurface * (part == 0 ? horizon.left : from);
            precise vec3 end = lobe.cosineFromSurface * (part == 0 ? from : to);
            vec3 startAbove = start, endAbove = end;
            bool comesUpAgain;
            if (!cutEdge(startAbove, endAbove, base, comesUpAgain)) continue;
            if (comesUpAgain && base.isBelow) {
                sum += edgePart(base.left, startAbove);
                base.isBelow = false;
            }
            sum += edgePart(startAbove, endAbove);
        }
        if (closes) horizon.isBelow = false;
    }
    if (base.isBelow && base.hasEntered) sum += edgePart(base.left, base.entered);
    precise float share = abs(sum) * (0.5 * kInversePi) * lobe.perAbove;
    return min(share, 1.0);
}

// ---- Surfaces -------------------------------------------------------------------------------------------------------

#define AREA_LOBES 3 // the diffuse reflection, the lobe and the coat

// Of the surface that is lit, the same for all lights.
AreaLobe areaLobes[AREA_LOBES];
vec3 areaWeights[AREA_LOBES]; // radiance towards the viewer per radiance of a light that is all a lobe sees
vec3 areaEntering;            // per irradiance that enters: of wrapped light

void prepareAreaLobes(SeenSurface seen)
{
    EvenShares shares = evenShares(seen, false);
    float sineView;
    mat3 axes = surfaceAxes(seen.surface.normalLS, seen.toViewer, seen.nv, sineView);
    areaLobes[0] = AreaLobe(axes, mat3(1.0), 1.0);
    precise vec3 diffuse = kPi * (shares.ofEntering + shares.ofIrradiance);
    areaWeights[0] = diffuse;
    areaEntering = shares.ofEntering;
    areaWeights[1] = shares.ofLobe;
    areaLobes[1] = areaLobes[0];
    if (shares.ofLobe != vec3(0.0))
        areaLobes[1] = areaLobe(seen.surface.normalLS, seen.toViewer, seen.nv, lobeAlpha(seen.surface));
#if HAS_TANGENT_FRAME
    if (shares.ofLobe != vec3(0.0) && isAnisotropic(seen.surface)) areaLobes[1] = stretchedLobe(seen);
#endif
    areaWeights[2] = vec3(0.0);
    areaLobes[2] = areaLobes[0];
#if HAS_CLEARCOAT
    areaWeights[2] = shares.ofCoat;
    if (shares.ofCoat != vec3(0.0))
        areaLobes[2] = areaLobe(seen.coatNormalLS, seen.toViewer, seen.coatNv, seen.surface.coatAlpha);
#endif
}

// Radiance towards the viewer that the surface of prepareAreaLobes() reflects of area light `index`.
vec3 areaLightOnSurface(int index, int kind, SeenSurface seen, vec3 positionLS, vec3 toLightLS, vec3 smallIrradiance)
{
    vec4 place = lightTexel(index, 0);
    precise vec3 middle = place.xyz - positionLS;
    precise float reach = dot(middle, middle) * place.w;
    precise float window = 1.0 - reach * reach;
    Outline outline = areaOutline(kind, middle, lightShapeTexel(index, 0), lightShapeTexel(index, 1));
    if (outline.edges == 0) return vec3(0.0);
    precise vec3 reflected = vec3(0.0);
    for (int lobe = 0; lobe < AREA_LOBES; ++lobe)
        if (areaWeights[lobe] != vec3(0.0)) reflected += areaWeights[lobe] * shareSeen(outline, areaLobes[lobe]);
    precise vec3 light = reflected * ((window * window) * lightTexel(index, 1).rgb);
#if HAS_SUBSURFACE_WRAP
    // What wraps is hardly anything of a large light, and taken from its middle.
    if (wrapsLight(seen.surface)) {
        precise float cosine = dot(seen.surface.normalLS, toLightLS);
        light += areaEntering * wrappedExcess(seen.surface, cosine) * smallIrradiance;
    }
#endif
    return light;
}
