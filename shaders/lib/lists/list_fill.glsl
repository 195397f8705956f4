// Last step: every tile writes its cells and their entries, lights ascending, where the scan placed them. With several
// rounds, a separate step first counts each cell (sizeTile); then a cell's second word is its number of entries so far.
#pragma once
#include "lib/lists/list_cells.glsl"

layout(std430, binding = STORAGE_TILE_COUNTS) readonly buffer TileFirsts
{
    uvec2 tileFirsts[]; // index of the first cell and of the first entry
};
layout(std430, binding = STORAGE_LIGHT_CELLS) buffer LightCells
{
    uvec2 lightCells[];
};
layout(std430, binding = STORAGE_LIGHT_ENTRIES) writeonly buffer LightEntries
{
    uint lightEntries[];
};

#if LIST_METHOD == LIST_METHOD_CLUSTER
#define MOST_CELLS LIGHT_TILE_SLICES
#else
#define MOST_CELLS 1u
#endif

// By cell, then lane: the number of the lane's entries for the cell, then the place of its next one.
LIST_MEMORY uint laneEntries[MOST_CELLS * uint(LIST_THREADS)];
// Number of entries of each cell, then the index of its first one of this round.
LIST_MEMORY uint cellEntries[MOST_CELLS];

uint lowestBit(uvec2 bits)
{
    return bits.x != 0u ? uint(findLSB(bits.x)) : 32u + uint(findLSB(bits.y));
}

uvec2 withoutLowestBit(uvec2 bits)
{
    return bits.x != 0u ? uvec2(bits.x & (bits.x - 1u), bits.y) : uvec2(0u, bits.y & (bits.y - 1u));
}

uint placeOf(uint cell, uint lane)
{
    return cell * uint(LIST_THREADS) + lane;
}

void clearLane(ListedTile tile)
{
    for (uint cell = 0u; cell < tile.cells; ++cell) laneEntries[placeOf(cell, LIST_LANE)] = 0u;
}

void countLane(ListedTile tile, uvec2 share)
{
    for (uint light = nextInReach(tile, share.x, share.y); light < share.y;
         light = nextInReach(tile, light + 1u, share.y)) {
        for (uvec2 cells = touchedCells(tile, light); cells != uvec2(0u); cells = withoutLowestBit(cells))
            laneEntries[placeOf(lowestBit(cells), LIST_LANE)] += 1u;
    }
}

// Turns the counts of a cell's lanes into consecutive places, by prefix sums.
void placeLanes(ListedTile tile)
{
    listSync();
    for (uint cell = LIST_LANE; cell < tile.cells; cell += uint(LIST_THREADS)) {
        uint sum = 0u;
        for (uint lane = 0u; lane < uint(LIST_THREADS); ++lane) {
            uint entries = laneEntries[placeOf(cell, lane)];
            laneEntries[placeOf(cell, lane)] = sum;
            sum += entries;
        }
        cellEntries[cell] = sum;
    }
    listSync();
}

// Assigns consecutive runs of entries to the cells; `sized`: the entries are yet to be written.
void placeCells(ListedTile tile, uvec2 firsts, bool sized)
{
    if (LIST_LANE == 0u) {
        uint first = firsts.y;
        for (uint cell = 0u; cell < tile.cells; ++cell) {
            uint entries = cellEntries[cell];
            lightCells[firsts.x + cell] = uvec2(first, sized ? 0u : entries);
            cellEntries[cell] = first;
            first += entries;
        }
    }
    listSync();
}

void writeLane(ListedTile tile, uvec2 share)
{
    for (uint light = nextInReach(tile, share.x, share.y); light < share.y;
         light = nextInReach(tile, light + 1u, share.y)) {
        for (uvec2 cells = touchedCells(tile, light); cells != uvec2(0u); cells = withoutLowestBit(cells)) {
            uint cell = lowestBit(cells);
            uint place = placeOf(cell, LIST_LANE);
            lightEntries[cellEntries[cell] + laneEntries[place]] = light;
            laneEntries[place] += 1u;
        }
    }
}

// Adds the round's lights to the sizes of the tile's cells; after the last round assigns the cells' runs of entries.
void sizeTile(uvec2 item)
{
    if (!isInGrid(item)) return;
    ListedTile tile = listedTile(item);
    if (tile.cells == 0u) return;
    uvec2 firsts = tileFirsts[tileIndex(item)];
    clearLane(tile);
    countLane(tile, lightShare());
    placeLanes(tile);
    for (uint cell = LIST_LANE; cell < tile.cells; cell += uint(LIST_THREADS)) {
        if (!isFirstRound()) cellEntries[cell] += lightCells[firsts.x + cell].y;
        lightCells[firsts.x + cell] = uvec2(0u, cellEntries[cell]);
    }
    listSync();
    if (isLastRound()) placeCells(tile, firsts, true);
}

void fillTile(uvec2 item)
{
    if (!isInGrid(item)) return;
    ListedTile tile = listedTile(item);
    if (tile.cells == 0u) return;
    uvec2 firsts = tileFirsts[tileIndex(item)];
    clearLane(tile);
#if LIST_IN_ROUNDS
#if LIST_THREADS > 1
    countLane(tile, lightShare());
    placeLanes(tile);
#endif
    for (uint cell = LIST_LANE; cell < tile.cells; cell += uint(LIST_THREADS)) {
        uvec2 written = lightCells[firsts.x + cell];
        cellEntries[cell] = written.x + written.y;
    }
    listSync();
#else
    countLane(tile, lightShare());
    placeLanes(tile);
    placeCells(tile, firsts, false);
#endif
    writeLane(tile, lightShare());
#if LIST_IN_ROUNDS
    // The last place of the last lane is the number of the round's entries.
    listSync();
    for (uint cell = LIST_LANE; cell < tile.cells; cell += uint(LIST_THREADS))
        lightCells[firsts.x + cell].y += laneEntries[placeOf(cell, uint(LIST_THREADS) - 1u)];
#endif
    if (LIST_LANE != 0u || !isLastRound()) return;
#if LIST_METHOD == LIST_METHOD_CLUSTER
    bool oneCell = tile.cells == 1u;
    lightTiles[tileIndex(item)].words =
        uvec4(firsts.x, oneCell ? ONE_LIGHT_SLICE : tile.slicing, oneCell ? uvec2(1u, 0u) : tile.slices);
#else
    lightTiles[tileIndex(item)].words = uvec4(firsts.x, ONE_LIGHT_SLICE, lightCells[firsts.x]);
#endif
}
