#include "viewer/session/History.h"

#include <array>
#include <filesystem>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "scenes/Fingerprint.h"
#include "scenes/Load.h"
#include "scenes/Rest.h"
#include "scenes/write/SceneText.h"
#include "tests/unit/scenes/RiggedScene.h"
#include "tests/unit/viewer/Scenes.h"
#include "viewer/edit/LightLife.h"

namespace tessera::viewer {
namespace {

using test::opened;
using test::settle;

std::string textOf(const OpenScene& open) {
    return scenes::sceneText(open.scene(), open.origin(), std::filesystem::temp_directory_path() / "edited.json",
                             open.environmentView());
}

void undoAll(OpenScene& open) {
    while (open.undo() != nullptr) {
    }
}
void redoAll(OpenScene& open) {
    while (open.redo() != nullptr) {
    }
}

/// Random edits and jumps of all kinds, as the window makes them.
class RandomEdits {
public:
    explicit RandomEdits(OpenScene& open, std::uint64_t seed = 1) : open_(open), engine_(seed) {}

    /// Also edits light animation, several lights at once and parameters of a hook. Meanwhile clips play.
    void editOrPlay() {
        const Lights& lights = open_.scene().lights;
        switch (number(8)) {
        case 0:
            for (std::size_t i = number(4); i > 1; --i) static_cast<void>(open_.undo());
            static_cast<void>(open_.showTime(double(share()) * open_.clipSeconds()));
            return;
        case 1:
            return open_.playClip(std::array{"bend", "shine", "none"}[number(3)]);
        case 2: {
            constexpr std::size_t kMany = 6;
            if (lights.size() < kMany)
                return open_.replaceLights("add", number(lights.size() + 1), 0, {newLight(lights, scenes::Light())});
            std::vector<std::size_t> deleted;
            for (std::size_t i = 0; i < lights.size(); ++i)
                if (number(4) == 0) deleted.push_back(i);
            if (!deleted.empty()) open_.deleteLights("delete several", deleted);
            return;
        }
        case 3:
            return open_.changeHookParameter(number(open_.scene().hook->parameters.size()), share());
        case 4:
        case 5:
            if (lights.empty()) return;
            return test::changeLight(open_, number(lights.size()), [this](scenes::Light& light) { changeLife(light); });
        case 6:
            return test::changeMaterial(open_, 0, [this](scenes::Material& material) {
                (number(2) == 0 ? material.metallic : material.perceptualRoughness) = share();
            });
        default:
            return edit();
        }
    }

