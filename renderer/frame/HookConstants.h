#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scenes/Hook.h"
#include "shaders/shared/hook.h"

namespace tessera::frame {

/// What of a hook decides on programs.
struct HookShape {
    std::string file; ///< absolute
    std::uint64_t contentHash = 0;
    std::vector<std::string> parameters; ///< names, in order
};
HookShape hookShape(const scenes::Hook& hook);

/// What it reads: the time, rounded to fp32, and its parameters.
shared::HookConstants hookConstants(const scenes::Hook& hook, double timeSeconds);

} // namespace tessera::frame
