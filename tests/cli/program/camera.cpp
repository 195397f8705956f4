#include <fmt/format.h>

#include "tests/cli/program/Cli.h"
#include "validation/figures/ErrorFigures.h"

namespace tessera::test {
namespace {

/// Cameras placed by the command line.
class CameraOptions : public Cli {
protected:
    /// The image of a scene rendered with further arguments.
    std::string rendered(const Words& more, const char* scene = "spheres") {
        const std::string name = fmt::format("{}.exr", ++made_);
        Words words{"render", scene, "--size", "48x27", "-o", name};
        words.insert(words.end(), more.begin(), more.end());
        EXPECT_EQ(runGood(words), "");
        return text(name);
    }
    /// The same with a camera of a scene file.
    std::string renderedBy(const std::string& camera) {
        folder_.write("scene.json",
                      R"({"tessera": 1, "base": {"file": "builtin:spheres"}, "cameras": [)" + camera + "]}");
        return rendered({}, "scene.json");
    }

private:
    int made_ = 0;
};

TEST_F(CameraOptions, aPlacedCameraIsExactlyTheOneOfASceneFileOfTheSameNumbers) {
    EXPECT_TRUE(
        rendered({"--eye", "3.3,2.1,-4", "--target", "0,0.5,0", "--fov", "31.7", "--near", "0.01"}) ==
        renderedBy(R"({"position": [3.3, 2.1, -4], "target": [0, 0.5, 0], "fovYDegrees": 31.7, "near": 0.01})"));
    const Words rolled{"--eye", "-3,4,5", "--target", "0,0,0", "--up", "1,0,0.25"};
    const std::string picture = rendered(rolled);
    EXPECT_FALSE(picture == rendered({rolled.begin(), rolled.end() - 2})) << "up turns the picture";
    EXPECT_FALSE(picture == rendered({"--camera", "front"})) << "the scene's own camera";
}

TEST_F(CameraOptions, everyCommandThatLooksAtAFrameTakesThem) {
    const char* const kNoneInView = "no point light is on and in view";
    EXPECT_THAT(runGood({"plan", "lattice", "--eye", "0,900,0", "--target", "0,1000,0"}),
                testing::HasSubstr(kNoneInView));
    EXPECT_THAT(runGood({"plan", "lattice"}), testing::Not(testing::HasSubstr(kNoneInView)));
    runGood({"compare", "spheres", "--techniques", "forward", "--size", "48x27", "--eye", "3,2,-4"});
}

TEST_F(CameraOptions, furtherCamerasAreNamedWhereNoneIsChosen) {
    const auto said = [&](const Words& more, const char* scene = "room") {
        Words words{"render", scene, "--size", "16x9", "-o", "a.png"};
        words.insert(words.end(), more.begin(), more.end());
        return runGood(words);
    };
    const std::string line = "camera 'corner' of 2; --camera takes 'back'\n";
    EXPECT_EQ(said({}), line);
    EXPECT_EQ(said({"--fov", "50"}), line);
    EXPECT_EQ(said({"--technique", "reference"}), line);
    EXPECT_EQ(said({"--camera", "0"}), "");
    EXPECT_EQ(said({"--quiet"}), "");
    EXPECT_EQ(said({"--eye", "0.5,1.5,2", "--target", "0,1,-1"}), "") << "a camera of the user's own";
    std::string cameras;
    for (int i = 0; i < 9; ++i)
        cameras += fmt::format(R"({}{{"name": "c{}", "position": [-1.5, 1.75, 2.75], "target": [0.4, 1.1, -1.5]}})",
                               i == 0 ? "" : ", ", i);
    folder_.write("many.json", R"({"tessera": 1, "base": {"file": "builtin:room"}, "options": {"camera": "c2"},
                                   "cameras": [)" +
                                   cameras + "]}");
    EXPECT_EQ(said({}, "many.json"), "camera 'c2' of 9; --camera takes 'c0', 'c1', 'c3', 'c4', 'c5' and 3 more\n");
    EXPECT_THAT(runGood({"plan", "room"}), testing::StartsWith(line));
    EXPECT_THAT(runGood({"plan", "room", "--camera", "back"}), testing::Not(testing::HasSubstr("corner")));
}

TEST_F(CameraOptions, theDefaultLightReachesWhateverTheOptionsLookAt) {
    folder_.write("cube.obj", "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
                              "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n");
    folder_.write("cube.json", R"({"tessera": 1, "include": [{"file": "cube.obj"}],
        "cameras": [{"name": "front", "position": [0, 0, 5], "target": [0, 0, 0]},
                    {"name": "behind", "position": [0, 0, -5], "target": [0, 0, 0]}]})");
    const Words behind{"--eye", "0,0,-5", "--target", "0,0,0"};
    const auto made = [&](const char* file, const Words& more) {
        Words words{"--quiet", "render", "cube.json", "--size", "48x27", "-o", file};
        words.insert(words.end(), more.begin(), more.end());
        runGood(words);
        return text(file);
    };
    made("front.exr", {});
    const std::string behindText = made("behind.exr", behind);
    EXPECT_TRUE(made("named.exr", {"--camera", "behind"}) == behindText);
    for (const char* file : {"front.exr", "behind.exr"}) EXPECT_GT(picture(file).pixel(13 * 48 + 24)[0], 0.1f) << file;
    Words compare{"--quiet",      "compare", "cube.json", "--size",    "48x27",
                  "--techniques", "forward", "--against", "behind.exr"};
    compare.insert(compare.end(), behind.begin(), behind.end());
    runGood(compare);
}

TEST_F(CameraOptions, theDefaultCameraShowsAFileAsOneWithoutCamerasIsShown) {
    folder_.write("roof.obj", "v -1 0 -1\nv 1 0 -1\nv 1 0 1\nv 0 2 0\nf 1 2 3\nf 1 3 4\nf 2 4 3\nf 1 4 2\n");
    folder_.write("bare.json", R"({"tessera": 1, "include": [{"file": "roof.obj"}]})");
    folder_.write("away.json", R"({"tessera": 1, "include": [{"file": "roof.obj"}], "options": {"camera": "away"},
        "cameras": [{"name": "front", "position": [0, 0, 5], "target": [0, 0, 0]},
                    {"name": "away", "position": [9, 0, 0], "target": [10, 0, 0]}]})");
    const auto made = [&](const char* scene, const Words& more) {
        Words words{"--quiet", "render", scene, "--size", "27x48", "-o", "made.exr"};
        words.insert(words.end(), more.begin(), more.end());
        runGood(words);
        return text("made.exr");
    };
    for (const Words& more : {Words{}, Words{"--fov", "30"}, Words{"--eye", "3,4,5", "--target", "0,1,0"}}) {
        Words withDefault = more;
        withDefault.insert(withDefault.begin(), "--default-camera");
        const std::string picture = made("away.json", withDefault);
        EXPECT_TRUE(picture == made("bare.json", more)) << more.size();
        EXPECT_FALSE(picture == made("away.json", more)) << more.size();
    }
    const ProcessResult own = run({"render", "away.json", "--size", "48x27", "-o", "a.exr"});
    EXPECT_THAT(own.err, testing::HasSubstr("sees nothing of the scene; give --default-camera, which sees all of it"));
    EXPECT_THAT(runGood({"plan", "away.json", "--default-camera"}),
                testing::HasSubstr("seen whole by the supplied camera 'default' in the place of its own"));
    expectError(2, {"render", "none.json", "-o", "a.exr", "--default-camera", "--camera", "front"},
                {"whose place --default-camera takes; give one of the two"});
}

TEST_F(CameraOptions, invalidCameraValuesAreRefusedInOneLine) {
    const Words render{"render", "spheres", "-o", "a.exr"};
    const auto expectRefused = [&](const Words& more, const std::string& part) {
        Words words = render;
        words.insert(words.end(), more.begin(), more.end());
        expectError(2, words, {part});
    };
    expectRefused({"--eye", "1,2"}, "--eye '1,2' is not three finite numbers, such as 0,1.5,-2");
    expectRefused({"--eye", "1,2,3", "--target", "1,2,3"}, "it cannot look at its own place; give another target");
    expectRefused({"--fov", "180"}, "its field of view would be 180 degrees; less than 180 is needed");
    expectRefused({"--half-height", "2"}, "has no half height; give a field of view");
    expectRefused({"--camera", "999"}, "unknown camera '999'");
}

} // namespace
} // namespace tessera::test
