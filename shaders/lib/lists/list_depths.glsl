// Second step: finds the nearest and farthest depth of the surfaces in each tile, and the slices of that range that
// hold a surface.
#pragma once
#include "lib/lists/list_tiles.glsl"

layout(binding = TEXTURE_UNIT_DEPTH) uniform sampler2D opaqueDepth; // a range with several samples per pixel, as below
#if HAS_TRANSPARENT_LAYER
layout(binding = TEXTURE_UNIT_TRANSPARENT_DEPTH) uniform sampler2D transparentDepth; // x nearest, y farthest negated
#endif
layout(std430, binding = STORAGE_LIGHT_TILES) writeonly buffer LightTiles
{
    LightTile lightTiles[];
};
layout(std430, binding = STORAGE_TILE_DEPTHS) writeonly buffer TileDepths
{
    vec2 tileDepths[]; // nearest, farthest, reverse-Z; 0: no surface in the tile
};

LIST_MEMORY vec2 laneDepths[LIST_THREADS];
LIST_MEMORY uvec2 laneSlices[LIST_THREADS];

vec2 depthsOfRange(vec2 range)
{
    return vec2(range.x, -range.y);
}

// Nearest and farthest depth of a pixel's surfaces; nearest 0: it has none.
vec2 pixelDepths(ivec2 pixel, bool transparent)
{
#if HAS_TRANSPARENT_LAYER
    if (transparent) return depthsOfRange(texelFetch(transparentDepth, pixel, 0).xy);
#endif
#if SAMPLES > 1
    return depthsOfRange(texelFetch(opaqueDepth, pixel, 0).xy);
#else
    return texelFetch(opaqueDepth, pixel, 0).rr;
#endif
}

struct TilePixels {
    uvec2 low;
    uvec2 size;
};

TilePixels pixelsOfTile(uint column, uint row)
{
    // Tiles count from the top, pixels from the bottom.
    uint side = 1u << lighting.tileGrid.w;
    uvec2 size = view.sizePixels.xy;
    uint bottom = size.y - min((row + 1u) * side, size.y);
    TilePixels pixels;
    pixels.low = uvec2(column * side, bottom);
    pixels.size = uvec2(min((column + 1u) * side, size.x), size.y - row * side) - pixels.low;
    return pixels;
}

ivec2 pixelOf(TilePixels pixels, uint i)
{
    uint y = i / pixels.size.x;
    return ivec2(pixels.low + uvec2(i - y * pixels.size.x, y));
}

vec2 nearestAndFarthest(TilePixels pixels, bool transparent)
{
    vec2 found = vec2(0.0, 2.0);
    for (uint i = LIST_LANE; i < pixels.size.x * pixels.size.y; i += uint(LIST_THREADS)) {
        vec2 depths = pixelDepths(pixelOf(pixels, i), transparent);
        found.x = max(found.x, depths.x);
        if (depths.x > 0.0) found.y = min(found.y, depths.y);
    }
    laneDepths[LIST_LANE] = found;
    listSync();
    for (uint lane = 0u; lane < uint(LIST_THREADS); ++lane)
        found = vec2(max(found.x, laneDepths[lane].x), min(found.y, laneDepths[lane].y));
    return found;
}

uvec2 bitsFromTo(uint first, uint last)
{
    uvec2 upToLast = last < 32u ? uvec2(0xffffffffu >> (31u - last), 0u) : uvec2(0xffffffffu, 0xffffffffu >> (63u - last));
    uvec2 belowFirst = first < 32u ? uvec2((1u << first) - 1u, 0u) : uvec2(0xffffffffu, (1u << (first - 32u)) - 1u);
    return upToLast & ~belowFirst;
}

uvec2 occupiedSlices(TilePixels pixels, bool transparent, uint slicing)
{
    uvec2 slices = uvec2(0u);
    for (uint i = LIST_LANE; i < pixels.size.x * pixels.size.y; i += uint(LIST_THREADS)) {
        vec2 depths = pixelDepths(pixelOf(pixels, i), transparent);
        if (!(depths.x > 0.0)) continue;
        slices |= bitsFromTo(sliceOfKey(depthKeyOf(depths.y), slicing), sliceOfKey(depthKeyOf(depths.x), slicing));
    }
    laneSlices[LIST_LANE] = slices;
    listSync();
    for (uint lane = 0u; lane < uint(LIST_THREADS); ++lane) slices |= laneSlices[lane];
    return slices;
}

void findDepths(uvec2 item)
{
    if (!isInGrid(item)) return;
    bool transparent = isTransparentTile(item);
    TilePixels pixels = pixelsOfTile(item.x, tileRow(item));
    vec2 depths = nearestAndFarthest(pixels, transparent);
    uint slicing = ONE_LIGHT_SLICE;
    uvec2 slices = uvec2(0u);
    if (depths.x > 0.0) {
        uint high = depthKeyOf(depths.x);
        slices = uvec2(1u, 0u);
#if LIST_METHOD == LIST_METHOD_SLICES || LIST_METHOD == LIST_METHOD_CLUSTER
        slicing = slicingOf(depthKeyOf(depths.y), high, lighting.slices.x, LIGHT_TILE_SLICES);
        if (sliceOfKey(high, slicing) != 0u) slices = occupiedSlices(pixels, transparent, slicing);
#endif
    } else {
        depths = vec2(0.0);
    }
    if (LIST_LANE != 0u) return;
    tileDepths[tileIndex(item)] = depths;
    lightTiles[tileIndex(item)].words = uvec4(0u, slicing, slices);
}
