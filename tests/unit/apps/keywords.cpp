#include "apps/Keywords.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <set>

#include <gmock/gmock.h>

#include "apps/FrameOptionText.h"
#include "apps/Options.h"
#include "base/Error.h"

namespace tessera::app {
namespace {

using testing::HasSubstr;

/// Parses the words of a command line into options.
FrameOptions ofCommandLine(std::vector<std::string> words) {
    CLI::App command;
    FrameOptions options;
    addFrameOptions(command, options, "hall");
    std::ranges::reverse(words); // CLI11 expects them reversed
    command.parse(words);
    return options;
}

/// A keyword's value and the equivalent words of the command line.
struct SaidTwice {
    KeywordValue value;
    std::vector<std::string> words;
};

const std::map<std::string_view, SaidTwice>& saidTwice() {
    static const std::map<std::string_view, SaidTwice> table{
        {"lights", {{.number = 7}, {"--lights", "7"}}},
        {"default_light", {{.isOn = false}, {"--no-default-light"}}},
        {"environment", {{.text = "sky"}, {"--environment", "sky"}}},
        {"background", {{.point = {0.1, 0.25, 0.0}}, {"--background", "0.1,0.25,0"}}},
        {"clip", {{.text = "2"}, {"--clip", "2"}}},
        {"hook", {{.hooks = {{"wind", 1.5f}, {"shade", -2.0f}}}, {"--hook", "wind=1.5", "--hook", "shade=-2"}}},
        {"memory_limit", {{.text = "4G"}, {"--memory-limit", "4G"}}},
        {"variant", {{.text = "deep red"}, {"--variant", "deep red"}}},
        {"light_units", {{.text = "watt"}, {"--light-units", "watt"}}},
        {"obj_colours", {{.text = "linear"}, {"--obj-colours", "linear"}}},
        {"strict", {{.isOn = true}, {"--strict"}}},
        {"default_camera", {{.isOn = true}, {"--default-camera"}}},
        {"eye", {{.point = {1.0, 0.1, -3.0}}, {"--eye", "1,0.1,-3"}}},
        {"target", {{.point = {4.0, 5.0, 6.0}}, {"--target", "4,5,6"}}},
        {"up", {{.point = {0.0, 0.0, 1.0}}, {"--up", "0,0,1"}}},
        {"fov", {{.number = 33.3}, {"--fov", "33.3"}}},
        {"half_height", {{.number = 2.5}, {"--half-height", "2.5"}}},
        {"near", {{.number = 0.1}, {"--near", "0.1"}}},
        {"far", {{.number = 90.0}, {"--far", "90"}}},
    };
    return table;
}

/// Text of the options apart from their settings.
std::string allOf(const FrameOptions& options) {
    return frameOptionText(options) + " memory " + options.memoryLimit.value_or("");
}

TEST(Keywords, everyOneSaysWhatItsFlagSays) {
    for (const LoadKeyword& row : loadKeywords()) {
        ASSERT_TRUE(saidTwice().contains(row.keyword)) << row.keyword;
        const SaidTwice& said = saidTwice().at(row.keyword);
        FrameOptions options;
        takeKeyword(row.keyword, said.value, options);
        EXPECT_EQ(allOf(options), allOf(ofCommandLine(said.words))) << row.keyword;
        EXPECT_NE(allOf(options), allOf({})) << row.keyword;
    }
    EXPECT_EQ(saidTwice().size(), loadKeywords().size());
}

TEST(Keywords, everyOptionOfAFrameHasOne) {
    std::set<std::string> keywords;
    for (const engine::Setting& setting : engine::settingTable()) keywords.insert(keywordOf(setting.flag));
    for (const LoadKeyword& row : loadKeywords())
        EXPECT_TRUE(keywords.emplace(row.keyword).second) << row.keyword << " is said by two";
    keywords.erase("default_light");
    keywords.insert("no_default_light"); // the only negated flag
    CLI::App command;
    FrameOptions options;
    addFrameSettings(command, options);
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_name() == "--help") continue;
        EXPECT_EQ(keywords.erase(keywordOf(option->get_name())), 1u) << option->get_name();
    }
    EXPECT_TRUE(keywords.empty()) << *keywords.begin();
}

TEST(Keywords, typeStubsNameEveryOneAndNoOther) {
    std::ifstream file(TESSERA_SOURCE_DIR "/python/tessera.pyi");
    std::set<std::string> named;
    std::string line;
    while (std::getline(file, line) && !line.starts_with("class Keywords")) {
    }
    while (std::getline(file, line) && !line.starts_with("class "))
        if (const std::size_t colon = line.find(": "); line.starts_with("    ") && colon != std::string::npos)
            named.insert(line.substr(4, colon - 4));
    std::erase_if(named, [](const std::string& name) { return name.find(' ') != std::string::npos; }); // docstring
    std::set<std::string> keywords;
    for (const engine::Setting& setting : engine::settingTable()) keywords.insert(keywordOf(setting.flag));
    for (const LoadKeyword& row : loadKeywords()) keywords.emplace(row.keyword);
    EXPECT_EQ(named, keywords);
}

TEST(Keywords, aValueThatTheCommandLineRefusesIsRefused) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const std::pair<std::string_view, KeywordValue> kBad[] = {
        {"lights", {.number = 1.5}},
        {"lights", {.number = 3e9}},
        {"fov", {.number = kNaN}},
        {"eye", {.point = {0.0, kNaN, 0.0}}},
        {"variant", {}},
        {"light_units", {.text = "lux"}},
        {"obj_colours", {.text = "bytes"}},
        {"hook", {.hooks = {{"", 1}}}},
        {"hook", {.hooks = {{"wind", std::numeric_limits<float>::infinity()}}}}};
    for (const auto& [keyword, value] : kBad) {
        FrameOptions options;
        EXPECT_THROW(takeKeyword(keyword, value, options), InputError) << keyword;
        EXPECT_EQ(allOf(options), allOf({})) << keyword;
    }
}

TEST(Keywords, messagesNameThemInsteadOfFlags) {
    EXPECT_EQ(withKeywords("check --eye, --half-height and (--cull-on)"), "check eye, half_height and (cull_on)");
    EXPECT_EQ(withKeywords("--range-tolerance -1 is below 0"), "range_tolerance -1 is below 0");
    for (const char* same : {"a--b.json: 3 -- 4", "'--eye.obj' does not exist", "--", "-- --5", ""})
        EXPECT_EQ(withKeywords(same), same);
    EXPECT_EQ(withKeywords("ends in --tile"), "ends in tile");
}

TEST(Keywords, aWordThatIsNoneGetsTheNearestOnes) {
    EXPECT_THAT(suggestKeywords("exposur"), HasSubstr("did you mean 'exposure'"));
    EXPECT_THAT(suggestKeywords("half_hight"), HasSubstr("'half_height'"));
    constexpr std::string_view kFurther[] = {"progress"};
    EXPECT_THAT(suggestKeywords("progres", kFurther), HasSubstr("'progress'"));
}

} // namespace
} // namespace tessera::app
