#pragma once
// Light lists: which lights a pixel visits. Every culling method builds this one structure, and the light cursor
// (lib/light/light_cursor.glsl) reads it. The picture is divided into square tiles, tile (0, 0) at its top left; a
// tile's depth range into at most 64 slices, of which those that hold a surface have a cell each; a cell names a run of
// entries. A tile of a method with one list a tile names it itself.
//
//   tiles    a LightTile each: first all tiles for opaque surfaces, then all tiles for transparent ones; a storage
//            block, and in deferred lighting a buffer texture RG32UI, where a tile of one list takes one fetch
//   cells    storage block, uvec2 each: x index of the first entry, y number of entries
//            (zbin: x first word with a bit, y one past the last)
//   entries  buffer texture R32UI, indices of lights in ascending order; before all runs those of the lights that reach
//            everywhere
//
// zbin keeps bitmasks over the lights instead of runs: a tile names its own mask among the entries, all tiles share one
// division of depth into bins, cell b is bin b's, whose mask follows the one before it from entry 0 on, and a light is
// visited where both masks have its bit.
#include "interop.h"

#define LIGHT_LAYER_OPAQUE 0
#define LIGHT_LAYER_TRANSPARENT 1

// Texels of RG32UI that a LightTile is.
#define LIGHT_TILE_TEXELS 2

// Most depth slices of a tile: its bits fit a LightTile. Most depth bins of a frame.
#define LIGHT_TILE_SLICES 64u
#define ZBIN_COUNT 256u

// Lights per loop iteration of a shader that builds masks (lib/lists/list_masks.glsl spells out as many).
#define MASK_LIGHTS_AN_ITERATION 8u

// The slicing of a tile with one cell: every depth lies in slice 0.
#define ONE_LIGHT_SLICE 31u

SHARED_BEGIN

// A surface's depth key, floatBitsToUint(bias + depth), grows towards the viewer. Its high bits slice depth evenly in
// the logarithm of the distance where bias + depth is proportional to 1/distance, and evenly in the distance where
// depth is even, or nearly so, and the bias 1. No logarithm is taken, so CPU and GPU agree on every bit.

// A tile's slices: slice 0 begins at `first`, a multiple of 2^shift, and a slice is 2^shift keys deep. Packed in one
// word, since shift needs 5 bits and is at least 5.
SHARED_FUNCTION uint packSlices(uint first, uint shift) {
    return first | shift;
}
SHARED_FUNCTION uint firstKeyOfSlices(uint slices) {
    return slices & ~31u;
}
SHARED_FUNCTION uint sliceOfKey(uint key, uint slices) {
    return (key - firstKeyOfSlices(slices)) >> (slices & 31u);
}

// The depths that slices first..last lie between: x the farthest, y the nearest. `bias` is ViewConstants::depthKey's.
SHARED_FUNCTION vec2 depthsOfSlices(uint slices, uint first, uint last, float bias) {
    uint shift = slices & 31u;
    uint begin = firstKeyOfSlices(slices) + (first << shift);
    uint beyond = firstKeyOfSlices(slices) + ((last + 1u) << shift);
    SHARED_PRECISE vec2 depths = vec2(uintBitsToFloat(begin) - bias, uintBitsToFloat(beyond) - bias);
    return depths;
}

// The slicing of keys low..high into fewer than `most` + 1 slices, none finer than 2^finestShift keys.
SHARED_FUNCTION uint slicingOf(uint low, uint high, uint finestShift, uint most) {
    uint shift = finestShift;
    while ((high >> shift) - (low >> shift) >= most) ++shift;
    return packSlices((low >> shift) << shift, shift);
}

struct LightTile {
    uvec4 words; // x first cell (zbin: first word of the mask); y packSlices(); z, w bits 0 to 31, 32 to 63: occupied
                 // slices, or where every tile has one list what its cell says
};

SHARED_END
