#include <algorithm>
#include <functional>

#include "base/Error.h"
#include "engine/Rendering.h"
#include "tests/support/GlContext.h"
#include "tests/support/TestScenes.h"

namespace tessera {
namespace {

using engine::Technique;

/// Edits of a scene that a renderer already draws.
class Edits : public test::GlTest {
protected:
    static frame::FrameSettings small() {
        frame::FrameSettings settings;
        settings.sizePixels = {160, 91};
        return settings;
    }
    /// Compares a renderer's picture after an edit with a new renderer's.
    void expectSameAsNew(const std::function<void(scenes::Scene&)>& edit, bool ofMaterials,
                         scenes::Scene scene = test::everythingScene()) {
        engine::Renderer renderer(context(), scene);
        for (const Technique technique : {Technique::Forward, Technique::Deferred}) {
            const std::vector<float> before = renderer.render(technique, small()).radiance;
            edit(scene);
            if (ofMaterials) renderer.materialsChanged();
            const std::vector<float> after = renderer.render(technique, small()).radiance;
            EXPECT_NE(after, before) << "the edit changes nothing";
            engine::Renderer anew(context(), scene);
            EXPECT_EQ(after, anew.render(technique, small()).radiance);
        }
    }
};

TEST_F(Edits, factorsOfMaterialsAreDrawnAsByANewRenderer) {
    // The first keeps materials in its pixels, the second their numbers.
    for (const scenes::Scene& scene : {test::everythingScene(), test::evenScene()}) {
        float step = 0.0f;
        expectSameAsNew(
            [&step](scenes::Scene& edited) {
                step += 0.1f;
                for (scenes::Material& material : edited.materials) {
                    material.baseColor *= glm::vec4(1.0f - step, 0.5f + step, 0.9f, 1.0f);
                    material.perceptualRoughness = 0.5f + step;
                    material.alpha = 0.3f + step;
                }
            },
            true, scene);
    }
}

TEST_F(Edits, tangentsAreDerivedAnewWhereAMaterialFollowsOthersThanBefore) {
    // Anisotropy and coats that begin, and end again. Others of the scene keep both features in use.
    std::vector<std::size_t> turned;
    expectSameAsNew(
        [&turned](scenes::Scene& scene) {
            const bool begins = turned.empty();
            for (std::size_t i = 0; i < scene.materials.size(); ++i) {
                scenes::Material& material = scene.materials[i];
                if (begins && material.model == scenes::MaterialModel::MetallicRoughness &&
                    material.anisotropyStrength == 0.0f && material.clearcoat == 0.0f)
                    turned.push_back(i);
            }
            ASSERT_FALSE(turned.empty());
            for (const std::size_t i : turned)
                scene.materials[i].anisotropyStrength = scene.materials[i].clearcoat = begins ? 0.7f : 0.0f;
        },
        true);
}

TEST_F(Edits, anEditThatCannotBeDrawnIsNotForgottenAndLeavesNoTrace) {
    scenes::Scene scene = test::everythingScene();
    const auto normalMap = [](scenes::Material& material) -> scenes::TextureUse& {
        return material.texture(scenes::TextureSlot::Normal);
    };
    const auto mapped = std::ranges::find_if(scene.materials, [&](scenes::Material& material) {
        return normalMap(material).image != scenes::kNone && material.normalMapSpace == scenes::NormalMapSpace::Tangent;
    });
    ASSERT_NE(mapped, scene.materials.end());
    // A triangle among a million vertices, with 40 materials.
    constexpr std::size_t kVertices = std::size_t(1) << 20, kMaterials = 40;
    scenes::Mesh mesh;
    mesh.positionsOS.resize(kVertices);
    mesh.normalsOS.resize(kVertices, glm::vec3(0.0f, 0.0f, 1.0f));
    mesh.texCoords[0].resize(kVertices);
    mesh.tangentsOS.resize(kVertices, glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
    mesh.positionsOS[1].x = mesh.positionsOS[2].y = 0.1f;
    mesh.indices = {0, 1, 2};
    const scenes::Material material = *mapped;
    const scenes::TextureTransform before = normalMap(*mapped).transform;
    const std::size_t first = scene.materials.size();
    scenes::Node node;
    for (std::size_t i = 0; i < kMaterials; ++i) {
        scene.materials.push_back(material);
        node.instances.push_back({int(scene.meshes.size()), int(first + i)});
    }
    scene.meshes.push_back(std::move(mesh));
    scene.nodes.push_back(std::move(node));

    engine::Renderer renderer(context(), scene);
    renderer.draw(Technique::Forward, small());
    frame::FrameSettings exact = small();
    exact.filter = frame::TextureFilter::Exact;
    for (std::size_t i = 0; i < kMaterials; ++i)
        normalMap(scene.materials[first + i]).transform.rotationRadians = 0.1f * float(i);
    for (scenes::Material& each : scene.materials) each.baseColor *= 0.5f;
    renderer.materialsChanged();
    for (const frame::FrameSettings& settings : {small(), exact, small()})
        EXPECT_THROW(renderer.draw(Technique::Forward, settings), InputError);
    for (std::size_t i = 0; i < kMaterials; ++i) normalMap(scene.materials[first + i]).transform = before;
    const std::vector<float> after = renderer.render(Technique::Forward, small()).radiance;
    EXPECT_EQ(after, engine::Renderer(context(), scene).render(Technique::Forward, small()).radiance);
}

TEST_F(Edits, surfacesThatBecomeTransparentAreDrawnAsByANewRenderer) {
    std::size_t next = 0;
    expectSameAsNew(
        [&next](scenes::Scene& scene) {
            while (scene.materials[next].alphaMode == scenes::AlphaMode::Blend) ++next;
            scene.materials[next].alphaMode = scenes::AlphaMode::Blend;
            scene.materials[next].baseColor.w = 0.4f;
            ++next;
        },
        true);
}

TEST_F(Edits, aModelThatNoMaterialHadIsDrawnAsByANewRenderer) {
    std::size_t next = 0;
    expectSameAsNew(
        [&next](scenes::Scene& scene) {
            scenes::Material& material = scene.materials[next++];
            material.model = material.model == scenes::MaterialModel::SingleColor ? scenes::MaterialModel::Lambert
                                                                                  : scenes::MaterialModel::SingleColor;
        },
        true);
}

TEST_F(Edits, lightsAndCamerasAreDrawnAsTheyAre) {
    expectSameAsNew(
        [](scenes::Scene& scene) {
            scene.lights.front().intensity *= 2.0f;
            scene.lights.push_back(test::pointLight({0.0, 1.0, 2.0}, 3.0f));
            scene.cameras.front().worldFromCamera[3] += glm::dvec4(0.1, 0.05, 0.0, 0.0);
        },
        false);
}

} // namespace
} // namespace tessera
