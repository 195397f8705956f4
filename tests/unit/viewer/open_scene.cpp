// Opened scenes: their cameras and hooks.
#include "viewer/session/OpenScene.h"

#include <glm/trigonometric.hpp>

#include "base/Error.h"
#include "scenes/write/SceneText.h"
#include "tests/support/TestScenes.h"
#include "tests/unit/viewer/Scenes.h"
#include "viewer/session/Keys.h"

namespace tessera::viewer {
namespace {

using namespace test;

/// A scene with a perspective and an orthographic camera.
struct Opened {
    OpenScene open{"test.json", {}, made(), {}};

    static scenes::Scene made() {
        scenes::Scene scene;
        scene.cameras = {perspective({-3.2, 1.8, 4.9}, {0, 1, 0}), orthographic({3, 4, 5}, {0, 1, 0}, 2.5)};
        return scene;
    }
    const scenes::Camera& shown() const { return open.scene().cameras[std::size_t(open.camera())]; }
    /// The camera of `tessera render` with the copied command.
    scenes::Camera said() const {
        return scenes::changedCamera(made().cameras[std::size_t(open.camera())], open.cameraChange());
    }
    void move() {
        open.rig().rotate({120.0, 30.0}, kHeightPixels);
        open.rig().zoom(0.7, {}, kHeightPixels);
        settle();
    }
    void settle() { test::settle(open); }
    void goHome() {
        open.rig().goHome();
        settle();
    }
    void turn() { turnCamera(open); }
};

/// Every kind of change that the command line can make to a perspective camera.
std::vector<scenes::CameraChange> changes() {
    std::vector<scenes::CameraChange> list(7);
    list[0].fovYDegrees = 20.0;
    list[1].nearMetres = 3.0;
    list[2].farMetres = 1e3 / 3.0;
    list[3].eyeWS = glm::dvec3(0.1, 2.0, -7.0 / 3.0);
    list[4].targetWS = glm::dvec3(1.0, 0.2, 0.3);
    list[5].upWS = glm::dvec3(1.0, 1.0, 0.1);
    list[6] = {glm::dvec3(0.1, 2.0, 9.0), glm::dvec3(0, 1, 0), glm::dvec3(1, 1, 0), 100.0 / 3.0, {}, 1.0 / 3.0, 77.7};
    return list;
}

TEST(OpenScene, aPlacedCameraEqualsItsCommandToTheLastBit) {
    for (const scenes::CameraChange& change : changes()) {
        Opened opened;
        opened.open.place(change);
        const scenes::Camera camera = scenes::changedCamera(Opened::made().cameras[0], change);
        EXPECT_EQ(opened.shown(), camera);
        EXPECT_EQ(opened.open.cameraChange(), change);
        opened.move();
        EXPECT_NE(opened.shown(), camera);
        opened.goHome();
        EXPECT_EQ(opened.shown(), camera);
        EXPECT_EQ(opened.open.cameraChange(), change);
    }
}

TEST(OpenScene, aFieldOfViewChangesInItsPlaceAndHomeStaysHome) {
    Opened opened;
    opened.move();
    const CameraPose pose = opened.open.rig().pose();
    const scenes::Camera before = opened.shown();
    opened.open.changeFieldOfView(31.5, Gesture::Once);
    EXPECT_EQ(opened.open.rig().pose(), pose);
    EXPECT_NEAR(glm::degrees(opened.shown().fovYRadians), 31.5, 1e-12);
    EXPECT_EQ(opened.said(), opened.shown());
    opened.open.undo();
    EXPECT_EQ(opened.shown(), before);
    opened.open.redo();
    opened.goHome();
    EXPECT_EQ(opened.shown().worldFromCamera, Opened::made().cameras[0].worldFromCamera);
    EXPECT_EQ(opened.said(), opened.shown());
    EXPECT_FALSE(opened.open.isEdited());
}

TEST(OpenScene, aCameraMovedByNumbersIsOneStepADragAndItsCommandReproducesIt) {
    Opened opened;
    const scenes::Camera before = opened.shown();
    const CameraPose pose = opened.open.rig().pose();
    for (const double x : {1.0, 2.0})
        opened.open.moveCamera(between(pose, {x, 3.0, 4.0}, {0.0, 1.0, 0.0}), Gesture::GoesOn);
    opened.open.endGesture();
    EXPECT_FALSE(opened.open.isEdited());
    EXPECT_EQ(opened.open.rig().pose().eyeWS, glm::dvec3(2.0, 3.0, 4.0));
    EXPECT_LT(glm::distance(targetOf(opened.open.rig().pose()), glm::dvec3(0.0, 1.0, 0.0)), 1e-12);
    EXPECT_EQ(opened.said(), opened.shown());
    opened.open.undo();
    EXPECT_EQ(opened.shown(), before);
    EXPECT_EQ(between(pose, pose.eyeWS, pose.eyeWS), pose) << "there is no way from a point to itself";
}

TEST(OpenScene, aViewpointIsStoredGoneToRemovedUndoneAndSavedAsACamera) {
    Opened opened;
    opened.move();
    const scenes::Camera stored = opened.shown();
    opened.open.storeViewpoint();
    EXPECT_TRUE(opened.open.isEdited());
    ASSERT_EQ(opened.open.viewpoints().size(), 1u);
    EXPECT_EQ(opened.open.viewpoints()[0].name, "view 1");
    EXPECT_EQ(opened.open.viewpoints()[0].worldFromCamera, stored.worldFromCamera);
    opened.goHome();
    opened.open.changeFieldOfView(20.0, Gesture::Once);
    opened.open.storeViewpoint();
    EXPECT_EQ(opened.open.viewpoints()[1].name, "view 2");
    opened.open.jumpToViewpoint(0);
    opened.settle();
    EXPECT_LT(glm::distance(opened.shown().worldFromCamera[3], stored.worldFromCamera[3]), 1e-9);
    EXPECT_LT(glm::distance(opened.shown().worldFromCamera[2], stored.worldFromCamera[2]), 1e-9);
    EXPECT_NEAR(opened.shown().fovYRadians, stored.fovYRadians, 1e-12);
    const std::string text =
        scenes::sceneText(opened.open.scene(), opened.open.origin(), "saved.json", {}, opened.open.viewpoints());
    EXPECT_LT(text.find("\"view 1\""), text.find("\"view 2\""));
    opened.open.removeViewpoint(0);
    ASSERT_EQ(opened.open.viewpoints().size(), 1u);
    EXPECT_EQ(opened.open.viewpoints()[0].name, "view 2");
    EXPECT_EQ(*opened.open.history().undoText(), "remove 'view 1'");
    opened.open.undo();
    EXPECT_EQ(opened.open.viewpoints().size(), 2u);
}

TEST(OpenScene, looksAlongAnAxisAboutWhatItTurnsAbout) {
    Opened opened;
    opened.move();
    const glm::dvec3 pivotWS = targetOf(opened.open.rig().pose());
    const double metres = opened.open.rig().pose().focusMetres;
    const glm::dvec3 towardsEyeWS[] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    for (std::size_t i = 0; i < axisViews().size(); ++i) {
        opened.open.jumpToHeading("look", axisViews()[i].heading, 1.5);
        opened.settle();
        EXPECT_LT(glm::distance(glm::dvec3(opened.shown().worldFromCamera[3]), pivotWS + metres * towardsEyeWS[i]),
                  1e-6)
            << axisViews()[i].name;
        EXPECT_LT(glm::distance(targetOf(opened.open.rig().pose()), pivotWS), 1e-6);
        EXPECT_EQ(opened.said(), opened.shown());
    }
}

TEST(OpenScene, looksAlongAnAxisAtAllOfASceneThatItIsOutsideOf) {
    scenes::Scene scene = tessera::test::quadScene({});
    scene.cameras = {perspective({-3.2, 1.8, 9.9}, {4, 1, 0})}; // turns about a point beside the quad
    OpenScene open{"test.json", {}, std::move(scene), {}};
    for (const AxisView& view : axisViews()) {
        open.jumpToHeading("look", view.heading, 1.5);
        test::settle(open);
        EXPECT_LT(glm::length(targetOf(open.rig().pose())), 1e-6) << view.name;
    }
}

TEST(OpenScene, theCommandOfAMovedCameraReproducesIt) {
    for (const scenes::CameraChange& change : changes()) {
        Opened opened;
        opened.open.place(change);
        opened.turn();
        EXPECT_EQ(opened.said(), opened.shown());
        for (const double factor : {1.0, 0.3, 5.0}) {
            opened.move();
            opened.open.rig().zoom(factor, {}, kHeightPixels);
            opened.settle();
            EXPECT_EQ(opened.said(), opened.shown());
            EXPECT_EQ(opened.shown().fovYRadians, scenes::changedCamera(Opened::made().cameras[0], change).fovYRadians);
        }
    }
    Opened parallel;
    parallel.open.useCamera(1);
    parallel.open.place(changing(&Change::halfHeightMetres, 0.7));
    EXPECT_EQ(parallel.shown().halfHeightMetres, 0.7);
    parallel.turn();
    EXPECT_EQ(parallel.said(), parallel.shown());
    EXPECT_EQ(parallel.shown().halfHeightMetres, 0.7);
    parallel.move();
    EXPECT_EQ(parallel.said(), parallel.shown());
}

TEST(OpenScene, orbitingTurnsAboutTheGivenTarget) {
    Opened opened;
    const scenes::CameraChange change =
        changing(&Change::eyeWS, glm::dvec3(0, 1, 9), &Change::targetWS, glm::dvec3(2, 1, 3));
    opened.open.place(change);
    opened.open.rig().rotate({200.0, -40.0}, kHeightPixels);
    opened.settle();
    const glm::dvec3 shown = shownAt(opened.shown(), *change.targetWS);
    EXPECT_NEAR(glm::length(glm::dvec2(shown)), 0.0, 1e-9);
    EXPECT_NEAR(shown.z, glm::distance(*change.eyeWS, *change.targetWS), 1e-12);
}

TEST(OpenScene, orbitingTurnsAboutWhatIsSeenInTheMiddleAndNotAboutTheMiddleOfTheScene) {
    scenes::Scene scene = Opened::made();
    scene.cameras.resize(1);
    scene.cameras[0] = perspective({0, 0, 9}, {0, 0, 0});
    // A wall far behind a small plate, which is two metres before the eye.
    const auto add = [&](double z, float side) {
        scenes::Mesh plate = tessera::test::quad();
        for (glm::vec3& position : plate.positionsOS) position *= side;
        scenes::Node node;
        node.parentFromNode[3] = glm::dvec4(0.0, 0.0, z, 1.0);
        node.instances = {{int(scene.meshes.size()), 0}};
        scene.meshes.push_back(plate);
        scene.nodes.push_back(node);
    };
    scene.materials.resize(1);
    add(-40.0, 30.0f);
    add(7.0, 0.1f);
    const OpenScene open{"test.json", {}, scene, {}};
    EXPECT_NEAR(open.rig().pose().focusMetres, 2.0, 1e-9);
}

TEST(OpenScene, aRefusedPlaceNeverChangesAnything) {
    Opened opened;
    EXPECT_THROW(opened.open.place(changing(&Change::halfHeightMetres, 1.0)), InputError);
    EXPECT_EQ(opened.shown(), Opened::made().cameras[0]);
    EXPECT_EQ(opened.open.cameraChange(), scenes::CameraChange());
}

TEST(OpenScene, anotherCameraIsNotPlacedAsTheOneBefore) {
    Opened opened;
    opened.open.place(changes()[6]);
    opened.open.useCamera(1);
    EXPECT_EQ(opened.shown(), Opened::made().cameras[1]);
    EXPECT_EQ(opened.open.cameraChange(), scenes::CameraChange());
    opened.open.useCamera(0);
    EXPECT_EQ(opened.shown(), Opened::made().cameras[0]);
    EXPECT_EQ(opened.open.cameraChange(), scenes::CameraChange());
}

TEST(OpenScene, savingMovesNeitherPictureNorPivotNorMovements) {
    Opened opened, other;
    for (Opened* one : {&opened, &other}) {
        one->open.place(changes()[6]);
        one->open.rig().pan({300.0, 50.0}, kHeightPixels);
        one->open.rig().zoom(0.3, {}, kHeightPixels);
        one->open.rig().advance(0.05, kHeightPixels);
        one->open.applyRig();
    }
    const scenes::Camera saved = opened.shown();
    opened.open.becomes("/saved.json");
    EXPECT_EQ(opened.shown(), saved);
    EXPECT_EQ(opened.open.cameras()[0], saved);
    EXPECT_EQ(opened.open.cameraChange(), scenes::CameraChange()) << "the file's own camera is shown";
    for (Opened* one : {&opened, &other}) {
        one->settle();
        one->move();
    }
    EXPECT_EQ(opened.shown(), other.shown());
    EXPECT_EQ(scenes::changedCamera(saved, opened.open.cameraChange()), opened.shown());
    opened.goHome();
    EXPECT_EQ(opened.shown(), saved) << "home is the camera that was saved";
}

TEST(OpenScene, aDragOfAHooksParameterIsOneStepAndIsUndone) {
    scenes::Scene scene = Opened::made();
    scene.hook.emplace().parameters = {{"windStrength", 0.5f, 0.0f, 2.0f}, {"speed", 1.0f, 0.0f, 3.0f}};
    OpenScene open("test.json", {}, scene, {});
    const auto strength = [&] { return open.scene().hook->parameters[0].value; };
    open.changeHookParameter(0, 0.5f);
    EXPECT_FALSE(open.isEdited()) << "it has that value";
    for (const float value : {0.75f, 1.0f, 1.25f}) open.changeHookParameter(0, value, Gesture::GoesOn);
    open.changeHookParameter(1, 2.0f, Gesture::GoesOn);
    open.endGesture();
    EXPECT_EQ(open.history().undoable(), 2u);
    ASSERT_NE(open.history().undoText(), nullptr);
    EXPECT_EQ(*open.history().undoText(), "change 'speed' of the hook");
    const std::uint64_t revision = open.revision();
    open.undo();
    open.undo();
    EXPECT_EQ(strength(), 0.5f);
    EXPECT_EQ(open.scene().hook->parameters[1].value, 1.0f);
    EXPECT_GT(open.revision(), revision);
    EXPECT_FALSE(open.isEdited());
    open.redo();
    EXPECT_EQ(strength(), 1.25f);
}

/// A scene in a variant with a material of its own after the common one.
scenes::Scene inVariant(const char* ownMaterial) {
    scenes::Scene scene = Opened::made();
    for (const char* name : {"paint", ownMaterial}) scene.materials.emplace_back().name = name;
    scene.lights.resize(2);
    return scene;
}

template <class Change>
void edit(OpenScene& open, const Change& change) {
    scenes::Light light = open.scene().lights[1];
    scenes::Material material = open.scene().materials[0];
    change(light, material);
    open.changeLight(1, light);
    open.changeMaterial(0, material);
}

TEST(OpenScene, namesAndViewpointsDrawNothingAnew) {
    OpenScene open("model.gltf", {}, inVariant("ruby"), {});
    const std::uint64_t pictureEdits = open.pictureEdits(), revision = open.revision();
    scenes::Light light = open.scene().lights[0];
    light.name = "lamp";
    open.changeLight(0, light);
    open.storeViewpoint();
    EXPECT_EQ(open.scene().lights[0], light);
    EXPECT_EQ(open.edits(), 2u);
    EXPECT_EQ(open.pictureEdits(), pictureEdits);
    EXPECT_EQ(open.revision(), revision);
    light.intensity *= 2.0f;
    open.changeLight(0, light);
    EXPECT_GT(open.pictureEdits(), pictureEdits);
    EXPECT_GT(open.revision(), revision);
}

TEST(OpenScene, anotherVariantOfTheMaterialsGoesOnWithTheEdits) {
    for (const bool isSaved : {false, true}) {
        OpenScene before("model.gltf", {}, inVariant("ruby"), {});
        edit(before, [](scenes::Light& light, scenes::Material& material) {
            light.intensity = 3.0f;
            material.perceptualRoughness = 0.25f;
        });
        // The saved file has these edits.
        scenes::Scene loaded = inVariant("sky");
        if (isSaved) {
            before.storeViewpoint();
            before.becomes("saved.json");
            loaded.lights = before.scene().lights;
            loaded.materials[0] = before.scene().materials[0];
            loaded.cameras.push_back(before.viewpoints()[0]);
        }
        before.jumpToCamera(1);
        edit(before, [](scenes::Light& light, scenes::Material&) { light.intensity = 5.0f; });
        ASSERT_NE(before.undo(), nullptr);
        ASSERT_TRUE(before.canGoOnAs(loaded));
        const scenes::Light light = before.scene().lights[1];
        const scenes::Material material = before.scene().materials[0];

        OpenScene now("model.gltf", {}, loaded, {});
        now.goOnFrom(before);
        EXPECT_EQ(now.scene().lights[1], light);
        EXPECT_EQ(now.scene().materials[0], material);
        EXPECT_EQ(now.scene().materials[1].name, "sky");
        EXPECT_EQ(now.camera(), 0) << "a jump of the other moves this one's camera";
        EXPECT_EQ(now.environmentView(), before.environmentView());
        EXPECT_EQ(now.isEdited(), !isSaved);
        EXPECT_EQ(now.viewpoints().size(), isSaved ? 1u : 0u);
        EXPECT_EQ(now.scene().cameras.size(), inVariant("sky").cameras.size()) << "viewpoints are not cameras";
        EXPECT_EQ(now.history().undoable(), isSaved ? 4u : 3u);
        ASSERT_NE(now.redo(), nullptr);
        EXPECT_EQ(now.scene().lights[1].intensity, 5.0f);
        now.useCamera(1); // as it was before
        now.undo();
        EXPECT_EQ(now.camera(), 1);
        now.undo();
        EXPECT_EQ(now.camera(), 0) << "where the jump began";
        while (now.undo() != nullptr) {
        }
        EXPECT_EQ(now.scene().lights, inVariant("sky").lights);
        EXPECT_EQ(now.scene().materials, inVariant("sky").materials);
        EXPECT_EQ(now.isEdited(), isSaved);
    }
}

TEST(OpenScene, aVariantDoesNotGoOnWithEditsOfMaterialsThatItLacksOrFromAStateThatNoStepLeadsTo) {
    OpenScene open("model.gltf", {}, inVariant("ruby"), {});
    const auto changeOwn = [&](float roughness) {
        changeMaterial(open, 1, [&](scenes::Material& material) { material.perceptualRoughness = roughness; });
    };
    EXPECT_TRUE(open.canGoOnAs(inVariant("sky")));
    changeOwn(0.25f);
    EXPECT_FALSE(open.canGoOnAs(inVariant("sky")));
    EXPECT_TRUE(open.canGoOnAs(inVariant("ruby")));
    const auto goesOnIf = [&](const auto& change) {
        scenes::Scene other = inVariant("ruby");
        change(other);
        return open.canGoOnAs(other);
    };
    EXPECT_FALSE(goesOnIf([](scenes::Scene& fewer) { fewer.materials.pop_back(); }));
    EXPECT_FALSE(
        goesOnIf([](scenes::Scene& other) { other.materials[1].texture(scenes::TextureSlot::BaseColor).image = 0; }));
    EXPECT_FALSE(goesOnIf([](scenes::Scene& fewer) { fewer.lights.pop_back(); }));
    EXPECT_FALSE(goesOnIf([](scenes::Scene& other) { other.lights[1].type = scenes::LightType::Directional; }));
    EXPECT_FALSE(goesOnIf([](scenes::Scene& other) { other.materials[1].thicknessMetres += 1.0f; }));
    EXPECT_FALSE(goesOnIf([](scenes::Scene& other) {
        other.rig.numbers.emplace_back().property = scenes::AnimatedProperty::LightIntensity;
    }));
    open.becomes("saved.json");
    open.undo();
    changeOwn(0.75f); // replaces the saved edit
    EXPECT_FALSE(open.canGoOnAs(inVariant("ruby")));
}

} // namespace
} // namespace tessera::viewer
