#pragma once
// A light as RGBA32F texels of a buffer texture: LightTexels, then LightShapeTexels if any light has a shape,
// LightCornerTexels if any is a polygon, and LightShadowTexels if shadows are soft or use maps. The faces of shadow
// maps (shadow_maps.h) follow all lights. A buffer texture is the fastest store measured on software rasterisers (2 to
// 3 times faster per pair of light and pixel than a storage buffer) and has no 64 KiB limit.
#include "interop.h"

// Light kind, type plus flag bits, stored as a float value: as float bits, small integers would be denormals, which
// hardware may flush. The type is that of scenes::LightType, in shaders LIGHT_<NAME> (scenes/Light.h).
#define LIGHT_TYPE_MASK 15
#define LIGHT_ATTENUATION 16 // positional: falloff by A + B d + C d^2
#define LIGHT_BROAD 32       // cone: the outer angle is between 60 and 120 degrees
#define LIGHT_SHADOWED 64    // casts shadows
#define LIGHT_SIX_FACES 128  // has a shadow-map face for each direction of the axes

#define LIGHT_TEXELS 2
#define LIGHT_SHAPE_TEXELS 2
#define LIGHT_CORNER_TEXELS 7
#define LIGHT_SHADOW_TEXELS 1

// Round outlines are polygons of equal area, whose vertices lie at most this factor farther out
// (lib/light/area_outline.glsl).
#define AREA_OUTLINE_REACH 1.015f

SHARED_BEGIN

// Data of every kind of light.
struct LightTexels {
    vec4 position; // xyz position LS in metres (types without one: unit direction to the light); w 1/range^2, 0 when
                   // infinite
    vec4 color;    // rgb colour x intensity; w kind
};

// Additional data of types with a shape (LightTypeInfo::hasShape) and of the falloff by A, B, C: the direction of
// travel and two parameters, or a cone. With l the unit direction to the light, a cone's window is
//   clamp(offset - weight |l + axis|^2, 0, 1), or clamp(offset - weight l.axis, 0, 1) where the kind has LIGHT_BROAD.
// Both are (cos angle - cos outer) x scale, scale = 1/max(0.001, cos inner - cos outer): with a the unit direction in
// which the light travels, |l + a|^2 / 2 = 1 - cos angle. Cosines of small angles share their leading digits; |l + a|^2
// keeps the digits of their difference.
// Area lights (LightTypeInfo::isArea): position is the centre, color the radiance. A rectangle or disk has the
// perpendicular half axes axis.xyz and attenuation.xyz, whose cross product points to the emitting side; attenuation.w
// encodes the emitting sides and the light texture (light_pictures.h). A polygon has such axes too, both as long as its
// farthest corner is away, and in axis.w its area relative to their product. A sphere has its radius in axis.w; a tube
// extends from the centre by axis.xyz to either side, with its radius in axis.w.
struct LightShapeTexels {
    vec4 axis;        // xyz a LS, w first parameter; cone: -a where cos outer <= -0.5, w weight: scale/2, -scale/2,
                      // broad: scale
    vec4 attenuation; // xyz A, B, C; w second parameter; cone: offset: (1 - cos outer) x scale, -(1 + cos outer) x
                      // scale, broad: -cos outer x scale
};

// Outline of a polygon, in coordinates along axis.xyz and attenuation.xyz; corners wind counterclockwise, from the
// first axis to the second.
struct LightCornerTexels {
    vec4 outline;    // xy centroid, z number of corners
    vec4 corners[4]; // xy one and zw the next
    // Triangulation of up to six triangles, for sampling the area: cumulative area fractions at the ends of the first
    // five triangles, then numbers that each hold the corner indices of two triangles, 3 bits per corner from the
    // lowest bit.
    vec4 shareEnds;
    vec4 lastEnd; // x fifth fraction, yzw corner indices
};

struct LightShadowTexels {
    vec4 shadow; // x radius in metres of the disk that represents the light in shadows (without a position: tangent of
                 // its angular radius); y index into Scene::lights; z first texel of its first face (shadow_maps.h), 0
                 // without one; w rounding error in metres of a surface's position relative to the faces
};

// The unit direction in which the light of a cone travels.
SHARED_FUNCTION vec3 coneTravel(LightShapeTexels shape) {
    return vec3(shape.axis) * (shape.axis.w > 0.0f ? 1.0f : -1.0f);
}

// Cosine of a cone's outer angle, to a few roundings.
SHARED_FUNCTION float coneCosOuter(int kind, LightShapeTexels shape) {
    float share = shape.attenuation.w / shape.axis.w;
    if ((kind & LIGHT_BROAD) != 0) return -share;
    return shape.axis.w > 0.0f ? 1.0f - 0.5f * share : 0.5f * share - 1.0f;
}

SHARED_END
