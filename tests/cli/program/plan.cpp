#include <set>

#include "tests/cli/program/Cli.h"

namespace tessera::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

class Plan : public Cli {
protected:
    static void expectKeys(const Json& object, const std::set<std::string>& wanted) {
        for (const std::string& key : wanted) EXPECT_TRUE(object.contains(key)) << key << " in " << object;
    }
};

TEST_F(Plan, theJsonHasTheDocumentedFields) {
    const std::string said = runGood({"plan", "lattice", "--lights", "8", "--json", "p.json", "--dot", "p.dot"});
    EXPECT_THAT(said, testing::StartsWith("lattice, deferred: 5 passes run, "));
    const Json plan = json("p.json");
    expectKeys(plan, {"schema", "scene", "technique", "passes", "left_out", "choices", "counters", "resources", "bytes",
                      "bytesWithoutAliasing"});
    EXPECT_EQ(plan["scene"], "lattice");
    EXPECT_EQ(plan["technique"], "deferred");
    EXPECT_EQ(plan["counters"]["lights"], 8);
    for (const Json& pass : plan["passes"]) expectKeys(pass, {"name", "reads", "writes"});
    for (const Json& item : plan["left_out"]) expectKeys(item, {"what", "why", "bytes", "ms"});
    for (const Json& choice : plan["choices"]) expectKeys(choice, {"what", "chosen", "why"});
    for (const Json& resource : plan["resources"])
        expectKeys(resource, {"name", "format", "width", "height", "bytes", "first", "last", "aliasOf"});
    EXPECT_FALSE(plan["passes"].empty() || plan["left_out"].empty() || plan["choices"].empty() ||
                 plan["resources"].empty());
    for (const Json& item : plan["left_out"]) EXPECT_TRUE(item["ms"].is_null()) << "not measured";
    EXPECT_THAT(text("p.dot"), testing::StartsWith("digraph"));
    EXPECT_THAT(text("p.dot"), HasSubstr("deferred_lighting"));
}

TEST_F(Plan, aHyphenMeansTheStandardOutputAlone) {
    const Words plan{"plan", "lattice", "--lights", "8"};
    const auto with = [&](const Words& more) {
        Words words = plan;
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    runGood(with({"--json", "p.json", "--dot", "p.dot"}));
    EXPECT_EQ(runGood(with({"--json", "-"})), text("p.json"));
    EXPECT_EQ(runGood(with({"--dot", "-"})), text("p.dot"));
    EXPECT_FALSE(files().contains("-"));
    expectError(2, with({"--json", "-", "--dot", "-"}), {"--json -", "--dot -", "name a file"});
    EXPECT_EQ(Json::parse(runGood({"compare", "lattice", "--lights", "8", "--size", "160x90", "--techniques",
                                   "deferred", "--quiet", "--json", "-"}))["pairs"]
                  .size(),
              1u);
    EXPECT_FALSE(files().contains("-"));
}

TEST_F(Plan, measureFillsInMilliseconds) {
    runGood({"plan", "room", "--size", "160x90", "--measure", "--json", "p.json"});
    const Json plan = json("p.json");
    for (const Json& pass : plan["passes"]) EXPECT_GT(pass["ms"], 0.0) << pass;
    bool isMeasured = false;
    for (const Json& item : plan["left_out"]) isMeasured = isMeasured || item["ms"].is_number();
    EXPECT_TRUE(isMeasured);
}

TEST_F(Plan, theMemoryOfLightListsIsNotGuessedAndMeasured) {
    const auto entriesOf = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"plan",   "lattice",     "--lights",       "64",     "--size",
                                           "160x90", "--technique", "tiled_deferred", "--json", "p.json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        runGood(arguments);
        const Json plan = json("p.json");
        for (const Json& resource : plan["resources"])
            if (resource["name"] == "light_entries") return resource["bytes"];
        ADD_FAILURE() << "no light_entries";
        return Json();
    };
    EXPECT_TRUE(entriesOf({}).is_null());
    const Json measured = entriesOf({"--measure"});
    ASSERT_TRUE(measured.is_number());
    EXPECT_EQ(measured, 4 * json("p.json")["counters"]["lightListEntries"].get<int>());
    EXPECT_GT(measured, 100);
}

TEST_F(Plan, pruneOffNeverLeavesAnythingOutOfThePlan) {
    runGood({"plan", "lattice", "--json", "on.json"});
    runGood({"plan", "lattice", "--prune", "off", "--json", "off.json"});
    EXPECT_GT(json("on.json")["left_out"].size(), json("off.json")["left_out"].size());
    EXPECT_LT(json("on.json")["bytes"], json("off.json")["bytes"]);
}

TEST_F(Plan, furtherCamerasAreAlwaysViewsOfTheSameFrame) {
    runGood({"plan", "hall", "--json", "one.json"});
    const std::string said = runGood({"plan", "hall", "--also", "0", "--also", "0"});
    EXPECT_THAT(said, HasSubstr("hall, deferred, deferred, deferred: "));
    EXPECT_THAT(said, HasSubstr("radiance (3)"));
    runGood({"plan", "hall", "--also", "0", "--json", "two.json"});
    const Json one = json("one.json"), two = json("two.json");
    EXPECT_EQ(two["passes"].size(), 2 * one["passes"].size());
    EXPECT_LT(two["bytes"], two["bytesWithoutAliasing"]);
    EXPECT_EQ(two["bytesWithoutAliasing"], 2 * one["bytesWithoutAliasing"].get<std::size_t>());
    expectError(2, {"plan", "hall", "--also", "0", "0"}, {"'0'"});
    expectError(2, {"plan", "hall", "--also", "nowhere"}, {"unknown camera 'nowhere'"});
    expectError(2, {"plan", "hall", "--also", "0", "--measure"}, {"--measure", "one view", "--also"});
}

TEST_F(Plan, plansNeedNoGraphicsAndOtherCommandsNameTheMissingPackage) {
    EXPECT_THAT(runGood({"plan", "room"}, kNoGraphics), HasSubstr("deferred_lighting"));
    const Words remedy{"no OpenGL 4.5 context can be made", "EGL surfaceless", "install", "libegl1 libgl1-mesa-dri"};
    expectError(1, {"render", "room", "-o", "a.png"}, remedy, kNoGraphics);
    expectError(1, {"render", "room", "-o", "a.png", "--context", "egl"}, remedy, kNoGraphics);
    expectError(1, {"render", "room", "-o", "a.png", "--context", "window"}, {"GLFW window", "install", "display"},
                kNoGraphics);
    expectError(1, {"compare", "room"}, remedy, kNoGraphics);
    expectError(1, {"plan", "room", "--measure"}, remedy, kNoGraphics);
    expectError(1, {"demo", "room"}, remedy, kNoGraphics);
    expectError(1, {"--version", "--verbose"}, remedy, kNoGraphics);
    // The program's version needs no driver.
    EXPECT_THAT(
        runGood({"--version"}, kNoGraphics),
        testing::ContainsRegex("^tessera [0-9.]+\ncommit +[^ \n]+\nOpenGL +none: no OpenGL 4.5 context[^\n]*\n$"));
}

} // namespace
} // namespace tessera::test
