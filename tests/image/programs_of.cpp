// Which programs a frame needs, told before it is drawn: the window says so while it compiles them.
#include <algorithm>
#include <functional>
#include <set>
#include <string>

#include "engine/Renderer.h"
#include "scenes/Load.h"
#include "tests/support/GlContext.h"

namespace tessera {
namespace {

using engine::Technique;

class ProgramsOf : public test::GlTest {
protected:
    /// Draws, and holds what was told to what was compiled.
    void expectTold(engine::Renderer& renderer, const frame::FrameSettings& settings, const char* what, bool isOther) {
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

TEST_F(ProgramsOf, tellsWhatAnEditMakesDrawingCompile) {
    scenes::Scene scene = scenes::loadScene("room");
    scenes::Light light = scene.lights.at(0); // in view
    scene.lights.clear();
    light.type = scenes::LightType::Point;
    light.castsShadow = false;
    light.radiusMetres = 0.0f;
    light.falloff = scenes::Light().falloff;
    scene.lights.reserve(2); // its place stays
    scene.lights.push_back(light);
    frame::FrameSettings settings;
    settings.sizePixels = {32, 18};
    engine::Renderer renderer(context(), scene);
    expectTold(renderer, settings, "the first frame", true);
    expectTold(renderer, settings, "the same again", false);

    struct Edit {
        const char* what;
        bool isOther; ///< needs other programs than all before
        std::function<void()> edit;
    };
    scenes::Light& own = scene.lights[0];
    const Edit edits[] = {
        {"a place", false, [&] { own.positionWS.y += 0.1; }},
        {"a colour", false,
         [&] {
             own.color = {1.0f, 0.5f, 0.25f};
         }},
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
        {"a paint", false,
         [&] {
             scene.materials[0].baseColor = {0.1f, 0.2f, 0.3f, 1.0f};
         }},
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
        expectTold(renderer, settings, edit.what, edit.isOther);
    }
}

} // namespace
} // namespace tessera
