// The picture of a flat area light as a lobe sees it (docs/area-lights.md).
#pragma once
#include "lib/light/area_edges.glsl"
#include "lib/light/area_lobe.glsl"
#include "lib/light/area_outline.glsl"
#include "lib/light/light_picture.glsl"

// An edge's part of the vector irradiance, of which edgePart() is the height.
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

// Corners one by one; each is cut off at the horizon, then at the cosine's, and what is left adds its edges.
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

// The direction of the mean of what a lobe sees of a flat outline, of any length and sign, in the frame of the cosine.
// It needs few digits: what is seen so small that they are lost is seen as the mean of its picture.
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

// The deviation of the Gaussian that is nearest to what a cosine sees of a plane straight ahead, in parts of its distance.
const float kCosineDeviation = 0.75;
const float kMostStretch = 3.0; // of a Gaussian that several of a level stand for
const int kStretchTaps = 5;

// The mean direction meets the mean of the places weighted by 1 / distance^4. The light weights them by their height too,
// which is linear: so its mean lies further by their covariance with the height, over the mean height. `variances` are
// those of the surface's places, which count as far as a cosine sees: `turns` are the squares of how many radians a step
// along either vector turns, and their mixed term. The variance of the height is at most that of heights spread evenly from
// zero, a third of the squared mean; what the horizon cuts may have more.
vec2 placeByHeight(vec2 variances, vec3 turns, vec2 slope, float meanHeight)
{
    // Where a step turns by more than 100 radians nearly nothing is left to move, and the determinant has no digits.
    precise vec3 held = turns * (min(1.0, 1e4 / max(turns.x + turns.y, 1e-30)) / (kCosineDeviation * kCosineDeviation));
    precise vec2 ofAll = variances * slope, own = 1.0 + variances * held.xy, other = variances * held.z;
    precise float determinant = own.x * own.y - other.x * other.y;
    precise vec2 withHeight = vec2(own.y * ofAll.x - other.x * ofAll.y, own.x * ofAll.y - other.y * ofAll.x) / determinant;
    precise float ofHeight = dot(withHeight, slope);
    precise vec2 further = withHeight * (max(meanHeight, 0.0) / max(max(3.0 * ofHeight, meanHeight * meanHeight), 1e-30));
    return further;
}

// The factor of a picture as a lobe sees it: around the mean of the directions it comes from, as wide as the cosine is
// there. Across an outline that is seen aslant it is longer than wide.
vec3 pictureSeen(int picture, Outline outline, AreaLobe lobe)
{
    precise mat3 cosineFromLS = lobe.cosineFromSurface * lobe.surfaceFromLS;
    precise vec3 middle = cosineFromLS * outline.middle;
    precise vec3 right = cosineFromLS * outline.right, up = cosineFromLS * outline.up;
    // Of what is small from afar single precision leaves no place, and it is seen nearly as its mean.
    precise float across = sqrt(max(dot(right, right), dot(up, up)) / max(dot(middle, middle), 1e-30));
    precise float digits = clamp(100.0 * across - 1.0, 0.0, 1.0);
    if (!(digits > 0.0)) return lightPictureMean(picture);
    precise vec3 direction = seenDirection(outline, lobe);
    precise vec3 front = cross(right, up);
    precise float along = dot(direction, front);
    precise float height = dot(middle, front);
    precise vec3 met = along != 0.0 ? direction * (height / along) : middle;
    precise float right2 = dot(right, right), up2 = dot(up, up), both = dot(right, up);
    // Of a light that touches the point, all that is seen lies there.
    precise float metres2 = dot(met, met);
    if (!(metres2 < 1e30)) return lightPictureMean(picture);
    precise float distance2 = max(metres2, 1e-12 * max(right2, up2));
    // The place by the two vectors, which the lobe's matrix has sheared.
    precise vec3 place = met - middle;
    precise float sheared = right2 * up2 - both * both;
    if (!(sheared > 0.0)) return lightPictureMean(picture);
    precise float inRight = dot(place, right), inUp = dot(place, up);
    precise vec2 within = vec2(inRight * up2 - inUp * both, inUp * right2 - inRight * both) / sheared;
    // By how many radians a step along either vector turns: a quadratic form, and its axes.
    precise float metRight = dot(met, right), metUp = dot(met, up);
    precise float turnRight = max(right2 - metRight * metRight / distance2, 0.0) / distance2;
    precise float turnUp = max(up2 - metUp * metUp / distance2, 0.0) / distance2;
    precise float turnBoth = (both - metRight * metUp / distance2) / distance2;
    within += placeByHeight(lightPictureVariances(picture), vec3(turnRight, turnUp, turnBoth), vec2(right.z, up.z), met.z);
    within = clamp(within, -1.0, 1.0);
    precise float mean = 0.5 * (turnRight + turnUp), lean = 0.5 * (turnRight - turnUp);
    precise float apart = sqrt(lean * lean + turnBoth * turnBoth);
    precise float most = max(mean + apart, 1e-30), least = max(mean - apart, 1e-30);
    // In parts of the picture's sides, which are two of the vectors.
    precise float narrow = 0.5 * kCosineDeviation / sqrt(most);
    precise float wide = min(0.5 * kCosineDeviation / sqrt(least), 1.0); // the last level is as wide as the picture
    precise float level = min(max(narrow, wide / kMostStretch), 1.0);
    precise float beyond = sqrt(max(wide * wide - level * level, 0.0));
    // Along the axis of the lesser turn.
    precise vec2 slow = lean > 0.0 ? vec2(-turnBoth, lean + apart) : vec2(apart - lean, -turnBoth);
    precise float length2 = dot(slow, slow);
    precise vec2 axis = length2 > 0.0 ? slow / sqrt(length2) : vec2(1.0, 0.0);
    precise vec2 at = vec2(0.5 + 0.5 * within.x, 0.5 - 0.5 * within.y);
    precise vec2 stride = vec2(axis.x, -axis.y) * (0.75 * beyond);
    // All of them lie within the picture, so that their mean stays where it is.
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
