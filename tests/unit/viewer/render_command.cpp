#include "viewer/save/RenderCommand.h"

#include <wordexp.h>

#include <gmock/gmock.h>

#include "apps/FrameOptionText.h"
#include "apps/Options.h"
#include "base/Error.h"
#include "tests/support/SettingTexts.h"
#include "tests/support/TempFolder.h"

namespace tessera::viewer {
namespace {

using testing::HasSubstr;

/// A scene of two lights and three cameras, the last with the first one's name; `options` are its own options.
std::string sceneFile(const tessera::test::TempFolder& folder, const std::string& options = "{}") {
    folder.write("sway.glsl", "void hookSurface(inout HookedSurface surface, HookInputs inputs) {}");
    folder.write("model.gltf", R"({"asset": {"version": "2.0"}, "extensions": {"KHR_materials_variants": {"variants":
        [{"name": "it's red"}]}}})");
    return folder
        .write("a scene's file.json",
               R"({"tessera": 1, "base": {"file": "builtin:room"}, "include": [{"file": "model.gltf"}],
        "lights": [{"type": "directional", "direction": [0, -1, 0]}, {"type": "point", "position": [0, 1, 0]}],
        "cameras": [{"name": "front", "position": [0, 1, 4], "target": [0, 1, 0]},
                    {"name": "plan of $HOME", "type": "orthographic", "position": [0, 9, 0], "direction": [0, -1, 0],
                     "up": [0, 0, -1], "halfHeight": 3},
                    {"name": "front", "position": [0, 1, 4], "target": [0, 2, 0]}],
        "hook": {"file": "sway.glsl", "parameters": [{"name": "wind", "value": 1, "least": 0, "most": 2},
                                                     {"name": "shade", "value": 0}]},
        "options": )" +
                   options + "}")
        .string();
}

/// Splits a line into words as a shell does.
std::vector<std::string> wordsOf(const std::string& line) {
    wordexp_t words{};
    EXPECT_EQ(wordexp(line.c_str(), &words, WRDE_NOCMD | WRDE_UNDEF), 0) << line;
    std::vector<std::string> list(words.we_wordv, words.we_wordv + words.we_wordc);
    wordfree(&words);
    return list;
}

struct Parsed {
    app::FrameOptions options;
    std::string output;
    app::Request request;
};

/// Parses a command line as the program does.
Parsed parsed(const std::string& line) {
    std::vector<std::string> words = wordsOf(line);
    EXPECT_EQ(words.at(0), "tessera");
    EXPECT_EQ(words.at(1), "render");
    words.erase(words.begin(), words.begin() + 2);
    std::ranges::reverse(words); // CLI11 expects them reversed
    Parsed result;
    CLI::App command;
    app::addFrameOptions(command, result.options, "");
    command.add_option("-o,--output", result.output)->required();
    command.parse(words);
    result.request = app::resolve(result.options);
    return result;
}

/// Expects the pasted command to give the same technique, settings and camera, to the last bit.
void expectSame(const RenderRequest& request) {
    scenes::LoadOptions load;
    load.lights = request.lights;
    load.defaultLight = request.defaultLight;
    load.defaultCamera = request.defaultCamera;
    load.environment = request.environment;
    load.background = request.background;
    load.clip = request.clip;
    load.hookValues = request.hookValues;
    load.import = request.import;
    const scenes::Scene scene = scenes::loadScene(request.source, load);
    const std::string line = renderCommand(request, scene, "it's a picture.exr");
    SCOPED_TRACE(line);
    const Parsed result = parsed(line);
    EXPECT_EQ(result.options.scene, request.source);
    EXPECT_EQ(result.output, "it's a picture.exr");
    EXPECT_EQ(result.options.import, request.import);
    EXPECT_EQ(result.request.technique, request.technique);
    EXPECT_TRUE(result.request.settings == request.settings);
    const std::size_t camera = std::size_t(request.settings.camera);
    EXPECT_TRUE(result.request.scene.cameras.at(camera) ==
                scenes::changedCamera(scene.cameras.at(camera), request.pose));
    EXPECT_TRUE(result.request.scene.lights == scene.lights);
    EXPECT_TRUE(result.request.scene.hook == scene.hook);
    const auto sourceOf = [](const scenes::Scene& of) { return of.environment ? of.environment->source : ""; };
    EXPECT_EQ(sourceOf(result.request.scene), sourceOf(scene));
    EXPECT_EQ(result.request.scene.background, scene.background);
}

