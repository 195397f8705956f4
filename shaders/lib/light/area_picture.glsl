// The light texture of a flat area light, averaged over a lobe (docs/area-lights.md).
#pragma once
#include "lib/light/area_edges.glsl"
#include "lib/light/area_lobe.glsl"
#include "lib/light/area_outline.glsl"
#include "lib/light/light_picture.glsl"

// An edge's term of the vector irradiance; edgePart() is its height (z).
vec3 edgeVector(vec3 a, vec3 b)
{
    precise float lengths = sqrt(dot(a, a)) * sqrt(dot(b, b));
    if (!(lengths > 0.0)) return vec3(0.0);
    precise vec3 across = cross(a, b - a) / lengths;
    precise float cosine = clamp(dot(a, b) / lengths, -1.0, 1.0);
    precise float acute = angleOverSine(abs(cosine));
    precise vec3 part = across * (cosine >= 0.0 ? acute : kPi / max(length(across), 1e-18) - acute);
    return part;
}

// Clips a polygon, corner by corner, at the surface's horizon, then at the cosine's, and sums the remaining edges.
struct CutCorners {
    vec3 last, lastBase, lastAbove, firstBase, firstAbove;
    bool hasBase, hasAbove;
    vec3 sum;
};

void addAbove(inout CutCorners cut, vec3 corner)
{
    if (cut.hasAbove) {
        precise vec3 sum = cut.sum + edgeVector(cut.lastAbove, corner);
        cut.sum = sum;
    } else {
        cut.firstAbove = corner;
    }
    cut.hasAbove = true;
    cut.lastAbove = corner;
}

void addBase(inout CutCorners cut, vec3 corner, bool isAgain)
{
    if (cut.hasBase) {
        if ((cut.lastBase.z > 0.0) != (corner.z > 0.0)) {
            precise float share = cut.lastBase.z / (cut.lastBase.z - corner.z);
            precise vec3 crossing = vec3(cut.lastBase.xy + share * (corner.xy - cut.lastBase.xy), 0.0);
            addAbove(cut, crossing);
        }
    } else {
        cut.firstBase = corner;
    }
    if (corner.z > 0.0 && !isAgain) addAbove(cut, corner);
    cut.hasBase = true;
    cut.lastBase = corner;
}

// Mean direction of the visible part of a flat outline under a lobe, of any length and sign, in the cosine's frame. Few
// digits suffice: lights too small for them use the mean of their texture.
vec3 seenDirection(Outline outline, AreaLobe lobe)
{
    CutCorners cut;
    cut.sum = vec3(0.0);
    cut.hasBase = cut.hasAbove = false;
    cut.lastBase = cut.lastAbove = cut.firstBase = cut.firstAbove = vec3(0.0);
    cut.last = lobe.surfaceFromLS * (outline.middle + outlineCorner(outline, 0));
    for (int i = 1; i <= outline.edges; ++i) {
        vec3 from = cut.last;
        precise vec3 to = lobe.surfaceFromLS * (outline.middle + outlineCorner(outline, i));
        cut.last = to;
        if ((from.z > 0.0) != (to.z > 0.0)) {
            precise float share = from.z / (from.z - to.z);
            precise vec3 crossing = vec3(from.xy + share * (to.xy - from.xy), 0.0);
            precise vec3 seen = lobe.cosineFromSurface * crossing;
            addBase(cut, seen, false);
        }
        precise vec3 seen = lobe.cosineFromSurface * to;
        if (to.z > 0.0) addBase(cut, seen, false);
    }
    if (cut.hasBase) addBase(cut, cut.firstBase, true);
    precise vec3 sum = cut.sum;
    if (cut.hasAbove) sum += edgeVector(cut.lastAbove, cut.firstAbove);
    return sum;
}

// Deviation, relative to the distance, of the Gaussian that best fits a clamped cosine on a plane straight ahead.
const float kCosineDeviation = 0.75;
const float kMostStretch = 3.0; // largest stretch of a Gaussian that several taps of a level replace
const int kStretchTaps = 5;

// Offset of the look-up by the cosine's height. The mean direction meets the mean position weighted by 1 / distance^4.
// The light also weights positions by height, which is linear, and so moves the mean by their covariance with the
// height over the mean height. `variances`: of the surface's positions, limited to the cosine's extent. `turns`:
// squares of the radians that a step along either axis turns by, and their mixed term. The height's variance is at most
// a third of the squared mean, as for heights spread evenly from zero; clipping at the horizon may exceed that.
vec2 placeByHeight(vec2 variances, vec3 turns, vec2 slope, float meanHeight)
{
    // If a step turns by more than 100 radians, nearly no offset is left, and the determinant has no digits.
    precise vec3 held = turns * (min(1.0, 1e4 / max(turns.x + turns.y, 1e-30)) / (kCosineDeviation * kCosineDeviation));
    precise vec2 ofAll = variances * slope, own = 1.0 + variances * held.xy, other = variances * held.z;
    precise float determinant = own.x * own.y - other.x * other.y;
    precise vec2 withHeight = vec2(own.y * ofAll.x - other.x * ofAll.y, own.x * ofAll.y - other.y * ofAll.x) / determinant;
    precise float ofHeight = dot(withHeight, slope);
    precise vec2 further = withHeight * (max(meanHeight, 0.0) / max(max(3.0 * ofHeight, meanHeight * meanHeight), 1e-30));
    return further;
}

