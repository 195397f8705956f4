#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/Error.h"
#include "scenes/Load.h"
#include "tests/support/ErrorText.h"
#include "tests/unit/validation/Benches.h"
#include "validation/bench/BenchHtml.h"
#include "validation/bench/BenchJson.h"
#include "validation/bench/BenchMatrix.h"
#include "validation/bench/Recommend.h"
#include "validation/bench/ScalingFit.h"

namespace tessera::validation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

BenchMatrix matrixOf(const std::string& json) {
    scenes::LoadLedger ledger;
    return parseMatrix(json, "m.json", ledger);
}

std::string refusal(const std::string& json) {
    return test::errorText<InputError>([&] { matrixOf(json); });
}

/// The plan of one technique on a scene, at 64x36 pixels.
BenchPlan planOf(const std::string& scene, const std::string& json, frame::FrameSettings settings = {},
                 const scenes::LoadOptions& options = {}) {
    settings.sizePixels = {64, 36};
    BenchMatrix matrix = matrixOf(json);
    matrix.techniques = {engine::Technique::Forward};
    BenchPlan plan;
    addToPlan(plan, matrix, scene, {}, settings, [&](std::optional<int>) { return scenes::loadScene(scene, options); });
    return plan;
}

std::vector<std::string> namesOf(const BenchPlan& plan) {
    std::vector<std::string> names;
    for (const BenchPoint& point : plan.groups.front().points) names.push_back(pointName(point.key));
    return names;
}

std::vector<std::string> reasonsOf(const BenchPlan& plan) {
    std::vector<std::string> reasons;
    for (const SkippedPoint& point : plan.skipped) reasons.push_back(point.what + ": " + point.why);
    return reasons;
}

/// 16 KB may request 10^11 points.
TEST(BenchMatrix, pointsAreCountedBeforeTheyArePlanned) {
    std::string hundred = "0";
    for (int i = 1; i < 100; ++i) hundred += "," + std::to_string(i);
    const std::string two = R"("range": [)" + hundred + R"(], "lights": [)" + hundred + "]";
    const std::string sizes = R"(, "size": ["1x1", "2x1", "3x1", "4x1", "5x1", "6x1", "7x1", "8x1", "9x1", "10x1")";
    const std::string one = R"({"technique": ["forward"], )";
    EXPECT_EQ(matrixOf(one + two + sizes + "]}").lights.size(), 100u);
    EXPECT_EQ(refusal(one + two + sizes + R"(, "9x9"]})"),
              "m.json: needs 1.1e+05 points, the product of its lists' lengths; at most 100000 can be measured: "
              "shorten the lists, or divide them over several runs");
    EXPECT_THAT(refusal("{" + two + sizes + "]}"), testing::StartsWith("m.json: needs 8e+05 points"))
        << "of every technique";
    const std::string counted = hundred.substr(hundred.find(',') + 1); // 1 to 99
    EXPECT_THAT(refusal(one + R"("shadowSamples": [)" + counted +
                        R"(], "environmentSamples": [1, 4, 16, 64, 1, 4, 16, 64, 1, 4, 16]})"),
                testing::StartsWith("m.json: needs 1.09e+03 combinations of settings"));
}

