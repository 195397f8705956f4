// Iterates over the lights of a pixel in ascending index order, so that every technique adds the same terms in the same
// order. LIGHT_CURSOR: ALL lights of the frame; the LIST of the pixel's cell, merged with the unbounded lights; the
// BITS that the masks of the pixel's tile and depth bin have in common (shared/light_lists.h); or NONE, if other passes
// add the lights.
#pragma once
#include "lib/surface/camera.glsl"
#include "shared/light_lists.h"

#define LIGHT_CURSOR_ALL 0
#define LIGHT_CURSOR_LIST 1
#define LIGHT_CURSOR_BITS 2
#define LIGHT_CURSOR_NONE 3
#ifndef LIGHT_CURSOR
#define LIGHT_CURSOR LIGHT_CURSOR_ALL
#endif

#if LIGHT_CURSOR == LIGHT_CURSOR_LIST || LIGHT_CURSOR == LIGHT_CURSOR_BITS
#ifdef LIGHT_TILES_IN_TEXELS
// Mesa's software rasteriser reads storage blocks lane by lane.
layout(binding = TEXTURE_UNIT_LIGHT_TILES) uniform usamplerBuffer lightTileTexels;
#else
layout(std430, binding = STORAGE_LIGHT_TILES) readonly buffer LightTiles
{
    LightTile lightTiles[];
};
#endif
layout(std430, binding = STORAGE_LIGHT_CELLS) readonly buffer LightCells
{
    uvec2 lightCells[];
};
layout(binding = TEXTURE_UNIT_LIGHT_ENTRIES) uniform usamplerBuffer lightEntries;

// A helper invocation may lie outside the image or in an unoccupied depth slice, where there is no list.
#define WHERE_LISTED(index) (IS_HELPER ? 0u : (index))

uint lightTileIndex(vec2 pixel)
{
    uvec2 tile = uvec2(uint(pixel.x), lighting.tileGrid.z - 1u - uint(pixel.y)) >> lighting.tileGrid.w;
    uint index = tile.y * lighting.tileGrid.x + tile.x;
#if LIGHT_LAYER == LIGHT_LAYER_TRANSPARENT
    index += lighting.tileGrid.x * lighting.tileGrid.y;
#endif
    return WHERE_LISTED(index);
}

// Run of entries of the pixel's tile, with one list per tile.
uvec2 runOfTile(vec2 pixel)
{
    uint index = lightTileIndex(pixel);
#ifdef LIGHT_TILES_IN_TEXELS
    return texelFetch(lightTileTexels, int(index) * LIGHT_TILE_TEXELS + 1).xy;
#else
    return lightTiles[index].words.zw;
#endif
}

uvec4 lightTile(vec2 pixel)
{
    uint index = lightTileIndex(pixel);
#ifdef LIGHT_TILES_IN_TEXELS
    int texel = int(index) * LIGHT_TILE_TEXELS;
    return uvec4(texelFetch(lightTileTexels, texel).xy, texelFetch(lightTileTexels, texel + 1).xy);
#else
    return lightTiles[index].words;
#endif
}

uint depthSlice(float depth, uint slices)
{
    precise float sum = view.depthKey.x + depth;
    return sliceOfKey(floatBitsToUint(sum), slices);
}
#endif

#if LIGHT_CURSOR == LIGHT_CURSOR_ALL || LIGHT_CURSOR == LIGHT_CURSOR_NONE

struct LightCursor {
    int next;
    int end;
};

LightCursor lightCursor(vec2 pixel, float depth)
{
#if LIGHT_CURSOR == LIGHT_CURSOR_NONE
    return LightCursor(0, 0);
#else
    return LightCursor(0, int(lighting.lights.x));
#endif
}

bool nextLight(inout LightCursor cursor, out int light)
{
    light = cursor.next;
    cursor.next += 1;
    return light < cursor.end;
}

bool nextBatch(inout LightCursor cursor, out int light)
{
    light = 0;
    return false;
}

#elif LIGHT_CURSOR == LIGHT_CURSOR_LIST

// Run of entries of the pixel's cell.
uvec2 lightRun(vec2 pixel, float depth)
{
#if ONE_LIST_A_TILE
    return runOfTile(pixel);
#else
    uvec4 tile = lightTile(pixel);
    uint slice = depthSlice(depth, tile.y);
    // A tile has cells for its occupied slices only, so a slice's rank among them is the index of its cell.
    uint below = slice < 32u ? tile.z & ((1u << slice) - 1u) : tile.z;
    uint belowHigh = slice < 32u ? 0u : tile.w & ((1u << (slice & 31u)) - 1u);
    return lightCells[WHERE_LISTED(tile.x + uint(bitCount(below) + bitCount(belowHigh)))];
#endif
}

