#include "engine/HookedSurfaces.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "renderer/frame/HookConstants.h"
#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::engine {
namespace {

/// Of shaders/passes/hook_surfaces.comp: local_size_x, and numbers a point.
constexpr std::size_t kGroupPoints = 64, kGivenNumbers = 14, kTakenNumbers = 8;
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

/// With the program in use.
void addTaken(std::span<const scenes::HookPoint> points, std::vector<scenes::HookedSurface>& surfaces) {
    const gpu::Buffer from = gpu::Buffer::of("hook points", givenOf(points));
    const gpu::Buffer to("hook surfaces", points.size() * kTakenNumbers * sizeof(float), gpu::BufferUse::Readback);
    gpu::bindStorageBuffer(STORAGE_HOOK_POINTS, from);
    gpu::bindStorageBuffer(STORAGE_HOOK_SURFACES, to);
    gpu::dispatch(std::uint32_t((points.size() + kGroupPoints - 1) / kGroupPoints));
    gpu::memoryBarrier(graph::Barrier::TransferOrUpdate);
    const std::vector<float> taken = to.downloadAs<float>(points.size() * kTakenNumbers);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const float* const own = taken.data() + kTakenNumbers * i;
        surfaces.push_back({{own[0], own[1], own[2]}, {own[3], own[4], own[5]}, own[6], own[7]});
    }
}

} // namespace

shader::ProgramDesc hookedSurfacesProgram(const scenes::Hook& hook) {
    shader::ProgramDesc desc;
    desc.name = "hook_surfaces";
    desc.compute = "passes/hook_surfaces.comp";
    desc.defines = frame::hookDefines(frame::hookShape(hook));
    desc.defines.emplace_back("DEPTH_ONLY", "0");
    return desc;
}

std::vector<scenes::HookedSurface> hookedSurfaces(const scenes::Hook& hook, double timeSeconds,
                                                  std::span<const scenes::HookPoint> points,
                                                  shader::ProgramLibrary& programs) {
    std::vector<scenes::HookedSurface> surfaces;
    surfaces.reserve(points.size());
    gpu::useProgram(programs.get(hookedSurfacesProgram(hook)));
    const gpu::Buffer constants = gpu::Buffer::of("hook", std::vector{frame::hookConstants(hook, timeSeconds)});
    gpu::bindUniformBuffer(UNIFORM_HOOK, constants);
    for (std::size_t first = 0; first < points.size(); first += kMostPointsAtOnce)
        addTaken(points.subspan(first, std::min(kMostPointsAtOnce, points.size() - first)), surfaces);
    return surfaces;
}

} // namespace tessera::engine