TEST(ShadowMatrix, valuesHaveTheBoundsOfTheSettings) {
    EXPECT_EQ(refusal(R"({"shadow": ["pfc"]})"), "m.json: \"shadow\": unknown 'pfc': did you mean 'pcf'?");
    EXPECT_EQ(refusal(R"({"shadow": [1024]})"),
              "m.json: \"shadow\": 1024 is no name; valid are none, traced, hard, pcf, pcss");
    EXPECT_EQ(refusal(R"({"shadowRes": [64]})"), "m.json: unknown key 'shadowRes': did you mean 'shadowResolution'?");
    EXPECT_EQ(refusal(R"({"shadow": "hard"})"),
              "m.json: \"shadow\": must be an array with at least one entry, as in {\"shadow\": [\"hard\"]}");
    for (const char* none : {"[]", "{}", "null"})
        EXPECT_EQ(refusal(fmt::format(R"({{"shadow": {}}})", none)),
                  "m.json: \"shadow\": must be an array with at least one entry");
    EXPECT_EQ(refusal(R"({"shadowWidth": [4]})"), "m.json: \"shadowWidth\": shadow width 4: give one of 1, 3, 5, 7");
    EXPECT_EQ(refusal(R"({"shadowResolution": [100]})"),
              "m.json: \"shadowResolution\": shadow resolution 100: give one of 64, 128, 256, 512, 1024, 2048, 4096, "
              "8192");
    EXPECT_EQ(refusal(R"({"shadowResolution": ["large"]})"), "m.json: \"shadowResolution\": \"large\" is no number");
    EXPECT_EQ(refusal(R"({"shadowBudget": [2048]})"),
              "m.json: \"shadowBudget\": shadow budget 2048 is above 1024; give 0.001 to 1024");
    EXPECT_EQ(refusal(R"({"shadowSamples": [0]})"),
              "m.json: \"shadowSamples\": shadow samples 0 is below 1; give 1 to 1024");
    EXPECT_EQ(refusal(R"({"shadowCascades": [2.5]})"),
              "m.json: \"shadowCascades\": shadow cascades '2.5' is not a whole number, such as 8");
    EXPECT_THAT(refusal(R"({"shadowWidht": [3]})"), HasSubstr("did you mean 'shadowWidth'"));
    EXPECT_EQ(refusal(R"({"shadowCascades": [2.0]})"), "");
    EXPECT_EQ(refusal(R"({"shadowResolution": ["automatic", 64], "shadowBudget": [0.5]})"), "");
}

TEST(ShadowMatrix, everySettingIsVariedByItsFilterAndDrawnOnceWithTheOthers) {
    // A lamp with a size and a sun: each shadow setting affects some filter.
    const auto names = [](const std::string& more) {
        return namesOf(planOf("shadow_truth", R"({"shadow": ["traced", "hard", "pcf", "pcss", "none"])" + more + "}"));
    };
    EXPECT_THAT(names(R"(, "shadowSamples": [16, 4])"),
                ElementsAre("forward, exact, traced", "forward, exact, traced, samples 4", "forward, exact, hard",
                            "forward, exact, pcf", "forward, exact, pcss", "forward, exact, pcss, samples 4",
                            "forward, exact, no shadows"));
    EXPECT_THAT(names(R"(, "shadowWidth": [3, 5])"),
                ElementsAre("forward, exact, traced", "forward, exact, hard", "forward, exact, pcf",
                            "forward, exact, pcf, 5x5", "forward, exact, pcss", "forward, exact, no shadows"));
    EXPECT_THAT(names(R"(, "shadowResolution": [64, 128])"),
                ElementsAre("forward, exact, traced", "forward, exact, hard, 64 texels",
                            "forward, exact, hard, 128 texels", "forward, exact, pcf, 64 texels",
                            "forward, exact, pcf, 128 texels", "forward, exact, pcss, 64 texels",
                            "forward, exact, pcss, 128 texels", "forward, exact, no shadows"));
}

TEST(ShadowMatrix, mapsWithTheSameFacesAreMeasuredOnce) {
    frame::FrameSettings all;
    all.shadows = {scenes::ShadowRequest::Kind::All};
    // head has no directional light; 64 MiB hold its faces, as 128 do, and 1 does not.
    const BenchPlan plan = planOf("head", R"({"shadow": ["hard"], "shadowCascades": [4, 1],
                                              "shadowBudget": [64, 128, 1], "shadowResolution": [512]})",
                                  all);
    EXPECT_THAT(namesOf(plan),
                ElementsAre("forward, exact, hard, 512 texels", "forward, exact, hard, 512 texels, 1 MiB"));
    EXPECT_THAT(
        reasonsOf(plan),
        testing::Contains("shadow hard, shadowBudget 128, shadowCascades 4, shadowResolution 512 in head with 4 "
                          "lights: it is the same frame as hard, 512 texels"));
    EXPECT_EQ(plan.skipped.size(), 4u);
}

