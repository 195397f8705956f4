// Mapping of light-list items to GPU threads: an item (a tile, a light, a depth bin) belongs to the LIST_THREADS lanes
// of a workgroup, or to a single lane. Items lie in a grid, since a grid's side may not exceed 65535. If a group holds
// several items, the last ones of a row may lie outside the grid; rows never do (passes/ListStep.cpp).
#pragma once

// Culling methods (culling::Method).
#define LIST_METHOD_MINMAX 1
#define LIST_METHOD_SLICES 2
#define LIST_METHOD_CLUSTER 3
#define LIST_METHOD_ZBIN 4

layout(local_size_x = LIST_GROUP) in;

#if LIST_THREADS > 1
#define LIST_MEMORY shared
#define LIST_LANE gl_LocalInvocationIndex
uvec2 listItem()
{
    return gl_WorkGroupID.xy;
}
void listSync()
{
    memoryBarrierShared();
    barrier();
}
#else
// A single lane per item has nothing to share or to wait for.
#define LIST_MEMORY
#define LIST_LANE 0u
uvec2 listItem()
{
    return gl_GlobalInvocationID.xy;
}
void listSync()
{
}
#endif

// A lane's contiguous range of `count` things: x the first, y one beyond the last. The lanes' results are in order if
// appended one after the other.
uvec2 laneShare(uint count)
{
    uint share = (count + uint(LIST_THREADS) - 1u) / uint(LIST_THREADS);
    return min(uvec2(LIST_LANE, LIST_LANE + 1u) * share, uvec2(count));
}
