#pragma once
// Light culling test for C++ and GLSL: whether a light may affect a cell, the part of a tile's frustum between two
// depths. It is conservative: it never rejects a light that changes a pixel; the oracle counts false positives. Culling
// space: x metres to the right, y up and z ahead of the origin of lighting space (frame.h). Unlike in view space, which
// looks along -Z, z is positive in front. Pixel rays at s metres ahead lie (spread.x + spread.y s) times as far to the
// side as ViewConstants::rayFromPixel states: spread is (view depth of the origin, 1) for a perspective camera and (1,
// 0) for an orthographic one. Everything is precise, so that the shader that counts lights and the one that lists them
// get the same result.
#include "interop.h"

// Tile columns tested together against the column planes; box tests follow.
#define CULL_BLOCK_COLUMNS 8u

// The cosines of the angle at a cone light and of its outer angle are off by at most 4e-7: a few roundings of 2^-24, of
// directions and squares (lib/light/light.glsl, shared/light.h). A cone widened by this margin in its cosine encloses
// every lit point.
#define CONE_COSINE_MARGIN 1e-6

SHARED_BEGIN

// Bound in metres on the fp32 rounding error of positions of a light and of the surfaces in its range. First term: 1e-5
// of the farthest distance from the origin (24 bits keep 6e-8 of each distance, and a handful of roundings accumulate).
// Second term: quantisation of linear depth, at any distance: two rounded coefficients, a product, a sum, and the sum
// in the depth key are each off by 2^-24 of ViewConstants::depthKey.y, the distance from depth 0 to 1. Eight such
// errors are allowed.
SHARED_FUNCTION float roundingMargin(float farthestMetres, vec4 depthKey) {
    return 1e-5f * farthestMetres + 4.76837158e-7f * depthKey.y;
}

// Bounds of the region where a light is not exactly 0, in culling space. Every length includes the fp32 rounding error
// of positions.
struct CullLight {
    vec4 sphere; // xyz centre, w radius of the bounding sphere; w < 0: unbounded
    vec4 apex;   // cone: xyz apex, w sine of the outer angle; else w radius of the light's surface around its centre;
                 // front: also xyz point of the plane behind which there is no light
    vec4 axis;   // cone: xyz unit direction of travel, w cosine of the outer angle; front: xyz the same, w -3; else w
                 // -2
};

struct CellBox {
    vec4 low;  // xyz in culling space
    vec4 high; // xyz in culling space
};

// Bounds of the shading rays of tile (column, row), in the units of rayFromPixel: x, y minimum and maximum to the
// right, z, w minimum and maximum upwards. Pixels with one sample are shaded at their centres, those with several
// anywhere within (lib/raster/shading_place.glsl). `size`: ViewConstants::sizePixels.
SHARED_FUNCTION vec4 tileRays(vec4 rayFromPixel, uint column, uint row, uint side, uvec4 size) {
    float inset = size.z > 1u ? 0.0f : 0.5f;
    float left = float(column * side) + inset;
    float right = float(min((column + 1u) * side, size.x)) - inset;
    float top = float(size.y - row * side) - inset;
    float bottom = float(size.y - min((row + 1u) * side, size.y)) + inset;
    SHARED_PRECISE vec4 rays =
        vec4(rayFromPixel.x * (left - rayFromPixel.z), rayFromPixel.x * (right - rayFromPixel.z),
             rayFromPixel.y * (bottom - rayFromPixel.w), rayFromPixel.y * (top - rayFromPixel.w));
    return rays;
}

// Factor from the units of rayFromPixel to metres at a distance ahead.
SHARED_FUNCTION float spreadAt(float ahead, vec2 spread) {
    SHARED_PRECISE float width = spread.x + spread.y * ahead;
    return width;
}

// The two planes through the camera (orthographic: parallel to its axis) that bound a row or column of tiles: x, y
// their rays, z, w the lengths of their normals.
SHARED_FUNCTION vec4 slabBetween(vec2 rays, vec2 spread) {
    SHARED_PRECISE float lowLength = sqrt(1.0f + spread.y * rays.x * rays.x);
    SHARED_PRECISE float highLength = sqrt(1.0f + spread.y * rays.y * rays.y);
    return vec4(rays, lowLength, highLength);
}

// Whether a sphere intersects a slab. `across`: coordinate of its centre to the right or up; `width`: spreadAt() of its
// centre.
SHARED_FUNCTION bool sphereTouchesSlab(float across, float width, float radius, vec4 slab) {
    SHARED_PRECISE float lowGap = across - slab.x * width;
    SHARED_PRECISE float highGap = across - slab.y * width;
    SHARED_PRECISE float lowReach = -radius * slab.z;
    SHARED_PRECISE float highReach = radius * slab.w;
    return min(lowGap - lowReach, highReach - highGap) >= 0.0f;
}

