// Shadow maps (shared/shadow_maps.h): compares a point's depth, as seen from a light, with those of the nearest
// casters.
//
// No surface shadows itself within a texel. On the way from a texel's centre c to the point p in it, let e be where one
// triangle meets the next, with slopes a (at c) and b (at p) of depth by texels. The map holds the depth at c, moved
// away by at least half the sum of |a|'s components, but in cascades by a texel's width at most
// (passes/ShadowMapsPass.cpp). The look-up follows the plane of the point's triangle to c and moves it nearer by
// |b| |c - p|. The two depths differ by (b - a)(c - e), and since e lies between c and p, no component of c - e is more
// than that of c - p, nor half a texel. Further away, taps of wide filters may find a surface that bends towards the
// light in front of the plane.
//
// This misses casters that are nearer to the light by less than half a texel's width times the slope, in metres per
// metre. Where a triangle is steep, the next texel on the viewer's side of it is therefore tested too. It lies up to
// 1.5 texels aside, where the triangle is behind the point; a triangle beside it that rises by 45 degrees is at most
// 1.5 texels nearer, and the map has moved it away by half a texel. So casters nearer by a texel count. The test costs
// 1.5 texels aside and one ahead, which pays where half a slope is as much: from 5 on.
#pragma once
#include "shared/face_colors.h"
#include "shared/slots.h"
#include "shared/shadow_maps.h"
#include "lib/maths/cut_loop.glsl"
#include "lib/light/light_store.glsl"
#include "lib/shadow/own_triangle.glsl"
#include "lib/surface/camera.glsl"

#if HAS_SOFT_SHADOWS
#include "lib/shadow/disk_samples.glsl"
#endif

layout(binding = TEXTURE_UNIT_SHADOWS) uniform sampler2D shadowAtlas;

// 1 if a view shows which faces are looked up (lib/lighting/views.glsl).
#ifndef SHOWS_FACES
#define SHOWS_FACES 0
#endif
#if SHOWS_FACES
// Faces looked up by the latest mappedShadow(): rgb the weighted sum of their colours; a the sum of the weights.
vec4 answeringFaces = vec4(0.0);
#endif

// A point relative to a face.
struct FacePoint {
    vec2 texel;    // position in the atlas, in texels
    float depth;   // reverse-Z, as stored
    vec2 slope;    // change of depth per texel, along the plane of the point's triangle
    float bias;    // rounding error, in depth
    vec2 steepest; // the largest |slope| within the error of the stored normal
    vec2 doubt;    // error of the slope
    vec3 face;     // xy its centre and z half its side, in texels
    bool isParallel; // the light is directional
    bool isSoft;   // the light has a size, and the filter uses it
    float perSize; // radius in texels, per light size and depth, within which casters may hide part of the light
    vec2 aside;    // tangents from the light's axis to the point; 0 if the light is parallel
    float rise;    // minimum depth by which a caster must be nearer to count in the texel `beside`
    vec2 ascent;   // slope of its triangle in metres per metre across the light's direction
    ivec2 beside;  // offset to the next texel on the viewer's side of a steep triangle, else 0
    bool isSeen;   // false if edge-on, where depth is arbitrary
};

