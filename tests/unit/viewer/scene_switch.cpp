#include "viewer/session/SceneSwitch.h"

#include <chrono>
#include <cmath>
#include <thread>

#include <gmock/gmock.h>

#include "base/Error.h"
#include "tests/support/TempFolder.h"
#include "tests/unit/viewer/Scenes.h"
#include "viewer/save/SaveScene.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

using namespace test;
using tessera::test::TempFolder;
using testing::HasSubstr;

/// Switches scenes as the window does, without a window.
class SceneSwitchTest : public testing::Test {
protected:
    SceneSwitchTest() {
        state_.pictureAspect = kMadeForAspect;
        options_.lookOf = [this](const scenes::Scene& scene, const std::string& source, bool first) {
            firsts_.push_back(first);
            FirstLook look;
            engine::applyRequestedOptions(scene, source, look.look);
            if (!first) return look;
            if (saidCamera_ >= int(scene.cameras.size())) throw InputError("no such camera");
            look.look.settings.camera = saidCamera_;
            look.pose = saidPose_;
            return look;
        };
    }

    void waitForResult() const {
        for (int i = 0; i < 6000 && !switch_.hasResult(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        EXPECT_TRUE(switch_.hasResult()) << "after a minute";
    }
    /// Opens a scene and waits for it. Returns whether it is open; otherwise failure_ holds the reason.
    bool open(const std::string& source, const scenes::LoadOptions& load = {}) {
        switch_.open(source, load);
        waitForResult();
        try {
            std::unique_ptr<OpenScene> scene = switch_.take([this](const OpenScene&) {
                if (cannotShow_) throw std::runtime_error("no memory");
            });
            EXPECT_TRUE(scene);
            state_.open = std::move(scene);
            return true;
        } catch (const std::exception& error) {
            failure_ = error.what();
            return false;
        }
    }

    /// A scene of two cameras, which other scenes lack.
    std::string sceneFile(const std::string& name) {
        return folder_
            .write(name, R"({"tessera": 1, "base": {"file": "builtin:room"},
                "cameras": [{"name": "front", "position": [0, 1, 4], "target": [0, 1, 0]},
                            {"name": "side", "position": [4, 1, 0], "target": [0, 1, 0]}]})")
            .string();
    }

    const scenes::Camera& shown() const { return state_.open->scene().cameras[std::size_t(state_.open->camera())]; }

    void moveCamera() { turnCamera(*state_.open); }
    /// Shows the second camera.
    void useSecondCamera() {
        state_.open->useCamera(1);
        for (Look& look : state_.looks) look.settings.camera = 1;
    }
    std::string at(const std::string& name) const { return (folder_.path() / name).string(); }
    /// Expects the copied command to give this file the displayed camera, for images of any aspect ratio.
    void expectCommandShows(const std::string& file, scenes::LoadOptions load) {
        for (const double aspect : {0.5, 4.0}) {
            load.aspect = aspect;
            const scenes::Camera supplied = scenes::loadScene(file, load).cameras.at(0);
            EXPECT_EQ(scenes::changedCamera(supplied, state_.open->cameraChange()), shown()) << aspect;
        }
    }

    static constexpr double kMadeForAspect = 16.0 / 9.0; ///< aspect ratio of the cameras of built-in scenes

    TempFolder folder_;
    std::string failure_;
    bool cannotShow_ = false;
    int saidCamera_ = 0;
    scenes::CameraChange saidPose_;
    std::vector<bool> firsts_;
    ViewerOptions options_;
    State state_;
    EventLog log_{false};
    SceneSwitch switch_{options_, state_, log_, [] {}};
};

TEST_F(SceneSwitchTest, optionsOfTheFirstSceneDoNotApplyToAnotherEvenIfItFailed) {
    saidCamera_ = 7;
    EXPECT_FALSE(open("room"));
    EXPECT_EQ(failure_, "no such camera");
    EXPECT_TRUE(open("room"));
    EXPECT_EQ(firsts_, (std::vector<bool>{true, false}));
    EXPECT_EQ(state_.looks[1].technique, engine::Technique::ClusteredForward) << "as with the first that is shown";
}

TEST_F(SceneSwitchTest, aMissingFirstFileNeverPlacesTheCameraOfTheNext) {
    saidPose_.eyeWS = glm::dvec3(9, 9, 9);
    EXPECT_FALSE(open(at("missing.glb")));
    EXPECT_THAT(failure_, HasSubstr("missing.glb"));
    EXPECT_TRUE(open("room"));
    EXPECT_EQ(firsts_, std::vector<bool>{false});
    EXPECT_FALSE(state_.open->rig().isMoved());
    EXPECT_EQ(state_.open->cameraChange(), scenes::CameraChange());
}

TEST_F(SceneSwitchTest, anotherSceneBeginsAtItsOwnTimeAndTheSameOneGoesOn) {
    ASSERT_TRUE(open("room"));
    for (Look& look : state_.looks) look.settings.timeSeconds = 3.7;
    ASSERT_TRUE(open("room"));
    EXPECT_EQ(state_.looks[0].settings.timeSeconds, 3.7);
    ASSERT_TRUE(open("lattice"));
    for (const Look& look : state_.looks) EXPECT_EQ(look.settings.timeSeconds, 0.0);
}

TEST_F(SceneSwitchTest, aSceneShowsTheCameraAndThePoseThatItWasLeftWith) {
    const std::string a = sceneFile("a.json"), b = sceneFile("b.json");
    saidPose_.fovYDegrees = 20.0;
    ASSERT_TRUE(open(a));
    const scenes::Camera placed = shown();
    EXPECT_DOUBLE_EQ(placed.fovYRadians, glm::radians(20.0));
    ASSERT_TRUE(open(b));
    useSecondCamera();
    moveCamera();
    const scenes::Camera moved = shown();

    ASSERT_TRUE(open(a));
    EXPECT_EQ(state_.open->camera(), 0);
    EXPECT_EQ(state_.looks[0].settings.camera, 0);
    EXPECT_EQ(shown(), placed);
    EXPECT_EQ(state_.open->cameraChange(), saidPose_);

    ASSERT_TRUE(open(at("./b.json")));
    EXPECT_EQ(state_.open->camera(), 1);
    EXPECT_EQ(state_.looks[0].settings.camera, 1);
    EXPECT_EQ(state_.looks[1].settings.camera, 1);
    EXPECT_EQ(shown(), moved);
    EXPECT_EQ(state_.open->source(), at("./b.json")) << "the user's words";
}

TEST_F(SceneSwitchTest, aCameraThatWasSavedWhereItIsNotCountsAsMovedWhenItsFileIsOpenedAgain) {
    ASSERT_TRUE(open("room"));
    moveCamera();
    const std::string file = at("saved.json");
    saveOpenScene(state_, file);
    const scenes::Camera saved = shown();
    ASSERT_TRUE(open("room"));
    ASSERT_TRUE(open(file));
    EXPECT_EQ(shown(), saved);
    EXPECT_EQ(state_.open->cameraChange(), scenes::CameraChange());
}

TEST_F(SceneSwitchTest, aTurnOfTheEnvironmentThatWasSavedIsNeitherMadeTwiceNorOfOtherScenes) {
    folder_.write("even.pfm", "PF\n1 1\n-1.0\n" + std::string(12, '?')); // one texel of 0.747 in each channel
    const auto turned = [&](const std::string& name, int degrees) {
        return folder_
            .write(name, R"({"tessera": 1, "base": {"file": "builtin:room"}, "environment": {"map": "even.pfm"},
                "options": {"environmentRotation": )" +
                             std::to_string(degrees) + "}}")
            .string();
    };
    const auto degrees = [&] { return state_.looks[0].settings.environment.rotationDegrees; };
    const auto seen = [&] { return state_.open->scene().environment.value().rotationDegrees + degrees(); };
    ASSERT_TRUE(open(turned("a.json", 25)));
    EXPECT_EQ(degrees(), 25.0f);
    viewEnvironment(state_, {40.0f, 1.0f});
    const std::string file = at("saved.json");
    saveOpenScene(state_, file);
    EXPECT_EQ(seen(), 40.0f);
    ASSERT_TRUE(open(turned("b.json", 10)));
    EXPECT_EQ(degrees(), 10.0f) << "as it requests itself";
    ASSERT_TRUE(open(file));
    EXPECT_EQ(seen(), 40.0f);
    EXPECT_EQ(degrees(), 0.0f);
    viewEnvironment(state_, {30.0f, 2.0f}); // not saved
    ASSERT_TRUE(open(file));
    EXPECT_EQ(seen(), 40.0f) << "edits are left behind with their scene";
    EXPECT_EQ(environmentSeenBy(state_.looks[1]), state_.open->environmentView());
    EXPECT_FALSE(state_.open->isEdited());
    EXPECT_EQ(state_.maps, std::vector<std::string>{at("even.pfm")}) << "to be chosen again";
}

TEST_F(SceneSwitchTest, aCameraThatTheFileLacksIsNotRestored) {
    const std::string file = sceneFile("a.json");
    ASSERT_TRUE(open(file));
    state_.open->useCamera(1);
    moveCamera();
    folder_.write("a.json", R"({"tessera": 1, "base": {"file": "builtin:room"},
        "cameras": [{"name": "only", "position": [0, 1, 4], "target": [0, 1, 0]}]})");
    ASSERT_TRUE(open(file));
    EXPECT_EQ(state_.open->camera(), 0);
    EXPECT_FALSE(state_.open->rig().isMoved());
}

