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

} // namespace tessera::frame
