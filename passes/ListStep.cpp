#include "passes/ListStep.h"

#include <fmt/format.h>

#include "renderer/gpu/Commands.h"
#include "shaders/shared/slots.h"

namespace tessera::passes {

namespace {

/// Invocations of a workgroup whose items have one lane each: what the widest hardware runs together.
constexpr int kGroup = 64;
/// The same on software rasterisers, which run 4 to 16 together; there a row of tiles is seldom a multiple of 64.
constexpr int kSoftwareGroup = 8;

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
    const int itemLanes = compute && lanes == Lanes::Many ? spec.culling.lanes : 1;
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
                        {"LIST_THREADS", std::to_string(itemLanes)},
                        {"LIST_LIGHTS_A_ROW", std::to_string(kLightsARow)},
                        {"HAS_TRANSPARENT_LAYER", spec.features[frame::Feature::Blend] ? "1" : "0"}};
    if (compute) program_.defines.emplace_back("LIST_GROUP", std::to_string(group));
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
