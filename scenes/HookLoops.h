#pragma once
#include <cstddef>
#include <map>
#include <span>
#include <string>

#include "scenes/HookTokens.h"

namespace tessera::scenes {

/// Text before tokens, by their places, that lets every loop go on only while hookGoesOn() of
/// shaders/lib/material/hook_interface.glsl holds: `while ((c) && hookGoesOn())`. So loops end alike on every driver,
/// after HOOK_ITERATIONS_MOST. Throws HookFault where a condition declares a variable. What is no loop of GLSL is left
/// to the driver.
std::map<std::size_t, std::string> hookLoopGuards(std::span<const HookToken> tokens);

} // namespace tessera::scenes
