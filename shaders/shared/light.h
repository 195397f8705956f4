#pragma once
// A light as RGBA32F texels of two buffer textures. Buffer textures, because they are the fastest store
// measured on software rasterisers (2 to 3 times faster a light-pixel pair than a storage buffer) and have no 64 KiB
// limit.
#include "interop.h"

// Kinds, stored as plain numbers: small integers stored as float bits would be denormals, which hardware may flush.
#define LIGHT_POINT 0
#define LIGHT_DIRECTIONAL 1
#define LIGHT_SPOT 2
#define LIGHT_ATTENUATION 4 // added to point or spot: falloff by A + B d + C d^2

#define LIGHT_TEXELS 2
#define LIGHT_SHAPE_TEXELS 2

// Where a shader reads lights from (lib/light_store.glsl).
#define LIGHT_STORE_TEXEL 0 // what every pass of a frame uses
#define LIGHT_STORE_UNIFORM 1
#define LIGHT_STORE_STORAGE 2

// Lights of a uniform block, which stays below the 16 KiB that OpenGL 4.5 guarantees.
#define LIGHT_UNIFORM_LIGHTS 256

SHARED_BEGIN

// What every kind of light has. Kept apart from what few have, so that twice as many lights fit a cache.
struct LightTexels {
    vec4 position; // xyz position LS in metres (directional: unit direction to the light); w 1/range^2, 0 when infinite
    vec4 color;    // rgb colour x intensity; w kind
};

// What spot lights and the falloff by A B C need besides.
struct LightShapeTexels {
    vec4 axis;        // spot: xyz unit direction of travel LS, w cone scale 1/max(0.001, cos inner - cos outer)
    vec4 attenuation; // xyz A, B, C; w cone offset -cos outer x scale
};

SHARED_END
