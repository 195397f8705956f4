// Last step of zbin: bitmasks of the lights that touch each depth bin, and of those that touch each tile. Source:
// Drobot 2017, "Improved Culling for Tiled and Clustered Rendering"
#pragma once
#include "lib/lists/list_lights.glsl"
#include "lib/lists/list_tiles.glsl"

layout(binding = TEXTURE_UNIT_LIGHT_REACH) uniform usamplerBuffer lightReachTexels;
layout(std430, binding = STORAGE_LIST_TOTALS) readonly buffer ListTotals
{
    uvec4 listTotals; // slicing, number of bins
};
layout(std430, binding = STORAGE_LIGHT_TILES) writeonly buffer LightTiles
{
    LightTile lightTiles[];
};
layout(std430, binding = STORAGE_LIGHT_CELLS) writeonly buffer LightCells
{
    uvec2 lightCells[];
};
layout(std430, binding = STORAGE_LIGHT_ENTRIES) writeonly buffer LightEntries
{
    uint lightEntries[];
};

LIST_MEMORY uvec2 laneWords[LIST_THREADS];

// Bits of the eight lights from `first` on: 1 if test(light, at).
#define FOUR_BITS(test, first, at) \
    (test(first, at) | test(first + 1u, at) << 1 | test(first + 2u, at) << 2 | test(first + 3u, at) << 3)
#define EIGHT_BITS(test, first, at) (FOUR_BITS(test, first, at) | FOUR_BITS(test, first + 4u, at) << 4)

// Distance range of a bin, in metres ahead.
vec2 runOfBin(uint bin)
{
    vec2 depths = depthsOfSlices(listTotals.x, bin, bin, view.depthKey.x);
    return vec2(aheadMetres(view.aheadFromDepth, depths.y), aheadMetres(view.aheadFromDepth, max(0.0, depths.x)));
}

// 1 if the light may touch the bin.
uint binBit(uint light, vec2 run)
{
    if (light >= lightCount()) return 0u;
    vec4 sphere = cullSphere(light);
    return sphere.w < 0.0 || sphereTouchesDepths(sphere, run.x, run.y) ? 1u : 0u;
}

// 1 if the light may touch the tile.
uint tileBit(uint light, uvec2 item)
{
    if (light >= lightCount()) return 0u;
    uvec2 reach = texelFetch(lightReachTexels, int(light)).xy;
    bool touches = reaches(reach.x, item.x, item.x) && reaches(reach.y, item.y, item.y);
    return touches || cullSphere(light).w < 0.0 ? 1u : 0u;
}

void maskBin(uvec2 item)
{
    uint bin = item.x;
    if (bin >= listTotals.y) return;
    uint words = lighting.lights.w;
    vec2 run = runOfBin(bin);
    uvec2 occupied = uvec2(words, 0u); // first word with a bit, one past the last
    for (uint word = LIST_LANE; word < words; word += uint(LIST_THREADS)) {
        uint bits = 0u;
        for (uint i = 0u; i < 32u; i += MASK_LIGHTS_AN_ITERATION)
            bits |= EIGHT_BITS(binBit, 32u * word + i, run) << i;
        lightEntries[bin * words + word] = bits;
        if (bits != 0u) occupied = uvec2(min(occupied.x, word), max(occupied.y, word + 1u));
    }
    laneWords[LIST_LANE] = occupied;
    listSync();
    if (LIST_LANE != 0u) return;
    for (uint lane = 1u; lane < uint(LIST_THREADS); ++lane)
        occupied = uvec2(min(occupied.x, laneWords[lane].x), max(occupied.y, laneWords[lane].y));
    lightCells[bin] = uvec2(occupied.x, max(occupied.x, occupied.y));
}

// The masks of tiles do not depend on depth, so both layers share them.
void maskTile(uvec2 item)
{
    if (item.x >= lighting.tileGrid.x) return;
    uint words = lighting.lights.w;
    uint first = (listTotals.y + tileIndex(item)) * words;
    for (uint word = LIST_LANE; word < words; word += uint(LIST_THREADS)) {
        uint bits = 0u;
        for (uint i = 0u; i < 32u; i += MASK_LIGHTS_AN_ITERATION)
            bits |= EIGHT_BITS(tileBit, 32u * word + i, item) << i;
        lightEntries[first + word] = bits;
    }
    if (LIST_LANE != 0u) return;
    for (uint tile = tileIndex(item); tile < listedTiles(); tile += tilesALayer())
        lightTiles[tile].words = uvec4(first, listTotals.x, 1u, 0u);
}