TEST(ShadowMatrix, aSceneWithoutShadowsIsOnePoint) {
    const std::string matrix = R"({"shadow": ["traced", "hard", "none"], "shadowResolution": [64, 128]})";
    const BenchPlan room = planOf("room", matrix); // none of its lights casts shadows
    EXPECT_THAT(namesOf(room), ElementsAre("forward, exact"));
    EXPECT_THAT(reasonsOf(room), testing::Each(HasSubstr("there are no shadows")));
    EXPECT_EQ(room.skipped.size(), 5u);
    frame::FrameSettings none;
    none.shadows = {scenes::ShadowRequest::Kind::None};
    EXPECT_THAT(namesOf(planOf("shadow_truth", matrix, none)), ElementsAre("forward, exact"));
}

TEST(ShadowMatrix, theTruthHasTheShadowsOfTheCommandLineWhateverThePointsHave) {
    const PlannedGroup group = planOf("shadow_truth", R"({"shadow": ["none", "hard"]})").groups.front();
    EXPECT_EQ(group.points.front().settings.shadows.kind, scenes::ShadowRequest::Kind::None);
    EXPECT_EQ(group.settings.shadows.kind, scenes::ShadowRequest::Kind::Scene);
    const frame::FrameSettings exact = exactSettings(group.points[1].settings, frame::TextureFilter::Exact);
    EXPECT_EQ(exact.shadowFilter, frame::ShadowFilter::Traced);
}

/// Points with traced shadows, with maps, and with none.
BenchGroup shadowedGroup() {
    BenchGroup group = madeUpGroup(4, {madeUpResult("forward", 100, 1e-9), madeUpResult("forward", 20, 2e-3),
                                       madeUpResult("deferred", 10, 5e-5), madeUpResult("deferred", 8, 0.4)});
    group.results[0].key.method(MethodKind::Shadows) = MethodKey{"traced", {}};
    group.results[1].key.method(MethodKind::Shadows) =
        MethodKey{"hard", {{"shadowResolution", "1024"}, {"shadowBudget", "64"}}};
    group.results[2].key.method(MethodKind::Shadows) =
        MethodKey{"pcf", {{"shadowWidth", "5"}, {"shadowResolution", "1024"}, {"shadowBudget", "0.5"}}};
    group.results[3].key.method(MethodKind::Shadows) = MethodKey{std::string(kNoShadows)};
    return group;
}

TEST(ShadowPoints, theRecordHasEverySettingThatCountsAndAReasonForTheOthers) {
    const nlohmann::ordered_json points = groupJson(shadowedGroup())["points"];
    EXPECT_EQ(points[0]["shadow"], "traced");
    EXPECT_EQ(points[2]["shadow"], "pcf");
    EXPECT_EQ(points[2]["shadowWidth"], 5);
    EXPECT_EQ(points[2]["shadowBudget"], 0.5);
    EXPECT_EQ(points[2]["why"]["shadowSamples"],
              "no shadow is soft: no light with a size casts one, or the filter ignores the sizes");
    EXPECT_EQ(points[3]["shadow"], "none");
    EXPECT_EQ(points[3]["why"]["shadowResolution"], "there are no shadows");
    for (const nlohmann::ordered_json& point : points)
        for (const auto& [name, value] : point.items())
            EXPECT_TRUE(!value.is_null() || point["why"].contains(name)) << name;
    BenchRecord record;
    record.groups = {shadowedGroup()};
    const std::string csv = benchCsv(record);
    EXPECT_THAT(
        csv, HasSubstr(",range,shadow,shadowSamples,shadowWidth,shadowResolution,shadowBudget,shadowCascades,"
                       "subsurface,diffusionTexels,diffusionGaussians,diffusionHalf,"
                       "environmentLight,environmentSamples,environmentCompensation,areaLights,areaSamples,lights,"));
    EXPECT_THAT(csv, HasSubstr(",exact,0,pcf,,5,1024,0.5,,,,,,,,,,,4,64,32,"));
    EXPECT_THAT(csv, HasSubstr(",exact,0,none,,,,,,,,,,,,,,,4,64,32,"));
}