// `shadow`: LightShadowTexels of the light.
FacePoint facePoint(int firstTexel, vec4 shadow, vec3 positionRWS, vec3 facetNormalRWS, float roundingMetres)
{
    vec4 right = texelFetch(lightTexels, firstTexel);
    vec4 up = texelFetch(lightTexels, firstTexel + 1);
    vec4 forward = texelFetch(lightTexels, firstTexel + 2);
    vec4 place = texelFetch(lightTexels, firstTexel + 3);
    precise vec3 position = vec3(dot(right.xyz, positionRWS) + right.w, dot(up.xyz, positionRWS) + up.w,
                                 dot(forward.xyz, positionRWS) + forward.w);
    // Half widths, in metres or as tangents.
    precise vec2 width2 = 1.0 / vec2(dot(right.xyz, right.xyz), dot(up.xyz, up.xyz));
    precise vec2 width = sqrt(width2);
    precise vec3 normal = vec3(dot(right.xyz, facetNormalRWS) * width2.x, dot(up.xyz, facetNormalRWS) * width2.y,
                               dot(forward.xyz, facetNormalRWS));
    bool isParallel = place.w < 0.0;
    // Vertex snapping may move the map's triangles aside by part of a texel.
    roundingMetres += view.depthKey.w * width.x / place.z * (isParallel ? 1.0 : max(position.z, 0.0));
    precise FacePoint point;
    point.isSoft = SHADOW_FILTER == SHADOW_FILTER_PCSS && shadow.x > 0.0;
    point.face = place.xyz;
    point.isParallel = isParallel;
    // Depth is linear in texels: its slope is scale times the plane's normal over its distance from the light, or
    // (parallel) over the normal's component along the light.
    precise float scale, distance, atOne;
    if (isParallel) {
        scale = -place.w;
        distance = normal.z;
        atOne = 1.0;
        point.aside = vec2(0.0);
        point.depth = 1.0 + place.w * position.z;
        point.texel = place.xy + place.z * position.xy;
    } else {
        precise float perMetre = 1.0 / max(position.z, 1e-30);
        scale = place.w;
        distance = dot(normal, position);
        atOne = length(vec3(position.xy * width, position.z));
        point.aside = position.xy * width * perMetre;
        point.depth = place.w * perMetre;
        point.texel = place.xy + (place.z * perMetre) * position.xy;
    }
    precise float leastDistance = abs(distance) - FACET_ERROR_RADIANS * atOne;
    point.isSeen = leastDistance > 0.0;
    precise float perDistance = scale / max(leastDistance, 1e-30);
    precise vec2 slope = normal.xy * (scale / (distance * place.z));
    precise vec2 steepest = (abs(normal.xy) + FACET_ERROR_RADIANS * width) * (perDistance / place.z);
    precise float rounding = isParallel ? perDistance * roundingMetres + 4.8e-7
                                        : point.depth * (roundingMetres / max(leastDistance, 1e-30) + 4.8e-7);
    precise vec2 rising = normal.xy / width * (isParallel ? 1.0 : position.z);
    vec2 across = abs(rising);
    point.ascent = rising / max(abs(distance), 1e-3 * max(max(across.x, across.y), 1e-30));
    ivec2 toViewer = across.x > across.y ? ivec2(-sign(normal.x), 0) : ivec2(0, -sign(normal.y));
    point.beside = max(across.x, across.y) > 5.0 * leastDistance ? toViewer : ivec2(0);
    precise float texelDepth = (isParallel ? scale : point.depth) * width.x / place.z;
    point.rise = texelDepth + (isParallel ? scale * roundingMetres + 4.8e-7
                                          : point.depth * (roundingMetres / max(position.z, 1e-30) + 4.8e-7));
    point.slope = slope;
    // The stored normal's error in the numerator and in the denominator.
    point.doubt = (width + abs(normal.xy) * (atOne / max(leastDistance, 1e-30))) *
                  (FACET_ERROR_RADIANS * perDistance / place.z);
    point.bias = rounding;
    point.steepest = steepest;
    point.perSize = place.z / (width.x * scale);
    return point;
}

ivec2 withinFace(FacePoint point, ivec2 texel)
{
    return clamp(texel, ivec2(point.face.xy - point.face.z), ivec2(point.face.xy + point.face.z) - 1);
}

float borderTexels(FacePoint point)
{
    return shadowBorderTexels(2.0 * point.face.z, float(SHADOW_TAP_TEXELS), point.isSoft);
}

// 1 if no caster hides a position in the face, in texels, at the depth of the point or of its triangle's plane; else 0.
float seenAt(FacePoint point, vec2 place)
{
    ivec2 within = withinFace(point, ivec2(floor(place)));
    precise vec2 away = vec2(within) + 0.5 - point.texel;
    precise float onPlane = point.depth + dot(point.slope, away) + dot(point.doubt, abs(away)) + point.bias;
    // Casters farther from the light than the point do not hide it, also where the plane passes below other surfaces.
    precise float depth = max(onPlane + dot(point.steepest, min(abs(away), 0.5)), point.depth);
    // 0 is no caster.
    float caster = texelFetch(shadowAtlas, within, 0).r;
    bool isHidden = point.isSeen && caster > max(depth, 0.0);
    if (point.beside != ivec2(0)) {
        precise vec2 aside = place - point.texel;
        precise float own = point.depth + (point.isSeen ? dot(point.slope, aside) + dot(point.doubt, abs(aside)) : 0.0);
        precise float nearer = max(max(own, point.depth) + point.rise, 0.0);
        float casterBeside = texelFetch(shadowAtlas, withinFace(point, within + point.beside), 0).r;
        isHidden = isHidden || min(caster, casterBeside) > nearer;
    }
    return isHidden ? 0.0 : 1.0;
}

