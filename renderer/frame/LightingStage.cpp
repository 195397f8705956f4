#include "renderer/frame/LightingStage.h"

namespace tessera::frame {

namespace {

constexpr LightingStageInfo kStages[] = {
    {LightingStage::Fragment, "fragment", "a triangle that covers the picture"},
    {LightingStage::Compute, "compute", "workgroups of 8 x 8 pixels"},
};

} // namespace

std::span<const LightingStageInfo> lightingStageTable() {
    return kStages;
}

const LightingStageInfo& infoOf(LightingStage stage) {
    return kStages[std::size_t(stage)];
}

} // namespace tessera::frame