TEST(ShadowPoints, tablesAndThePageNameThem) {
    BenchRecord record;
    record.groups = {shadowedGroup()};
    const std::string table = benchTable(record);
    for (const char* text : {"shadows", "traced", "no shadows"}) EXPECT_THAT(table, HasSubstr(text));
    const std::string page = benchHtml(record, record.groups[0], {}).sections;
    EXPECT_THAT(page, HasSubstr("<th scope=\"col\">Shadows</th>"));
    EXPECT_THAT(page, HasSubstr("<td data-label=\"Shadows\">pcf, 5x5, 1024 texels, 0.5 MiB</td>"));
    EXPECT_THAT(page, HasSubstr(R"("markKind":"shadow filter")"));
    EXPECT_THAT(page, HasSubstr(R"("mark":"pcf")"));
    for (BenchResult& result : record.groups[0].results) result.key.method(MethodKind::Shadows).reset();
    EXPECT_THAT(benchHtml(record, record.groups[0], {}).sections, HasSubstr(R"("markKind":"layout")"));
    EXPECT_THAT(benchTable(record), Not(HasSubstr("shadows")));
}

TEST(ShadowPoints, theRecommendationNamesTheFilterAndThatOfTheForwardItIsComparedWith) {
    const BenchGroup group = shadowedGroup();
    const std::optional<Recommendation> choice = recommendFor(group);
    EXPECT_EQ(choice->best, &group.results[2]);
    EXPECT_EQ(choice->baseline, &group.results[0]); // the most exact of forward's points
    EXPECT_THAT(recommendationText(group),
                HasSubstr("take deferred, exact, pcf, 5x5, 1024 texels, 0.5 MiB: 10.0x faster than forward (traced) at "
                          "relMSE 5.0e-05"));
    EXPECT_THAT(recommendationText(group), HasSubstr("The most exact is forward, exact, traced at relMSE 1.0e-09."));
}

TEST(ShadowPoints, curvesJoinPointsThatFindShadowsAlike) {
    BenchGroup few = shadowedGroup(), many = shadowedGroup();
    many.lights = 16;
    EXPECT_EQ(scalingCurves(std::vector<BenchGroup>{few, many}).size(), 4u);
    many.results[1].key.method(MethodKind::Shadows)->values[0].text = "512";
    EXPECT_EQ(scalingCurves(std::vector<BenchGroup>{few, many}).size(), 3u);
}

TEST(SubsurfaceMatrix, methodsAndSettingsOfDiffusionAreVariedWhereTheyChangeTheFrame) {
    const BenchPlan plan = planOf("diffusion_truth", R"({"subsurface": ["none", "wrap", "texture_space_diffusion"],
                                                         "diffusionTexels": [64, 1024], "diffusionHalf": [true]})");
    EXPECT_THAT(namesOf(plan),
                ElementsAre("forward, exact, traced, no subsurface", "forward, exact, traced, wrap",
                            "forward, exact, traced, texture_space_diffusion, 64 texels, half resolution on",
                            "forward, exact, traced, texture_space_diffusion, half resolution on"));
    EXPECT_THAT(reasonsOf(plan), testing::Contains(HasSubstr("it is the same frame as traced, wrap")));
    EXPECT_THAT(namesOf(planOf("room", R"({"subsurface": ["wrap", "none"]})")), ElementsAre("forward, exact"));
    // By default, the frame uses the methods of its materials.
    EXPECT_THAT(namesOf(planOf("diffusion_truth", "{}")),
                ElementsAre("forward, exact, traced, texture_space_diffusion"));
}

