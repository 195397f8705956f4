// Outline of an area light seen from a point: straight edges, convex except for polygons. Round outlines have
// kRoundEdges edges and the area of the circle, so that their light is accurate to 1e-4 and their edge to 3e-3 of the
// radius. A tube's visible end has as many; its hidden end has half as many, accurate to 1.4e-2.
#pragma once
#include "shared/light.h"
#include "shared/light_pictures.h"
#include "lib/light/light_store.glsl"
#include "lib/maths/math.glsl"

const int kRoundEdges = 32;
const float kRoundGrowth = 1.0032206; // sqrt(2 pi / (32 sin(2 pi / 32)))

// A tube's vertices lie on two arcs around its ends; other round shapes have one arc.
struct Outline {
    vec3 middle;    // centre; metres from the point, like all members
    vec3 faces;     // flat shapes: normal times area
    vec3 right, up; // rectangle: half sides; polygon: axes of its corners; else perpendicular radii
    vec3 toEnds;    // from the centre to the centre of the first arc; its opposite: to the second
    vec2 turns;     // angle between adjacent vertices of the first arc, and of the second
    vec2 firstTurn; // angle of the first vertex of either arc
    // A tube as flat pieces: the strip between the lines, and the part of either end beyond it. ofSide and ofEnds are
    // their areas times the point's distance from their planes.
    vec3 toSide; // from the centre to that of the strip; of a polygon to its centroid
    float ofSide;
    vec2 ofEnds;
    ivec2 arcEdges; // numbers of edges of the arcs
    int edges;      // 0 if nothing is visible
    bool isRound;
    int polygon; // index of a polygon among the lights, for its corners; else -1
};

const Outline kNoOutline = Outline(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec2(0.0), vec2(0.0),
                                   vec3(0.0), 0.0, vec2(0.0), ivec2(0), 0, false, -1);

Outline roundOutline(vec3 middle, vec3 right, vec3 up, vec3 faces)
{
    const float kTurn = 2.0 * kPi / float(kRoundEdges);
    return Outline(middle, faces, right, up, vec3(0.0), vec2(kTurn), vec2(0.0), vec3(0.0), 0.0, vec2(0.0),
                   ivec2(0), kRoundEdges, true, -1);
}

#if HAS_SPHERE_LIGHTS
// A sphere is replaced by the disk within its silhouette.
Outline sphereOutline(vec3 middle, float radius)
{
    precise float distance2 = dot(middle, middle);
    precise float outside2 = distance2 - radius * radius;
    if (!(outside2 > 0.0)) return kNoOutline;
    precise vec3 ahead = middle / sqrt(distance2);
    precise vec3 aside = anyPerpendicular(ahead);
    precise float share = outside2 / distance2;
    precise float seenRadius = radius * sqrt(share);
    precise vec3 right = seenRadius * aside;
    precise vec3 up = seenRadius * cross(ahead, aside);
    precise vec3 seenMiddle = share * middle;
    precise vec3 faces = (kPi * seenRadius * seenRadius) * ahead;
    return roundOutline(seenMiddle, right, up, faces);
}
#endif

#if HAS_TUBE_LIGHTS
// Silhouette of a closed cylinder: the outward half of the edge of each end, and the two lines between them. For a
// point within the cylinder's continuation, the hidden end and the lines shrink to the point where they meet the edge
// of the other end, so that the outline is continuous where the point leaves it.
Outline tubeOutline(vec3 middle, vec3 halfLength, float radius)
{
    precise float halfMetres = max(length(halfLength), 1e-18);
    precise vec3 axis = halfLength / halfMetres;
    precise float along = -dot(middle, axis); // position of the point along the axis
    precise vec3 outwards = -middle - along * axis;
    precise float away2 = dot(outwards, outwards), away = sqrt(away2);
    bool seesFirst = along > halfMetres, seesSecond = along < -halfMetres;
    bool seesSide = away > radius;
    if (!seesSide && !seesFirst && !seesSecond) return kNoOutline;
    // Orthogonalised twice, since for a point on the axis only rounding is left.
    precise vec3 radial = safeNormalize(outwards, anyPerpendicular(axis));
    precise vec3 across = radial - dot(radial, axis) * axis;
    radial = dot(across, across) > 0.25 ? normalize(across) : anyPerpendicular(axis);
    precise vec3 right = radius * radial;
    precise vec3 up = radius * cross(axis, radial);
    precise float cosHalf = min(radius / max(away, 1e-18), 1.0);
    precise float sinHalf = sqrt((1.0 - cosHalf) * (1.0 + cosHalf));
    float seenHalf = atan(sinHalf, cosHalf); // half angle of the visible side
    precise float ofSide = 4.0 * halfMetres * radius * away * (sinHalf * sinHalf * sinHalf);
    // For a hidden end, the segment between the strip and the point; for a visible one, the rest of the disk.
    precise float segment = seenHalf - sinHalf * cosHalf;
    precise vec2 shares = vec2(seesFirst ? kPi - segment : segment, seesSecond ? kPi - segment : segment);
    precise vec2 ofEnds = radius * radius * shares * abs(vec2(along - halfMetres, along + halfMetres));
    // Around the front of a hidden end, around the back of a visible one.
    ivec2 arcEdges = ivec2(seesFirst ? kRoundEdges : kRoundEdges / 2, seesSecond ? kRoundEdges : kRoundEdges / 2);
    precise vec2 arcs = vec2(seesFirst ? 2.0 * seenHalf - 2.0 * kPi : 2.0 * seenHalf,
                             seesSecond ? 2.0 * kPi - 2.0 * seenHalf : -2.0 * seenHalf);
    precise vec2 turns = arcs / vec2(arcEdges);
    return Outline(middle, vec3(0.0), right, up, halfLength, turns, vec2(-seenHalf, seenHalf), cosHalf * right, ofSide,
                   ofEnds, arcEdges, arcEdges.x + arcEdges.y + 2, true, -1);
}
#endif

