#pragma once
// Light lists: the lights that a pixel visits. Every culling method builds this structure, and the light cursor
// (lib/light/light_cursor.glsl) reads it. The image is divided into square tiles, tile (0, 0) at the top left, and a
// tile's depth range into at most 64 slices. Each slice that holds a surface has a cell, and a cell refers to a run of
// entries. With methods of one list per tile, the tile itself refers to the run.
//
//   tiles    a LightTile each: first all tiles for opaque surfaces, then all tiles for transparent ones; a storage
//            block, and in deferred lighting a buffer texture RG32UI, where a tile of one list takes one fetch
//   cells    storage block, uvec2 each: x index of the first entry, y number of entries
//            (zbin: x first word with a bit, y one past the last)
//   entries  buffer texture R32UI, light indices in ascending order; the unbounded lights come before all runs
//
// zbin stores bitmasks over the lights instead of runs: a tile refers to its mask among the entries; all tiles share
// the depth bins; cell b belongs to bin b, whose mask follows that of bin b - 1, from entry 0 on. A light is visited if
// both masks have its bit.
#include "interop.h"

#define LIGHT_LAYER_OPAQUE 0
#define LIGHT_LAYER_TRANSPARENT 1

// RG32UI texels per LightTile.
#define LIGHT_TILE_TEXELS 2

// Maximum depth slices per tile, whose bits fit a LightTile. Maximum depth bins per frame.
#define LIGHT_TILE_SLICES 64u
#define ZBIN_COUNT 256u

// Lights per loop iteration of a shader that builds masks (unrolled in lib/lists/list_masks.glsl).
#define MASK_LIGHTS_AN_ITERATION 8u

// The slicing of a tile with one cell: every depth lies in slice 0.
#define ONE_LIGHT_SLICE 31u

SHARED_BEGIN

// A surface's depth key, floatBitsToUint(bias + depth), grows towards the viewer. Its high bits slice depth
// logarithmically where bias + depth is proportional to 1/distance, and linearly where depth is (nearly) linear and the
// bias is 1. No logarithm is computed, so CPU and GPU agree on every bit.

// A tile's slices: slice 0 begins at `first`, a multiple of 2^shift, and a slice is 2^shift keys deep. Both fit one
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

// Depth range of slices first..last: x farthest, y nearest. `bias`: ViewConstants::depthKey.x.
SHARED_FUNCTION vec2 depthsOfSlices(uint slices, uint first, uint last, float bias) {
    uint shift = slices & 31u;
    uint begin = firstKeyOfSlices(slices) + (first << shift);
    uint beyond = firstKeyOfSlices(slices) + ((last + 1u) << shift);
    SHARED_PRECISE vec2 depths = vec2(uintBitsToFloat(begin) - bias, uintBitsToFloat(beyond) - bias);
    return depths;
}

// Slicing of keys low..high into at most `most` slices, none finer than 2^finestShift keys.
SHARED_FUNCTION uint slicingOf(uint low, uint high, uint finestShift, uint most) {
    uint shift = finestShift;
    while ((high >> shift) - (low >> shift) >= most) ++shift;
    return packSlices((low >> shift) << shift, shift);
}

struct LightTile {
    uvec4 words; // x first cell (zbin: first word of the mask); y packSlices(); z, w bits 0 to 31, 32 to 63: occupied
                 // slices, or with one list per tile the contents of its cell
};

SHARED_END
