// How the steps that build light lists are spread over a GPU: an item (a tile, a light, a depth bin) belongs to the
// LIST_THREADS lanes of a workgroup together, or to a lane of its own. Items lie in a grid, since a grid's side may not exceed
// 65535. Where a group holds several items, the last of a row may lie beyond the grid; rows never do (passes/ListStep.cpp).
#pragma once

// What lists are built by (culling::Method).
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
// Alone with its item, a lane has no one to share with or to wait for.
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

// A lane's share of `count` things: x the first, y one beyond the last. Contiguous, so that the lanes' results are in
// order when appended one after the other.
uvec2 laneShare(uint count)
{
    uint share = (count + uint(LIST_THREADS) - 1u) / uint(LIST_THREADS);
    return min(uvec2(LIST_LANE, LIST_LANE + 1u) * share, uvec2(count));
}
