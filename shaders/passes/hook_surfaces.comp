// What a scene's hook makes of surfaces at points that are given, for the reference renderer.
#include "shared/slots.h"
#include "lib/material/hook_interface.glsl"

layout(local_size_x = 64) in;

// A point each, as bits: colour, emission, alpha, metallic, uv, position in the mesh, and a whole number, its instance.
layout(std430, binding = STORAGE_HOOK_POINTS) readonly buffer HookPoints
{
    uint given[];
};
// A point each, as bits: colour, emission, alpha, metallic.
layout(std430, binding = STORAGE_HOOK_SURFACES) writeonly buffer HookSurfaces
{
    uint taken[];
};

vec3 givenVector(uint at)
{
    return uintBitsToFloat(uvec3(given[at], given[at + 1u], given[at + 2u]));
}

void main()
{
    uint from = 14u * gl_GlobalInvocationID.x, to = 8u * gl_GlobalInvocationID.x;
    if (from >= uint(given.length())) return;
    HookedSurface surface = HookedSurface(givenVector(from), givenVector(from + 3u), uintBitsToFloat(given[from + 6u]),
                                          uintBitsToFloat(given[from + 7u]));
    hookSurface(surface, HookInputs(uintBitsToFloat(uvec2(given[from + 8u], given[from + 9u])), givenVector(from + 10u),
                                    int(given[from + 13u])));
    for (int i = 0; i < 3; ++i) {
        taken[to + uint(i)] = floatBitsToUint(surface.color[i]);
        taken[to + 3u + uint(i)] = floatBitsToUint(surface.emission[i]);
    }
    taken[to + 6u] = floatBitsToUint(surface.alpha);
    taken[to + 7u] = floatBitsToUint(surface.metallic);
}
