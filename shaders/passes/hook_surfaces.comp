// What a scene's hook makes of surfaces at points that are given, for the reference renderer.
#include "shared/slots.h"
#include "lib/material/hook_interface.glsl"

layout(local_size_x = 64) in;

// The names are none that a hook, whose text follows, is likely to have.
// A point each, as bits: colour, emission, alpha, metallic, uv, position in the mesh, and a whole number, its instance.
layout(std430, binding = STORAGE_HOOK_POINTS) readonly buffer HookPoints
{
    uint hookPointNumbers[];
};
// A point each, as bits: colour, emission, alpha, metallic.
layout(std430, binding = STORAGE_HOOK_SURFACES) writeonly buffer HookSurfaces
{
    uint hookSurfaceNumbers[];
};

float hookPointNumber(uint at)
{
    return uintBitsToFloat(hookPointNumbers[at]);
}
vec3 hookPointVector(uint at)
{
    return vec3(hookPointNumber(at), hookPointNumber(at + 1u), hookPointNumber(at + 2u));
}

void main()
{
    uint from = 14u * gl_GlobalInvocationID.x, to = 8u * gl_GlobalInvocationID.x;
    if (from >= uint(hookPointNumbers.length())) return;
    HookedSurface surface = HookedSurface(hookPointVector(from), hookPointVector(from + 3u),
                                          hookPointNumber(from + 6u), hookPointNumber(from + 7u));
    vec2 uv = vec2(hookPointNumber(from + 8u), hookPointNumber(from + 9u));
    hookSurface(surface, HookInputs(uv, hookPointVector(from + 10u), int(hookPointNumbers[from + 13u])));
    for (int i = 0; i < 3; ++i) {
        hookSurfaceNumbers[to + uint(i)] = floatBitsToUint(surface.color[i]);
        hookSurfaceNumbers[to + 3u + uint(i)] = floatBitsToUint(surface.emission[i]);
    }
    hookSurfaceNumbers[to + 6u] = floatBitsToUint(surface.alpha);
    hookSurfaceNumbers[to + 7u] = floatBitsToUint(surface.metallic);
}