TEST(SubsurfacePoints, theRecordHasThemAndReadsThemAgain) {
    BenchGroup group = shadowedGroup();
    group.results[0].key.method(MethodKind::Subsurface) = MethodKey{
        "texture_space_diffusion", {{"diffusionTexels", "256"}, {"diffusionGaussians", "8"}, {"diffusionHalf", "on"}}};
    group.results[1].key.method(MethodKind::Subsurface) = MethodKey{"wrap", {}};
    const nlohmann::ordered_json points = groupJson(group)["points"];
    EXPECT_EQ(points[0]["subsurface"], "texture_space_diffusion");
    EXPECT_EQ(points[0]["diffusionTexels"], 256);
    EXPECT_EQ(points[0]["diffusionHalf"], true);
    EXPECT_EQ(points[1]["subsurface"], "wrap");
    EXPECT_EQ(points[1]["why"]["diffusionTexels"], "no surface diffuses light");
    EXPECT_EQ(points[2]["why"]["subsurface"], "no material has a subsurface");
    const BenchGroup again = groupFromJson(groupJson(group));
    for (std::size_t i = 0; i < group.results.size(); ++i) EXPECT_EQ(again.results[i].key, group.results[i].key);
    BenchRecord record;
    record.groups = {group};
    EXPECT_THAT(benchCsv(record), HasSubstr(",texture_space_diffusion,256,8,on,,,,,,4,64,32,"));
    const std::string page = benchHtml(record, record.groups[0], {}).sections;
    EXPECT_THAT(page,
                HasSubstr("<td data-label=\"Subsurface\">texture_space_diffusion, 256 texels, half resolution on"));
    EXPECT_THAT(page, HasSubstr(R"("markKind":"subsurface")"));
}

scenes::LoadOptions inTheStudio() {
    scenes::LoadOptions options;
    options.environment = "studio"; // the fastest to make
    return options;
}

TEST(EnvironmentMatrix, valuesHaveTheBoundsOfTheSettings) {
    EXPECT_EQ(refusal(R"({"environmentLight": ["sample"]})"),
              "m.json: \"environmentLight\": unknown 'sample': did you mean 'sampled'?");
    EXPECT_EQ(refusal(R"({"environmentSamples": [100]})"),
              "m.json: \"environmentSamples\": environment samples 100: give one of 1, 4, 16, 64, 256, 1024, 4096");
    EXPECT_EQ(refusal(R"({"environmentCompensation": [1]})"),
              "m.json: \"environmentCompensation\": 1 is neither true nor false");
    EXPECT_EQ(refusal(R"({"environmentLight": ["off", "sampled"], "environmentCompensation": [true]})"), "");
}

TEST(EnvironmentMatrix, everySettingIsVariedWhereItIsUsed) {
    const BenchPlan plan =
        planOf("room", R"({"environmentLight": ["split_sum", "sampled", "off"], "environmentSamples": [4, 64],
                           "environmentCompensation": [false, true]})",
               {}, inTheStudio());
    EXPECT_THAT(namesOf(plan),
                ElementsAre("forward, exact, environment split_sum", "forward, exact, environment sampled, samples 4",
                            "forward, exact, environment sampled", "forward, exact, no environment light",
                            "forward, exact, environment split_sum, compensation on",
                            "forward, exact, environment sampled, samples 4, compensation on",
                            "forward, exact, environment sampled, compensation on"));
    EXPECT_THAT(reasonsOf(plan), testing::Contains(HasSubstr("it is the same frame as no environment light")));
    EXPECT_EQ(plan.skipped.size(), 5u);
    // By default, the frame uses the settings of the command line.
    EXPECT_THAT(namesOf(planOf("room", "{}", {}, inTheStudio())), ElementsAre("forward, exact, environment split_sum"));
}

TEST(EnvironmentMatrix, whereTheTruthHasNoneOfItsLightNoPointHas) {
    const std::string matrix = R"({"environmentLight": ["split_sum", "sampled"]})";
    EXPECT_THAT(namesOf(planOf("room", matrix)), ElementsAre("forward, exact")) << "no environment";
    frame::FrameSettings off;
    off.environment.light = frame::EnvironmentLight::Off;
    const BenchPlan plan = planOf("room", matrix, off, inTheStudio());
    EXPECT_THAT(namesOf(plan), ElementsAre("forward, exact"));
    EXPECT_EQ(plan.groups.front().points.front().settings.environment.light, frame::EnvironmentLight::Off);
    EXPECT_THAT(reasonsOf(plan), testing::Each(HasSubstr("no environment shines")));
    const PlannedGroup lit = planOf("room", R"({"environmentLight": ["off"]})", {}, inTheStudio()).groups.front();
    EXPECT_EQ(lit.points.front().settings.environment.light, frame::EnvironmentLight::Off);
    EXPECT_EQ(lit.settings.environment.light, frame::EnvironmentLight::SplitSum) << "which is what the truth shows";
}

