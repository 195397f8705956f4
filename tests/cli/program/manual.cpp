// The manual page.
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "engine/Settings.h"
#include "tests/cli/program/Cli.h"
#include "tests/cli/program/HelpWords.h"

namespace tessera::test {
namespace {

using testing::HasSubstr;

class Manual : public Cli {
protected:
    void SetUp() override { page_ = runGood({"manual"}); }

    /// The page's text with its escapes replaced.
    std::string plain() const {
        std::string text = page_;
        for (const auto& [escape, sign] : {std::pair<std::string, std::string>{"\\-", "-"},
                                           {"\\(aq", "'"},
                                           {"\\(ga", "`"},
                                           {"\\(ha", "^"},
                                           {"\\(ti", "~"},
                                           {"\\fB", ""},
                                           {"\\fI", ""},
                                           {"\\fR", ""},
                                           {"\\&", ""}})
            for (std::size_t at = 0; (at = text.find(escape, at)) != text.npos; at += sign.size())
                text.replace(at, escape.size(), sign);
        return text;
    }
    /// The names of the options in a section.
    static std::set<std::string> itemsOf(const std::string& section) {
        std::set<std::string> names;
        bool isItem = false;
        for (const std::string& line : linesOf(section)) {
            std::istringstream words(isItem ? line : "");
            for (std::string word; words >> word;) names.insert(word.substr(0, word.find(',')));
            isItem = line == ".TP";
        }
        return names;
    }
    /// The text below a heading of `kind`, "SH" or "SS", up to the next one.
    std::string section(const std::string& kind, const std::string& name) const {
        const std::string text = plain(), heading = "\n." + kind + " " + name + "\n";
        const std::size_t begin = text.find(heading);
        EXPECT_NE(begin, text.npos) << name;
        if (begin == text.npos) return "";
        std::size_t end = text.find("\n.SH ", begin + 1);
        if (kind == "SS") end = std::min(end, text.find("\n.SS ", begin + 1));
        return text.substr(begin, end - begin);
    }

    std::string page_;
};

TEST_F(Manual, itReportsEveryCommandAndEveryOptionOfTheHelp) {
    const std::set<std::string> shared =
        itemsOf(section("SH", "SHARED OPTIONS") + section("SH", "OPTIONS OF THE PROGRAM"));
    for (const std::string& option : optionsIn(runGood({"--help"}))) EXPECT_TRUE(shared.contains(option)) << option;
    const Words commands = commandsIn(runGood({"--help"}));
    ASSERT_GT(commands.size(), 8u);
    for (const std::string& command : commands) {
        SCOPED_TRACE(command);
        const std::string help = runGood({command, "--help"});
        const std::string text = section("SS", command) + '\n';
        std::smatch usage;
        ASSERT_TRUE(std::regex_search(help, usage, std::regex("Usage: ([^\n]+)")));
        EXPECT_THAT(text, HasSubstr("\n" + usage[1].str() + "\n"));
        std::set<std::string> listed = itemsOf(text);
        listed.insert(shared.begin(), shared.end());
        for (const std::string& option : optionsIn(help)) EXPECT_TRUE(listed.contains(option)) << option;
        const std::size_t examples = help.find("\nExamples\n");
        if (examples != help.npos) {
            for (const std::string& line : linesOf(help.substr(examples + 1)))
                EXPECT_TRUE(line.empty() || text.find("\n" + line + "\n") != text.npos) << line;
        }
    }
}

TEST_F(Manual, whatSettingsSayStandsThereOnce) {
    const std::string text = plain();
    int listed = 0;
    for (const engine::Setting& setting : engine::settingTable()) {
        if (setting.key == "technique") continue; // its help differs between commands
        const std::string item = fmt::format("\n.TP\n{} {}\n{}", setting.flag, setting.type, setting.help);
        const std::size_t at = text.find(item);
        EXPECT_NE(at, text.npos) << setting.flag;
        EXPECT_EQ(text.find(item, at + 1), text.npos) << setting.flag;
        ++listed;
    }
    EXPECT_GT(listed, 30);
}

TEST_F(Manual, troffFindsNothingToWarnOf) {
    folder_.write("tessera.1", page_);
    const ProcessResult result =
        runProcess({"groff", "-man", "-Tascii", "-ww", "-P-cbou", "tessera.1"}, {folder_.path(), {}, 60.0});
    EXPECT_EQ(result.exitCode, 0);
    EXPECT_EQ(result.err, "");
    EXPECT_THAT(result.out, HasSubstr("TESSERA(1)"));
    EXPECT_THAT(result.out, HasSubstr("\n       --layout NAME\n"));
    EXPECT_THAT(result.out, HasSubstr("tessera render hall -o hall.png  "));
    // The line that man -k and apropos list.
    EXPECT_THAT(page_, HasSubstr("\n.SH NAME\ntessera \\- "));
}

} // namespace
} // namespace tessera::test
