// Last step of zbin: the bitmask of the lights that touch a bin of depth, and of those that touch a tile.
// Source: Drobot 2017, "Improved Culling for Tiled and Clustered Rendering"
#pragma once
#include "lib/list_lights.glsl"
#include "lib/list_tiles.glsl"

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

// Four lights an iteration: software rasterisers stop a shader after 65535 iterations of its loops.
#define LIGHTS_AN_ITERATION 4u

// Metres ahead between which a bin lies.
vec2 runOfBin(uint bin)
{
    vec2 depths = depthsOfSlices(listTotals.x, bin, bin, frame.depthKey.x);
    return vec2(aheadMetres(frame.aheadFromDepth, depths.y), aheadMetres(frame.aheadFromDepth, max(0.0, depths.x)));
}

uint fourBits(uvec4 bits)
{
    return bits.x | bits.y << 1 | bits.z << 2 | bits.w << 3;
}

// 1 where the light may touch the bin.
uint binBit(uint light, vec2 run)
{
    if (light >= lightCount()) return 0u;
    vec4 sphere = cullSphere(light);
    return sphere.w < 0.0 || sphereTouchesDepths(sphere, run.x, run.y) ? 1u : 0u;
}

// 1 where the light may touch the tile.
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
    if (bin >= listTotals.y || item.y > 0u) return;
    uint words = frame.lights.w;
    vec2 run = runOfBin(bin);
    uvec2 occupied = uvec2(words, 0u); // first word with a bit, one past the last
    for (uint word = LIST_LANE; word < words; word += uint(LIST_THREADS)) {
        uint bits = 0u;
        for (uint i = 0u; i < 32u; i += LIGHTS_AN_ITERATION)
            bits |= fourBits(uvec4(binBit(32u * word + i, run), binBit(32u * word + i + 1u, run),
                                   binBit(32u * word + i + 2u, run), binBit(32u * word + i + 3u, run)))
                    << i;
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
    if (item.x >= frame.tileGrid.x || item.y >= frame.tileGrid.y) return;
    uint words = frame.lights.w;
    uint first = (listTotals.y + tileIndex(item)) * words;
    for (uint word = LIST_LANE; word < words; word += uint(LIST_THREADS)) {
        uint bits = 0u;
        for (uint i = 0u; i < 32u; i += LIGHTS_AN_ITERATION)
            bits |= fourBits(uvec4(tileBit(32u * word + i, item), tileBit(32u * word + i + 1u, item),
                                   tileBit(32u * word + i + 2u, item), tileBit(32u * word + i + 3u, item)))
                    << i;
        lightEntries[first + word] = bits;
    }
    if (LIST_LANE != 0u) return;
    for (uint tile = tileIndex(item); tile < listedTiles(); tile += tilesALayer())
        lightTiles[tile].words = uvec4(first, listTotals.x, 1u, 0u);
}
