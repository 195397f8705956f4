#pragma once
// The table of the shapes of lobes under area lights (renderer/frame/LobeShapes.h): linearly transformed cosines.
// Source: Heitz, Dupuy, Hill, Neubelt 2016, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines".
#include "interop.h"

// By the viewer's cosine (to the right) and by alpha (upwards), each at the square of its place, as LOBE_TABLE_SIDE.
// The first rows hold the smallest alpha, the first column the smallest cosine.
#define LOBE_SHAPES_SIDE 32
#define LOBE_SHAPES_SMALLEST_ALPHA 1e-3f
#define LOBE_SHAPES_SMALLEST_COSINE 1e-4f

SHARED_BEGIN

// The matrix that takes directions of light to a clamped cosine around z, whose density there is the lobe's shape: of a
// unit direction w it is |det| / |m w|^3 times max(z, 0) / pi of m w / |m w|. Scaling the matrix changes nothing. Axes:
// z is the normal, x the viewer's projection on the surface, so that the viewer is (sineView, 0, cosView) and a mirror
// sends its light to (-sineView, 0, cosView).
//
// The numbers of the table are those of this product, divided by what they do where alpha is small:
//     | width p                  alpha sine q       |   | cosine   0   sine   |
//     |             1                               | x |    0     1     0    |
//     | alpha sine r             alpha width s      |   | -sine    0   cosine |
// The right one turns the mirror's direction to z. width is Smith's sqrt(alpha^2 + (1 - alpha^2) cosine^2): a narrow
// lobe is as many times narrower across than along the plane of the viewer. There p is 1 and s is 2.
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

// The share of a shape that lies above the surface. A lobe is its shape above the surface, divided by this.
SHARED_FUNCTION float shareAbove(mat3 inverse) {
    // The surface's plane cuts the cosine's hemisphere into two lunes; the projected area of one is (1 + n.z) / 2, n
    // the normal of the plane.
    SHARED_PRECISE vec3 normal = cross(inverse[0], inverse[1]);
    SHARED_PRECISE float cosine = normal.z / sqrt(dot(normal, normal));
    return 0.5f + 0.5f * cosine;
}

// The inverse of a shape whose facets' slopes have another alpha across the plane of the viewer than along it. `along`
// is of slopes with the alpha along that plane; slopes across it are as many times narrower as `narrower` says, after
// `lean` times those along it are taken off.
SHARED_FUNCTION mat3 stretchedAcross(mat3 along, float narrower, float lean) {
    mat3 stretched = along;
    for (int i = 0; i < 3; ++i) {
        SHARED_PRECISE float across = narrower * (along[i].y - lean * along[i].x);
        stretched[i].y = across;
    }
    return stretched;
}

SHARED_END
