// Moves the vertices of a mesh as its scene's hook says. Every pass reads what it writes.
#include "shared/slots.h"
#include "lib/material/hook_interface.glsl"

layout(local_size_x = 64) in;

// The names are none that a hook, whose text follows, is likely to have.
// A vertex each: position, normal, the first texture coordinates.
layout(std430, binding = STORAGE_HOOK_REST) readonly buffer HookRest
{
    float hookRestNumbers[];
};
// A vertex each: position, normal of any length.
layout(std430, binding = STORAGE_HOOK_MOVED) writeonly buffer HookMoved
{
    float hookMovedNumbers[];
};

void main()
{
    uint from = 8u * gl_GlobalInvocationID.x, to = 6u * gl_GlobalInvocationID.x;
    if (from >= uint(hookRestNumbers.length())) return;
    vec3 positionOS = vec3(hookRestNumbers[from], hookRestNumbers[from + 1u], hookRestNumbers[from + 2u]);
    vec3 normalOS = vec3(hookRestNumbers[from + 3u], hookRestNumbers[from + 4u], hookRestNumbers[from + 5u]);
    hookVertex(positionOS, normalOS, vec2(hookRestNumbers[from + 6u], hookRestNumbers[from + 7u]));
    for (int i = 0; i < 3; ++i) {
        hookMovedNumbers[to + uint(i)] = positionOS[i];
        hookMovedNumbers[to + 3u + uint(i)] = normalOS[i];
    }
}
