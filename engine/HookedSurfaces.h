#pragma once
#include <span>
#include <vector>

#include "renderer/shader/ProgramLibrary.h"
#include "scenes/Hook.h"

namespace tessera::engine {

/// Evaluates a hook's hookSurface() at points and a time, by running its source in a compute shader. Returns values by
/// point, not bounds. Throws InputError if the hook is faulty.
std::vector<scenes::HookedSurface> hookedSurfaces(const scenes::Hook& hook, double timeSeconds,
                                                  std::span<const scenes::HookPoint> points,
                                                  shader::ProgramLibrary& programs);

} // namespace tessera::engine
