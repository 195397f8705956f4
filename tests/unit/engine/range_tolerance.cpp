#include <limits>

#include <gtest/gtest.h>

#include "base/Error.h"
#include "engine/PrepareView.h"
#include "engine/Renderer.h"

namespace tessera::engine {
namespace {

scenes::Light attenuated(float intensity, const glm::vec3& abc) {
    scenes::Light light;
    light.falloff = scenes::Falloff::Attenuation;
    light.intensity = intensity;
    light.attenuation = abc;
    return light;
}

scenes::Scene sceneWith(std::vector<scenes::Light> lights) {
    scenes::Scene scene;
    scene.name = "lamps";
    scene.cameras.emplace_back();
    scene.lights = std::move(lights);
    return scene;
}

/// The plan's choice of the range tolerance and its reason; empty without one.
std::string said(const scenes::Scene& scene, double tolerance) {
    frame::FrameSettings settings;
    settings.rangeTolerance = tolerance;
    for (const graph::Plan::Choice& choice : planFrame(scene, Technique::Deferred, settings).choices) {
        if (choice.what == "range tolerance") return choice.chosen + ": " + choice.why;
    }
    return "";
}

TEST(RangeTolerance, thePlanReportsWhichLightsItEndsAndWhere) {
    const scenes::Scene scene = sceneWith({attenuated(8.0f, {0, 0, 1}), attenuated(8.0f, {0, 0, 4}),
                                           attenuated(1.0f, {2, 1, 0}), attenuated(1.0f, {1, 0, 0}), scenes::Light()});
    EXPECT_EQ(said(scene, 0.5), "0.5: 2 lights with falloff by A B C or from an area made finite, radii 2 m to 4 m; 1 "
                                "light nowhere above it, so dark; 1 light without end, B = C = 0");
    EXPECT_EQ(said(scene, 0.0),
              "0: falloff by A B C or from an area of 4 lights never ends; a tolerance above 0 gives it a radius");
    EXPECT_EQ(said(sceneWith({scenes::Light()}), 0.5),
              "0.5: no light that is on falls off by A B C or from an area, so it ends none");
    EXPECT_EQ(said(sceneWith({scenes::Light()}), 0.0), "");
}

TEST(RangeTolerance, negativeAndNonFiniteValuesAreRefused) {
    const scenes::Scene scene = sceneWith({});
    for (const double tolerance : {-1e-300, -std::numeric_limits<double>::infinity(),
                                   std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
        frame::FrameSettings settings;
        settings.rangeTolerance = tolerance;
        EXPECT_THROW(prepareView(scene, Technique::Forward, settings), InputError) << tolerance;
    }
}

} // namespace
} // namespace tessera::engine