TEST_F(SceneSwitchTest, aSceneThatCannotBeShownNeverChangesWhatTheOpenOneLooksLike) {
    ASSERT_TRUE(open(sceneFile("a.json")));
    useSecondCamera();
    const auto looks = state_.looks;
    const std::vector<std::string> recent = state_.recent;
    cannotShow_ = true;
    EXPECT_FALSE(open(sceneFile("b.json")));
    EXPECT_EQ(failure_, "no memory");
    EXPECT_TRUE(state_.looks == looks);
    EXPECT_EQ(state_.recent, recent);
    EXPECT_TRUE(state_.loading.empty());
    cannotShow_ = false;
    EXPECT_TRUE(open("room"));
}

TEST_F(SceneSwitchTest, ofMessagesOnlyThoseAboutWhatOpensStayWhenItIsThere) {
    state_.notice = {"of the scene before", true};
    ASSERT_TRUE(open("room"));
    EXPECT_EQ(state_.notice.text, "");
    state_.notice = {"of this one", false, true};
    ASSERT_TRUE(open("room"));
    EXPECT_EQ(state_.notice.text, "of this one");
}

TEST_F(SceneSwitchTest, oneGoesOnFlyingAsFastInAnotherScene) {
    ASSERT_TRUE(open("room"));
    CameraRig& rig = state_.open->rig();
    rig.setMode(CameraRig::Mode::Fly);
    rig.wheel(4.0, {}, kHeightPixels);
    const double speed = rig.flyMetresPerSecond();
    ASSERT_TRUE(open("room"));
    EXPECT_EQ(state_.open->rig().mode(), CameraRig::Mode::Fly);
    EXPECT_EQ(state_.open->rig().flyMetresPerSecond(), speed);
}