#if SHADOW_FILTER == SHADOW_FILTER_PCF
// Mean visibility over a rectangle around the point, SHADOW_WIDTH texels wide, which cuts the texels at its rim. Where
// the triangle is steep along a row or a column, the rectangle is as narrow there as a square on the triangle would
// look. Otherwise taps would follow the plane far beyond the end of the surface, past the casters there.
float meanSeen(FacePoint point)
{
    precise vec2 width = float(SHADOW_WIDTH) * inversesqrt(1.0 + point.ascent * point.ascent);
    precise vec2 low = point.texel - 0.5 * width;
    precise vec2 high = low + width;
    ivec2 first = ivec2(floor(low));
    ivec2 count = min(ivec2(floor(high)) - first, SHADOW_WIDTH) + 1;
    precise float sum = 0.0, all = 0.0;
    int y = 0, x = 0;
    for (; y < count.y; ++y) {
        precise float row = 0.0, allOfRow = 0.0;
        for (x = 0; x < count.x; ++x) {
            precise vec2 corner = vec2(first + ivec2(x, y));
            precise vec2 from = max(corner, low);
            precise vec2 to = min(corner + 1.0, high);
            precise float share = max(to.x - from.x, 0.0);
            row += share * seenAt(point, clamp(corner + 0.5, from, to));
            allOfRow += share;
        }
        precise float share = max(min(float(first.y + y) + 1.0, high.y) - max(float(first.y + y), low.y), 0.0);
        sum += share * row;
        all += share * allOfRow;
    }
    if (y < count.y || x < count.x) return CUT_LOOP;
    // Both sums add the same terms if nothing is hidden: exactly 1.
    return clamp(sum / all, 0.0, 1.0);
}
#endif

#if SHADOW_FILTER == SHADOW_FILTER_PCSS && HAS_SOFT_SHADOWS
// Maps an offset over a disk across the light's axis to the disk that faces the point: off the axis it covers 1/cos as
// many texels in that direction.
vec2 acrossDisk(FacePoint point, vec2 offset)
{
    precise vec2 turned = offset + point.aside * (dot(offset, point.aside) /
                                                  (1.0 + sqrt(1.0 + dot(point.aside, point.aside))));
    return turned;
}

// Mean visibility over the penumbra of casters at the mean depth of those around (Fernando 2005, "Percentage-Closer
// Soft Shadows"). The search covers casters that hide part of the light and are not nearer to it than to the point, or
// (parallel) at any distance.
float penumbraSeen(FacePoint point, float size, vec2 random)
{
    precise float perDepth = size * point.perSize;
    precise float range = point.isParallel ? 1.0 - point.depth : point.depth;
    float widest = borderTexels(point);
    precise float reach = clamp(perDepth * range, 1.0, widest);
    precise float depths = 0.0;
    precise float hidden = 0.0;
    int i = 0;
    for (; i < SHADOW_SAMPLES; ++i) {
        precise vec2 place = point.texel + acrossDisk(point, reach * diskPlace(i, random));
        if (seenAt(point, place) == 0.0) {
            hidden += 1.0;
            depths += texelFetch(shadowAtlas, withinFace(point, ivec2(floor(place))), 0).r;
        }
    }
    if (i != SHADOW_SAMPLES) return CUT_LOOP;
    // Returns before a division by their number.
    if (hidden == 0.0) return 1.0;
    if (hidden == float(SHADOW_SAMPLES)) return 0.0;
    precise float penumbra = clamp(perDepth * (depths / hidden - point.depth), 1.0, widest);
    precise float seen = 0.0;
    for (i = 0; i < SHADOW_SAMPLES; ++i)
        seen += seenAt(point, point.texel + acrossDisk(point, penumbra * diskPlace(i, random)));
    if (i != SHADOW_SAMPLES) return CUT_LOOP;
    return clamp(seen * (1.0 / float(SHADOW_SAMPLES)), 0.0, 1.0);
}
#endif

