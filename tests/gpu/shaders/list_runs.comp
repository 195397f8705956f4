// The boxes of tiles whose depth is divided into slices (method tile_2.5d). In: slicing, the tile's occupied slices, -,
// in whole groups of 64. Out: begin and end of each box in metres ahead, -1 if there is none.
#include "lib/lists/list_cells.glsl"

layout(std430, binding = 1) readonly buffer Inputs { uvec4 inputs[]; };
layout(std430, binding = 2) writeonly buffer Outputs { vec2 outputs[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    ListedTile tile;
    tile.depths = vec2(2.0, 0.0); // beyond every slice
    tile.slicing = inputs[i].x;
    tile.slices = inputs[i].yz;
    for (uint box = 0u; box < LIGHT_TILE_SLICES; ++box) boxRuns[box] = vec2(-1.0);
    findBoxRuns(tile);
    for (uint box = 0u; box < LIGHT_TILE_SLICES; ++box) outputs[i * LIGHT_TILE_SLICES + box] = boxRuns[box];
}
