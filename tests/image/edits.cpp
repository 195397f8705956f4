#include <functional>
#include <set>

#include "base/Error.h"
#include "tests/image/ImageTest.h"

namespace tessera {
namespace {

using engine::Technique;
using namespace test;

/// Edits of a scene that a renderer already draws.
class Edits : public ImageTest {
protected:
    static frame::FrameSettings small() { return ofSize(160, 91); }
    /// Compares the image of a renderer after an edit with a new renderer's.
    void expectSameAsNew(const std::function<void(scenes::Scene&)>& edit, bool ofMaterials,
                         scenes::Scene scene = everythingScene()) {
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
    // With the first scene the G-buffer stores material values, with the second material indices.
    for (const scenes::Scene& scene : {everythingScene(), evenScene()}) {
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
    // Anisotropy and coats are added and removed; other materials keep both features in use.
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
    scenes::Scene scene = everythingScene();
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
            scene.lights.push_back(pointLight({0.0, 1.0, 2.0}, 3.0f));
            scene.cameras.front().worldFromCamera[3] += glm::dvec4(0.1, 0.05, 0.0, 0.0);
        },
        false);
}

/// Programs that a frame needs, listed before it is drawn: the window reports them while it compiles them.
class ProgramsOf : public ImageTest {
protected:
    /// Draws, and compares the programs listed before with those compiled.
    void expectReported(engine::Renderer& renderer, const frame::FrameSettings& settings, const char* what,
                        bool isOther) {
        std::set<std::string> keys;
        for (const shader::ProgramDesc& program : renderer.programsOf(Technique::ClusteredDeferred, settings))
            keys.insert(program.key());
        const bool isLacking = !std::ranges::includes(known_, keys);
        EXPECT_EQ(isLacking, isOther) << what << ": the test lacks its point";
        const std::size_t before = renderer.programs().size();
        renderer.draw(Technique::ClusteredDeferred, settings);
        EXPECT_EQ(renderer.programs().size() > before, isLacking) << what;
        known_.insert(keys.begin(), keys.end());
    }

private:
    std::set<std::string> known_;
};

TEST_F(ProgramsOf, reportsWhatAnEditMakesDrawingCompile) {
    scenes::Scene scene = scenes::loadScene("room");
    scenes::Light light = scene.lights.at(0); // in view
    scene.lights.clear();
    light.type = scenes::LightType::Point;
    light.castsShadow = false;
    light.radiusMetres = 0.0f;
    light.falloff = scenes::Light().falloff;
    scene.lights.reserve(2); // keeps the element's address
    scene.lights.push_back(light);
    frame::FrameSettings settings = ofSize(32, 18);
    engine::Renderer renderer(context(), scene);
    expectReported(renderer, settings, "the first frame", true);
    expectReported(renderer, settings, "the same again", false);

    struct Edit {
        const char* what;
        bool isOther; ///< needs programs that no earlier edit needed
        std::function<void()> edit;
    };
    scenes::Light& own = scene.lights[0];
    const Edit edits[] = {
        {"a place", false, [&] { own.positionWS.y += 0.1; }},
        {"a colour", false, [&] { own.color = glm::vec3(1.0f, 0.5f, 0.25f); }},
        {"shadows", true, [&] { own.castsShadow = true; }},
        {"soft ones", true, [&] { own.radiusMetres = 0.1f; }},
        {"another type", true, [&] { own.type = scenes::LightType::Sphere; }},
        {"the type before", false, [&] { own.type = scenes::LightType::Point; }},
        {"a light that is out of view", false,
         [&] {
             scene.lights.push_back(own);
             scene.lights[1].type = scenes::LightType::Spot;
             scene.lights[1].castsShadow = false;
             scene.lights[1].positionWS = {1e4, 0.0, 0.0};
             scene.lights[1].rangeMetres = 1.0f;
         }},
        {"the same, come into view", true, [&] { scene.lights[1].positionWS = own.positionWS; }},
        {"another falloff", true, [&] { own.falloff = scenes::Falloff::Attenuation; }},
        {"no light", true, [&] { scene.lights.clear(); }},
        {"a paint", false, [&] { scene.materials[0].baseColor = glm::vec4(0.1f, 0.2f, 0.3f, 1.0f); }},
        {"glass", true,
         [&] {
             scene.materials[0].model = scenes::MaterialModel::MetallicRoughness;
             scene.materials[0].transmission = 1.0f;
             scene.materials[0].perceptualRoughness = 0.0f;
         }},
        {"rough glass", true, [&] { scene.materials[0].perceptualRoughness = 0.4f; }},
    };
    for (const Edit& edit : edits) {
        edit.edit();
        renderer.materialsChanged();
        expectReported(renderer, settings, edit.what, edit.isOther);
    }
}

} // namespace
} // namespace tessera
