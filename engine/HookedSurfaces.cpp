#include "engine/HookedSurfaces.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "engine/HookProgram.h"
#include "shaders/shared/slots.h"

namespace tessera::engine {
namespace {

/// Of shaders/passes/hook_surfaces.comp: numbers a point.
constexpr std::size_t kGivenNumbers = 14, kTakenNumbers = 8;
/// At once: 56 MiB, less than the 128 that OpenGL guarantees a storage block.
constexpr std::size_t kMostPointsAtOnce = std::size_t(1) << 20;

std::vector<std::uint32_t> givenOf(std::span<const scenes::HookPoint> points) {
    std::vector<std::uint32_t> given;
    given.reserve(points.size() * kGivenNumbers);
    const auto add = [&given](float value) { given.push_back(std::bit_cast<std::uint32_t>(value)); };
    for (const scenes::HookPoint& point : points) {
        for (int i = 0; i < 3; ++i) add(point.surface.color[i]);
        for (int i = 0; i < 3; ++i) add(point.surface.emission[i]);
        add(point.surface.alpha);
        add(point.surface.metallic);
        for (int i = 0; i < 2; ++i) add(point.uv[i]);
        for (int i = 0; i < 3; ++i) add(point.positionOS[i]);
        given.push_back(std::uint32_t(point.instance));
    }
    return given;
}

void addTaken(const HookRun& hook, std::span<const scenes::HookPoint> points,
              std::vector<scenes::HookedSurface>& surfaces) {
    const std::vector<float> taken = hook.run(STORAGE_HOOK_POINTS, gpu::Buffer::of("hook points", givenOf(points)),
                                              STORAGE_HOOK_SURFACES, points.size(), kTakenNumbers);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float* const own = taken.data() + kTakenNumbers * i;
        surfaces.push_back({{own[0], own[1], own[2]}, {own[3], own[4], own[5]}, own[6], own[7]});
    }
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
