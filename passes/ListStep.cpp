#include "passes/ListStep.h"

#include <algorithm>

#include "renderer/frame/LightRounds.h"
#include "renderer/gpu/Commands.h"
#include "scenes/Limits.h"
#include "shaders/shared/light_lists.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

/// Invocations of a workgroup whose items have one lane each: what the widest hardware runs together.
constexpr int kGroup = 64;
/// The same on software rasterisers, which run 4 to 16 together; there a row of tiles is seldom a multiple of 64.
constexpr int kSoftwareGroup = 8;

/// A light takes at most, once to count and once to write: itself, the end of the loop that looked for it, and its
/// cells, tested and written. The other lanes' loops may pass over it in iterations of their own, up to 15 more.
constexpr std::size_t kIterationsALight = 2 * (2 + 2 * (LIGHT_TILE_SLICES + 1)) + 2 * (frame::kMostLanesTogether - 1);
/// Lights that a lane may look at in one shader on software rasterisers, whose loops end after some iterations.
constexpr std::size_t kSoftwareLightsALane =
    (frame::kMostLoopIterations - frame::kOtherLoopIterations) / kIterationsALight;

/// Masks are built without rounds, a word after the other.
constexpr std::size_t kIterationsAWord = 2 + 32 / MASK_LIGHTS_AN_ITERATION;
static_assert(scenes::kMostLights / 32 * kIterationsAWord <= frame::kMostLoopIterations - frame::kOtherLoopIterations);

const char* methodDefine(culling::Method method) {
    switch (method) {
    case culling::Method::TileMinmax:
        return "LIST_METHOD_MINMAX";
    case culling::Method::Tile25d:
        return "LIST_METHOD_SLICES";
    case culling::Method::Zbin:
        return "LIST_METHOD_ZBIN";
    case culling::Method::Cluster:
    case culling::Method::None:
        break;
    }
    return "LIST_METHOD_CLUSTER";
}

} // namespace

ListStep::ListStep(const frame::FrameSpec& spec, std::string name, Lanes lanes) {
    const bool compute = spec.culling.builder == culling::Builder::Compute;
    const int many = lanes == Lanes::Group ? kGroup : spec.culling.lanes;
    const int itemLanes = compute && lanes != Lanes::One ? many : 1;
    const int group = itemLanes > 1 ? itemLanes : spec.settings.softwareBackend ? kSoftwareGroup : kGroup;
    itemsAGroup_ = compute ? std::uint32_t(group / itemLanes) : 0;
    const std::string path = "passes/light_" + name;
    program_.name = "light_" + std::move(name);
    if (compute) {
        program_.compute = path + ".comp";
    } else {
        program_.vertex = "passes/fullscreen.vert";
        program_.fragment = path + ".frag";
    }
    program_.defines = {{"LIST_METHOD", methodDefine(spec.culling.method)},
                        {"LIST_IN_ROUNDS", inRounds(spec) ? "1" : "0"},
                        {"LIST_THREADS", std::to_string(itemLanes)},
                        {"LIST_LIGHTS_A_ROW", std::to_string(kLightsARow)},
                        {"SAMPLES", std::to_string(spec.samples)},
                        {"HAS_TRANSPARENT_LAYER", spec.features[frame::Feature::Blend] ? "1" : "0"}};
    if (compute) program_.defines.emplace_back("LIST_GROUP", std::to_string(group));
}

std::size_t ListStep::lightsARound(const frame::FrameSpec& spec) {
    if (!spec.settings.softwareBackend) return spec.lights;
    const bool compute = spec.culling.builder == culling::Builder::Compute;
    return kSoftwareLightsALane * std::size_t(compute ? spec.culling.lanes : 1);
}

void ListStep::runRounds(const frame::FrameSpec& spec, const frame::FrameResources& resources, glm::uvec2 items) const {
    const gpu::Buffer& round = resources.lightLists.round;
    const auto lights = std::uint32_t(spec.lights);
    std::uint32_t first = 0;
    do {
        const auto end = std::uint32_t(std::min(first + lightsARound(spec), spec.lights));
        round.uploadValue(glm::uvec4(first, end, 0u, 0u));
        gpu::bindUniformBuffer(UNIFORM_LIST_ROUND, round);
        if (first > 0) gpu::memoryBarrier(graph::Barrier::ShaderStorage); // the round before is the same pass's
        run(resources, items);
        first = end;
    } while (first < lights);
}

void ListStep::run(const frame::FrameResources& resources, glm::uvec2 items) const {
    gpu::useProgram(resources.programs.get(program_));
    gpu::bindUniformBuffer(UNIFORM_FRAME, resources.frameConstants);
    if (itemsAGroup_ > 0) {
        gpu::dispatch((items.x + itemsAGroup_ - 1) / itemsAGroup_, items.y);
        return;
    }
    gpu::bindFramebuffer(resources.framebuffers.get({{}, nullptr, int(items.x), int(items.y)}));
    gpu::setState({});
    gpu::drawFullscreenTriangle();
}

} // namespace tessera::passes