TEST_F(SceneSwitchTest, choicesAreRememberedEvenIfTheNextSceneSetsTheSame) {
    options_.preferencesFile = folder_.path() / "viewer.json";
    ASSERT_TRUE(open("room"));
    for (Look& look : state_.looks) look.technique = engine::Technique::Forward;
    options_.lookOf = [](const scenes::Scene&, const std::string&, bool) {
        FirstLook look;
        look.look.technique = engine::Technique::Forward;
        return look;
    };
    ASSERT_TRUE(open("spheres"));
    switch_.remember({800, 600});
    EXPECT_EQ(readPreferences(*options_.preferencesFile).settings.at("technique"), "forward");
}

TEST_F(SceneSwitchTest, aDiscardedResultDoesNotReturn) {
    switch_.open("room");
    waitForResult();
    EXPECT_NE(switch_.scene(), nullptr);
    switch_.discard();
    EXPECT_TRUE(!switch_.hasResult() && switch_.scene() == nullptr);
    EXPECT_TRUE(state_.loading.empty());
    EXPECT_EQ(switch_.take([](const OpenScene&) { FAIL() << "shown"; }), nullptr);
}

TEST_F(SceneSwitchTest, aNoteCountsTheWarningsOfALoadAndNamesWhatWasSupplied) {
    ASSERT_TRUE(open("spheres"));
    EXPECT_EQ(state_.notice.text, "");
    folder_.write("bare.mtl", "newmtl a\nmap_Kd gone.png\nnewmtl b\nmap_Kd lost.png\nd 0\n");
    const std::string bare = folder_
                                 .write("bare.obj", "mtllib bare.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n"
                                                    "usemtl a\nf 1/1 2/1 3/1\nusemtl b\nf 1/1 2/1 3/1\n")
                                 .string();
    ASSERT_TRUE(open(bare)) << failure_;
    EXPECT_EQ(state_.notice.text,
              "2 pictures missing, shown by a checkerboard; 1 other warning; supplied: environment, "
              "camera (see the panel Scene)");
    EXPECT_FALSE(state_.notice.isError);
}

TEST_F(SceneSwitchTest, withoutTheDefaultLightNoSceneEverGetsIt) {
    options_.load.defaultLight = false;
    const std::string file = folder_.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").string();
    ASSERT_TRUE(open("room"));
    ASSERT_TRUE(open(file));
    EXPECT_FALSE(state_.open->scene().environment);
    EXPECT_FALSE(state_.open->load().defaultLight) << "and the command says so";
}

