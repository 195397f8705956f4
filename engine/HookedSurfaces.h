#pragma once
#include <span>
#include <vector>

#include "renderer/shader/ProgramLibrary.h"
#include "scenes/Hook.h"

namespace tessera::engine {

/// What a hook's hookSurface() makes of surfaces at a time, by point: its own text, in a compute shader, and no bounds.
/// Throws InputError where the hook is faulty.
std::vector<scenes::HookedSurface> hookedSurfaces(const scenes::Hook& hook, double timeSeconds,
                                                  std::span<const scenes::HookPoint> points,
                                                  shader::ProgramLibrary& programs);

} // namespace tessera::engine
