#include "passes/ListStep.h"

#include <algorithm>

#include "renderer/frame/LightRounds.h"
#include "renderer/gpu/Commands.h"
#include "scenes/Limits.h"
#include "shaders/shared/light_lists.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

/// Invocations of a workgroup whose items have one lane each: the widest subgroup of any hardware.
constexpr int kGroup = 64;
/// The same on software rasterisers, which run 4 to 16 together; there a row of tiles is seldom a multiple of 64.
constexpr int kSoftwareGroup = 8;

/// Most iterations per light, once to count and once to write: the light, the end of its search loop, and its cells,
/// tested and written. Loops of up to 15 other lanes may skip the light in separate iterations.
constexpr std::size_t kIterationsALight = 2 * (2 + 2 * (LIGHT_TILE_SLICES + 1)) + 2 * (frame::kMostLanesTogether - 1);
/// Lights per lane in one shader on software rasterisers, which truncate loops after kMostLoopIterations.
constexpr std::size_t kSoftwareLightsALane =
    (frame::kMostLoopIterations - frame::kOtherLoopIterations) / kIterationsALight;

/// Masks are built without rounds, word by word.
constexpr std::size_t kIterationsAWord = 2 + 32 / MASK_LIGHTS_AN_ITERATION;
static_assert(scenes::kMostLights / 32 * kIterationsAWord <= frame::kMostLoopIterations - frame::kOtherLoopIterations);

std::size_t lightsARound(const frame::FrameSpec& spec) {
    if (!spec.settings.softwareBackend) return std::max<std::size_t>(spec.lights, 1);
    return kSoftwareLightsALane * std::size_t(spec.culling.lanes);
}

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
    const int itemLanes = lanes == Lanes::One ? 1 : lanes == Lanes::Group ? kGroup : spec.culling.lanes;
    const int group = itemLanes > 1 ? itemLanes : spec.settings.softwareBackend ? kSoftwareGroup : kGroup;
    itemsAGroup_ = std::uint32_t(group / itemLanes);
    program_.compute = "passes/light_" + name + ".glsl";
    program_.name = "light_" + std::move(name);
    program_.defines = {{"LIST_METHOD", methodDefine(spec.culling.method)},
                        {"LIST_IN_ROUNDS", spec.lights > lightsARound(spec) ? "1" : "0"},
                        {"LIST_THREADS", std::to_string(itemLanes)},
                        {"LIST_GROUP", std::to_string(group)},
                        {"LIST_LIGHTS_A_ROW", std::to_string(kLightsARow)},
                        {"SAMPLES", std::to_string(spec.samples)},
                        {"HAS_TRANSPARENT_LAYER", spec.features[frame::Feature::Blend] ? "1" : "0"}};
}

std::vector<glm::uvec4> ListStep::rounds(const frame::FrameSpec& spec) {
    const std::size_t most = lightsARound(spec);
    std::vector<glm::uvec4> rounds;
    std::size_t first = 0;
    do {
        const std::size_t end = std::min(first + most, spec.lights);
        rounds.emplace_back(first, end, 0u, 0u);
        first = end;
    } while (first < spec.lights);
    return rounds;
}

void ListStep::run(const graph::PassContext& context, glm::uvec2 items, std::size_t program) const {
    gpu::useProgram(context.program(program));
    gpu::dispatch((items.x + itemsAGroup_ - 1) / itemsAGroup_, items.y);
}

} // namespace tessera::passes
