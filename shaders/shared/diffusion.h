#pragma once
// Light that spreads over a surface, in an atlas of its texture coordinates (renderer/frame/UvAtlas.h).
#include "interop.h"

// Units of the passes that spread light, which sample nothing else.
#define TEXTURE_UNIT_DIFFUSION_STEPS 0     // xy steps along u and v in metres, z shear, w chart, negative outside of it
#define TEXTURE_UNIT_DIFFUSION_CONTINUED 1 // xy where the surface goes on, in texels
#define TEXTURE_UNIT_DIFFUSION_LIGHT 2     // what is spread
#define TEXTURE_UNIT_DIFFUSION_UNSPREAD 3  // light that leaves the texels where it is lit

// Gaussians end at so many standard deviations: their tails beyond hold a thousandth. Taps lie about this share of one
// apart where light has spread before to at least 1 / DIFFUSION_WIDENING of the width, and a texel where it is not yet
// so smooth, so many to either side at most.
#define DIFFUSION_REACH 3.5
#define DIFFUSION_TAP_SHARE 0.7
#define DIFFUSION_WIDENING 2.0
#define DIFFUSION_MOST_FINE_TAPS 128
// Where a Gaussian is narrower than this share of a texel's square, three taps have its variance.
#define DIFFUSION_NARROW 0.4

// Where texture coordinates lie in a UV atlas of so many texels a side, of which so many lie around what the
// coordinates 0 to 1 cover; in texels: 0.5 is the middle of the first. A macro, since C++ computes it in double
// precision.
#define PLACE_IN_UV_ATLAS(texCoord, border, side) ((border) + (texCoord) * ((side)-2.0 * (border)))

// Light is computed tile by tile of so many texels a side (renderer/frame/DiffusionTiles.h).
#define DIFFUSION_TILE_TEXELS 16

SHARED_BEGIN

struct DiffusionLightConstants {
    vec4 inPixels; // rgb the share of light that does not spread: pixels reflect it
    vec4 inTexels; // rgb the share that texels show as they are lit
};

struct DiffusionStoreConstants {
    uvec4 store; // xy corner of the cell, in texels
};

struct DiffusionSpreadConstants {
    vec4 gaussian; // x variance to spread to, m^2 of the scene; y 0 along u, 1 along v; z variance to spread from, of
                   // both no less than what showing texels adds
    vec4 weight;   // rgb of what is spread so far in the sum; a variance that showing texels adds, squares of a texel
};

SHARED_END
