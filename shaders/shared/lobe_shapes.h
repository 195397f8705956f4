#pragma once
// Table of specular lobes as linearly transformed cosines, for area lights (renderer/frame/LobeShapes.h).
#include "interop.h"

// Columns: the viewer's cosine; rows: alpha; each is the square of its position, as in LOBE_TABLE_SIDE. The first row
// holds the smallest alpha, the first column the smallest cosine.
#define LOBE_SHAPES_SIDE 32
#define LOBE_SHAPES_SMALLEST_ALPHA 1e-3f
#define LOBE_SHAPES_SMALLEST_COSINE 1e-4f

SHARED_BEGIN

// Inverse matrix m of a linearly transformed cosine: takes the lobe's light directions to a clamped cosine around z.
// The lobe's density in a unit direction w is |det| / |m w|^3 times max(z, 0) / pi of m w / |m w|. Scaling m changes
// nothing. Axes: z is the normal, x the viewer's projection on the surface, so that the viewer is (sineView, 0,
// cosView) and a mirror reflects its light to (-sineView, 0, cosView).
//
// The table holds p, q, s and r of this product; their factors in it are their behaviour for small alpha:
//     | width p                  alpha sine q       |   | cosine   0   sine   |
//     |             1                               | x |    0     1     0    |
//     | alpha sine r             alpha width s      |   | -sine    0   cosine |
// The right matrix turns the mirror direction to z. width is Smith's sqrt(alpha^2 + (1 - alpha^2) cosine^2): for small
// alpha, a lobe is narrower by this factor across the viewer's plane than along it; there p is 1 and s is 2.
SHARED_FUNCTION mat3 inverseOfShape(vec4 numbers, float alpha, float cosView, float sineView) {
    SHARED_PRECISE float slant = alpha * sineView;
    SHARED_PRECISE float width = sqrt(slant * slant + cosView * cosView);
    SHARED_PRECISE float p = width * numbers.x;
    SHARED_PRECISE float q = slant * numbers.y;
    SHARED_PRECISE float s = alpha * width * numbers.z;
    SHARED_PRECISE float r = slant * numbers.w;
    SHARED_PRECISE vec3 x = vec3(p * cosView - q * sineView, 0.0f, r * cosView - s * sineView);
    SHARED_PRECISE vec3 z = vec3(p * sineView + q * cosView, 0.0f, r * sineView + s * cosView);
    return mat3(x, vec3(0.0f, 1.0f, 0.0f), z);
}

// Fraction of a transformed cosine above the surface. A lobe is the part above the surface, divided by this.
SHARED_FUNCTION float shareAbove(mat3 inverse) {
    // The surface's plane cuts the cosine's hemisphere into two lunes; the projected area of one is (1 + n.z) / 2, n
    // the normal of the plane.
    SHARED_PRECISE vec3 normal = cross(inverse[0], inverse[1]);
    SHARED_PRECISE float cosine = normal.z / sqrt(dot(normal, normal));
    return 0.5f + 0.5f * cosine;
}

// Inverse matrix of a lobe whose alpha across the viewer's plane differs from that along it. `along`: the matrix for
// the alpha along that plane. Slopes across it have `lean` times those along it subtracted, and are then narrower by
// the factor `narrower`.
SHARED_FUNCTION mat3 stretchedAcross(mat3 along, float narrower, float lean) {
    mat3 stretched = along;
    for (int i = 0; i < 3; ++i) {
        SHARED_PRECISE float across = narrower * (along[i].y - lean * along[i].x);
        stretched[i].y = across;
    }
    return stretched;
}

SHARED_END
