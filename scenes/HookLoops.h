#pragma once
#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "scenes/HookTokens.h"

namespace tessera::scenes {

/// Returns text to insert before tokens, by index, which ends every loop once hookGoesOn() of
/// shaders/lib/material/hook_interface.glsl returns false: `while ((c) && hookGoesOn())`. Loops thus end after
/// HOOK_ITERATIONS_MOST iterations on every driver. Throws HookFault if a condition declares a variable. Invalid loops
/// are left to the driver.
std::map<std::size_t, std::string> hookLoopGuards(std::span<const HookToken> tokens);

} // namespace tessera::scenes
