// Cells of a tile, and the test which of them a light may touch; used by counting and by filling.
#pragma once
#include "lib/lists/list_lights.glsl"
#include "lib/lists/list_tiles.glsl"

layout(binding = TEXTURE_UNIT_LIGHT_REACH) uniform usamplerBuffer lightReachTexels;
layout(std430, binding = STORAGE_LIGHT_TILES) buffer LightTiles
{
    LightTile lightTiles[];
};
layout(std430, binding = STORAGE_TILE_DEPTHS) readonly buffer TileDepths
{
    vec2 tileDepths[]; // nearest, farthest, reverse-Z
};

// Distance range of each box of the tile, in metres ahead.
LIST_MEMORY vec2 boxRuns[LIGHT_TILE_SLICES];

struct ListedTile {
    uint column;
    uint row;
    vec4 rays;
    vec2 depths;   // nearest, farthest
    uint slicing;
    uvec2 slices;
    uint cells;    // 0: no surface in the tile
    uint boxes;    // entries of boxRuns: 0 if the box around the whole tile suffices
    CellBox whole;
};

// Occupied slices whose predecessor is empty.
uvec2 startsOf(uvec2 slices)
{
    return slices & ~uvec2(slices.x << 1, slices.y << 1 | slices.x >> 31);
}

bool hasBit(uvec2 bits, uint i)
{
    return ((i < 32u ? bits.x : bits.y) >> (i & 31u) & 1u) != 0u;
}

uint bitsBelow(uvec2 bits, uint i)
{
    uint low = i < 32u ? bits.x & ((1u << i) - 1u) : bits.x;
    uint high = i < 32u ? 0u : bits.y & ((1u << (i & 31u)) - 1u);
    return uint(bitCount(low) + bitCount(high));
}

uint bitsOf(uvec2 bits)
{
    return uint(bitCount(bits.x) + bitCount(bits.y));
}

vec2 runBetween(float nearest, float farthest)
{
    return vec2(aheadMetres(view.aheadFromDepth, nearest), aheadMetres(view.aheadFromDepth, farthest));
}

// Distance range of slices first..last of a tile, within that of its surfaces.
vec2 runOfSlices(ListedTile tile, uint first, uint last)
{
    vec2 depths = depthsOfSlices(tile.slicing, first, last, view.depthKey.x);
    return runBetween(min(tile.depths.x, depths.y), max(tile.depths.y, depths.x));
}

// Fills boxRuns: one entry per slice for clusters, else one per run of neighbouring slices.
void findBoxRuns(ListedTile tile)
{
#if LIST_METHOD == LIST_METHOD_SLICES
    uvec2 starts = startsOf(tile.slices);
#else
    uvec2 starts = tile.slices;
#endif
    for (uint slice = LIST_LANE; slice < LIGHT_TILE_SLICES; slice += uint(LIST_THREADS)) {
        if (!hasBit(starts, slice)) continue;
        uint last = slice;
#if LIST_METHOD == LIST_METHOD_SLICES
        while (last + 1u < LIGHT_TILE_SLICES && hasBit(tile.slices, last + 1u)) ++last;
#endif
        boxRuns[bitsBelow(starts, slice)] = runOfSlices(tile, slice, last);
    }
}

// Reads a tile and finds its boxes. All lanes of the item call it.
ListedTile listedTile(uvec2 item)
{
    uvec4 words = lightTiles[tileIndex(item)].words;
    ListedTile tile;
    tile.column = item.x;
    tile.row = tileRow(item);
    tile.rays = raysOfTile(tile.column, tile.row);
    tile.depths = tileDepths[tileIndex(item)];
    tile.slicing = words.y;
    tile.slices = words.zw;
    uint slices = bitsOf(tile.slices);
    tile.cells = min(slices, 1u);
    tile.boxes = 0u;
    vec2 run = runBetween(tile.depths.x, tile.depths.y);
    tile.whole = cellBox(tile.rays, run.x, run.y, raySpread());
#if LIST_METHOD == LIST_METHOD_CLUSTER
    tile.cells = slices;
    if (slices > 1u) tile.boxes = slices;
#elif LIST_METHOD == LIST_METHOD_SLICES
    if (slices > 1u) tile.boxes = bitsOf(startsOf(tile.slices));
#endif
    if (tile.boxes > 0u) findBoxRuns(tile);
    listSync();
    return tile;
}

bool touchesBox(ListedTile tile, CullLight cull, uint box)
{
    return lightTouchesBox(cull, cellBox(tile.rays, boxRuns[box].x, boxRuns[box].y, raySpread()));
}

// This lane's range of the round's lights.
uvec2 lightShare()
{
    return listRound.x + laneShare(listRound.y - listRound.x);
}

bool inReach(ListedTile tile, uint light)
{
    uvec2 reach = texelFetch(lightReachTexels, int(light)).xy;
    uint block = tile.column / CULL_BLOCK_COLUMNS * CULL_BLOCK_COLUMNS;
    return reaches(reach.x, block, min(block + CULL_BLOCK_COLUMNS, lighting.tileGrid.x) - 1u)
           && reaches(reach.y, tile.row, tile.row);
}

// The first light from `light` on whose rows and columns contain the tile, or `end`. A separate loop: rasterisers that
// mask lanes instead of branching can skip work only by loops, and the tiles of a block of columns agree on it.
uint nextInReach(ListedTile tile, uint light, uint end)
{
    while (light < end && !inReach(tile, light)) ++light;
    return light;
}

// Bit k: the light may touch the tile's cell k. Its rows and columns must contain the tile.
uvec2 touchedCells(ListedTile tile, uint light)
{
    CullLight cull = cullLight(light);
#if LIST_METHOD == LIST_METHOD_SLICES
    if (tile.boxes > 0u) {
        bool touched = false;
        for (uint box = 0u; box < tile.boxes && !touched; ++box) touched = touchesBox(tile, cull, box);
        return uvec2(touched ? 1u : 0u, 0u);
    }
#endif
    if (!lightTouchesBox(cull, tile.whole)) return uvec2(0u);
    if (tile.boxes == 0u) return uvec2(1u, 0u);
    uvec2 cells = uvec2(0u);
#if LIST_METHOD == LIST_METHOD_CLUSTER
    for (uint box = 0u; box < tile.boxes; ++box) {
        if (!touchesBox(tile, cull, box)) continue;
        if (box < 32u) cells.x |= 1u << box;
        else cells.y |= 1u << (box - 32u);
    }
#endif
    return cells;
}
