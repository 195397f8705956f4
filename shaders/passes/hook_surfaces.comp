// Applies a scene's surface hook at given points, for the reference renderer.
#include "shared/slots.h"
#include "lib/material/hook_interface.glsl"

layout(local_size_x = HOOK_GROUP) in;

layout(std430, binding = STORAGE_HOOK_POINTS) readonly buffer HookPoints
{
    HookPointRow hookPointRows[];
};
layout(std430, binding = STORAGE_HOOK_SURFACES) writeonly buffer HookSurfaces
{
    HookSurfaceRow hookSurfaceRows[];
};

vec3 hookRowVector(float numbers[3])
{
    return vec3(numbers[0], numbers[1], numbers[2]);
}

void main()
{
    uint at = gl_GlobalInvocationID.x;
    if (at >= uint(hookPointRows.length())) return;
    HookPointRow point = hookPointRows[at];
    HookedSurface surface = HookedSurface(hookRowVector(point.surface.color), hookRowVector(point.surface.emission),
                                          point.surface.alpha, point.surface.metallic);
    hookSurface(surface, HookInputs(vec2(point.uv[0], point.uv[1]), hookRowVector(point.positionOS), point.instance));
    for (int i = 0; i < 3; ++i) {
        hookSurfaceRows[at].color[i] = surface.color[i];
        hookSurfaceRows[at].emission[i] = surface.emission[i];
    }
    hookSurfaceRows[at].alpha = surface.alpha;
    hookSurfaceRows[at].metallic = surface.metallic;
    hookSurfaceRows[at].isCut = hookIsCut(point.instance) ? 1 : 0;
}