    void edit() {
        const Lights& lights = open_.scene().lights;
        switch (number(10)) {
        case 0:
            return open_.replaceLights("add", lights.size(), 0, {newLight(lights, scenes::Light())});
        case 1:
            if (!lights.empty()) open_.replaceLights("delete", number(lights.size()), 1, {});
            return;
        case 2:
            return open_.replaceLights("scatter", 0, lights.size(), Lights(number(5)));
        case 3:
            return drag();
        case 4: {
            ChosenEnvironment chosen;
            chosen.name = "environment";
            scenes::Environment& environment = chosen.environment.emplace();
            environment.source = "builtin:studio";
            environment.intensity = float(number(100));
            environment.map = {"map", scenes::TexelFormat::Rgba32Float, 1, 1, std::vector<std::byte>(16)};
            return open_.takeEnvironment(std::move(chosen));
        }
        case 9:
            return turnEnvironment();
        case 5:
            return test::changeMaterial(open_, number(open_.scene().materials.size()),
                                        [this](scenes::Material& material) { material.baseColor.x = share(); });
        case 6:
            open_.jumpToCamera(int(number(open_.cameras().size())));
            return settle(open_);
        case 7:
            open_.jumpHome();
            return settle(open_);
        default:
            open_.jumpToAll(0.5 + share());
            return settle(open_);
        }
    }

private:
    void drag() {
        if (open_.scene().lights.empty()) return;
        const std::size_t index = number(open_.scene().lights.size());
        const auto move = [this](scenes::Light& light) { light.positionWS.x += double(share()) - 0.5; };
        for (int i = 0; i < 3; ++i) test::changeLight(open_, index, move, Gesture::GoesOn);
        open_.endGesture();
    }
    /// Changes the environment, if there is one.
    void turnEnvironment() {
        const bool turns = number(2) == 0;
        for (int i = 0; i < 3; ++i) {
            scenes::EnvironmentView view = open_.environmentView();
            (turns ? view.rotationDegrees : view.intensity) = 100.0f * share();
            open_.changeEnvironmentView(view, Gesture::GoesOn);
        }
        open_.endGesture();
    }
    void changeLife(scenes::Light& light) {
        const scenes::LightTypeInfo& type = scenes::infoOf(light.type);
        const scenes::LightKeyedInfo& info = scenes::keyedMembers()[number(scenes::keyedMembers().size())];
        const double timeSeconds = 4.0 * double(share());
        const glm::dvec3 value(0.1 + double(share()), double(share()), double(share()));
        const scenes::LightKeys* const keys = keysOf(light, info.member);
        const std::size_t key = keys != nullptr ? number(keys->timesSeconds.size()) : 0;
        const bool hasPath = light.animation && light.animation->kind == scenes::LightAnimationKind::Path;
        switch (number(12)) {
        case 0:
            return chooseType(light, scenes::lightTypes()[number(scenes::lightTypes().size())].type, 10.0);
        case 1:
        case 2:
            if (info.isOf(type)) addKey(light, info.member, timeSeconds);
            return;
        case 3:
            if (keys != nullptr) removeKey(light, info.member, key);
            return;
        case 4:
            if (keys != nullptr) moveKey(light, info.member, key, timeSeconds);
            return;
        case 5:
            if (keys != nullptr) setKey(light, info.member, key, value);
            return;
        case 6:
            if (keys != nullptr) setInterpolation(light, info.member, scenes::Interpolation(number(3)));
            return;
        case 7:
            if (type.hasPosition())
                chooseWay(light, scenes::LightAnimationKind(number(4)), timeSeconds, 0.5 + double(share()));
            return;
        case 8:
            if (hasPath) addPathPoint(light, number(light.animation->pointsWS.size()));
            return;
        case 9:
            if (hasPath) removePathPoint(light, number(light.animation->pointsWS.size()));
            return;
        case 10:
            return turnLight(light, value);
        default:
            light.intensity = 10.0f * share();
            light.radiusMetres = share();
            return letFlicker(light, !light.flicker, 0);
        }
    }
    std::size_t number(std::size_t count) { return std::size_t(engine_() % count); }
    float share() { return float(engine_() >> 11) * 0x1p-53f; }

