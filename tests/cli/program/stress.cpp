#include <set>

#include "apps/Commands.h"
#include "tests/cli/program/Cli.h"

namespace tessera::test {
namespace {

using app::kBadInput;
using app::kToleranceMissed;

class StressCommand : public Cli {};

TEST_F(StressCommand, aCaseReportsItsFiguresOnTheTerminalAndAsJson) {
    const std::string table = runGood({"stress", "--quick", "--case", "terms", "--case", "scene/light_place",
                                       "--technique", "forward,deferred", "--json", "s.json"});
    EXPECT_THAT(table, testing::HasSubstr("terms/fresnel"));
    EXPECT_THAT(table, testing::ContainsRegex("\nall [0-9]+ hold over [0-9]+ samples\n"));
    const nlohmann::json record = json("s.json");
    EXPECT_EQ(record["schema"], 1);
    EXPECT_FALSE(record["renderer"].get<std::string>().empty());
    std::set<std::string> techniques;
    for (const nlohmann::json& row : record["cases"]) {
        EXPECT_EQ(row["ok"], true) << row["name"];
        EXPECT_GT(row["samples"], 0) << row["name"];
        EXPECT_LE(row["worstRel"], row["tolerance"]) << row["name"];
        if (row["technique"].is_string()) techniques.insert(row["technique"].get<std::string>());
    }
    EXPECT_EQ(techniques, (std::set<std::string>{"deferred", "forward"}));
}

TEST_F(StressCommand, theShardsHaveEveryResultOfAWholeRunOnceAndAsItIsThere) {
    const auto casesOf = [this](const std::string& name, const Words& more) {
        Words words{"stress", "--quick", "--case", "terms", "--json", name};
        words.insert(words.end(), more.begin(), more.end());
        runGood(words);
        return json(name)["cases"];
    };
    const nlohmann::json whole = casesOf("whole.json", {});
    ASSERT_GT(whole.size(), 3u);
    nlohmann::json together = nlohmann::json::array();
    const nlohmann::json shards[] = {casesOf("1.json", {"--shard", "1/3"}), casesOf("2.json", {"--shard", "2/3"}),
                                     casesOf("3.json", {"--shard", "3/3"})};
    // Each shader function has one result, and each shard every third of them.
    for (std::size_t i = 0; i < whole.size(); ++i) {
        ASSERT_LT(i / 3, shards[i % 3].size());
        together.push_back(shards[i % 3][i / 3]);
    }
    EXPECT_EQ(together, whole);
    EXPECT_EQ(shards[0].size() + shards[1].size() + shards[2].size(), whole.size());
    expectError(kBadInput, {"stress", "--case", "terms", "--shard", "1/1000"}, {"--shard 1/1000", "give fewer"});
    expectError(kBadInput, {"stress", "--shard", "3/2"}, {"--shard 3/2", "1/4"});
}

TEST_F(StressCommand, theListShowsEveryGroupAndRunsNothing) {
    const std::string list = runGood({"stress", "--list"});
    for (const char* group :
         {"brdf/", "directions/", "roughness/", "terms/", "light/", "lights/", "scene/", "geometry/", "target/"})
        EXPECT_THAT(list, testing::HasSubstr(group));
}

TEST_F(StressCommand, aShaderWithAFaultEndsWithExitCodeThree) {
    std::filesystem::copy(std::filesystem::path(TESSERA_SOURCE_DIR) / "shaders", folder_.path() / "shaders",
                          std::filesystem::copy_options::recursive);
    std::string source = text("shaders/lib/maths/math.glsl");
    const std::string right = "kPi = 3.14159265358979323846";
    ASSERT_NE(source.find(right), std::string::npos);
    folder_.write("shaders/lib/maths/math.glsl", source.replace(source.find(right), right.size(), "kPi = 3.17300858"));
    const ProcessResult result =
        run({"stress", "--quick", "--case", "terms", "--json", "s.json"}, {{"TESSERA_SHADERS", path("shaders")}});
    EXPECT_EQ(result.exitCode, kToleranceMissed);
    EXPECT_EQ(result.err, "");
    EXPECT_THAT(result.out, testing::HasSubstr("missed: terms/distribution_0.3: the worst relative error is 0.0"));
    EXPECT_EQ(json("s.json")["ok"], false);
}

TEST_F(StressCommand, anUnknownNameIsRefusedWithTheNearest) {
    expectError(kBadInput, {"stress", "--case", "terms/fresnal"}, {"terms/fresnal", "terms/fresnel"});
    expectError(kBadInput, {"stress", "--case", "directons/peak"}, {"did you mean 'directions'?"});
    expectError(kBadInput, {"stress", "--case", "nosuch"}, {"valid are brdf, directions, roughness"});
    expectError(kBadInput, {"stress", "--technique", "forwart"}, {"forwart", "forward"});
    expectError(app::kFailed, {"stress", "--quick", "--case", "terms", "--json", "/proc/nix/s.json"}, {"/proc/nix"});
}

} // namespace
} // namespace tessera::test
