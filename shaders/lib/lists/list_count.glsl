// Third step: counts the cells of each tile and their entries in total.
#pragma once
#include "lib/lists/list_cells.glsl"

layout(std430, binding = STORAGE_TILE_COUNTS) buffer TileCounts
{
    uvec2 tileCounts[]; // cells, entries
};

LIST_MEMORY uint laneEntries[LIST_THREADS];

void countTile(uvec2 item)
{
    if (!isInGrid(item)) return;
    ListedTile tile = listedTile(item);
    uint entries = 0u;
    if (tile.cells > 0u) {
        uvec2 share = lightShare();
        for (uint light = nextInReach(tile, share.x, share.y); light < share.y;
             light = nextInReach(tile, light + 1u, share.y))
            entries += bitsOf(touchedCells(tile, light));
    }
    laneEntries[LIST_LANE] = entries;
    listSync();
    if (LIST_LANE != 0u) return;
    for (uint lane = 1u; lane < uint(LIST_THREADS); ++lane) entries += laneEntries[lane];
    if (!isFirstRound()) entries += tileCounts[tileIndex(item)].y;
    tileCounts[tileIndex(item)] = uvec2(tile.cells, entries);
}
