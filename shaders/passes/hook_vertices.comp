// Moves the vertices of a mesh by its scene's hook. Every pass reads the result.
#include "shared/slots.h"
#include "lib/material/hook_interface.glsl"

layout(local_size_x = HOOK_GROUP) in;

layout(std430, binding = STORAGE_HOOK_REST) readonly buffer HookRest
{
    HookVertexRow hookRestRows[];
};
layout(std430, binding = STORAGE_HOOK_MOVED) writeonly buffer HookMoved
{
    HookMovedRow hookMovedRows[];
};

void main()
{
    uint at = gl_GlobalInvocationID.x;
    if (at >= uint(hookRestRows.length())) return;
    HookVertexRow rest = hookRestRows[at];
    vec3 positionOS = vec3(rest.positionOS[0], rest.positionOS[1], rest.positionOS[2]);
    vec3 normalOS = vec3(rest.normalOS[0], rest.normalOS[1], rest.normalOS[2]);
    hookVertex(positionOS, normalOS, vec2(rest.uv[0], rest.uv[1]));
    for (int i = 0; i < 3; ++i) {
        hookMovedRows[at].positionOS[i] = positionOS[i];
        hookMovedRows[at].normalOS[i] = normalOS[i];
    }
    hookMovedRows[at].isCut = hookIsCut(int(at)) ? 1 : 0;
}
