// The scripts that complete command lines in shells.
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "engine/Settings.h"
#include "scenes/Load.h"
#include "tests/cli/program/Cli.h"
#include "tests/cli/program/HelpWords.h"

namespace tessera::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;
using testing::StartsWith;

class Completion : public Cli {
protected:
    /// Completions that bash offers for these words, the last of which is being typed.
    Words offered(const Words& line) const {
        std::string words;
        for (const std::string& word : line) words += fmt::format(" '{}'", word);
        const ProcessResult result =
            runProcess({"bash", "-c",
                        fmt::format("source <('{}' completion bash)\nCOMP_WORDS=(tessera{})\nCOMP_CWORD={}\n_tessera\n"
                                    "[ ${{#COMPREPLY[@]}} -eq 0 ] || printf '%s\\n' \"${{COMPREPLY[@]}}\"",
                                    kProgram, words, line.size())},
                       {folder_.path(), {}, 60.0});
        EXPECT_EQ(result.exitCode, 0);
        EXPECT_EQ(result.err, "");
        return linesOf(result.out);
    }
};

TEST_F(Completion, bashOffersEveryCommandAndEveryOptionOfTheHelp) {
    const Words commands = commandsIn(runGood({"--help"}));
    ASSERT_GT(commands.size(), 8u);
    Words first = commands;
    first.push_back("help");
    EXPECT_THAT(offered({""}), testing::UnorderedElementsAreArray(first));
    EXPECT_THAT(offered({"help", ""}), testing::UnorderedElementsAreArray(commands));
    EXPECT_THAT(offered({"-"}), testing::UnorderedElementsAreArray(optionsIn(runGood({"--help"}))));
    for (const std::string& command : commands) {
        SCOPED_TRACE(command);
        EXPECT_THAT(offered({command, "-"}),
                    testing::UnorderedElementsAreArray(optionsIn(runGood({command, "--help"}))));
    }
}

TEST_F(Completion, bashOffersTheNamesThatASettingTakes) {
    int named = 0;
    for (const engine::Setting& setting : engine::settingTable()) {
        const auto* choice = std::get_if<engine::ChoiceKind>(&setting.value.kind);
        if (choice == nullptr) continue;
        const Words words = offered({"render", "hall", std::string(setting.flag), ""});
        for (const engine::ChoiceKind::Entry& entry : choice->entries)
            EXPECT_THAT(words, Contains(entry.name)) << setting.flag;
        // A shell would interpret other characters.
        for (const std::string& word : words)
            EXPECT_TRUE(std::regex_match(word, std::regex("[A-Za-z0-9_./-]+"))) << word;
        ++named;
    }
    EXPECT_GT(named, 15);
    EXPECT_THAT(offered({"render", "hall", "--specular", ""}), ElementsAre("on", "off"));
    EXPECT_THAT(offered({"render", "hall", "--layout", "p"}), ElementsAre("packed"));
    EXPECT_THAT(offered({"view", "--technique", "ref"}), IsEmpty());
    EXPECT_THAT(offered({"render", "hall", "--technique", "ref"}), ElementsAre("reference"));
    EXPECT_THAT(offered({"compare", "hall", "--against", "ref"}), ElementsAre("reference"));
    EXPECT_THAT(offered({"stress", "--case", "scene/"}), AllOf(Not(IsEmpty()), Each(StartsWith("scene/"))));
    EXPECT_THAT(offered({"completion", ""}), ElementsAre("bash", "zsh"));
}

TEST_F(Completion, bashTakesWordsAsTheProgramDoes) {
    // The value of a program option is not a command.
    EXPECT_THAT(offered({"--context", "egl", "sc"}), ElementsAre("scenes"));
    EXPECT_THAT(offered({"--context", "=", "egl", "sc"}), ElementsAre("scenes"));
    EXPECT_THAT(offered({"render", "hall", "--technique", "=", "forward_"}),
                ElementsAre("forward_prepass", "forward_plus"));
    EXPECT_THAT(offered({"render", "hall", "--technique", "="}), Contains("deferred"));
    // Several names in one word.
    EXPECT_THAT(offered({"compare", "hall", "--techniques", "forward,tiled"}), ElementsAre("forward,tiled_deferred"));
    for (const char* name : {"--techniques", "--technique"})
        EXPECT_THAT(offered({"stress", name, "forward,tiled"}), ElementsAre("forward,tiled_deferred"));
    // A value is not an option, even if it begins like one.
    EXPECT_THAT(offered({"render", "hall", "--exposure", "-"}), IsEmpty());
    EXPECT_THAT(offered({"scenes", ""}), IsEmpty());
}

