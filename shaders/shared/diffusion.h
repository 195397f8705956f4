#pragma once
// Light that spreads over a surface, in an atlas of its texture coordinates (renderer/frame/UvAtlas.h).
#include "interop.h"

// Units of the passes that spread light, which sample nothing else.
#define TEXTURE_UNIT_DIFFUSION_STEPS 0     // xy steps along u and v in metres, z shear, w chart, negative outside of it
#define TEXTURE_UNIT_DIFFUSION_CONTINUED 1 // xy where the surface goes on, in texels
#define TEXTURE_UNIT_DIFFUSION_LIGHT 2     // what is spread
#define TEXTURE_UNIT_DIFFUSION_LEAVING 3   // what leaves where it enters

// Taps lie this share of a Gaussian's standard deviation apart, so many to either side: its tails beyond 3.5 hold a
// thousandth. A step of irradiance, narrower Gaussians before it or none, takes every texel (docs/skin.md).
#define DIFFUSION_TAP_SHARE 0.7
#define DIFFUSION_TAPS 5
#define DIFFUSION_MOST_FINE_TAPS 64
// Where a Gaussian is narrower than this share of a texel's square, three taps have its variance.
#define DIFFUSION_NARROW 0.4

// Light is computed tile by tile of so many texels a side (renderer/frame/DiffusionTiles.h).
#define DIFFUSION_TILE_TEXELS 16

SHARED_BEGIN

struct DiffusionLightConstants {
    vec4 unspread;  // rgb the share of light that leaves where it enters
    vec4 unblurred; // rgb that which texels show as they are lit
};

struct DiffusionStoreConstants {
    uvec4 store; // xy corner of the cell, in texels
};

struct DiffusionBlurConstants {
    vec4 blur;   // x variance that is added, m^2 of the scene; y 0 along u, 1 along v; z 1 where every texel is a tap
    vec4 weight; // rgb of what is spread so far in the sum
};

SHARED_END
