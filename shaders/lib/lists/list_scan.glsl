// Fourth step, one item: prefix sums of the tiles' cells and entries, and their totals. Cell 0 is the empty cell, and
// the first entries are the unbounded lights. For zbin instead: the depth bins between the nearest and farthest surface
// of all tiles.
#pragma once
#include "lib/lists/list_tiles.glsl"

layout(std430, binding = STORAGE_LIST_TOTALS) writeonly buffer ListTotals
{
    uvec4 listTotals; // cells; entries, low and high word. zbin: slicing, number of bins
};

#if LIST_METHOD == LIST_METHOD_ZBIN

layout(std430, binding = STORAGE_TILE_DEPTHS) readonly buffer TileDepths
{
    vec2 tileDepths[]; // nearest, farthest, reverse-Z; 0: no surface in the tile
};

LIST_MEMORY vec2 laneDepths[LIST_THREADS];

void scanTiles(uvec2 item)
{
    if (item != uvec2(0u)) return;
    vec2 range = vec2(0.0, 2.0);
    for (uint tile = LIST_LANE; tile < listedTiles(); tile += uint(LIST_THREADS)) {
        vec2 depths = tileDepths[tile];
        if (depths.x > 0.0) range = vec2(max(range.x, depths.x), min(range.y, depths.y));
    }
    laneDepths[LIST_LANE] = range;
    listSync();
    if (LIST_LANE != 0u) return;
    for (uint lane = 1u; lane < uint(LIST_THREADS); ++lane)
        range = vec2(max(range.x, laneDepths[lane].x), min(range.y, laneDepths[lane].y));
    uvec2 bins = uvec2(ONE_LIGHT_SLICE, 1u);
    if (range.x > 0.0) {
        bins.x = slicingOf(depthKeyOf(range.y), depthKeyOf(range.x), lighting.slices.x, ZBIN_COUNT);
        bins.y = sliceOfKey(depthKeyOf(range.x), bins.x) + 1u;
    }
    listTotals = uvec4(bins, 0u, 0u);
}

#else

layout(std430, binding = STORAGE_TILE_COUNTS) buffer TileCounts
{
    uvec2 tileCounts[]; // cells, entries; then index of the first of each
};

LIST_MEMORY uvec3 laneSums[LIST_THREADS];

// Entries in two words: they may exceed 2^32 before it is detected that they do not fit.
uvec3 added(uvec3 sum, uvec3 more)
{
    uint carry;
    uint low = uaddCarry(sum.y, more.y, carry);
    return uvec3(sum.x + more.x, low, sum.z + more.z + carry);
}

void scanTiles(uvec2 item)
{
    if (item != uvec2(0u)) return;
    uvec2 share = laneShare(listedTiles());
    uvec3 sum = uvec3(0u);
    for (uint tile = share.x; tile < share.y; ++tile) sum = added(sum, uvec3(tileCounts[tile], 0u));
    laneSums[LIST_LANE] = sum;
    listSync();
    uvec3 first = uvec3(1u, lighting.lights.z, 0u);
    for (uint lane = 0u; lane < LIST_LANE; ++lane) first = added(first, laneSums[lane]);
    for (uint tile = share.x; tile < share.y; ++tile) {
        uvec3 counts = uvec3(tileCounts[tile], 0u);
        tileCounts[tile] = first.xy;
        first = added(first, counts);
    }
    if (LIST_LANE == uint(LIST_THREADS) - 1u) listTotals = uvec4(first, 0u);
}

#endif