#if HAS_LIGHTS_EVERYWHERE

// A run of entries for merging; the head is its next light.
const int kNoLight = 0x7fffffff;
struct HeadedRun {
    int next;
    int end;
    int head;
};

HeadedRun headedRun(uvec2 run)
{
    return HeadedRun(int(run.x), int(run.x + run.y), run.y > 0u ? int(texelFetch(lightEntries, int(run.x)).x) : kNoLight);
}

void advance(inout HeadedRun run)
{
    run.next += 1;
    int head = int(texelFetch(lightEntries, run.next).x);
    run.head = run.next < run.end ? head : kNoLight;
}

struct LightCursor {
    HeadedRun cell;
    HeadedRun everywhere;
};

LightCursor lightCursor(vec2 pixel, float depth)
{
    return LightCursor(headedRun(lightRun(pixel, depth)), headedRun(uvec2(0u, lighting.lights.z)));
}

// Avoids an early return: rasterisers that mask lanes run the rest of the function anyway, and keep both results.
bool nextLight(inout LightCursor cursor, out int light)
{
    // Fetches once, for the run with the smaller head; no light is in both.
    bool isOfCell = cursor.cell.head < cursor.everywhere.head;
    HeadedRun run = cursor.everywhere;
    if (isOfCell) run = cursor.cell;
    light = run.head;
    advance(run);
    if (isOfCell) {
        cursor.cell = run;
    } else {
        cursor.everywhere = run;
    }
    return light != kNoLight;
}

#else

struct LightCursor {
    int next;
    int end;
};

LightCursor lightCursor(vec2 pixel, float depth)
{
    uvec2 run = lightRun(pixel, depth);
    return LightCursor(int(run.x), int(run.x + run.y));
}

bool nextLight(inout LightCursor cursor, out int light)
{
    light = int(texelFetch(lightEntries, cursor.next).x); // undefined at the end
    bool found = cursor.next < cursor.end;
    cursor.next += 1;
    return found;
}

#endif

bool nextBatch(inout LightCursor cursor, out int light)
{
    light = 0;
    return false;
}

#else

struct LightCursor {
    int tileWords; // index of the tile's mask among the entries
    int binWords;
    int word;
    int end;
    uint bits; // unvisited lights of the current word
};

LightCursor lightCursor(vec2 pixel, float depth)
{
    uvec4 tile = lightTile(pixel);
    uint bin = depthSlice(depth, tile.y);
    uvec2 words = lightCells[bin];
    return LightCursor(int(tile.x), int(bin * lighting.lights.w), int(words.x) - 1, int(words.y), 0u);
}

bool nextLight(inout LightCursor cursor, out int light)
{
    light = cursor.word * 32 + findLSB(cursor.bits);
    bool found = cursor.bits != 0u;
    cursor.bits &= cursor.bits - 1u;
    return found;
}

// Advances to the next word if there is one and this one is empty.
void skipEmptyWord(inout LightCursor cursor)
{
    if (cursor.bits != 0u || cursor.word >= cursor.end) return;
    cursor.word += 1;
    if (cursor.word >= cursor.end) return;
    cursor.bits = texelFetch(lightEntries, cursor.tileWords + cursor.word).x
                  & texelFetch(lightEntries, cursor.binWords + cursor.word).x;
}

void leaveTwoEmptyWords(inout LightCursor cursor)
{
    skipEmptyWord(cursor);
    skipEmptyWord(cursor);
}

// A batch is the lights of one 32-bit word of the mask. If lights are so many that loop iterations are scarce, a step
// skips up to twice as many empty words as a round visits lights (renderer/frame/LightRounds.h).
bool nextBatch(inout LightCursor cursor, out int light)
{
    do {
#if LIGHTS_PER_ROUND == 1
        skipEmptyWord(cursor);
#else
        leaveTwoEmptyWords(cursor);
        leaveTwoEmptyWords(cursor);
#endif
#if LIGHTS_PER_ROUND > 2
        leaveTwoEmptyWords(cursor);
        leaveTwoEmptyWords(cursor);
#endif
#if LIGHTS_PER_ROUND > 4
        leaveTwoEmptyWords(cursor);
        leaveTwoEmptyWords(cursor);
        leaveTwoEmptyWords(cursor);
        leaveTwoEmptyWords(cursor);
#endif
    } while (cursor.bits == 0u && cursor.word < cursor.end);
    return nextLight(cursor, light);
}

#endif
