#pragma once
// A scene's own GLSL that changes its surfaces and moves its vertices (docs/hooks.md). It is put behind the programs
// that call it (renderer/shader/Preprocess.cpp), so that nothing in it changes what stands before: hookSurface() behind
// fragment shaders that shade surfaces, and behind a compute shader for the reference renderer; hookVertex() behind
// another compute shader, which every pass depends on.
#include "interop.h"

#define HOOK_PARAMETERS_MOST 15

// Iterations of all loops of a hook that an invocation makes; then each of them ends.
#define HOOK_ITERATIONS_MOST 60000

// Invocations of a group of the compute shaders.
#define HOOK_GROUP 64

// Opacities of vertices that a debug view marks: moved farther than the hook may move them; moved nowhere, to NaN or
// beyond 1000 km, or with a normal of NaN.
#define HOOK_MARK_TOO_FAR 2.0
#define HOOK_MARK_NOWHERE 3.0

SHARED_BEGIN

// The block that a hook reads as `hook`: number 0 is timeSeconds, the parameters follow.
struct HookConstants {
    vec4 numbers[(HOOK_PARAMETERS_MOST + 1) / 4];
};

// What the compute shaders read and write: storage blocks of such rows, without gaps in std430 as in C++.

// Of passes/hook_vertices.comp: 32 bytes a vertex in, 28 out.
struct HookVertexRow {
    float positionOS[3];
    float normalOS[3];
    float uv[2]; // the first texture coordinates
};
struct HookMovedRow {
    float positionOS[3];
    float normalOS[3]; // of any length
    int isCut;         // hookVertex() takes more than HOOK_ITERATIONS_MOST, or than the driver makes
};

// Of passes/hook_surfaces.comp: 60 bytes a point in, 36 out.
struct HookSurfaceRow {
    float color[3];
    float emission[3];
    float alpha;
    float metallic;
    int isCut; // as HookMovedRow's; 0 where it comes in
};
struct HookPointRow {
    HookSurfaceRow surface; // as the material has it
    float uv[2];
    float positionOS[3];
    int instance;
};

#ifndef __cplusplus
#if defined(HOOK_HASH) && defined(DEPTH_ONLY)
#define HOOKED (!DEPTH_ONLY)
#else
#define HOOKED 0
#endif
#endif

SHARED_END
