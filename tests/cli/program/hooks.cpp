#include <array>

#include <fmt/format.h>

#include "tests/cli/program/Cli.h"

namespace tessera::test {
namespace {

using testing::HasSubstr;

/// A black square whose hook emits its parameters as colour.
class HookedSquare : public Cli {
protected:
    void SetUp() override {
        folder_.write("shine.glsl", "void hookSurface(inout HookedSurface surface, HookInputs inputs)\n"
                                    "{\n    surface.emission = vec3(hook.red, hook.green, 0.0);\n}\n");
        folder_.write("square.obj", "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3 4\n");
        folder_.write("square.json", R"({"tessera": 1,
            "include": [{"file": "square.obj", "name": "square"}],
            "materials": [{"name": "black", "model": "lambert", "k_d": [0, 0, 0]}],
            "overrides": [{"node": "square", "material": "black"}],
            "cameras": [{"name": "front", "position": [0, 0, 2], "target": [0, 0, 0]}],
            "hook": {"file": "shine.glsl", "parameters": [{"name": "red", "value": 0.25, "least": 0, "most": 2},
                                                          {"name": "green", "value": 0.5, "least": 0, "most": 1}]}})");
    }
    static Words command(const Words& more) {
        Words words{"render", "square.json", "--no-default-light", "--size", "16x8", "-o", "a.exr"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    std::array<float, 2> shown() const {
        const Picture made = picture("a.exr");
        const float* const middle = made.pixel(made.pixelCount() / 2 + 8);
        return {middle[0], middle[1]};
    }
};

TEST_F(HookedSquare, optionsSetItsParameters) {
    runGood(command({}));
    EXPECT_EQ(shown(), (std::array{0.25f, 0.5f}));
    runGood(command({"--hook", "red=1.5"}));
    EXPECT_EQ(shown(), (std::array{1.5f, 0.5f}));
    runGood(command({"--hook", "green=0.125", "--hook", "red=2"}));
    EXPECT_EQ(shown(), (std::array{2.0f, 0.125f}));
}

TEST_F(HookedSquare, whatItHasNotIsRefusedByName) {
    expectError(kBadInput, command({"--hook", "blue=1"}),
                {"square.json: its hook has no parameter 'blue'", "valid are red, green"});
    expectError(kBadInput, command({"--hook", "red=3"}), {"'red' of its hook cannot be 3", "between 0 and 2"});
    for (const char* text : {"red", "red=", "red=x", "=1", "red=inf"})
        expectError(kBadInput, command({"--hook", text}), {fmt::format("--hook '{}' is not a name", text)});
    expectError(kBadInput, {"render", "room", "--size", "16x8", "-o", "a.exr", "--hook", "red=1"},
                {"room: has no hook whose parameter 'red'"});
}

TEST_F(HookedSquare, faultsThatTheDriverFindsNameTheHookAndWhatToDo) {
    const std::string signature = "void hookSurface(inout HookedSurface surface, HookInputs inputs)";
    const std::string refused = "/shine.glsl: the driver refuses this hook: ";
    folder_.write("shine.glsl", signature + "\n{\n    surface.emission = undeclaredName;\n}\n");
    expectError(kBadInput, command({}), {refused, "/shine.glsl:3: "});
    EXPECT_THAT(run(command({})).err, testing::Not(testing::HasSubstr("warning")));
    // The driver finds these faults when it links a program, and names no file.
    for (const std::string& nothing :
         Words{"#if 0\n" + signature + " {}\n#endif\n", signature + ";\n", "void hookSurface(int a) {}\n"}) {
        folder_.write("shine.glsl", nothing);
        expectError(
            kBadInput, command({}),
            {"/shine.glsl:", ": the driver refuses this hook: ", "write " + signature, "outside of conditionals"});
    }
}

/// The driver gives no position in a file for either.
TEST_F(HookedSquare, recursionAndVariablesInAreTheHooksFault) {
    const std::string signature = "void hookSurface(inout HookedSurface surface, HookInputs inputs)";
    folder_.write("shine.glsl", "float twice(float x)\n{\n    return x > 9.0 ? x : twice(2.0 * x);\n}\n" + signature +
                                    "\n{\n    surface.emission = vec3(twice(hook.red));\n}\n");
    expectError(kBadInput, command({}),
                {"/shine.glsl:1: the driver refuses this hook: ", "twice", "GLSL has no recursion"});
    folder_.write("shine.glsl", "\nin float glow;\n" + signature + "\n{\n    surface.emission = vec3(glow);\n}\n");
    expectError(kBadInput, command({}),
                {"/shine.glsl:2: the driver refuses this hook: ", "glow", "declares no in or out variables"});
}

TEST_F(HookedSquare, aFieldThatIsNotThereIsAnsweredByThoseThatAre) {
    for (const char* mistaken : {"surface.colour = vec3(1.0)", "surface.emission = vec3(hook.blue)"}) {
        folder_.write("shine.glsl", std::string("void hookSurface(inout HookedSurface surface, HookInputs inputs)\n{\n"
                                                "    ") +
                                        mistaken + ";\n}\n");
        expectError(kBadInput, command({}),
                    {"/shine.glsl:3: ", "HookedSurface has color, emission, alpha, metallic",
                     "hook has timeSeconds, "
                     "red, green"});
    }
}

TEST_F(HookedSquare, aParameterWhoseNameMeansSomethingElseInGlslIsTheHooksFault) {
    std::string square = text("square.json");
    square.replace(square.find("\"red\""), 5, "\"mat3\"");
    folder_.write("square.json", square);
    folder_.write("shine.glsl", "void hookSurface(inout HookedSurface surface, HookInputs inputs) {}\n");
    expectError(kBadInput, command({}), {"/shine.glsl (its parameters):4: "});
}

TEST_F(HookedSquare, loopsThatTheDriverGivesUpAreNamedWherePixelsAreNoNumbers) {
    const std::string light = R"("lights": [{"type": "directional", "direction": [0, 0, -1], "castsShadow": true}], )";
    std::string square = text("square.json");
    square.insert(square.find("\"cameras\""), light);
    square.replace(square.find("[0, 0, 0]"), 9, "[1, 1, 1]");
    folder_.write("square.json", square);
    const auto said = [&](const std::string& iterations) {
        folder_.write("shine.glsl", "void hookSurface(inout HookedSurface surface, HookInputs inputs)\n{\n"
                                    "    float sum = 0.0;\n    for (int i = 0; i < " +
                                        iterations +
                                        "; ++i) sum += 1e-6 * abs(inputs.positionOS.x);\n"
                                        "    surface.emission = vec3(sum);\n}\n");
        return run(command({"--technique", "forward"})).err; // its shadow rays need iterations too
    };
    EXPECT_THAT(said("100000 + int(0.0 * hook.red)"),
                testing::ContainsRegex("of its pixels are infinite or no numbers; .*, or a loop of its "
                                       "hook takes more than the [0-9]+ iterations"));
    EXPECT_EQ(said("1000"), "");
}

} // namespace
} // namespace tessera::test
