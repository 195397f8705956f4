// Last step: every tile writes its cells and their entries, lights ascending, where the scan has left it room.
#pragma once
#include "lib/list_cells.glsl"

layout(std430, binding = STORAGE_TILE_COUNTS) readonly buffer TileFirsts
{
    uvec2 tileFirsts[]; // index of the first cell and of the first entry
};
layout(std430, binding = STORAGE_LIGHT_CELLS) writeonly buffer LightCells
{
    uvec2 lightCells[];
};
layout(std430, binding = STORAGE_LIGHT_ENTRIES) writeonly buffer LightEntries
{
    uint lightEntries[];
};

#if LIST_METHOD == LIST_METHOD_CLUSTER
#define ONE_CELL_A_TILE 0
#define MOST_CELLS LIGHT_TILE_SLICES
#else
#define ONE_CELL_A_TILE 1
#define MOST_CELLS 1u
#endif

// By cell, then lane: how many entries a lane has for the cell, then where its next one goes.
LIST_MEMORY uint laneEntries[MOST_CELLS * uint(LIST_THREADS)];
// Entries of each cell, then the index of its first.
LIST_MEMORY uint cellEntries[MOST_CELLS];

uint lowestBit(uvec2 bits)
{
    return bits.x != 0u ? uint(findLSB(bits.x)) : 32u + uint(findLSB(bits.y));
}

uvec2 withoutLowestBit(uvec2 bits)
{
    return bits.x != 0u ? uvec2(bits.x & (bits.x - 1u), bits.y) : uvec2(0u, bits.y & (bits.y - 1u));
}

void countCells(ListedTile tile, uvec2 share)
{
    for (uint cell = 0u; cell < tile.cells; ++cell) laneEntries[cell * uint(LIST_THREADS) + LIST_LANE] = 0u;
    for (uint light = nextInReach(tile, share.x, share.y); light < share.y;
         light = nextInReach(tile, light + 1u, share.y)) {
        for (uvec2 cells = touchedCells(tile, light); cells != uvec2(0u); cells = withoutLowestBit(cells))
            laneEntries[lowestBit(cells) * uint(LIST_THREADS) + LIST_LANE] += 1u;
    }
    listSync();
}

// Turns counts into places: of a cell's lanes behind one another, and of the cells behind one another.
void placeCells(ListedTile tile, uvec2 firsts)
{
    for (uint cell = LIST_LANE; cell < tile.cells; cell += uint(LIST_THREADS)) {
        uint sum = 0u;
        for (uint lane = 0u; lane < uint(LIST_THREADS); ++lane) {
            uint entries = laneEntries[cell * uint(LIST_THREADS) + lane];
            laneEntries[cell * uint(LIST_THREADS) + lane] = sum;
            sum += entries;
        }
        cellEntries[cell] = sum;
    }
    listSync();
    if (LIST_LANE == 0u) {
        uint first = firsts.y;
        for (uint cell = 0u; cell < tile.cells; ++cell) {
            uint entries = cellEntries[cell];
            lightCells[firsts.x + cell] = uvec2(first, entries);
            cellEntries[cell] = first;
            first += entries;
        }
    }
    listSync();
}

void writeEntries(ListedTile tile, uvec2 share)
{
    for (uint light = nextInReach(tile, share.x, share.y); light < share.y;
         light = nextInReach(tile, light + 1u, share.y)) {
        for (uvec2 cells = touchedCells(tile, light); cells != uvec2(0u); cells = withoutLowestBit(cells)) {
            uint cell = lowestBit(cells);
            uint lane = cell * uint(LIST_THREADS) + LIST_LANE;
            lightEntries[cellEntries[cell] + laneEntries[lane]] = light;
            laneEntries[lane] += 1u;
        }
    }
}

void fillTile(uvec2 item)
{
    if (!isTile(item)) return;
    ListedTile tile = listedTile(item);
    if (tile.cells == 0u) return;
    uvec2 firsts = tileFirsts[tileIndex(item)];
    uvec2 share = laneShare(lightCount());
#if ONE_CELL_A_TILE && LIST_THREADS == 1
    // A lane alone with one cell need not count before it writes.
    laneEntries[0] = 0u;
    cellEntries[0] = firsts.y;
    writeEntries(tile, share);
    lightCells[firsts.x] = uvec2(firsts.y, laneEntries[0]);
#else
    countCells(tile, share);
    placeCells(tile, firsts);
    writeEntries(tile, share);
#endif
    if (LIST_LANE != 0u) return;
    bool oneCell = tile.cells == 1u;
    lightTiles[tileIndex(item)].words =
        uvec4(firsts.x, oneCell ? ONE_LIGHT_SLICE : tile.slicing, oneCell ? uvec2(1u, 0u) : tile.slices);
}
