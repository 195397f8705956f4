#pragma once
// Texture-space diffusion of light, in an atlas of an object's texture coordinates (renderer/frame/UvAtlas.h).
#include "interop.h"

// Texture units of the diffusion passes, which sample nothing else.
#define TEXTURE_UNIT_DIFFUSION_STEPS 0      // xy metres per texel along u and v, z shear, w chart, negative outside
#define TEXTURE_UNIT_DIFFUSION_CONTINUED 1  // xy where the surface continues, in texels
#define TEXTURE_UNIT_DIFFUSION_LIGHT 2      // light to diffuse
#define TEXTURE_UNIT_DIFFUSION_UNDIFFUSED 3 // undiffused light that leaves the texels

// Gaussians are truncated at this many standard deviations; the tails beyond hold a thousandth. Taps lie about
// DIFFUSION_TAP_SHARE standard deviations apart if the light is already diffused to at least 1 / DIFFUSION_WIDENING of
// the width; otherwise one texel apart, with at most DIFFUSION_MOST_FINE_TAPS to either side.
#define DIFFUSION_REACH 3.5
#define DIFFUSION_TAP_SHARE 0.7
#define DIFFUSION_WIDENING 2.0
#define DIFFUSION_MOST_FINE_TAPS 128
// If the variance is below this fraction of a squared texel, three taps reproduce it.
#define DIFFUSION_NARROW 0.4

// Position of texture coordinates in a UV atlas, in texels: 0.5 is the centre of the first. `side`: texels per side;
// `border`: texels around the area of the coordinates 0 to 1. A macro, since C++ computes it in double precision.
#define PLACE_IN_UV_ATLAS(texCoord, border, side) ((border) + (texCoord) * ((side)-2.0 * (border)))

// Texels per side of the tiles in which light is computed (renderer/frame/DiffusionTiles.h).
#define DIFFUSION_TILE_TEXELS 16

SHARED_BEGIN

struct DiffusionLightConstants {
    vec4 inPixels; // rgb fraction of light that is not diffused; pixels reflect it
    vec4 inTexels; // rgb fraction read from the texels as lit
};

struct DiffusionStoreConstants {
    uvec4 store; // xy corner of the cell, in texels
};

struct DiffusionBlurConstants {
    vec4 gaussian; // x target variance, m^2 of the scene; y 0 along u, 1 along v; z source variance; both are at least
                   // the variance of texel interpolation
    vec4 weight;   // rgb weight of the result in the sum; a variance of texel interpolation, in squared texels
};

SHARED_END