TEST(AreaMatrix, settingsAreVariedWhereAreaLightsShine) {
    EXPECT_EQ(refusal(R"({"areaLights": ["sample"]})"),
              "m.json: \"areaLights\": unknown 'sample': did you mean 'sampled'?");
    EXPECT_EQ(refusal(R"({"areaSamples": [100]})"),
              "m.json: \"areaSamples\": area samples 100: give one of 1, 4, 16, 64, 256, 1024");
    const std::string matrix = R"({"areaLights": ["ltc", "sampled"], "areaSamples": [16, 64]})";
    const BenchPlan plan = planOf("lamps", matrix);
    EXPECT_THAT(namesOf(plan), ElementsAre("forward, exact, area lights ltc", "forward, exact, area lights sampled",
                                           "forward, exact, area lights sampled, samples 64"));
    EXPECT_THAT(reasonsOf(plan), ElementsAre(HasSubstr("it is the same frame as area lights ltc")));
    EXPECT_THAT(namesOf(planOf("room", matrix)), ElementsAre("forward, exact")) << "no light has a surface";
}

TEST(LightOnMatrix, isVariedForTheTechniquesThatHaveTheChoice) {
    EXPECT_EQ(refusal(R"({"lightOn": ["computer"]})"),
              "m.json: \"lightOn\": unknown 'computer': did you mean 'compute'?");
    frame::FrameSettings settings;
    settings.sizePixels = {64, 36};
    settings.lightOn = frame::LightingStage::Compute;
    const auto plan = [&](const std::string& json) {
        BenchPlan made;
        addToPlan(made, matrixOf(json), "room", {}, settings,
                  [](std::optional<int>) { return scenes::loadScene("room"); });
        return made;
    };
    const BenchPlan both = plan(R"({"technique": ["forward", "deferred"], "lightOn": ["fragment", "compute"]})");
    EXPECT_THAT(namesOf(both), ElementsAre("forward, exact", "deferred, exact", "deferred, exact, compute"));
    EXPECT_THAT(reasonsOf(both), ElementsAre("forward, compute: the technique lights in fragment shaders only"));
    const std::vector<BenchPoint>& points = both.groups.front().points;
    EXPECT_EQ(points[0].key.lightOn, std::nullopt);
    EXPECT_EQ(points[0].settings.lightOn, std::nullopt);
    EXPECT_EQ(points[1].settings.lightOn, frame::LightingStage::Fragment);
    EXPECT_EQ(points[2].settings.lightOn, frame::LightingStage::Compute);
    EXPECT_THAT(namesOf(plan(R"({"technique": ["forward", "deferred"]})")),
                ElementsAre("forward, exact", "deferred, exact, compute"))
        << "what the command line says";
}

TEST(LightOnPoints, theRecordHasItAndReadsItAgain) {
    BenchGroup group = shadowedGroup();
    group.results[2].key.lightOn = "compute";
    group.results[3].key.lightOn = "fragment";
    const nlohmann::ordered_json points = groupJson(group)["points"];
    EXPECT_TRUE(points[0]["lightOn"].is_null());
    EXPECT_EQ(points[0]["why"]["lightOn"], "the technique lights in fragment shaders only");
    EXPECT_EQ(points[2]["lightOn"], "compute");
    const BenchGroup again = groupFromJson(groupJson(group));
    for (std::size_t i = 0; i < group.results.size(); ++i) EXPECT_EQ(again.results[i].key, group.results[i].key);
    BenchRecord record;
    record.groups = {group};
    EXPECT_THAT(benchCsv(record), HasSubstr(",compute,exact,"));
    EXPECT_THAT(benchTable(record), HasSubstr("lit on"));
    EXPECT_THAT(benchHtml(record, record.groups[0], {}).sections, HasSubstr("<td data-label=\"Lit on\">compute</td>"));
    record.groups[0].results[2].key.lightOn = "fragment";
    EXPECT_THAT(benchTable(record), Not(HasSubstr("lit on"))) << "nothing but what is usual";
}