// Bounding box of a tile's frustum between two distances ahead in metres, near < far.
SHARED_FUNCTION CellBox cellBox(vec4 rays, float nearMetres, float farMetres, vec2 spread) {
    SHARED_PRECISE float n = nearMetres - 1e-5f * abs(nearMetres);
    SHARED_PRECISE float f = farMetres + 1e-5f * abs(farMetres);
    SHARED_PRECISE float n1 = spread.x + spread.y * n;
    SHARED_PRECISE float f1 = spread.x + spread.y * f;
    SHARED_PRECISE CellBox box;
    box.low = vec4(min(rays.x * n1, rays.x * f1), min(rays.z * n1, rays.z * f1), n, 0.0f);
    box.high = vec4(max(rays.y * n1, rays.y * f1), max(rays.w * n1, rays.w * f1), f, 0.0f);
    return box;
}

// Whether the box's bounding sphere intersects the cone. A point v is |v| sin(angle - outer) away from the cone's
// surface; beyond a right angle that underestimates, so the test is conservative for every cone.
SHARED_FUNCTION bool coneTouchesBox(CullLight light, CellBox box) {
    SHARED_PRECISE vec3 center = 0.5f * (vec3(box.low) + vec3(box.high));
    SHARED_PRECISE vec3 halfSize = 0.5f * (vec3(box.high) - vec3(box.low));
    SHARED_PRECISE vec3 v = center - vec3(light.apex);
    SHARED_PRECISE float length2 = dot(v, v);
    SHARED_PRECISE float radius = sqrt(dot(halfSize, halfSize)) * (1.0f + 1e-4f) + 1e-4f * sqrt(length2);
    SHARED_PRECISE float along = dot(v, vec3(light.axis));
    SHARED_PRECISE float across = sqrt(max(length2 - along * along, 0.0f));
    SHARED_PRECISE float beyond = light.axis.w * across - light.apex.w * along;
    return beyond <= radius;
}

// Squared distance in m^2 of a point from the box; 0 inside. Takes components, so that loops over points vectorise.
SHARED_FUNCTION float squaredDistance(float x, float y, float z, CellBox box) {
    SHARED_PRECISE float gapX = max(max(box.low.x - x, x - box.high.x), 0.0f);
    SHARED_PRECISE float gapY = max(max(box.low.y - y, y - box.high.y), 0.0f);
    SHARED_PRECISE float gapZ = max(max(box.low.z - z, z - box.high.z), 0.0f);
    SHARED_PRECISE float distance2 = gapX * gapX + gapY * gapY + gapZ * gapZ;
    return distance2;
}

SHARED_FUNCTION bool hasCone(CullLight light) {
    return light.axis.w >= -1.5f;
}

SHARED_FUNCTION bool hasFront(CullLight light) {
    return light.axis.w < -2.5f;
}

// Whether any point of the box lies in front of the light's plane.
SHARED_FUNCTION bool frontTouchesBox(CullLight light, CellBox box) {
    SHARED_PRECISE vec3 halfSize = 0.5f * (vec3(box.high) - vec3(box.low));
    SHARED_PRECISE vec3 v = 0.5f * (vec3(box.low) + vec3(box.high)) - vec3(light.apex);
    SHARED_PRECISE float reach = dot(halfSize, abs(vec3(light.axis)));
    SHARED_PRECISE float rounding = 1e-5f * (sqrt(dot(v, v)) + reach);
    return dot(v, vec3(light.axis)) + reach + rounding >= 0.0f;
}

SHARED_FUNCTION bool lightTouchesBox(CullLight light, CellBox box) {
    SHARED_PRECISE float radius2 = light.sphere.w * light.sphere.w;
    if (squaredDistance(light.sphere.x, light.sphere.y, light.sphere.z, box) > radius2) return false;
    if (hasFront(light)) return frontTouchesBox(light, box);
    return !hasCone(light) || coneTouchesBox(light, box);
}

// Distance ahead in metres of a depth-buffer value, by ViewConstants::aheadFromDepth.
SHARED_FUNCTION float aheadMetres(vec4 aheadFromDepth, float depth) {
    SHARED_PRECISE float metres =
        (aheadFromDepth.x + aheadFromDepth.y * depth) / (aheadFromDepth.z + aheadFromDepth.w * depth);
    return metres;
}

// Whether a light's bounding sphere may intersect the range between two distances ahead.
SHARED_FUNCTION bool sphereTouchesDepths(vec4 sphere, float nearMetres, float farMetres) {
    SHARED_PRECISE float nearest = nearMetres - 1e-5f * abs(nearMetres);
    SHARED_PRECISE float farthest = farMetres + 1e-5f * abs(farMetres);
    SHARED_PRECISE float back = sphere.z + sphere.w;
    SHARED_PRECISE float front = sphere.z - sphere.w;
    return back >= nearest && front <= farthest;
}

SHARED_END