RenderRequest requestOf(const std::string& source) {
    RenderRequest request;
    request.source = source;
    return request;
}

TEST(RenderCommand, defaultsAreNotWritten) {
    const tessera::test::TempFolder folder;
    const RenderRequest request = requestOf("room");
    EXPECT_EQ(renderCommand(request, scenes::loadScene("room"), "picture.exr"), "tessera render room -o picture.exr");
}

TEST(RenderCommand, everyValueIsReadBackAndWrittenByItsOwnOptionAlone) {
    const tessera::test::TempFolder folder;
    const std::string file = sceneFile(folder);
    const scenes::Scene scene = scenes::loadScene(file);
    for (const engine::Setting& setting : engine::settingTable()) {
        for (const std::string& text : tessera::test::textsOf(setting)) {
            RenderRequest request = requestOf(file);
            setting.read(request, text, {{}, &scene});
            expectSame(request);
            const std::string line = renderCommand(request, scene, "a.exr"), flag = fmt::format(" {} ", setting.flag);
            EXPECT_EQ(line.find(flag) != line.npos, !setting.isDefault(request)) << line;
            EXPECT_EQ(line.find(" --") == line.npos, setting.isDefault(request)) << line;
        }
    }
}

/// A request in which no setting has its default.
RenderRequest everythingSaid(const std::string& file) {
    RenderRequest request = requestOf(file);
    request.lights = 1;
    request.defaultLight = false;
    request.environment = "studio"; // the fastest to make
    request.background = glm::dvec3(1.0 / 3.0, 1e-9, 70000.1);
    request.clip = "none";
    request.hookValues = {{"wind", 1.0f / 3.0f}, {"shade", 1e-7f}};
    request.import.isStrict = true;
    request.import.lightUnits = scenes::LightUnits::Watt;
    request.import.objColours = scenes::ObjColours::Linear;
    request.import.variant = "it's red";
    for (const engine::Setting& setting : engine::settingTable())
        setting.value.copy(request, tessera::test::changedIn(setting, tessera::test::sceneOfTwoCameras()));
    request.settings.timeSeconds = 1.0 / 3.0;
    request.settings.rangeTolerance = 1e-7;
    request.settings.exposureEV = -0.1f;
    request.pose.eyeWS = glm::dvec3(-1.0 / 3.0, 1e-17, 123456.789);
    request.pose.targetWS = glm::dvec3(0.1, 0.2, 0.3);
    request.pose.upWS = glm::dvec3(-1.0, 1.0, 1.0 / 7.0);
    request.pose.halfHeightMetres = 2.0 / 3.0;
    request.pose.nearMetres = 1e-3;
    request.pose.farMetres = 1e7 / 3.0;
    return request;
}

TEST(RenderCommand, allSettingsAtOnceAreReadBackToTheLastBit) {
    const tessera::test::TempFolder folder;
    expectSame(everythingSaid(sceneFile(folder)));
    RenderRequest perspective = everythingSaid(sceneFile(folder));
    perspective.settings.camera = 2; // shares its name with another
    perspective.pose.halfHeightMetres.reset();
    perspective.pose.fovYDegrees = 100.0 / 3.0;
    expectSame(perspective);
}

TEST(RenderCommand, theDefaultCameraIsWrittenWithItsPlace) {
    const tessera::test::TempFolder folder;
    RenderRequest request = requestOf(sceneFile(folder, R"({"camera": "plan of $HOME"})"));
    request.defaultCamera = true;
    expectSame(request);
    request.pose.eyeWS = glm::dvec3(0.1, 0.2, 9.0);
    request.pose.targetWS = glm::dvec3(0.1, 0.2, 0.3);
    expectSame(request);
}