TEST(EnvironmentPoints, theRecordHasThemAndReadsThemAgain) {
    BenchGroup group = shadowedGroup();
    group.results[0].key.method(MethodKind::Environment) =
        MethodKey{"sampled", {{"environmentSamples", "16"}, {"environmentCompensation", "on"}}};
    group.results[1].key.method(MethodKind::Environment) = MethodKey{"split_sum", {{"environmentCompensation", "off"}}};
    group.results[2].key.method(MethodKind::Environment) = MethodKey{"off", {}};
    const nlohmann::ordered_json points = groupJson(group)["points"];
    EXPECT_EQ(points[0]["environmentLight"], "sampled");
    EXPECT_EQ(points[0]["environmentSamples"], 16);
    EXPECT_EQ(points[0]["environmentCompensation"], true);
    EXPECT_EQ(points[1]["why"]["environmentSamples"], "the environment's light is not sampled");
    EXPECT_EQ(points[1]["environmentCompensation"], false);
    EXPECT_EQ(points[2]["environmentLight"], "off");
    EXPECT_EQ(points[2]["why"]["environmentCompensation"], "there is no light of the environment");
    EXPECT_EQ(points[3]["why"]["environmentLight"], "no environment shines");
    const BenchGroup again = groupFromJson(groupJson(group));
    for (std::size_t i = 0; i < group.results.size(); ++i) EXPECT_EQ(again.results[i].key, group.results[i].key);
    BenchRecord record;
    record.groups = {group};
    EXPECT_THAT(benchCsv(record), HasSubstr(",sampled,16,on,,,4,64,32,"));
    EXPECT_THAT(benchTable(record), HasSubstr("environ")); // its title may wrap
    const std::string page = benchHtml(record, record.groups[0], {}).sections;
    EXPECT_THAT(page,
                HasSubstr("<td data-label=\"Environment\">environment sampled, samples 16, compensation on</td>"));
    EXPECT_THAT(page, HasSubstr(R"("markKind":"environment light")"));
    EXPECT_THAT(page, HasSubstr(R"("mark":"split_sum")"));
    EXPECT_THAT(recommendationText(group), HasSubstr("forward (traced, environment sampled, samples 16"));
}

TEST(AreaPoints, theRecordHasThemAndReadsThemAgain) {
    BenchGroup group = shadowedGroup();
    group.results[0].key.method(MethodKind::AreaLights) = MethodKey{"sampled", {{"areaSamples", "64"}}};
    group.results[1].key.method(MethodKind::AreaLights) = MethodKey{"ltc", {}};
    const nlohmann::ordered_json points = groupJson(group)["points"];
    EXPECT_EQ(points[0]["areaLights"], "sampled");
    EXPECT_EQ(points[0]["areaSamples"], 64);
    EXPECT_EQ(points[1]["areaLights"], "ltc");
    EXPECT_EQ(points[1]["why"]["areaSamples"], "the light of area lights is not sampled");
    EXPECT_EQ(points[2]["why"]["areaLights"], "no area light shines");
    const BenchGroup again = groupFromJson(groupJson(group));
    for (std::size_t i = 0; i < group.results.size(); ++i) EXPECT_EQ(again.results[i].key, group.results[i].key);
    BenchRecord record;
    record.groups = {group};
    EXPECT_THAT(benchCsv(record), HasSubstr(",sampled,64,4,64,32,"));
    EXPECT_THAT(benchTable(record), HasSubstr("area"));
    const std::string page = benchHtml(record, record.groups[0], {}).sections;
    EXPECT_THAT(page, HasSubstr("<td data-label=\"Area lights\">area lights sampled, samples 64</td>"));
    EXPECT_THAT(page, HasSubstr(R"("markKind":"area lights")"));
    EXPECT_THAT(recommendationText(group), HasSubstr("forward (traced, area lights sampled, samples 64"));
}

} // namespace
} // namespace tessera::validation
