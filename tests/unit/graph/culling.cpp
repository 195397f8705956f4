#include <gmock/gmock.h>

#include "Frames.h"

namespace tessera::graph::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Culling, passThatLeadsToAnOutputRuns) {
    Graph graph;
    const TextureHandle gbuffer = draw(graph, "gbuffer", "normal");
    const TextureHandle lit = draw(graph, "lighting", "radiance", {gbuffer});
    graph.output(lit);
    const CompiledGraph compiled = compile(graph);
    EXPECT_THAT(orderOf(graph, compiled), ElementsAre("gbuffer", "lighting"));
    EXPECT_THAT(compiled.culled, IsEmpty());
}

TEST(Culling, aPassWithUnusedOutputsDoesNotRunAndThePlanSaysWhy) {
    Graph graph;
    const TextureHandle gbuffer = draw(graph, "gbuffer", "normal");
    declare(graph, "occlusion", [&](PassBuilder& builder) {
        builder.read(gbuffer);
        builder.create("ao", kColor);
        builder.create("bent normal", kColor);
        builder.create("ao depth", kDepth, Access::DepthAttachment);
    });
    graph.output(gbuffer);
    const CompiledGraph compiled = compile(graph);
    EXPECT_THAT(orderOf(graph, compiled), ElementsAre("gbuffer"));
    ASSERT_EQ(compiled.culled.size(), 1u);
    EXPECT_EQ(graph.passes()[compiled.culled[0].pass].name, "occlusion");
    EXPECT_EQ(compiled.culled[0].why, "nothing needs 'ao', 'bent normal' or 'ao depth'");
    EXPECT_EQ(compiled.culled[0].before, 1u);
}

TEST(Culling, chainThatLeadsNowhereIsLeftOutWhole) {
    Graph graph;
    const TextureHandle ao = draw(graph, "occlusion", "ao");
    draw(graph, "blur", "smooth", {ao});
    const TextureHandle image = draw(graph, "shade", "image");
    draw(graph, "upsample", "large", {ao});
    graph.output(image);
    const CompiledGraph compiled = compile(graph);
    EXPECT_THAT(orderOf(graph, compiled), ElementsAre("shade"));
    ASSERT_EQ(compiled.culled.size(), 3u);
    EXPECT_EQ(compiled.culled[0].why, "'ao' is used only by 'blur' and 'upsample', left out as well");
    EXPECT_EQ(compiled.culled[1].why, "nothing needs 'smooth'");
    EXPECT_EQ(compiled.culled[0].before, 0u);
    EXPECT_EQ(compiled.culled[2].before, 1u);
}

TEST(Culling, mixedReasonsAreAllGiven) {
    Graph graph;
    TextureHandle a;
    declare(graph, "both", [&](PassBuilder& builder) {
        a = builder.create("a", kColor);
        builder.create("b", kColor);
    });
    blend(graph, "more", a);
    const CompiledGraph compiled = compile(graph);
    ASSERT_EQ(compiled.culled.size(), 2u);
    EXPECT_EQ(compiled.culled[0].why, "nothing needs 'b'; 'a' is used only by 'more', left out as well");
}

TEST(Culling, passThatWritesNothingNeverRunsUnlessKept) {
    Graph graph;
    const TextureHandle image = draw(graph, "shade", "image");
    declare(graph, "peek", [&](PassBuilder& builder) { builder.read(image); });
    consume(graph, "download", {image});
    const CompiledGraph compiled = compile(graph);
    EXPECT_THAT(orderOf(graph, compiled), ElementsAre("shade", "download"));
    ASSERT_EQ(compiled.culled.size(), 1u);
    EXPECT_EQ(compiled.culled[0].why, "it writes nothing and is not kept");
}

TEST(Culling, writerOfTheVersionAddedToRuns) {
    Graph graph;
    const TextureHandle opaque = draw(graph, "opaque", "image");
    const TextureHandle fog = blend(graph, "fog", opaque);
    blend(graph, "overlay", draw(graph, "text", "glyphs"));
    graph.output(fog);
    EXPECT_THAT(orderOf(graph, compile(graph)), ElementsAre("opaque", "fog"));
}

TEST(Culling, aLaterWriterDoesNotRunForEarlierReaders) {
    Graph graph;
    const TextureHandle first = draw(graph, "opaque", "image");
    const TextureHandle copy = draw(graph, "copy", "copied", {first});
    blend(graph, "overlay", first);
    graph.output(copy);
    EXPECT_THAT(orderOf(graph, compile(graph)), ElementsAre("opaque", "copy"));
}

TEST(Culling, withoutItEveryPassRunsInTheSameOrder) {
    Graph graph;
    const TextureHandle ao = draw(graph, "occlusion", "ao");
    const TextureHandle image = draw(graph, "shade", "image");
    draw(graph, "blur", "smooth", {ao});
    graph.output(image);
    const CompiledGraph compiled = compile(graph, {.cull = false});
    EXPECT_THAT(orderOf(graph, compiled), ElementsAre("occlusion", "shade", "blur"));
    EXPECT_THAT(compiled.culled, IsEmpty());
}

TEST(Culling, frameWithoutOutputsNeverRunsAnything) {
    Graph graph;
    draw(graph, "shade", "image");
    const CompiledGraph compiled = compile(graph);
    EXPECT_THAT(compiled.order, IsEmpty());
    EXPECT_THAT(compiled.allocations, IsEmpty());
    EXPECT_EQ(compiled.resources[0].first, -1);
    EXPECT_EQ(compiled.resources[0].physical, -1);
    EXPECT_EQ(compiled.bytes, 0u);
}

} // namespace
} // namespace tessera::graph::test
