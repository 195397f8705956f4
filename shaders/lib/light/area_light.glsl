// Area lights in closed form: integrates a clamped cosine over the light's outline, in the frame that linearly
// transforms a lobe to that cosine (docs/area-lights.md). Source: Heitz, Dupuy, Hill, Neubelt 2016, "Real-Time
// Polygonal-Light Shading with Linearly Transformed Cosines".
#pragma once
#include "lib/light/area_edges.glsl"
#include "lib/light/area_lobe.glsl"
#include "lib/light/area_outline.glsl"
#include "lib/light/light_store.glsl"
#if HAS_LIGHT_PICTURES
#include "lib/light/area_picture.glsl"
#endif

// ---- Outlines -------------------------------------------------------------------------------------------------------

// Fraction of a lobe covered by a light so small that the lobe is constant over it and edge terms would cancel.
// `facing`: the light's area times the distance of its plane. All positions are in metres from the shaded point.
float shareOfPlace(vec3 place, float facing, AreaLobe lobe)
{
    precise vec3 onSurface = lobe.surfaceFromLS * place;
    precise vec3 seen = lobe.cosineFromSurface * onSurface;
    if (!(onSurface.z > 0.0 && seen.z > 0.0)) return 0.0;
    precise float distance2 = dot(seen, seen);
    precise float share = (seen.z / distance2) * (facing * determinant(lobe.cosineFromSurface) / distance2) * kInversePi;
    return share;
}

// The same for a light that is narrow: the integral of z / distance^4 along its centre line, which `facing` scales to
// the light's area. The ends span an angle of 2 d, and h is the vector to the line's nearest point:
//     ((d - sin(d) cos(d)) h.z / |h| + sin(2 d) (h . bisector) / |h| bisector.z) / |h|^2
float shareOfLine(vec3 middle, vec3 halfLine, float facing, AreaLobe lobe)
{
    precise vec3 onSurface = lobe.surfaceFromLS * middle, alongSurface = lobe.surfaceFromLS * halfLine;
    precise vec3 seen = lobe.cosineFromSurface * onSurface, along = lobe.cosineFromSurface * alongSurface;
    // Clips to the part above the surface and in the cosine's hemisphere: both heights are linear along the line.
    vec2 part = vec2(-1.0, 1.0);
    for (int plane = 0; plane < 2; ++plane) {
        float height = plane == 0 ? onSurface.z : seen.z, rise = plane == 0 ? alongSurface.z : along.z;
        precise vec2 heights = vec2(height - rise, height + rise);
        if (!(max(heights.x, heights.y) > 0.0)) return 0.0;
        precise float crossing = -height / (rise != 0.0 ? rise : 1.0);
        if (!(heights.x > 0.0)) part.x = max(part.x, crossing);
        if (!(heights.y > 0.0)) part.y = min(part.y, crossing);
    }
    if (!(part.y > part.x)) return 0.0;
    precise vec3 first = seen + part.x * along, second = seen + part.y * along;
    precise float halfMetres2 = dot(along, along), halfMetres = sqrt(halfMetres2);
    precise float metres = (part.y - part.x) * halfMetres;
    precise float r0 = length(first), r1 = length(second);
    precise float inverse = 1.0 / (r0 * r1);
    precise vec3 moment = cross(seen, along);
    precise vec3 nearest = cross(along, moment) / halfMetres2; // h
    precise float h = length(moment) / halfMetres;
    precise float perHeight = metres * inverse; // sin(2 d) / h
    precise float sine = min(h * perHeight, 1.0), cosine = clamp(dot(first, second) * inverse, -1.0, 1.0);
    // 2 + 2 cos(2 d), which cancels if the line extends far to both sides.
    precise float bisector2 = cosine > 0.0 ? 2.0 + 2.0 * cosine : max(2.0 * sine * sine / (1.0 - cosine), 1e-18);
    precise float heights = max(first.z, 0.0) / r0 + max(second.z, 0.0) / r1;
    precise float sum = perHeight * ((1.0 / r0 + 1.0 / r1) * heights / bisector2);
    // (d - sin(d) cos(d)) / h^3: half of x - sin(x) with x = 2 d, which cancels for small x.
    precise float ofHeight;
    if (cosine > 0.0 && sine < 0.2) {
        precise float sine2 = sine * sine;
        precise float x = 1.0 + sine2 * (1.0 / 6.0 + sine2 * (3.0 / 40.0)); // x over the sine
        precise float x2 = x * x * sine2;
        ofHeight = (perHeight * perHeight * perHeight) * (x * x * x) * (1.0 - x2 * (1.0 / 20.0 - x2 / 840.0)) / 12.0;
    } else {
        ofHeight = 0.5 * (atan(sine, cosine) - sine) / (h * h * h);
    }
    sum += nearest.z * ofHeight;
    precise float perMetre = 0.5 * kInversePi * facing * determinant(lobe.cosineFromSurface) / halfMetres;
    precise float share = perMetre * sum;
    return max(share, 0.0);
}

