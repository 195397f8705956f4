// Interface of a scene's GLSL hooks (docs/hooks.md). In a program that includes this file, the scene's source comes
// last, preceded by the block `hook` with the time and its parameters.
#pragma once
#include "lib/maths/cut_loop.glsl"
#include "shared/hook.h"

#if HOOKED
struct HookedSurface {
    vec3 color;     // k_d, or base colour of metallic_roughness, linear
    vec3 emission;  // radiance that needs no light; all of an unlit surface
    float alpha;    // GGX alpha, of models that have one; along the tangent where the lobe is anisotropic
    float metallic; // of metallic_roughness
};

struct HookInputs {
    vec2 uv;         // first texture coordinates, 0 if the mesh has none
    vec3 positionOS; // as drawn: after skins, morph targets and hookVertex()
    int instance;    // index of the mesh instance in the scene, from 0
};

// Loop conditions of a hook get `&& hookGoesOn()` appended (scenes/HookLoops.h), so that no loop is endless.
int hookIterations = 0;
bool hookGoesOn()
{
    ++hookIterations;
    return hookIterations <= HOOK_ITERATIONS_MOST;
}
// Whether loops of the hook were truncated. `place`: as in loopsAreCut().
bool hookIsCut(int place)
{
    return hookIterations > HOOK_ITERATIONS_MOST || loopsAreCut(place);
}

// Defined by the scene, if it has them.
#if HOOK_SURFACE
void hookSurface(inout HookedSurface surface, HookInputs inputs);
#endif
#if HOOK_VERTEX
void hookVertex(inout vec3 positionOS, inout vec3 normalOS, vec2 uv);
#endif
#endif