#if HAS_POLYGON_LIGHTS
Outline polygonOutline(int index, vec3 middle, vec3 right, vec3 up, vec3 faces)
{
    vec4 outline = lightShapeTexel(index, LIGHT_SHAPE_TEXELS);
    precise vec3 toMiddle = outline.x * right + outline.y * up;
    return Outline(middle, faces, right, up, vec3(0.0), vec2(0.0), vec2(0.0), toMiddle, 0.0, vec2(0.0), ivec2(0),
                   int(outline.z), false, index);
}
#endif

// Outline of area light `index`.
Outline areaOutline(int index, int kind, vec3 middle)
{
    int type = kind & LIGHT_TYPE_MASK;
    vec4 first = lightShapeTexel(index, 0), second = lightShapeTexel(index, 1);
#if HAS_SPHERE_LIGHTS
    if (type == LIGHT_SPHERE) return sphereOutline(middle, first.w);
#endif
#if HAS_TUBE_LIGHTS
    if (type == LIGHT_TUBE) return tubeOutline(middle, first.xyz, first.w);
#endif
    precise vec3 faces = cross(first.xyz, second.xyz);
    if (!shinesFromBothSides(second.w) && !(dot(faces, middle) < 0.0)) return kNoOutline; // seen from behind
#if HAS_DISK_LIGHTS
    if (type == LIGHT_DISK) return roundOutline(middle, first.xyz, second.xyz, kPi * faces);
#endif
#if HAS_POLYGON_LIGHTS
    if (type == LIGHT_POLYGON) return polygonOutline(index, middle, first.xyz, second.xyz, first.w * faces);
#endif
    return Outline(middle, 4.0 * faces, first.xyz, second.xyz, vec3(0.0), vec2(0.0), vec2(0.0), vec3(0.0), 0.0, vec2(0.0),
                   ivec2(0), 4, false, -1);
}

bool isTube(Outline outline)
{
#if HAS_TUBE_LIGHTS
    return outline.arcEdges.x > 0;
#else
    return false;
#endif
}

bool isPolygon(Outline outline)
{
#if HAS_POLYGON_LIGHTS
    return outline.polygon >= 0;
#else
    return false;
#endif
}

// From the light's centre to a vertex; vertex `edges` is the first again.
vec3 outlineCorner(Outline outline, int vertex)
{
    int number = vertex == outline.edges ? 0 : vertex;
#if HAS_POLYGON_LIGHTS
    if (isPolygon(outline)) {
        vec2 at = lightCorner(outline.polygon, number);
        precise vec3 corner = at.x * outline.right + at.y * outline.up;
        return corner;
    }
#endif
    if (!outline.isRound) {
        precise vec3 corner = (number == 0 || number == 3 ? outline.right : -outline.right)
                              + (number < 2 ? outline.up : -outline.up);
        return corner;
    }
    bool isFirst = true;
    int onArc = number;
    float growth = kRoundGrowth;
#if HAS_TUBE_LIGHTS
    if (isTube(outline)) {
        isFirst = number <= outline.arcEdges.x;
        int arcEdges = isFirst ? outline.arcEdges.x : outline.arcEdges.y;
        if (!isFirst) onArc -= outline.arcEdges.x + 1;
        // The end vertices of an arc lie on it, so that the lines between arcs are the tube's; the others are moved out
        // until the area is that of the arc.
        float turn = abs(isFirst ? outline.turns.x : outline.turns.y);
        precise float ratio = turn > 1e-3 ? turn / sin(turn) : 1.0;
        float inner = float(arcEdges - 2);
        precise float grown = (sqrt(1.0 + inner * float(arcEdges) * ratio) - 1.0) / inner;
        growth = onArc == 0 || onArc == arcEdges ? 1.0 : grown;
    }
#endif
    precise float angle = isFirst ? outline.firstTurn.x + float(onArc) * outline.turns.x
                                  : outline.firstTurn.y + float(onArc) * outline.turns.y;
    precise vec2 place = growth * vec2(cos(angle), sin(angle));
    precise vec3 from = isFirst ? outline.toEnds : -outline.toEnds;
    precise vec3 corner = from + place.x * outline.right + place.y * outline.up;
    return corner;
}
