#include <algorithm>

#include <gtest/gtest.h>

#include "engine/Renderer.h"
#include "scenes/Load.h"

namespace tessera {
namespace {

bool drawsVolumes(const scenes::Scene& scene, frame::DebugView view) {
    frame::FrameSettings settings;
    settings.view = view;
    const auto programs = engine::framePrograms(scene, engine::Technique::DeferredVolumes, settings);
    return std::any_of(programs.begin(), programs.end(),
                       [](const auto& program) { return program.name == "light_volumes"; });
}

TEST(LightVolumesPass, isNeverDeclaredForViewsThatDoNotSumOverLights) {
    const scenes::Scene scene = scenes::loadScene("room");
    for (const frame::DebugViewInfo& info : frame::debugViewTable()) {
        if (info.needsGBuffer) continue; // a scene may not store their channel
        const bool sums = frame::sumsOverLights(info.view);
        EXPECT_EQ(drawsVolumes(scene, info.view), sums) << info.name;
    }
}

TEST(LightVolumesPass, isNotDeclaredWithoutLightsOrLitSurfaces) {
    scenes::Scene unlit = scenes::loadScene("room");
    scenes::Scene dark = unlit;
    for (scenes::Material& material : unlit.materials) material.model = scenes::MaterialModel::SingleColor;
    dark.lights.clear();
    EXPECT_FALSE(drawsVolumes(unlit, frame::DebugView::Final));
    EXPECT_FALSE(drawsVolumes(dark, frame::DebugView::Final));
}

} // namespace
} // namespace tessera
