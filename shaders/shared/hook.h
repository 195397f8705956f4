#pragma once
// GLSL hooks of a scene, which modify its surfaces and vertices (docs/hooks.md). A hook is appended to the programs
// that call it (renderer/shader/Preprocess.cpp), so that it cannot affect the code before it: hookSurface() to fragment
// shaders that shade surfaces, and to a compute shader for the reference renderer; hookVertex() to another compute
// shader, which every pass depends on.
#include "interop.h"

#define HOOK_PARAMETERS_MOST 15

// Maximum iterations of all loops of a hook per invocation; loops are truncated after that.
#define HOOK_ITERATIONS_MOST 60000

// Workgroup size of the compute shaders.
#define HOOK_GROUP 64

// Opacities that flag vertices for a debug view: moved farther than the hook may move them; moved to an invalid
// position (NaN or beyond 1000 km) or with a NaN normal.
#define HOOK_MARK_TOO_FAR 2.0
#define HOOK_MARK_NOWHERE 3.0

SHARED_BEGIN

// Uniform block `hook`: number 0 is timeSeconds, the parameters follow.
struct HookConstants {
    vec4 numbers[(HOOK_PARAMETERS_MOST + 1) / 4];
};

// Rows of the compute shaders' storage blocks, without padding in std430 as in C++.

// passes/hook_vertices.comp: 32 bytes per vertex in, 28 out.
struct HookVertexRow {
    float positionOS[3];
    float normalOS[3];
    float uv[2]; // the first texture coordinates
};
struct HookMovedRow {
    float positionOS[3];
    float normalOS[3]; // any length
    int isCut;         // loops of hookVertex() exceeded HOOK_ITERATIONS_MOST or the driver's limit
};

// passes/hook_surfaces.comp: 60 bytes per point in, 36 out.
struct HookSurfaceRow {
    float color[3];
    float emission[3];
    float alpha;
    float metallic;
    int isCut; // as in HookMovedRow; 0 on input
};
struct HookPointRow {
    HookSurfaceRow surface; // from the material
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
