// Moves the vertices of a mesh as its scene's hook says. Every pass reads what it writes.
#include "shared/slots.h"
#include "lib/material/hook_interface.glsl"

layout(local_size_x = 64) in;

// A vertex each: position, normal, the first texture coordinates.
layout(std430, binding = STORAGE_HOOK_REST) readonly buffer HookRest
{
    float rest[];
};
// A vertex each: position, normal of any length.
layout(std430, binding = STORAGE_HOOK_MOVED) writeonly buffer HookMoved
{
    float moved[];
};

void main()
{
    uint from = 8u * gl_GlobalInvocationID.x, to = 6u * gl_GlobalInvocationID.x;
    if (from >= uint(rest.length())) return;
    vec3 positionOS = vec3(rest[from], rest[from + 1u], rest[from + 2u]);
    vec3 normalOS = vec3(rest[from + 3u], rest[from + 4u], rest[from + 5u]);
    hookVertex(positionOS, normalOS, vec2(rest[from + 6u], rest[from + 7u]));
    for (int i = 0; i < 3; ++i) {
        moved[to + uint(i)] = positionOS[i];
        moved[to + 3u + uint(i)] = normalOS[i];
    }
}
