#include <algorithm>
#include <set>
#include <sstream>

#include "engine/Settings.h"
#include "scenes/Load.h"
#include "tests/cli/program/Cli.h"

namespace tessera::test {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

class Help : public Cli {
protected:
    static void expectReadable(const std::string& text) {
        EXPECT_THAT(text, AllOf(HasSubstr("Usage: tessera"), HasSubstr("--help"), HasSubstr("Examples\n  tessera ")));
        std::istringstream lines(text);
        int blank = 0;
        for (std::string line; std::getline(lines, line);) {
            EXPECT_LE(line.size(), 100u) << line; // the width of two windows side by side
            blank = line.empty() ? blank + 1 : 0;
            EXPECT_LE(blank, 1) << "two blank lines in a row";
        }
    }
};

TEST_F(Help, everyCommandExplainsItselfWithExamples) {
    for (const char* command : {"render", "compare", "plan", "demo"}) {
        SCOPED_TRACE(command);
        const std::string text = runGood({command, "--help"});
        expectReadable(text);
        EXPECT_THAT(text, HasSubstr(std::string("Usage: tessera ") + command + " "));
        for (const char* option :
             {"--layout NAME",     "--size WxH",         "--samples N",        "--camera NAME",
              "--default-camera",  "--eye X,Y,Z",        "--fov DEGREES",      "--time SECONDS",
              "--lights N",        "--view NAME",        "--exposure EV",      "--range-tolerance EPS",
              "--tonemap NAME",    "--prune on|off",     "--filter NAME",      "--solo N",
              "--specular on|off", "--space NAME",       "--no-default-light", "--background R,G,B",
              "--quiet",           "--context KIND",     "--clip NAME",        "--hook NAME=VALUE",
              "--variant NAME",    "--light-units NAME", "--obj-colours NAME", "--strict"})
            EXPECT_THAT(text, HasSubstr(option));
        // The demonstration shows several techniques.
        EXPECT_EQ(text.find("--technique NAME") == std::string::npos, std::string_view(command) == "demo");
    }
    EXPECT_THAT(runGood({"render", "-h"}), HasSubstr("Usage: tessera render SCENE -o FILE [options]"));
    EXPECT_THAT(runGood({"scenes", "--help"}), HasSubstr("Usage: tessera scenes"));
}

TEST_F(Help, everyOptionWithARangeReportsIt) {
    std::string text = runGood({"render", "--help"});
    text.resize(std::size_t(
        std::unique(text.begin(), text.end(), [](char a, char b) { return std::isspace(a) && std::isspace(b); }) -
        text.begin()));
    std::ranges::replace(text, '\n', ' '); // lines may break anywhere
    int count = 0;
    for (const engine::Setting& setting : engine::settingTable()) {
        if (setting.range().empty()) continue;
        EXPECT_THAT(text, HasSubstr(setting.help + " (" + setting.range() + ") [")) << setting.flag;
        ++count;
    }
    EXPECT_GE(count, 8);
}

TEST_F(Help, noArgumentPrintsTheHelp) {
    const std::string text = runGood({});
    expectReadable(text);
    EXPECT_EQ(text, runGood({"--help"}));
    for (const char* command : {"render", "compare", "plan", "scenes", "demo", "Exit codes: 0 "})
        EXPECT_THAT(text, HasSubstr(command));
}

TEST_F(Help, theWordHelpIsTheOption) {
    EXPECT_EQ(runGood({"help"}), runGood({"--help"}));
    EXPECT_EQ(runGood({"help", "render"}), runGood({"render", "--help"}));
}

TEST_F(Help, repeatableOptionsAreMarked) {
    EXPECT_THAT(runGood({"bench", "--help"}), HasSubstr("Usage: tessera bench [SCENE...] -o DIR [options]"));
    EXPECT_THAT(runGood({"demo", "--help"}), HasSubstr("Usage: tessera demo [SCENE] [options]"));
}

TEST_F(Help, versionReportsTheCommitAndTheDriver) {
    const auto expectDriver = [](const std::string& text) {
        EXPECT_THAT(text, ContainsRegex("^tessera [0-9]+\\.[0-9]+\\.[0-9]+\ncommit     [^ \n]+\n"));
        EXPECT_THAT(text, AllOf(ContainsRegex("\nrenderer   [^ ]"), ContainsRegex("\nOpenGL     4\\.[5-9]")));
    };
    const std::string text = runGood({"--version"});
    expectDriver(text);
    EXPECT_EQ(std::ranges::count(text, '\n'), 4);
    const ProcessResult verbose = run({"--version", "--verbose"});
    EXPECT_EQ(verbose.exitCode, 0);
    expectDriver(verbose.out);
    EXPECT_THAT(verbose.out, AllOf(ContainsRegex("\nvendor +[^ ]"), ContainsRegex("\nGLSL +4"),
                                   ContainsRegex("\ncontext +[^ ]"), ContainsRegex("\nlimits +texture side [0-9]")));
}

TEST_F(Help, theSchemaOfScenesHoldsEverySettingAndNoOther) {
    const Json options = Json::parse(runGood({"scenes", "--schema"}))["definitions"]["options"];
    std::set<std::string> keys{"clip", "defaultLight"};
    for (const engine::Setting& setting : engine::settingTable())
        if (setting.isRequestable) keys.emplace(setting.key);
    for (const auto& [key, schema] : options["properties"].items()) EXPECT_EQ(keys.erase(key), 1u) << key;
    EXPECT_EQ(keys, std::set<std::string>());
    EXPECT_EQ(options["additionalProperties"], false);
    EXPECT_EQ(options["properties"]["exposureEV"]["maximum"], 120.0);
    EXPECT_EQ(options["properties"]["layout"]["enum"], Json({"exact", "packed", "slim"}));
}

TEST_F(Help, scenesListsEveryBuiltinOne) {
    const std::string list = runGood({"scenes"}, kNoGraphics);
    for (const char* row : {"\nhall +[0-9]+ +258 +[0-9]+  [a-z]", "\nspheres +[0-9]+", "\nlattice +192000 +256 +9  ",
                            "\nroom +30 +1 +10  ", "\nhead +[0-9]+"})
        EXPECT_THAT(list, ContainsRegex(row));
    EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), std::ptrdiff_t(1 + scenes::builtinScenes().size()));
}

} // namespace
} // namespace tessera::test
