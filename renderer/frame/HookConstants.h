#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "renderer/shader/Preprocess.h"
#include "scenes/Hook.h"
#include "shaders/shared/hook.h"

namespace tessera::frame {

/// The parts of a hook that affect compiled programs.
struct HookShape {
    std::string file; ///< absolute
    std::uint64_t contentHash = 0;
    std::vector<std::string> parameters; ///< names, in order
    bool changesSurfaces = true, movesVertices = false;
};
HookShape hookShape(const scenes::Hook& hook);

/// Defines of programs that call the hook.
shader::Defines hookDefines(const HookShape& hook);

/// The hook's uniforms: the time, rounded to fp32, and its parameters.
shared::HookConstants hookConstants(const scenes::Hook& hook, double timeSeconds);

} // namespace tessera::frame
