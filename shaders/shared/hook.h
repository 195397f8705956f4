#pragma once
// A scene's own GLSL that changes its surfaces (docs/hooks.md), where a program shades them: it is put behind the
// program's fragment shader (renderer/shader/Preprocess.cpp), so that nothing in it changes what stands before.
#include "interop.h"

SHARED_BEGIN

#define HOOK_PARAMETERS_MOST 15

// The block that a hook reads as `hook`: number 0 is timeSeconds, the parameters follow.
struct HookConstants {
    vec4 numbers[(HOOK_PARAMETERS_MOST + 1) / 4];
};

#ifndef __cplusplus
#if defined(HOOK_HASH) && defined(DEPTH_ONLY)
#define HOOKED (!DEPTH_ONLY)
#else
#define HOOKED 0
#endif
#endif

SHARED_END
