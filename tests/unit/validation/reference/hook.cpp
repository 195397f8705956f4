#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/TestScenes.h"
#include "validation/reference/Render.h"

namespace tessera::reference {
namespace {

using scenes::HookedSurface;
using scenes::HookPoint;

/// A scene whose hook changes all materials, and the settings of its view.
struct HookedView {
    scenes::Scene scene;
    Settings settings;

    explicit HookedView(scenes::Scene of) : scene(std::move(of)) {
        scenes::Hook& hook = scene.hook.emplace();
        for (std::size_t i = 0; i < scene.materials.size(); ++i) hook.materials.push_back(int(i));
        settings.sizePixels = {48, 27};
        settings.camera = scene.cameras.front();
    }
    /// Renders as if the hook applied `change` to every point.
    template <class Change>
    Rendered rendered(const Change& change) const {
        Settings hooked = settings;
        hooked.runHook = [&](std::span<const HookPoint> points) {
            std::vector<HookedSurface> surfaces;
            for (const HookPoint& point : points) surfaces.push_back(change(point));
            return surfaces;
        };
        return render(scene, hooked);
    }
};

TEST(ReferenceHook, valuesThatAreLeftAloneChangeNoBit) {
    const HookedView view(test::everythingScene());
    const Rendered plain = render(view.scene, view.settings);
    const Rendered same = view.rendered([](const HookPoint& point) { return point.surface; });
    EXPECT_EQ(same.radiance, plain.radiance);
    EXPECT_EQ(same.covered, plain.covered);
    EXPECT_EQ(same.ids, plain.ids);
    ASSERT_EQ(same.alternatives.size(), plain.alternatives.size());
    for (std::size_t i = 0; i < plain.alternatives.size(); ++i) {
        ASSERT_EQ(same.alternatives[i].size(), plain.alternatives[i].size()) << i;
        for (std::size_t j = 0; j < plain.alternatives[i].size(); ++j) {
            EXPECT_EQ(same.alternatives[i][j].least, plain.alternatives[i][j].least) << i;
            EXPECT_EQ(same.alternatives[i][j].most, plain.alternatives[i][j].most) << i;
        }
    }
}

TEST(ReferenceHook, itGetsTheSurfaceAndThePlace) {
    scenes::Material material;
    material.model = scenes::MaterialModel::MetallicRoughness;
    material.baseColor = {0.25f, 0.5f, 0.75f, 1.0f};
    material.metallic = 0.5f;
    material.perceptualRoughness = 0.5f;
    material.emissive = {1.0f, 2.0f, 3.0f};
    HookedView view(test::quadScene(material));
    view.scene.nodes.insert(view.scene.nodes.begin(), view.scene.nodes.front());
    view.scene.nodes.front().parentFromNode[3].x = 100.0;
    std::size_t count = 0;
    scenes::Box3 boundsOS;
    for (const glm::vec3& position : view.scene.meshes[0].positionsOS) boundsOS.extend(glm::dvec3(position));
    const Rendered rendered = view.rendered([&](const HookPoint& point) {
        EXPECT_EQ(point.surface, (HookedSurface{{0.25f, 0.5f, 0.75f}, {1.0f, 2.0f, 3.0f}, 0.25f, 0.5f}));
        EXPECT_EQ(point.instance, 1) << "the first is out of the picture";
        for (int axis = 0; axis < 2; ++axis) {
            EXPECT_GE(double(point.positionOS[axis]), boundsOS.min[axis]);
            EXPECT_LE(double(point.positionOS[axis]), boundsOS.max[axis]);
        }
        ++count;
        return point.surface;
    });
    std::size_t covered = 0;
    for (const std::uint8_t pixel : rendered.covered) covered += pixel;
    EXPECT_GT(covered, 0u);
    EXPECT_EQ(count, covered) << "a pixel requests a point once";
}

TEST(ReferenceHook, whatItGivesIsKeptWithinWhatASurfaceMayBe) {
    scenes::Material material;
    material.model = scenes::MaterialModel::Lambert;
    material.baseColor = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
    HookedView view(test::quadScene(material));
    const std::size_t middle = std::size_t(view.settings.sizePixels.x) * 13 + 24;
    const auto shines = [](const glm::vec3& emission) {
        return [emission](HookPoint point) {
            point.surface.emission = emission;
            return point.surface;
        };
    };
    EXPECT_EQ(view.rendered(shines({-1.0f, 0.5f, 2.0f})).radiance[middle], glm::dvec3(0.0, 0.5, 2.0));
    view.scene.lights.push_back(test::pointLight({0.0, 0.0, 2.0}, 10.0f));
    const auto painted = [](float color) {
        return [color](HookPoint point) {
            point.surface.color = glm::vec3(color);
            return point.surface;
        };
    };
    const glm::dvec3 white = view.rendered(painted(1.0f)).radiance[middle];
    EXPECT_GT(white.r, 0.0);
    EXPECT_EQ(view.rendered(painted(7.0f)).radiance[middle], white);
    EXPECT_EQ(view.rendered(painted(-1.0f)).radiance[middle], glm::dvec3(0.0));
    EXPECT_EQ(view.rendered(painted(std::numeric_limits<float>::quiet_NaN())).radiance[middle], glm::dvec3(0.0));
}

TEST(ReferenceHook, anUnlitSurfaceShowsItsEmissionAlone) {
    scenes::Material material;
    material.model = scenes::MaterialModel::SingleColor;
    material.baseColor = {0.25f, 0.5f, 0.75f, 1.0f};
    const HookedView view(test::quadScene(material));
    const Rendered rendered = view.rendered([](HookPoint point) {
        EXPECT_EQ(point.surface.emission, glm::vec3(0.25f, 0.5f, 0.75f));
        point.surface.color = glm::vec3(0.0f);
        point.surface.emission.r = 0.125f;
        return point.surface;
    });
    EXPECT_EQ(rendered.radiance[std::size_t(view.settings.sizePixels.x) * 13 + 24], glm::dvec3(0.125, 0.5, 0.75));
}

TEST(ReferenceHook, materialsThatItLeavesAloneAreNotEvaluated) {
    HookedView view(test::everythingScene());
    view.scene.hook->materials.clear();
    const Rendered rendered = view.rendered([](const HookPoint& point) {
        ADD_FAILURE() << "instance " << point.instance;
        return point.surface;
    });
    EXPECT_EQ(rendered.radiance, render(view.scene, view.settings).radiance);
}

} // namespace
} // namespace tessera::reference