// Lights that extend less than this to the sides of their centre line, relative to their distance, are treated as
// lines. At this limit edges are accurate to 1e-4, and lines to 1e-5.
const float kNarrow = 2e-3;
const float kSmall2 = 4e-6; // square of the same limit in all directions, below which a light is treated as a point

// Fraction of a lobe covered by an outline, 1 if it fills the hemisphere.
float shareSeen(Outline outline, AreaLobe lobe)
{
    precise mat3 cosineFromLS = lobe.cosineFromSurface * lobe.surfaceFromLS;
    precise vec3 middle = cosineFromLS * outline.middle;
    precise vec3 right = cosineFromLS * outline.right, up = cosineFromLS * outline.up,
                 toEnds = cosineFromLS * outline.toEnds;
    precise float right2 = dot(right, right), up2 = dot(up, up), ends2 = dot(toEnds, toEnds);
    precise float distance2 = dot(middle, middle);
    bool isLong = isTube(outline), isWide = right2 > up2;
    if (!isLong && max(right2, up2) < kSmall2 * distance2) {
        precise float facing = abs(dot(outline.middle, outline.faces));
        precise vec3 place = outline.middle + outline.toSide;
        return min(shareOfPlace(place, facing, lobe) * lobe.perAbove, 1.0);
    }
    if (isLong || !(outline.isRound || isPolygon(outline))) {
        vec3 line = isLong ? toEnds : isWide ? right : up;
        float line2 = isLong ? ends2 : max(right2, up2), across2 = isLong ? max(right2, up2) : min(right2, up2);
        precise float nearest = clamp(-dot(middle, line) / max(line2, 1e-36), -1.0, 1.0);
        precise vec3 toNearest = middle + nearest * line;
        if (across2 < kNarrow * kNarrow * dot(toNearest, toNearest)) {
            vec3 halfLine = isLong ? outline.toEnds : isWide ? outline.right : outline.up;
            precise vec3 place = outline.middle + outline.toSide;
            float facing = isLong ? outline.ofSide : abs(dot(outline.middle, outline.faces));
            bool isShort = line2 < kSmall2 * distance2;
            precise float share = isShort ? shareOfPlace(place, facing, lobe) : shareOfLine(place, halfLine, facing, lobe);
            if (isLong) {
                share += shareOfPlace(outline.middle + halfLine, outline.ofEnds.x, lobe);
                share += shareOfPlace(outline.middle - halfLine, outline.ofEnds.y, lobe);
            }
            return min(share * lobe.perAbove, 1.0);
        }
    }
    // Winding as seen from the point; if clockwise, edges along a horizon have their hemisphere on the right.
    bool isClockwise = isLong || dot(outline.middle, cross(outline.right, outline.up)) > 0.0;
    float turn = isClockwise ? 1.0 : -1.0;
    precise vec3 surfaceNormal = cross(lobe.cosineFromSurface[0], lobe.cosineFromSurface[1]);
    precise float surfaceHeight = turn * surfaceNormal.z / length(surfaceNormal);
    // Directions in which a convex outline is closed along the surface's horizon and along the cosine's; parts of a
    // concave polygon may run against them.
    vec2 horizonWay = vec2(0.0), baseWay = vec2(0.0);
    if (isPolygon(outline)) {
        precise vec3 facesSurface = lobe.surfaceFromLS * outline.faces;
        precise vec3 faces = cross(right, up);
        horizonWay = vec2(-facesSurface.y, facesSurface.x);
        baseWay = vec2(-faces.y, faces.x);
    }
    precise float sum = 0.0;
    Cut horizon = kNoCut, base = kNoCut;
    precise vec3 corner = outlineCorner(outline, 0);
    precise vec3 a = lobe.surfaceFromLS * (outline.middle + corner);
    // One more iteration than edges closes the outline along the horizon.
    for (int edge = 0; edge <= outline.edges; ++edge) {
        vec3 from = a, to = a, along = vec3(0.0);
        bool isThere, comesUp = false;
        if (edge < outline.edges) {
            precise vec3 next = outlineCorner(outline, edge + 1);
            precise vec3 b = lobe.surfaceFromLS * (outline.middle + next);
            precise vec3 ab = lobe.surfaceFromLS * (next - corner);
            to = b;
            along = ab;
            a = b;
            corner = next;
            isThere = cutEdge(from, to, along, horizon, comesUp);
        } else {
            isThere = horizon.isBelow && horizon.hasEntered;
            from = horizon.left;
            to = horizon.entered;
            along = to - from;
        }
        bool isClosing = edge == outline.edges;
        // Where the outline comes up again, the segment along the horizon is added first.
        bool closes = comesUp && horizon.isBelow;
        for (int part = closes ? 0 : 1; part < 2; ++part) {
            if (!isThere) continue;
            precise vec3 start = lobe.cosineFromSurface * (part == 0 ? horizon.left : from);
            precise vec3 end = lobe.cosineFromSurface * (part == 0 ? from : to);
            precise vec3 between = lobe.cosineFromSurface * (part == 0 ? from - horizon.left : along);
            vec3 startAbove = start, endAbove = end, betweenAbove = between;
            bool comesUpAgain;
            if (!cutEdge(startAbove, endAbove, betweenAbove, base, comesUpAgain)) continue;
            if (comesUpAgain && base.isBelow) {
                sum += closingPart(base.left, startAbove, turn * closingTurn(base.left, startAbove, baseWay));
                base.isBelow = false;
            }
            if (part == 0 || isClosing) {
                float way = closingTurn(part == 0 ? horizon.left : from, part == 0 ? from : to, horizonWay);
                sum += closingPart(startAbove, endAbove, surfaceHeight * way);
            } else {
                sum += edgePart(startAbove, endAbove, betweenAbove);
            }
        }
        if (closes) horizon.isBelow = false;
    }
    if (base.isBelow && base.hasEntered)
        sum += closingPart(base.left, base.entered, turn * closingTurn(base.left, base.entered, baseWay));
    precise float share = abs(sum) * (0.5 * kInversePi) * lobe.perAbove;
    return min(share, 1.0);
}