float filtered(FacePoint point, vec4 shadow, Viewpoint viewpoint)
{
#if SHADOW_FILTER == SHADOW_FILTER_PCF
    return meanSeen(point);
#elif SHADOW_FILTER != SHADOW_FILTER_HARD && SHADOW_FILTER != SHADOW_FILTER_PCSS
#error "a filter without a way to look maps up"
#elif SHADOW_FILTER == SHADOW_FILTER_PCSS && HAS_SOFT_SHADOWS
    if (shadow.x > 0.0) return penumbraSeen(point, shadow.x, shadowRandom(viewpoint.pixel, shadow.y));
#endif
    return seenAt(point, point.texel);
}

// Fraction of its half side over which a cascade blends into the next; hard shadows change at once.
const float kBlendShare = SHADOW_FILTER == SHADOW_FILTER_HARD ? 0.0 : 0.1;

// Fraction of light `index` that its maps let through; isFar: it is directional, with cascades; planeNormalLS: away
// from the viewer, of the plane that the surface continues along (liftedPlaneNormal()).
//
// A single loop over the faces that may hold the point: the finest cascade, and the next one where it ends. It runs
// zero times for lights without shadows: rasterisers that mask lanes skip loops, but run all other code.
float mappedShadow(int index, int kind, vec3 placeLS, bool isFar, vec3 planeNormalLS, OwnPlane own, Viewpoint viewpoint)
{
    precise float hidden = 0.0;
    precise float share = 1.0;
    int left = (kind & LIGHT_SHADOWED) == 0 ? 0 : isFar ? SHADOW_CASCADES : 1;
    for (int i = 0; left > 0; ++i, --left) {
        vec4 shadow = lightShadowTexel(index);
        int face = int(shadow.z) + SHADOW_FACE_TEXELS * i;
        mat3 rwsFromLS = mat3(view.worldFromLS);
        precise vec3 toLight = isFar ? placeLS : placeLS - viewpoint.positionLS;
        if ((kind & LIGHT_SIX_FACES) != 0) {
            precise vec3 fromLight = rwsFromLS * -toLight;
            vec3 size = abs(fromLight);
            int axis = size.x >= max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
            face += SHADOW_FACE_TEXELS * (2 * axis + (fromLight[axis] < 0.0 ? 1 : 0));
        }
        precise vec3 positionRWS = rwsFromLS * viewpoint.positionLS;
        precise vec3 planeNormalRWS = rwsFromLS * planeNormalLS;
        precise float rounding =
            shadow.w + 1.9e-6 * length(viewpoint.positionLS) + snappingMetres(viewpoint.positionLS);
        FacePoint point = facePoint(face, shadow, positionRWS, planeNormalRWS, rounding);
        vec2 fromMiddle = abs(point.texel - point.face.xy);
        precise float room = point.face.z - max(fromMiddle.x, fromMiddle.y);
        precise float ownShare = 1.0;
        if (isFar) {
            room -= borderTexels(point);
            if (kBlendShare > 0.0 && left > 1) ownShare = min(room / (kBlendShare * point.face.z), 1.0);
        }
        // Outside a cascade, or the cone of a spot light.
        if (room <= 0.0) ownShare = 0.0;
        // Depth is ambiguous: triangles turned away at a grazing angle are steep and lie closely behind the lit side.
        bool isBehind = hidesBehind(own, toLight, rounding);
        if (ownShare > 0.0) hidden += share * ownShare * (1.0 - (isBehind ? 0.0 : filtered(point, shadow, viewpoint)));
#if SHOWS_FACES
        precise vec4 answer = (share * ownShare) * vec4(faceColor((face - int(shadow.z)) / SHADOW_FACE_TEXELS), 1.0);
        answeringFaces += answer;
#endif
        share *= 1.0 - ownShare;
        if (share <= 0.0) left = 1;
    }
    if (left != 0) return CUT_LOOP;
    // Outside all cascades no casters are known: lit.
    if (share >= 1.0) return 1.0;
    precise float seen = 1.0 - hidden / (1.0 - share);
    return isnan(seen) ? CUT_LOOP : clamp(seen, 0.0, 1.0);
}

