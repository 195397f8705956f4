#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <sstream>

#include "Frames.h"
#include "renderer/graph/Plan.h"
#include "renderer/graph/Table.h"

namespace tessera::graph::test {
namespace {

using nlohmann::json;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// A small frame with aliasing, a barrier, an import, an addition, a culled pass and an omitted feature.
Plan examplePlan() {
    Graph graph;
    const TextureHandle window = graph.import("window", {.format = Format::Srgb8Alpha8, .width = 64, .height = 32});
    TextureHandle depth;
    TextureHandle normal;
    declare(graph, "gbuffer", [&](PassBuilder& builder) {
        normal = builder.create("normal", kColor);
        depth = builder.create("depth", kDepth, Access::DepthAttachment);
    });
    BufferHandle lists;
    declare(graph, "cull", [&](PassBuilder& builder) {
        builder.read(depth);
        lists = builder.create("lists", BufferDesc{4096});
    });
    TextureHandle ao;
    declare(graph, "occlusion", [&](PassBuilder& builder) {
        builder.read(depth);
        ao = builder.create("ao", kColor);
    });
    TextureHandle lit;
    declare(graph, "lighting", [&](PassBuilder& builder) {
        builder.read(normal);
        builder.read(lists);
        lit = builder.create("radiance", kColor);
    });
    const TextureHandle fogged = blend(graph, "fog", lit, {depth});
    const TextureHandle bright = draw(graph, "bloom", "bright", {fogged});
    declare(graph, "display", [&](PassBuilder& builder) {
        builder.read(bright);
        builder.read(fogged);
        graph.output(builder.write(window));
    });
    Plan plan = makePlan(graph, compile(graph));
    plan.scene = "lattice";
    plan.technique = "tiled_deferred";
    plan.leftOut.push_back({.what = "channel tangent", .why = "no material is anisotropic", .bytes = 8192, .ms = {}});
    plan.choices.push_back({.what = "tile", .chosen = "16", .why = "the default"});
    plan.counters.emplace_back("lights", 1024);
    return plan;
}

TEST(Plan, textIsExactlyThis) {
    EXPECT_EQ(planText(examplePlan()), R"(lattice, tiled_deferred: 6 passes run, 2 things left out
44.0 KiB of memory, 60.0 KiB without aliasing

Runs, in this order
  #  pass      reads             writes         barrier before
  0  gbuffer   -                 normal, depth  -
  1  cull      depth             lists          storage
  2  lighting  normal, lists     radiance       storage
  3  fog       depth             radiance       -
  4  bloom     radiance          bright         -
  5  display   bright, radiance  window         -

Left out
  what             why                            saves
  pass occlusion   nothing needs 'ao'          16.0 KiB
  channel tangent  no material is anisotropic   8.0 KiB

Choices
  what  chosen  why
  tile  16      the default

Resources
  name      format        size       memory  lives       in the memory of
  window    SRGB8_ALPHA8  64 x 32   8.0 KiB  5-5 .....#  (imported)
  normal    RGBA16F       64 x 32  16.0 KiB  0-2 ###...  -
  depth     D32F          64 x 32   8.0 KiB  0-3 ####..  -
  lists     buffer        -         4.0 KiB  1-2 .##...  -
  radiance  RGBA16F       64 x 32  16.0 KiB  2-5 ..####  -
  bright    RGBA16F       64 x 32  16.0 KiB  4-5 ....##  normal

Counters
  counter  value
  lights    1024
)");
}

TEST(Plan, textNeverExceedsAHundredColumns) {
    Plan plan = examplePlan();
    plan.scene = std::string(120, 's');
    plan.passes[0].name = std::string(150, 'p');
    plan.passes[0].ms = 12.345;
    for (int i = 0; i < 40; ++i) plan.passes[1].reads.push_back("resource number " + std::to_string(i));
    plan.leftOut[0].why = "because " + std::string(200, 'w');
    plan.leftOut[0].ms = 0.5;
    plan.choices[0].why = std::string(300, 'y');
    plan.resources[0].name = std::string(99, 'r');
    plan.resources[1].aliasOf = std::string(99, 'a');
    while (plan.passes.size() < 24) plan.passes.push_back({.name = "more", .reads = {}, .writes = {}, .ms = {}});
    EXPECT_THAT(linesOf(planText(plan)), Each(testing::SizeIs(testing::Le(100u))));
    EXPECT_THAT(planText(plan), HasSubstr("12.35"));
}

TEST(Plan, anEmptyFrameIsReported) {
    EXPECT_EQ(planText(Plan{}), "0 passes run, 0 things left out\n0 B of memory, 0 B without aliasing\n");
    EXPECT_EQ(json::parse(planJson(Plan{})).at("passes").size(), 0u);
    EXPECT_THAT(planDot(Plan{}), HasSubstr("digraph frame"));
}

TEST(Plan, jsonHasTheFieldsOfTheDocumentation) {
    const json plan = json::parse(planJson(examplePlan()));
    const auto sortedKeys = [](const json& object) {
        std::vector<std::string> names;
        for (const auto& item : object.items()) names.push_back(item.key());
        return names;
    };
    EXPECT_THAT(sortedKeys(plan), ElementsAre("bytes", "bytesWithoutAliasing", "choices", "counters", "left_out",
                                              "passes", "resources", "scene", "schema", "technique"));
    EXPECT_EQ(plan["schema"], kPlanSchema);
    EXPECT_EQ(plan["scene"], "lattice");
    EXPECT_EQ(plan["technique"], "tiled_deferred");
    EXPECT_EQ(plan["passes"][2], json({{"name", "lighting"},
                                       {"reads", {"normal", "lists"}},
                                       {"writes", {"radiance"}},
                                       {"ms", nullptr},
                                       {"barrier", "storage"}}));
    EXPECT_EQ(plan["left_out"][0],
              json({{"what", "pass occlusion"}, {"why", "nothing needs 'ao'"}, {"bytes", 16384}, {"ms", nullptr}}));
    EXPECT_EQ(plan["left_out"][1]["what"], "channel tangent");
    EXPECT_EQ(plan["choices"][0], json({{"what", "tile"}, {"chosen", "16"}, {"why", "the default"}}));
    EXPECT_EQ(plan["counters"], json({{"lights", 1024}}));
    EXPECT_EQ(plan["resources"][4], json({{"name", "radiance"},
                                          {"format", "RGBA16F"},
                                          {"width", 64},
                                          {"height", 32},
                                          {"samples", 1},
                                          {"bytes", 16384},
                                          {"first", 2},
                                          {"last", 5},
                                          {"aliasOf", nullptr},
                                          {"imported", false}}));
    EXPECT_EQ(plan["resources"][5]["aliasOf"], "normal");
    EXPECT_EQ(plan["resources"][3]["format"], "buffer");
    EXPECT_EQ(plan["resources"][3]["width"], 0);
    EXPECT_EQ(plan["bytes"], 16384 * 2 + 8192 + 4096);
    EXPECT_EQ(plan["bytesWithoutAliasing"], 16384 * 3 + 8192 + 4096);
}

TEST(Plan, jsonKeepsItsOrderAndMeasuredTimes) {
    Plan plan = examplePlan();
    plan.passes[0].ms = 1.5;
    plan.leftOut[0].ms = 0.25;
    const std::string text = planJson(plan);
    std::size_t before = 0;
    for (const char* key : {"\"schema\"", "\"scene\"", "\"passes\"", "\"left_out\""}) {
        EXPECT_LT(before, text.find(key)) << key;
        before = text.find(key);
    }
    EXPECT_EQ(json::parse(text)["passes"][0]["ms"], 1.5);
    EXPECT_EQ(json::parse(text)["left_out"][0]["ms"], 0.25);
}

TEST(Plan, bytesThatAreNotUtf8NeverBreakTheJson) {
    Plan plan;
    plan.scene = "caf\xe9.gltf";
    EXPECT_EQ(json::parse(planJson(plan))["scene"], "caf\xef\xbf\xbd.gltf");
}

TEST(Plan, namesThatAreTakenGetANumber) {
    Graph graph;
    const TextureHandle a = draw(graph, "down", "blur");
    graph.output(draw(graph, "up", "blur", {a}));
    const Plan plan = makePlan(graph, compile(graph));
    EXPECT_THAT(plan.passes[1].reads, ElementsAre("blur"));
    EXPECT_THAT(plan.passes[1].writes, ElementsAre("blur (2)"));
}

TEST(Plan, aPassesOwnOutputIsNoInput) {
    Graph graph;
    declare(graph, "bin", [](PassBuilder& builder) {
        builder.read(builder.create("counts", kBytes), Access::StorageRead);
        builder.keep();
    });
    const Plan plan = makePlan(graph, compile(graph));
    EXPECT_THAT(plan.passes[0].reads, IsEmpty());
    EXPECT_THAT(plan.passes[0].writes, ElementsAre("counts"));
}

TEST(Plan, aCulledPassSavesTheMemoryOfItsTransientsAlone) {
    Graph graph;
    const TextureHandle window = graph.import("window", kColor);
    const TextureHandle unread = graph.import("unread", kColor);
    const TextureHandle history = graph.persist("history", kColor, 1);
    consume(graph, "show", {window});
    declare(graph, "overlay", [&](PassBuilder& builder) {
        builder.write(window);
        builder.write(unread);
        builder.write(history);
        builder.write(builder.create("marks", kDepth, Access::DepthAttachment), Access::Upload);
    });
    const Plan plan = makePlan(graph, compile(graph));
    ASSERT_EQ(plan.leftOut.size(), 1u);
    EXPECT_EQ(plan.leftOut[0].what, "pass overlay");
    EXPECT_EQ(plan.leftOut[0].bytes, descBytes(kDepth)) << "what exists outside the frame takes no memory of it";
}

TEST(Plan, drawingShowsEachVersionOnceAndNeverRunsBackwards) {
    const std::string dot = planDot(examplePlan());
    // The numbers follow the order of drawing: normal, depth, lists, ao, radiance, radiance after fog, bright, window.
    for (const char* drawn : {"pass0 -> resource1;", "resource1 -> pass2;", "resource5 -> pass3;",
                              "pass3 -> resource6;", "resource6 -> pass5;"})
        EXPECT_THAT(dot, HasSubstr(drawn));
    for (const char* backwards : {"resource6 -> pass3;", "resource5 -> pass5;"})
        EXPECT_THAT(dot, Not(HasSubstr(backwards)));
}

TEST(Plan, omittedPassesAreDashed) {
    const std::string dot = planDot(examplePlan());
    EXPECT_THAT(dot, HasSubstr(R"(leftOut0 [label=<<B>pass occlusion</B><BR/><FONT POINT-SIZE="9">nothing needs 'ao')"
                               R"(</FONT>>, shape=box, style=dashed)"));
    EXPECT_THAT(dot, HasSubstr("resource2 -> leftOut0 [style=dashed"));
    EXPECT_THAT(dot, HasSubstr("leftOut0 -> resource4 [style=dashed"));
    EXPECT_THAT(dot, HasSubstr("leftOut1 [label=<<B>channel tangent</B>"));
}

TEST(Plan, drawingShowsTheFlowAmongLeftOutPasses) {
    Graph graph;
    const TextureHandle image = draw(graph, "shade", "image");
    graph.output(draw(graph, "copy", "shown", {image}));
    const TextureHandle marked = blend(graph, "mark", image);
    draw(graph, "inspect", "report", {marked});
    const std::string dot = planDot(makePlan(graph, compile(graph)));
    // The ellipses in order of drawing: image, shown, image as marked, report.
    EXPECT_THAT(dot, HasSubstr("resource1 -> leftOut0 [style=dashed"));
    EXPECT_THAT(dot, HasSubstr("leftOut0 -> resource3 [style=dashed"));
    EXPECT_THAT(dot, HasSubstr("resource3 -> leftOut1 [style=dashed"));
    EXPECT_THAT(dot, Not(HasSubstr("resource1 -> leftOut1")));
    EXPECT_THAT(dot, HasSubstr("leftOut1 -> resource4 [style=dashed"));
    EXPECT_THAT(dot, HasSubstr("resource1 -> pass1;"));
}

TEST(Plan, drawingTintsExactlySharedMemory) {
    const std::string dot = planDot(examplePlan());
    const auto tintOf = [&](const std::string& node) {
        const std::size_t at = dot.find("fillcolor=", dot.find("  " + node + " ["));
        return dot.substr(at + 11, 7);
    };
    EXPECT_EQ(tintOf("resource1"), tintOf("resource7"));
    EXPECT_NE(tintOf("resource1"), tintOf("resource5"));
    EXPECT_EQ(tintOf("resource5"), tintOf("resource3"));
}

TEST(Plan, namesAreEscapedInTheDrawing) {
    Plan plan;
    plan.passes.push_back({.name = "a<b> & \"c\"", .reads = {}, .writes = {}, .ms = {}});
    EXPECT_THAT(planDot(plan), HasSubstr("a&lt;b&gt; &amp; &quot;c&quot;"));
}

TEST(Plan, bytesAreReadable) {
    const std::pair<std::size_t, const char*> kBytesAndText[] = {{0, "0 B"},
                                                                 {1023, "1023 B"},
                                                                 {1024, "1.0 KiB"},
                                                                 {3670016, "3.5 MiB"},
                                                                 {102400, "100 KiB"},
                                                                 {1048575, "1.0 MiB"},
                                                                 {std::size_t(5) << 30, "5.0 GiB"}};
    for (const auto& [bytes, text] : kBytesAndText) EXPECT_EQ(readableBytes(bytes), text);
}

TEST(Table, charactersAreCountedAndNeverBytes) {
    Table table(12);
    table.addColumn("a");
    table.addColumn("b", Table::Align::Right);
    table.addRow({"\u00e9\u00e9", "1"});
    table.addRow({"one two six", "22"});
    EXPECT_EQ(table.text(), "  a        b\n  \u00e9\u00e9       1\n  one     22\n  two\n  six\n");
}

TEST(Table, wordLongerThanALineIsCut) {
    EXPECT_THAT(wrapText("ab cdefgh i", 3), ElementsAre("ab", "cde", "fgh", "i"));
    EXPECT_THAT(wrapText("", 3), ElementsAre(""));
}

} // namespace
} // namespace tessera::graph::test