TEST(RenderCommand, everyChangedOptionIsWritten) {
    const tessera::test::TempFolder folder;
    RenderRequest request = everythingSaid(sceneFile(folder));
    const scenes::Scene scene = scenes::loadScene(request.source);
    std::string said = renderCommand(request, scene, "a.exr");
    request.pose.fovYDegrees = 50.0;
    request.defaultCamera = true;
    said += renderCommand(request, scene, "a.exr");
    app::FrameOptions options;
    CLI::App command;
    app::addFrameSettings(command, options);
    int count = 0;
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_group() != "Frame" && option->get_group() != "Camera" && option->get_group() != "Display")
            continue;
        EXPECT_THAT(said, HasSubstr(" --" + option->get_lnames().at(0) + (option->get_type_size() > 0 ? " " : "")));
        ++count;
    }
    EXPECT_GE(count, 28);
}

TEST(RenderCommand, optionsOfTheSceneAreNotWrittenButDefaultsThatOverrideThemAre) {
    const tessera::test::TempFolder folder;
    const std::string file =
        sceneFile(folder, R"({"technique": "forward", "layout": "packed", "camera": "plan of $HOME", "toneMap": "aces",
                              "exposureEV": 1.5, "size": [320, 200]})");
    RenderRequest requested = requestOf(file);
    requested.technique = engine::Technique::Forward;
    requested.settings.layout = frame::layoutTable()[1].layout;
    requested.settings.camera = 1;
    requested.settings.toneMap = frame::ToneMap::Aces;
    requested.settings.exposureEV = 1.5f;
    requested.settings.sizePixels = {320, 200};
    const std::string line = renderCommand(requested, scenes::loadScene(file), "a.exr");
    EXPECT_EQ(line.find("--"), std::string::npos) << line;
    expectSame(requested);
    expectSame(requestOf(file));
}

TEST(RenderCommand, aSceneWhoseNameBeginsWithADashIsNotTakenForAnOption) {
    EXPECT_EQ(renderCommand(requestOf("-x.json"), scenes::loadScene("room"), "-y.exr"),
              "tessera render ./-x.json -o ./-y.exr");
}

TEST(FrameOptionText, givenOptionsAreWrittenUnchanged) {
    const tessera::test::TempFolder folder;
    const RenderRequest request = everythingSaid(sceneFile(folder));
    const app::FrameOptions options = parsed(renderCommand(request, scenes::loadScene(request.source), "a")).options;
    const app::FrameOptions again =
        parsed("tessera render " + shellWord(request.source) + app::frameOptionText(options) + " -o a").options;
    EXPECT_EQ(app::frameOptionText(options), app::frameOptionText(again));
    EXPECT_TRUE(app::resolve(options).settings == app::resolve(again).settings);
    EXPECT_TRUE(options.pose == again.pose);
}

TEST(FrameOptionText, theSameValueIsTheSameTextHoweverItWasTyped) {
    app::FrameOptions options;
    options.settings = {{"exposureEV", "1.50"}, {"view", "3"}, {"camera", "a b"}, {"tile", "8"}};
    EXPECT_EQ(app::frameOptionText(options), " --tile 8 --camera 'a b' --view normal --exposure 1.5");
}

TEST(CameraOptions, malformedPointsAreNamedWithTheirOption) {
    for (const char* point : {"1,2", "1,2,3,4", "1;2;3", "a,b,c", "1,2,inf", "1, 2,3"}) {
        app::FrameOptions options;
        CLI::App command;
        app::addFrameSettings(command, options);
        try {
            command.parse(std::vector<std::string>{point, "--eye"});
            ADD_FAILURE() << point;
        } catch (const InputError& error) {
            EXPECT_EQ(error.what(), std::string("--eye '") + point + "' is not three finite numbers, such as 0,1.5,-2");
        }
    }
}

} // namespace
} // namespace tessera::viewer
