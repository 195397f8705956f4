// Tiles as items: item (column, row); the rows of the transparent layer follow those of the opaque one.
#pragma once
#include "lib/surface/camera.glsl"
#include "lib/lists/list_items.glsl"
#include "shared/light_lists.h"

uint tilesALayer()
{
    return lighting.tileGrid.x * lighting.tileGrid.y;
}

uint listedTiles()
{
#if HAS_TRANSPARENT_LAYER
    return 2u * tilesALayer();
#else
    return tilesALayer();
#endif
}

bool isInGrid(uvec2 item)
{
    return item.x < lighting.tileGrid.x;
}

uint tileIndex(uvec2 item)
{
    return item.y * lighting.tileGrid.x + item.x;
}

uint tileRow(uvec2 item)
{
    return item.y < lighting.tileGrid.y ? item.y : item.y - lighting.tileGrid.y;
}

bool isTransparentTile(uvec2 item)
{
    return item.y >= lighting.tileGrid.y;
}

uint depthKeyOf(float depth)
{
    precise float sum = view.depthKey.x + depth;
    return floatBitsToUint(sum);
}