    OpenScene& open_;
    std::mt19937_64 engine_;
};

TEST(History, aThousandUndoneEditsLeaveTheSavedSceneByteForByteAndRedoneOnesTheEdited) {
    const auto open = opened("hall");
    const std::string saved = textOf(*open);
    RandomEdits random(*open);
    for (int i = 0; i < 1000; ++i) random.edit();
    const std::string edited = textOf(*open);
    const std::size_t steps = open->history().undoable();
    EXPECT_GT(steps, 500u) << "some were nothing to do, as a jump to where the camera is";
    EXPECT_NE(edited, saved);
    for (int i = 0; i < 2; ++i) {
        undoAll(*open);
        EXPECT_EQ(textOf(*open), saved);
        EXPECT_FALSE(open->isEdited());
        redoAll(*open);
        EXPECT_EQ(textOf(*open), edited);
        EXPECT_TRUE(open->isEdited());
        EXPECT_EQ(open->history().undoable(), steps);
    }
}

TEST(History, editsUndoneInAnyOrderWithNewOnesLeadBackToo) {
    const auto open = opened("room");
    const std::string saved = textOf(*open);
    RandomEdits random(*open);
    std::mt19937_64 engine(2);
    for (int i = 0; i < 300; ++i) {
        switch (engine() % 4) {
        case 0:
            open->undo();
            break;
        case 1:
            open->redo();
            break;
        default:
            random.edit();
        }
        EXPECT_EQ(open->history().undoText() != nullptr, open->history().undoable() > 0);
    }
    undoAll(*open);
    EXPECT_EQ(textOf(*open), saved);
    EXPECT_FALSE(open->isEdited());
}

/// A model with two clips that both move a light; "shine" also changes the material. Has a hook of two parameters.
scenes::Scene livelyScene() {
    scenes::Scene scene = scenes::riggedScene();
    scene.rig.cameras.clear();
    scene.cameras = {test::perspective({0, 0, 9}, {0, 0, 0}), test::perspective({0, 9, 9}, {0, 0, 0})};
    scene.rig.numbers.push_back({scenes::AnimatedProperty::Metallic, 0});
    scenes::Clip& shine = scene.rig.clips.emplace_back();
    shine.name = "shine";
    shine.samplers = {{scenes::Interpolation::Linear, 1, {0.0f, 2.0f}, {0.5f, 1.0f}},
                      {scenes::Interpolation::Linear, 3, {0.0f, 1.0f}, {1, 0, 0, 3, 0, 0}}};
    shine.channels = {{scenes::AnimatedProperty::Metallic, 1, 0}, {scenes::AnimatedProperty::Translation, 0, 1}};
    scene.materials[0].metallic = 0.125f;
    scene.lights.emplace_back().type = scenes::LightType::Rectangle;
    scene.hook.emplace().parameters = {{"strength", 0.5f, 0.0f, 1.0f}, {"speed", 1.0f, 0.0f, 1.0f}};
    scenes::takeRest(scene);
    return scene;
}

TEST(History, aThousandEditsOfALivelySceneAreUndoneAndRedoneWhateverPlaysMeanwhile) {
    for (const std::uint64_t seed : {11u, 12u, 13u, 14u}) {
        SCOPED_TRACE(seed);
        OpenScene open("lively.gltf", {}, livelyScene(), {});
        const auto fingerprint = [&open] { // at the beginning of a clip
            open.playClip("bend");
            return scenes::fingerprint(open.scene());
        };
        const std::uint64_t saved = fingerprint();
        const Lights lights = open.scene().lights;
        const std::vector<scenes::Material> materials = open.scene().materials;
        RandomEdits random(open, seed);
        for (int i = 0; i < 1000; ++i) random.editOrPlay();
        redoAll(open); // the last of them may have been undone
        const std::uint64_t edited = fingerprint();
        const scenes::EnvironmentView turned = open.environmentView();
        EXPECT_GT(open.history().undoable(), 200u);
        EXPECT_NE(edited, saved);
        const auto stepAll = [&](const Edit* (OpenScene::*step)()) {
            for (int i = 0; (open.*step)() != nullptr; ++i)
                if (i % 7 == 0) static_cast<void>(open.showTime(0.125 * double(i % 8)));
        };
        stepAll(&OpenScene::undo);
        EXPECT_FALSE(open.isEdited());
        EXPECT_EQ(fingerprint(), saved);
        EXPECT_TRUE(open.scene().lights == lights);
        EXPECT_TRUE(open.scene().materials == materials);
        EXPECT_EQ(open.environmentView(), scenes::EnvironmentView());
        stepAll(&OpenScene::redo);
        EXPECT_EQ(fingerprint(), edited);
        EXPECT_EQ(open.environmentView(), turned);
    }
}

TEST(History, oneDragIsOneStepAndTheNextAnother) {
    const auto open = opened("room");
    const scenes::Light before = open->scene().lights.at(0);
    scenes::Light light = before;
    for (int drag = 0; drag < 2; ++drag) {
        for (int i = 0; i < 5; ++i) {
            light.intensity += 1.0f;
            open->changeLight(0, light, Gesture::GoesOn);
        }
        open->endGesture();
    }
    EXPECT_EQ(open->history().undoable(), 2u);
    open->undo();
    EXPECT_EQ(open->scene().lights[0].intensity, before.intensity + 5.0f);
    open->undo();
    EXPECT_TRUE(open->scene().lights[0] == before);
    open->redo();
    EXPECT_EQ(open->scene().lights[0].intensity, before.intensity + 5.0f) << "the end of the drag, not its beginning";
    // An edit without change is no step, and edits of several elements are several steps.
    open->changeLight(0, open->scene().lights[0]);
    EXPECT_EQ(open->history().redoable(), 1u);
    open->changeLight(0, before, Gesture::GoesOn);
    scenes::Material material = open->scene().materials.at(0);
    material.doubleSided = !material.doubleSided;
    open->changeMaterial(0, material, Gesture::GoesOn);
    EXPECT_EQ(open->history().undoable(), 3u);
}

TEST(History, aDragThatGoesOnAfterASaveIsUndoneToWhatWasSaved) {
    const auto open = opened("room");
    scenes::Light light = open->scene().lights.at(0);
    light.intensity = 0.25f;
    open->changeLight(0, light, Gesture::GoesOn);
    open->becomes("/saved.json");
    EXPECT_FALSE(open->isEdited());
    light.intensity = 0.5f;
    open->changeLight(0, light, Gesture::GoesOn);
    EXPECT_TRUE(open->isEdited());
    open->undo();
    EXPECT_FALSE(open->isEdited());
    EXPECT_EQ(open->scene().lights[0].intensity, 0.25f);
    open->undo();
    EXPECT_TRUE(open->isEdited()) << "the file has what was undone";
}

TEST(History, aSaveLeavesJumpsThatLeadWhereTheyLed) {
    const auto open = opened("room");
    test::turnCamera(*open);
    const CameraPose turned = open->rig().pose();
    open->jumpHome();
    settle(*open);
    open->becomes("/saved.json");
    ASSERT_NE(open->undo(), nullptr);
    EXPECT_EQ(open->rig().pose(), turned);
    const scenes::Camera& file = open->cameras()[std::size_t(open->camera())];
    EXPECT_EQ(scenes::changedCamera(file, open->cameraChange()), open->scene().cameras[std::size_t(open->camera())])
        << "the command that renders it says another camera";
}

TEST(History, environmentsComeBackWithTheirFilterAndWarnings) {
    const auto open = opened("room");
    ChosenEnvironment chosen;
    chosen.name = "/maps/sunset.hdr";
    chosen.environment.emplace().source = "/maps/sunset.hdr";
    chosen.filtered = std::make_shared<frame::FilteredEnvironment>();
    chosen.warnings = {"of the map"};
    const auto filtered = chosen.filtered;
    const std::vector<std::string> warnings = open->scene().warnings;
    const auto before = open->filteredEnvironment();
    open->takeEnvironment(std::move(chosen));
    EXPECT_EQ(*open->history().undoText(), "choose environment 'sunset.hdr'");
    open->undo();
    EXPECT_EQ(open->filteredEnvironment(), before);
    EXPECT_EQ(open->scene().warnings, warnings);
    EXPECT_EQ(open->environmentRevision(), 2u) << "the renderer gets the change";
    open->redo();
    EXPECT_EQ(open->filteredEnvironment(), filtered);
    EXPECT_EQ(open->scene().warnings.back(), "of the map");
}

TEST(History, textsSayWhatWasDoneAndToWhat) {
    const scenes::Light light;
    const auto text = [&light](auto change) {
        scenes::Light changed = light;
        change(changed);
        return changeText(light, changed, "lamp 3");
    };
    EXPECT_EQ(text([](scenes::Light& l) { l.positionWS.x = 2.0; }), "move light 'lamp 3'");
    EXPECT_EQ(text([](scenes::Light& l) { l.directionWS = {1.0, 0.0, 0.0}; }), "turn light 'lamp 3'");
    EXPECT_EQ(text([](scenes::Light& l) { l.enabled = false; }), "switch off light 'lamp 3'");
    EXPECT_EQ(text([](scenes::Light& l) { l.color.x = 0.5f; }), "colour light 'lamp 3'");
    EXPECT_EQ(text([](scenes::Light& l) { l.widthMetres = 3.0f; }), "resize light 'lamp 3'");
    EXPECT_EQ(text([](scenes::Light& l) { l.animation.emplace(); }), "animate light 'lamp 3'");
    EXPECT_EQ(text([](scenes::Light& l) { l.flicker.emplace(); }), "change flicker of light 'lamp 3'");
    EXPECT_EQ(text([](scenes::Light& l) { l.keyframes.emplace_back(); }), "change keyframes of light 'lamp 3'");
    EXPECT_EQ(text([](scenes::Light& l) { l.castsShadow = true; }), "change light 'lamp 3'");
    scenes::Light keyed = light;
    keyed.keyframes.emplace_back().of = scenes::LightKeyed::Color;
    scenes::Light stopped = keyed;
    stopped.color.x = 0.5f;
    stopped.keyframes.clear();
    EXPECT_EQ(changeText(keyed, stopped, "lamp"), "stop light 'lamp'");
    scenes::Light moving = light, slower;
    moving.animation.emplace().pointsWS = {{0, 0, 0}, {1, 0, 0}};
    slower = moving;
    slower.animation->periodSeconds = 9.0;
    EXPECT_EQ(changeText(moving, slower, "lamp"), "change path of light 'lamp'");
    slower = moving;
    placeLight(slower, 0.0, {5, 0, 0});
    EXPECT_EQ(changeText(moving, slower, "lamp"), "move light 'lamp'");
    scenes::Material material, glowing;
    glowing.emissive.x = 1.0f;
    EXPECT_EQ(changeText(material, glowing, "glass"), "change emission of material 'glass'");
}

} // namespace
} // namespace tessera::viewer