TEST_F(Completion, bashOffersFilesAndFoldersWhereTheyAreTaken) {
    folder_.write("hall of mine.json", "{}");
    std::filesystem::create_directory(folder_.path() / "maps");
    Words scenes;
    for (const scenes::BuiltinScene& builtin : scenes::builtinScenes()) scenes.emplace_back(builtin.name);
    scenes.insert(scenes.end(), {"hall of mine.json", "maps"});
    EXPECT_THAT(offered({"render", ""}), testing::UnorderedElementsAreArray(scenes));
    EXPECT_THAT(offered({"bench", "hall", "ha"}), IsSupersetOf({"hall", "hall of mine.json"}));
    EXPECT_THAT(offered({"render", "hall", "-o", "ha"}), ElementsAre("hall of mine.json"));
    EXPECT_THAT(offered({"compare", "hall", "--heatmap", ""}), ElementsAre("maps"));
    EXPECT_THAT(offered({"render", "hall", "--environment", ""}), IsSupersetOf({"studio", "none", "maps"}));
}

TEST_F(Completion, zshCompletesEveryOptionOfTheHelp) {
    folder_.write("complete.zsh", R"(
compdef() { }
_describe() { print -rl -- $commands }
_arguments() {
    print -rl -- "$@"
    [[ " $* " != *'->command'* ]] || { state=$requested line=($command) }
}
_alternative() { }
source <($program completion zsh)
_tessera
)");
    const auto completions = [&](const std::string& state, const std::string& command) {
        const ProcessResult result =
            runProcess({"zsh", "-f", "complete.zsh"},
                       {folder_.path(), {{"requested", state}, {"command", command}, {"program", kProgram}}, 60.0});
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(result.err, "");
        return linesOf(result.out);
    };
    const Words commands = commandsIn(runGood({"--help"}));
    const Words first = completions("command", "");
    for (const std::string& command : commands) {
        SCOPED_TRACE(command);
        EXPECT_THAT(first, Contains(StartsWith(command + ":")));
        // "(-o --output)--output=[what it is]:FILE:_files"
        std::set<std::string> names;
        for (const std::string& spec : completions("argument", command)) {
            std::smatch found;
            if (std::regex_search(spec, found, std::regex("^(?:\\*|\\([^)]*\\))?(-[-a-z]+)[=+]?\\[")))
                names.insert(found[1]);
        }
        for (const std::string& option : optionsIn(runGood({command, "--help"})))
            EXPECT_TRUE(names.count(option)) << option;
    }
    const Words render = completions("argument", "render");
    EXPECT_THAT(render, Contains(AllOf(StartsWith("--layout="), HasSubstr(":NAME:(exact packed slim)"))));
    EXPECT_THAT(render, Contains(AllOf(StartsWith("(-o --output)--output="), HasSubstr(":FILE:_files"))));
    EXPECT_THAT(render, Contains(StartsWith("*--hook=")));
    EXPECT_THAT(render, Contains(AllOf(StartsWith(":SCENE: _alternative"), HasSubstr("(hall "))));
    EXPECT_THAT(completions("argument", "view"), Contains(StartsWith("::SCENE: _alternative")));
    EXPECT_THAT(completions("argument", "bench"), Contains(StartsWith("*:SCENE: _alternative")));
}

TEST_F(Completion, otherShellsAreNamedAsUnknown) {
    expectError(2, {"completion", "powershell"}, {"'powershell'", "bash, zsh"});
    expectError(2, {"completion"}, {"completion", "shell"});
}

} // namespace
} // namespace tessera::test