// ---- Surfaces -------------------------------------------------------------------------------------------------------

#define AREA_LOBES 3 // the diffuse reflection, the lobe and the coat

// Lobes of the shaded surface, the same for all lights.
AreaLobe areaLobes[AREA_LOBES];
vec3 areaWeights[AREA_LOBES]; // radiance towards the viewer per radiance of a light that fills the lobe
vec3 areaEntering;            // per entering irradiance, for wrapped light

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

// Radiance towards the viewer from area light `index`, reflected by the surface passed to prepareAreaLobes().
vec3 areaLightOnSurface(int index, int kind, SeenSurface seen, Viewpoint viewpoint, vec3 toLightLS, vec3 smallIrradiance)
{
    vec4 place = lightTexel(index, 0);
    precise vec3 middle = place.xyz - viewpoint.positionLS;
    precise float reach = dot(middle, middle) * place.w;
    precise float window = 1.0 - reach * reach;
    Outline outline = areaOutline(index, kind, middle);
    if (outline.edges == 0) return vec3(0.0);
    precise vec3 reflected = vec3(0.0);
#if HAS_LIGHT_PICTURES
    int picture = lightPictureOf(lightShapeTexel(index, 1).w);
#endif
    for (int lobe = 0; lobe < AREA_LOBES; ++lobe) {
        if (areaWeights[lobe] == vec3(0.0)) continue;
        precise vec3 ofLobe = areaWeights[lobe] * shareSeen(outline, areaLobes[lobe]);
#if HAS_LIGHT_PICTURES
        if (picture >= 0 && ofLobe != vec3(0.0)) ofLobe *= pictureSeen(picture, outline, areaLobes[lobe]);
#endif
        reflected += ofLobe;
    }
    precise vec3 light = reflected * ((window * window) * lightTexel(index, 1).rgb);
#if HAS_SUBSURFACE_WRAP
    // Wrapped light is a small part of a large light, and approximated at the light's centre.
    if (wrapsLight(seen.surface)) {
        precise float cosine = dot(seen.surface.normalLS, toLightLS);
        light += areaEntering * wrappedExcess(seen.surface, cosine) * smallIrradiance;
    }
#endif
    return light;
}