TEST_F(SceneSwitchTest, aSuppliedCameraFitsTheWindowAndItsPlaceIsSaidForCommandsOfAnySize) {
    const std::string file = folder_.write("triangle.obj", "v 0 0 0\nv 9 0 1\nv 0 1 3\nf 1 2 3\n").string();
    state_.pictureAspect = 0.5;
    ASSERT_TRUE(open(file));
    EXPECT_EQ(state_.open->load().aspect, 0.5);
    expectCommandShows(file, {});
    moveCamera();
    const scenes::Camera moved = shown();
    ASSERT_TRUE(open("room"));
    state_.pictureAspect = 2.0;
    ASSERT_TRUE(open(file));
    EXPECT_EQ(shown(), moved) << "as it was left, whatever the window is now";
}

TEST_F(SceneSwitchTest, theDefaultCameraIsThatOfTheSceneItWasRequestedAndCommandsOfAnySizeRepeatItsPlace) {
    const std::string file = sceneFile("a.json");
    scenes::LoadOptions load;
    load.defaultCamera = true;
    saidPose_.fovYDegrees = 20.0;
    state_.pictureAspect = 0.5;
    ASSERT_TRUE(open(file, load));
    EXPECT_EQ(state_.open->cameras().size(), 1u);
    EXPECT_TRUE(state_.open->load().defaultCamera) << "and the command says so";
    EXPECT_DOUBLE_EQ(shown().fovYRadians, glm::radians(20.0));
    expectCommandShows(file, load);
    ASSERT_TRUE(open(sceneFile("b.json")));
    EXPECT_EQ(state_.open->cameras().size(), 2u);
}

TEST_F(SceneSwitchTest, everyCameraOfABuiltInSceneKeepsItsWidthInANarrowerPictureAndCommandsRepeatIt) {
    const std::vector<scenes::Camera> made = scenes::loadScene("spheres").cameras;
    state_.pictureAspect = 980.0 / 778.0; // of a window of 1280x800
    ASSERT_TRUE(open("spheres"));
    for (const int camera : {0, 1, 0}) {
        state_.open->jumpToCamera(camera);
        const scenes::Camera& own = made.at(std::size_t(camera));
        const double width = std::tan(0.5 * own.fovYRadians) * kMadeForAspect;
        const double shownWidth = std::tan(0.5 * shown().fovYRadians) * state_.pictureAspect;
        EXPECT_GT(shownWidth, width * (1.0 - 1e-12)) << camera;
        EXPECT_LT(shownWidth, width * 1.003) << "a tenth of a degree is the most that rounding adds";
        EXPECT_EQ(scenes::changedCamera(own, state_.open->cameraChange()), shown()) << camera;
        EXPECT_FALSE(state_.open->rig().isMoved());
    }
    moveCamera();
    EXPECT_EQ(scenes::changedCamera(made.at(0), state_.open->cameraChange()), shown());
}

TEST_F(SceneSwitchTest, aCameraOfAFileAndOneWhosePictureIsWideEnoughStayAsTheyAre) {
    ASSERT_TRUE(open("spheres"));
    EXPECT_EQ(state_.open->cameraChange(), scenes::CameraChange()) << "it is made for this";
    state_.pictureAspect = 0.5;
    ASSERT_TRUE(open(sceneFile("a.json")));
    EXPECT_EQ(state_.open->cameraChange(), scenes::CameraChange());
    state_.pictureAspect = 0.001;
    ASSERT_TRUE(open("room"));
    EXPECT_EQ(state_.open->cameraChange().fovYDegrees, 120.0) << "no picture is wider than this";
}

TEST_F(SceneSwitchTest, aCommandThatPlacesTheCameraOfABuiltInSceneIsFollowed) {
    saidPose_.fovYDegrees = 40.0;
    state_.pictureAspect = 0.5;
    ASSERT_TRUE(open("spheres"));
    EXPECT_EQ(state_.open->cameraChange(), saidPose_);
    EXPECT_EQ(shown(), scenes::loadScene("spheres").cameras.at(0));
}

TEST_F(SceneSwitchTest, settingsThatCannotBeSavedGiveAWarning) {
    options_.preferencesFile = folder_.write("file", "") / "viewer.json";
    std::string warning;
    options_.warn = [&warning](const std::string& text) { warning = text; };
    switch_.remember({800, 600});
    EXPECT_THAT(warning, HasSubstr("cannot make the folder"));
}

} // namespace
} // namespace tessera::viewer
