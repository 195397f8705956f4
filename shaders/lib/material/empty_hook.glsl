// A hook that changes nothing: where a program is whole with it, but not with its scene's hook, that one is at fault
// (renderer/shader/HookFault.h).
#if HOOK_SURFACE
void hookSurface(inout HookedSurface surface, HookInputs inputs) {}
#endif
#if HOOK_VERTEX
void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv) {}
#endif
