// Which edits of a scene the window takes for such that need other programs.
#include "viewer/show/EditedFeatures.h"

#include <functional>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "engine/Renderer.h"
#include "scenes/Load.h"

namespace tessera::viewer {
namespace {

using EditOfScene = std::function<void(scenes::Scene& scene)>;

std::set<std::string> programsOf(const scenes::Scene& scene) {
    frame::FrameSettings settings;
    settings.sizePixels = {64, 64};
    std::set<std::string> keys;
    for (const shader::ProgramDesc& program : engine::framePrograms(scene, engine::Technique::Deferred, settings))
        keys.insert(program.key());
    return keys;
}

scenes::Scene roomOfOneLight() {
    scenes::Scene scene = scenes::loadScene("room");
    scenes::Light light = scene.lights.at(0); // in view
    light.type = scenes::LightType::Point;
    light.castsShadow = false;
    light.radiusMetres = 0.1f;
    scene.lights = {light};
    return scene;
}

TEST(EditedFeatures, changeWithEditsThatNeedOtherPrograms) {
    const scenes::Scene scene = roomOfOneLight();
    const auto expectOther = [&](const char* what, const EditOfScene& edit) {
        scenes::Scene edited = scene;
        edit(edited);
        EXPECT_NE(programsOf(edited), programsOf(scene)) << what << ": the test lacks its point";
        EXPECT_NE(editedFeatures(edited), editedFeatures(scene)) << what;
    };
    for (const scenes::LightTypeInfo& type : scenes::lightTypes())
        if (type.type != scenes::LightType::Point)
            expectOther(type.name.data(), [&](scenes::Scene& its) { its.lights[0].type = type.type; });
    expectOther("its first light of a type", [](scenes::Scene& its) {
        its.lights.push_back(its.lights[0]);
        its.lights.back().type = scenes::LightType::Spot;
    });
    expectOther("its last light", [](scenes::Scene& its) { its.lights.clear(); });
    expectOther("a light that is off", [](scenes::Scene& its) { its.lights[0].enabled = false; });
    expectOther("a light without any", [](scenes::Scene& its) { its.lights[0].intensity = 0.0f; });
    expectOther("another falloff", [](scenes::Scene& its) { its.lights[0].falloff = scenes::Falloff::Attenuation; });
    expectOther("shadows", [](scenes::Scene& its) { its.lights[0].castsShadow = true; });
    expectOther("another model", [](scenes::Scene& its) {
        for (scenes::Material& material : its.materials)
            material.model = material.model == scenes::MaterialModel::Lambert ? scenes::MaterialModel::BlinnPhong
                                                                              : scenes::MaterialModel::Lambert;
    });
}

TEST(EditedFeatures, stayWhereTheSameProgramsDo) {
    const scenes::Scene scene = roomOfOneLight();
    const auto expectSame = [&](const char* what, const EditOfScene& edit) {
        scenes::Scene edited = scene;
        edit(edited);
        EXPECT_EQ(programsOf(edited), programsOf(scene)) << what << ": the test lacks its point";
        EXPECT_EQ(editedFeatures(edited), editedFeatures(scene)) << what;
    };
    expectSame("a place", [](scenes::Scene& its) { its.lights[0].positionWS.y += 0.1; });
    expectSame("a colour", [](scenes::Scene& its) { its.lights[0].color = {1.0f, 0.5f, 0.25f}; });
    expectSame("a light that is off", [](scenes::Scene& its) {
        its.lights.push_back(its.lights[0]);
        its.lights.back().type = scenes::LightType::Disk;
        its.lights.back().enabled = false;
    });
    expectSame("a paint", [](scenes::Scene& its) { its.materials[0].baseColor = {0.1f, 0.2f, 0.3f, 1.0f}; });
}

} // namespace
} // namespace tessera::viewer
