#pragma once
// A light as RGBA32F texels of a buffer texture: its LightTexels and behind them, where any light has a shape, its
// LightShapeTexels, behind those, where any is a polygon, its LightCornerTexels, and where shadows are soft or in maps,
// its LightShadowTexels. Behind all lights lie the faces of shadow maps (shadow_maps.h). A buffer texture, because it
// is the fastest store measured on software rasterisers (2 to 3 times faster per pair of light and pixel than a storage
// buffer) and has no 64 KiB limit.
#include "interop.h"

// Kinds, stored as plain numbers: small integers stored as float bits would be denormals, which hardware may flush. The
// type is that of scenes::LightType, in shaders LIGHT_<NAME> (scenes/Light.h).
#define LIGHT_TYPE_MASK 15
#define LIGHT_ATTENUATION 16 // added where there is a position: falloff by A + B d + C d^2
#define LIGHT_BROAD 32       // added to a cone: the outer angle is between 60 and 120 degrees
#define LIGHT_SHADOWED 64    // added where casters hide it
#define LIGHT_SIX_FACES 128  // added where its shadow map has a face for each direction of the axes

#define LIGHT_TEXELS 2
#define LIGHT_SHAPE_TEXELS 2
#define LIGHT_CORNER_TEXELS 7
#define LIGHT_SHADOW_TEXELS 1

// Round outlines are drawn with straight edges of the same area, whose vertices lie at most so many times as far out
// (lib/light/area_outline.glsl).
#define AREA_OUTLINE_REACH 1.015f

SHARED_BEGIN

// The data of every kind of light.
struct LightTexels {
    vec4 position; // xyz position LS in metres (types without one: unit direction to the light); w 1/range^2, 0 when
                   // infinite
    vec4 color;    // rgb colour x intensity; w kind
};

// What types with a shape (LightTypeInfo::hasShape) and the falloff by A B C need besides: the direction in which the
// light travels and two parameters, or a cone. With l the unit direction to the light, a cone is
//   clamp(offset - weight |l + axis|^2, 0, 1), or clamp(offset - weight l.axis, 0, 1) where the kind has LIGHT_BROAD.
// Both are (cos angle - cos outer) x scale, scale = 1/max(0.001, cos inner - cos outer): with a the unit direction in
// which the light travels, |l + a|^2 / 2 = 1 - cos angle. Cosines of small angles share their leading digits; this
// difference keeps its own.
// Of an area light (LightTypeInfo::isArea) position is its middle, color its radiance. A rectangle and a disk reach
// from the middle by axis.xyz and attenuation.xyz, at right angles, whose cross product points where they shine;
// attenuation.w says from which sides they shine, and their picture (light_pictures.h). A polygon has its plane so too,
// whose vectors are both as long as its farthest corner is away, and in axis.w its area in parts of their product. A
// sphere has its radius in axis.w; a tube reaches from the middle by axis.xyz and its opposite, and has its radius in
// axis.w.
struct LightShapeTexels {
    vec4 axis;        // xyz a LS, w first parameter; cone: -a where cos outer <= -0.5, w weight: scale/2, -scale/2,
                      // broad: scale
    vec4 attenuation; // xyz A, B, C; w second parameter; cone: offset: (1 - cos outer) x scale, -(1 + cos outer) x
                      // scale, broad: -cos outer x scale
};

// The outline of a polygon, in parts of axis.xyz and attenuation.xyz; corners run counterclockwise, from the first to
// the second.
struct LightCornerTexels {
    vec4 outline;    // xy the middle of its area, z how many corners
    vec4 corners[4]; // xy one and zw the next
    // Up to six triangles that cover it once, for places all over it: the shares of its area with which the first five
    // end, then the numbers of two triangles' corners each, of which each takes 3 bits, from the lowest.
    vec4 shareEnds;
    vec4 lastEnd; // x the fifth, yzw the numbers
};

struct LightShadowTexels {
    vec4 shadow; // x radius in metres of the disk that stands for it in shadows; of a light without a position the
                 // tangent of its angular radius; y index into Scene::lights; z the texel where its first face
                 // (shadow_maps.h) begins, 0 without one; w metres by which rounding may move a surface against its
                 // faces
};

// The unit direction in which the light of a cone travels.
SHARED_FUNCTION vec3 coneTravel(LightShapeTexels shape) {
    return vec3(shape.axis) * (shape.axis.w > 0.0f ? 1.0f : -1.0f);
}

// The cosine of a cone's outer angle, to some roundings of one.
SHARED_FUNCTION float coneCosOuter(int kind, LightShapeTexels shape) {
    float share = shape.attenuation.w / shape.axis.w;
    if ((kind & LIGHT_BROAD) != 0) return -share;
    return shape.axis.w > 0.0f ? 1.0f - 0.5f * share : 0.5f * share - 1.0f;
}

SHARED_END
