// Edges of outlines, from a point: what each adds to what a clamped cosine around z sees, and their parts above a plane.
#pragma once
#include "lib/maths/math.glsl"

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
// the irradiance of a polygon (Lambert 1760, "Photometria"). `edge` is b - a, with digits that a difference would lose.
float edgePart(vec3 a, vec3 b, vec3 edge)
{
    precise vec3 across = cross(a, edge); // of nearly equal vectors the products would cancel
    precise float lengths = sqrt(dot(a, a)) * sqrt(dot(b, b)); // the product of squares might overflow
    if (!(lengths > 0.0)) return 0.0;
    precise float cosine = clamp(dot(a, b) / lengths, -1.0, 1.0);
    precise float acute = angleOverSine(abs(cosine)) * (across.z / lengths);
    if (cosine >= 0.0) return acute;
    // The height itself, since the sine of nearly opposite directions has no digits left in the cosine.
    precise float height = across.z / max(length(across), 1e-18);
    precise float obtuse = kPi * height - acute;
    return obtuse;
}

// The same of an edge that closes an outline along a plane of which the height of the unit normal is known, with the sign
// of the outline's turn: it has one too where the edge runs through the point, which lies in the light's plane.
float closingPart(vec3 a, vec3 b, float height)
{
    precise vec3 across = cross(a, b - a);
    precise float lengths = sqrt(dot(a, a)) * sqrt(dot(b, b)); // the product of squares might overflow
    if (!(lengths > 0.0)) return 0.0;
    precise float cosine = clamp(dot(a, b) / lengths, -1.0, 1.0);
    precise float acute = angleOverSine(abs(cosine)) * (length(across) / lengths); // errs as other edges do
    precise float part = (cosine >= 0.0 ? acute : kPi - acute) * height;
    return part;
}

// Of such an edge: 1 along the way that a convex outline is closed, -1 against it.
float closingTurn(vec3 a, vec3 b, vec2 way)
{
#if HAS_POLYGON_LIGHTS
    precise float along = dot(b.xy - a.xy, way);
    return along < 0.0 ? -1.0 : 1.0;
#else
    return 1.0; // all outlines are convex
#endif
}

// Cuts an outline where it goes below a plane, and closes it there.
struct Cut {
    vec3 left, entered; // where it went below, and where it came up first
    bool isBelow;       // it went below and has not come up
    bool hasEntered;    // it came up before it first went below
};
const Cut kNoCut = Cut(vec3(0.0), vec3(0.0), false, false);

// The part of an edge above z = 0; false where there is none. `edge` is b - a.
bool cutEdge(inout vec3 a, inout vec3 b, inout vec3 edge, inout Cut cut, out bool comesUp)
{
    bool aIsAbove = a.z > 0.0, bIsAbove = b.z > 0.0;
    comesUp = false;
    if (!aIsAbove && !bIsAbove) return false;
    if (aIsAbove == bIsAbove) return true;
    precise float share = a.z / (a.z - b.z);
    precise vec3 crossing = vec3(a.xy + share * (b.xy - a.xy), 0.0);
    if (aIsAbove) {
        b = crossing;
        edge *= share;
        cut.left = crossing;
        cut.isBelow = true;
    } else {
        a = crossing;
        edge *= 1.0 - share;
        comesUp = true;
        if (!cut.isBelow) {
            cut.entered = crossing;
            cut.hasEntered = true;
        }
    }
    return true;
}