// Mean of a light texture over a lobe: around the mean direction of the light, as wide as the cosine is there, and
// anisotropic for an outline seen at a grazing angle.
vec3 pictureSeen(int picture, Outline outline, AreaLobe lobe)
{
    precise mat3 cosineFromLS = lobe.cosineFromSurface * lobe.surfaceFromLS;
    precise vec3 middle = cosineFromLS * outline.middle;
    precise vec3 right = cosineFromLS * outline.right, up = cosineFromLS * outline.up;
    // For small, distant lights fp32 cannot resolve the position, and the result is nearly the mean.
    precise float across = sqrt(max(dot(right, right), dot(up, up)) / max(dot(middle, middle), 1e-30));
    precise float digits = clamp(100.0 * across - 1.0, 0.0, 1.0);
    if (!(digits > 0.0)) return lightPictureMean(picture);
    precise vec3 direction = seenDirection(outline, lobe);
    precise vec3 front = cross(right, up);
    precise float along = dot(direction, front);
    precise float height = dot(middle, front);
    precise vec3 met = along != 0.0 ? direction * (height / along) : middle;
    precise float right2 = dot(right, right), up2 = dot(up, up), both = dot(right, up);
    // If the light touches the point, all of its light comes from there.
    precise float metres2 = dot(met, met);
    if (!(metres2 < 1e30)) return lightPictureMean(picture);
    precise float distance2 = max(metres2, 1e-12 * max(right2, up2));
    // Coordinates along the two axes, which the lobe's matrix has sheared.
    precise vec3 place = met - middle;
    precise float sheared = right2 * up2 - both * both;
    if (!(sheared > 0.0)) return lightPictureMean(picture);
    precise float inRight = dot(place, right), inUp = dot(place, up);
    precise vec2 within = vec2(inRight * up2 - inUp * both, inUp * right2 - inRight * both) / sheared;
    // Squared radians by which a step along either axis turns the direction: a quadratic form, and its axes.
    precise float metRight = dot(met, right), metUp = dot(met, up);
    precise float turnRight = max(right2 - metRight * metRight / distance2, 0.0) / distance2;
    precise float turnUp = max(up2 - metUp * metUp / distance2, 0.0) / distance2;
    precise float turnBoth = (both - metRight * metUp / distance2) / distance2;
    within += placeByHeight(lightPictureVariances(picture), vec3(turnRight, turnUp, turnBoth), vec2(right.z, up.z), met.z);
    within = clamp(within, -1.0, 1.0);
    precise float mean = 0.5 * (turnRight + turnUp), lean = 0.5 * (turnRight - turnUp);
    precise float apart = sqrt(lean * lean + turnBoth * turnBoth);
    precise float most = max(mean + apart, 1e-30), least = max(mean - apart, 1e-30);
    // Relative to the texture's sides, which are two axes long.
    precise float narrow = 0.5 * kCosineDeviation / sqrt(most);
    precise float wide = min(0.5 * kCosineDeviation / sqrt(least), 1.0); // the last level is as wide as the texture
    precise float level = min(max(narrow, wide / kMostStretch), 1.0);
    precise float beyond = sqrt(max(wide * wide - level * level, 0.0));
    // Along the principal axis of the smaller turn.
    precise vec2 slow = lean > 0.0 ? vec2(-turnBoth, lean + apart) : vec2(apart - lean, -turnBoth);
    precise float length2 = dot(slow, slow);
    precise vec2 axis = length2 > 0.0 ? slow / sqrt(length2) : vec2(1.0, 0.0);
    precise vec2 at = vec2(0.5 + 0.5 * within.x, 0.5 - 0.5 * within.y);
    precise vec2 stride = vec2(axis.x, -axis.y) * (0.75 * beyond);
    // Keeps all taps within the texture, so that their mean stays in place.
    precise vec2 room = min(at, 1.0 - at) / max(abs(stride) * float(kStretchTaps / 2), 1e-12);
    stride *= min(1.0, min(room.x, room.y));
    vec3 seen = lightPictureFiltered(picture, at, level);
    precise float weights = 1.0;
    for (int tap = 0; tap < kStretchTaps; ++tap) {
        float steps = float(tap - kStretchTaps / 2);
        precise vec2 there = at + steps * stride;
        if (steps == 0.0) continue;
        precise float weight = exp(-0.28125 * steps * steps); // 0.75^2 / 2
        weights += weight;
        seen = mixedFactor(seen, lightPictureFiltered(picture, there, level), weight / weights);
    }
    return mixedFactor(lightPictureMean(picture), seen, digits);
}
