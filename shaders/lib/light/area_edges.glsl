// Edges of light outlines seen from a point: their terms in the integral of a clamped cosine around z, and clipping.
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

// Angle between two directions, times the height (z) of the unit normal of their plane: an edge's term in Lambert's
// formula for the irradiance of a polygon (Lambert 1760, "Photometria"). `edge` is b - a, passed in with more digits.
float edgePart(vec3 a, vec3 b, vec3 edge)
{
    precise vec3 across = cross(a, edge); // cross(a, b) would cancel for nearly equal vectors
    precise float lengths = sqrt(dot(a, a)) * sqrt(dot(b, b)); // the product of squares might overflow
    if (!(lengths > 0.0)) return 0.0;
    precise float cosine = clamp(dot(a, b) / lengths, -1.0, 1.0);
    precise float acute = angleOverSine(abs(cosine)) * (across.z / lengths);
    if (cosine >= 0.0) return acute;
    // Computes the height directly, since the cosine of nearly opposite directions holds no digits of the sine.
    precise float height = across.z / max(length(across), 1e-18);
    precise float obtuse = kPi * height - acute;
    return obtuse;
}

// edgePart() of an edge that closes an outline along a clipping plane; `height`: z of the plane's unit normal, with the
// outline's winding as its sign. Not 0 even if the edge runs through the point, in the light's plane.
float closingPart(vec3 a, vec3 b, float height)
{
    precise vec3 across = cross(a, b - a);
    precise float lengths = sqrt(dot(a, a)) * sqrt(dot(b, b)); // the product of squares might overflow
    if (!(lengths > 0.0)) return 0.0;
    precise float cosine = clamp(dot(a, b) / lengths, -1.0, 1.0);
    precise float acute = angleOverSine(abs(cosine)) * (length(across) / lengths); // same errors as in edgePart()
    precise float part = (cosine >= 0.0 ? acute : kPi - acute) * height;
    return part;
}

// Sign of a closing edge: 1 in the direction in which a convex outline is closed, -1 against it.
float closingTurn(vec3 a, vec3 b, vec2 way)
{
#if HAS_POLYGON_LIGHTS
    precise float along = dot(b.xy - a.xy, way);
    return along < 0.0 ? -1.0 : 1.0;
#else
    return 1.0; // all outlines are convex
#endif
}

// State of clipping an outline at a plane and closing it along that plane.
struct Cut {
    vec3 left, entered; // where the outline last went below, and where it first came up
    bool isBelow;       // it went below and has not come up
    bool hasEntered;    // it came up before it first went below
};
const Cut kNoCut = Cut(vec3(0.0), vec3(0.0), false, false);

// Clips an edge to z > 0; false if nothing is left. `edge` is b - a.
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