#if HAS_SUBSURFACE_PASSAGE
// Change of a caster's depth per column and row of texels. Of the two neighbours, the one nearer in depth is on the
// same surface.
vec2 casterSlope(FacePoint point, ivec2 texel, float caster)
{
    vec2 slope = vec2(0.0);
    for (int axis = 0; axis < 2; ++axis) {
        ivec2 step = axis == 0 ? ivec2(1, 0) : ivec2(0, 1);
        ivec2 before = withinFace(point, texel - step), after = withinFace(point, texel + step);
        precise float toBefore = abs(caster - texelFetch(shadowAtlas, before, 0).r);
        precise float toAfter = abs(caster - texelFetch(shadowAtlas, after, 0).r);
        // At the face's rim there is one neighbour.
        slope[axis] = before == texel ? toAfter : after == texel ? toBefore : min(toBefore, toAfter);
    }
    return slope;
}

float metresBehind(FacePoint point, vec4 place, float wayMetres, float caster)
{
    precise float behind = point.isParallel ? (caster - point.depth) / -place.w
                                            : wayMetres * (1.0 - point.depth / max(caster, 1e-37));
    return behind;
}

// Metres from the first caster in a face to the point, along the way from the light, at least 0: the mean of the four
// texels around it. The map moves casters away from the light by the larger of their slopes, in a cascade by the width
// of a texel at most (passes/ShadowMapsPass.cpp); this is undone here. On the caster's plane, texels beside the point
// may lie behind it; what is farther behind is another surface.
float passageBehind(FacePoint point, vec4 place, float wayMetres)
{
    precise vec2 between = point.texel - 0.5;
    vec2 corner = floor(between);
    precise vec2 share = between - corner;
    precise float metres = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        ivec2 texel = withinFace(point, ivec2(corner) + step);
        float stored = texelFetch(shadowAtlas, texel, 0).r;
        if (!(stored > 0.0)) continue; // no caster
        vec2 slope = casterSlope(point, texel, stored);
        precise float moved = max(slope.x, slope.y);
        if (point.isParallel) moved = min(moved, 1.0 / point.perSize);
        precise float caster = stored + moved, farthest = point.depth - (slope.x + slope.y);
        vec2 weight = mix(1.0 - share, share, vec2(step));
        metres += weight.x * weight.y * metresBehind(point, place, wayMetres, max(caster, farthest));
    }
    return max(metres, 0.0);
}

// The same in the finest face that contains the point; below 0 if none does. Arguments as of mappedShadow().
float mappedPassage(int index, int kind, vec3 placeLS, bool isFar, vec3 facetNormalLS, Viewpoint viewpoint)
{
    vec4 shadow = lightShadowTexel(index);
    mat3 rwsFromLS = mat3(view.worldFromLS);
    precise vec3 toLight = isFar ? placeLS : placeLS - viewpoint.positionLS;
    precise vec3 positionRWS = rwsFromLS * viewpoint.positionLS;
    int face = int(shadow.z);
    if ((kind & LIGHT_SIX_FACES) != 0) {
        precise vec3 fromLight = rwsFromLS * -toLight;
        vec3 size = abs(fromLight);
        int axis = size.x >= max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
        face += SHADOW_FACE_TEXELS * (2 * axis + (fromLight[axis] < 0.0 ? 1 : 0));
    }
    precise float rounding =
            shadow.w + 1.9e-6 * length(viewpoint.positionLS) + snappingMetres(viewpoint.positionLS);
    int faces = isFar ? SHADOW_CASCADES : 1;
    int i = 0;
    for (; i < faces; ++i, face += SHADOW_FACE_TEXELS) {
        FacePoint point = facePoint(face, shadow, positionRWS, rwsFromLS * facetNormalLS, rounding);
        vec2 fromMiddle = abs(point.texel - point.face.xy);
        precise float room = point.face.z - max(fromMiddle.x, fromMiddle.y) - (isFar ? borderTexels(point) : 0.0);
        if (room > 0.0) return passageBehind(point, texelFetch(lightTexels, face + 3), length(toLight));
    }
    return i < faces ? CUT_LOOP : -1.0;
}
#endif
