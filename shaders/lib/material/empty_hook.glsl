// A hook that changes nothing: if a program builds with it, but not with its scene's hook, the scene's hook is at fault
// (renderer/shader/HookFault.h).
#if HOOK_SURFACE
void hookSurface(inout HookedSurface surface, HookInputs inputs) {}
#endif
#if HOOK_VERTEX
void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv) {}
#endif
