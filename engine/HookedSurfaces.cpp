#include "engine/HookedSurfaces.h"

#include <algorithm>

#include "engine/HookProgram.h"
#include "shaders/shared/hook.h"
#include "shaders/shared/slots.h"

namespace tessera::engine {
namespace {

/// Points per dispatch: 60 MiB, less than the 128 MiB that OpenGL guarantees for a storage block.
constexpr std::size_t kMostPointsAtOnce = std::size_t(1) << 20;

std::vector<shared::HookPointRow> rowsOf(std::span<const scenes::HookPoint> points) {
    std::vector<shared::HookPointRow> rows;
    rows.reserve(points.size());
    for (const auto& [surface, uv, positionOS, instance] : points) {
        const auto& [color, emission, alpha, metallic] = surface;
        rows.push_back({{{color.x, color.y, color.z}, {emission.x, emission.y, emission.z}, alpha, metallic, 0},
                        {uv.x, uv.y},
                        {positionOS.x, positionOS.y, positionOS.z},
                        instance});
    }
    return rows;
}

void addTaken(const HookRun& hook, std::span<const scenes::HookPoint> points,
              std::vector<scenes::HookedSurface>& surfaces) {
    const gpu::Buffer given = gpu::Buffer::of("hook points", rowsOf(points));
    for (const auto& [color, emission, alpha, metallic, isCut] :
         hook.run<shared::HookSurfaceRow>(STORAGE_HOOK_POINTS, given, STORAGE_HOOK_SURFACES, points.size()))
        surfaces.push_back({{color[0], color[1], color[2]}, {emission[0], emission[1], emission[2]}, alpha, metallic});
}

} // namespace

std::vector<scenes::HookedSurface> hookedSurfaces(const scenes::Hook& hook, double timeSeconds,
                                                  std::span<const scenes::HookPoint> points,
                                                  shader::ProgramLibrary& programs) {
    std::vector<scenes::HookedSurface> surfaces;
    surfaces.reserve(points.size());
    const HookRun changing(kHookSurfaces, hook, timeSeconds, programs);
    for (std::size_t first = 0; first < points.size(); first += kMostPointsAtOnce)
        addTaken(changing, points.subspan(first, std::min(kMostPointsAtOnce, points.size() - first)), surfaces);
    return surfaces;
}

} // namespace tessera::engine
