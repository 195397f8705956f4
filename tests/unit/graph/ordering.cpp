#include <gmock/gmock.h>

#include <random>

#include "Frames.h"

namespace tessera::graph::test {
namespace {

using testing::ElementsAre;

/// The handle of a version that may not exist yet.
TextureHandle forge(TextureHandle handle, std::uint32_t version) {
    return {handle.resource, version};
}

TEST(Ordering, freePassesRunInDeclarationOrder) {
    Graph graph;
    const TextureHandle c = draw(graph, "c", "1");
    const TextureHandle a = draw(graph, "a", "2");
    const TextureHandle b = draw(graph, "b", "3");
    consume(graph, "end", {a, b, c});
    EXPECT_THAT(orderOf(graph, compile(graph)), ElementsAre("c", "a", "b", "end"));
}

TEST(Ordering, everyReaderRunsBeforeTheWriterOverIt) {
    Graph graph;
    const TextureHandle v1 = draw(graph, "make", "image");
    const TextureHandle v2 = blend(graph, "second", v1);
    const TextureHandle v3 = blend(graph, "third", v2);
    consume(graph, "read v2", {v2});
    consume(graph, "read v1", {v1});
    graph.output(v3);
    EXPECT_THAT(orderOf(graph, compile(graph)), ElementsAre("make", "read v1", "second", "read v2", "third"));
}

TEST(Ordering, producerDeclaredLaterRunsFirst) {
    Graph graph;
    const TextureHandle history = graph.import("history", kColor);
    consume(graph, "show", {forge(history, 1)});
    blend(graph, "update", history);
    EXPECT_THAT(orderOf(graph, compile(graph)), ElementsAre("update", "show"));
}

TEST(Ordering, versionReadTooLateIsReportedAsACycle) {
    Graph graph;
    const TextureHandle opaque = draw(graph, "opaque", "image");
    const TextureHandle whole = blend(graph, "fog", opaque);
    consume(graph, "compare", {whole, opaque});
    EXPECT_THAT(faultsOf(graph),
                ElementsAre("passes 'fog', 'compare' wait for each other in a cycle: 'compare' reads 'image' from "
                            "'fog'; 'fog' writes over version 1 of 'image', which 'compare' reads"));
}

TEST(Ordering, cycleNamesExactlyThePassesOnIt) {
    Graph graph;
    const TextureHandle a = graph.import("a", kColor);
    const TextureHandle b = graph.import("b", kColor);
    const TextureHandle source = draw(graph, "source", "s");
    const TextureHandle a1 = blend(graph, "first", a, {forge(b, 1), source});
    blend(graph, "second", b, {a1});
    consume(graph, "behind", {forge(b, 1)});
    EXPECT_THAT(faultsOf(graph), ElementsAre("passes 'first', 'second' wait for each other in a cycle: 'second' reads "
                                             "'a' from 'first'; 'first' reads 'b' from 'second'"));
}

TEST(Ordering, eachKnotIsReportedOnce) {
    Graph graph;
    const TextureHandle a = graph.import("a", kColor);
    const TextureHandle b = graph.import("b", kColor);
    const TextureHandle c = graph.import("c", kColor);
    const TextureHandle d = graph.import("d", kColor);
    blend(graph, "one", a, {forge(b, 1)});
    blend(graph, "two", b, {forge(a, 2)});
    blend(graph, "one more", forge(a, 1));
    blend(graph, "three", c, {forge(d, 1), forge(a, 2)});
    blend(graph, "four", d, {forge(c, 1)});
    EXPECT_THAT(faultsOf(graph),
                ElementsAre("passes 'one', 'one more', 'two' wait for each other in a cycle: 'one more' adds to 'a' "
                            "from 'one'; 'two' reads 'a' from 'one more'; 'one' reads 'b' from 'two'",
                            "passes 'three', 'four' wait for each other in a cycle: 'four' reads 'c' from 'three'; "
                            "'three' reads 'd' from 'four'"));
}

/// Replays the order on memory that holds only the newest version; each reader must find its declared version.
TEST(Ordering, randomFramesReadTheirDeclaredVersions) {
    int compiledFrames = 0;
    for (unsigned seed = 0; seed < 300; ++seed) {
        std::mt19937 random(seed);
        const auto pick = [&](std::size_t count) { return std::size_t(random() % count); };
        Graph graph;
        std::vector<TextureHandle> handles{graph.import("import", kColor)};
        for (int pass = 0; pass < 12; ++pass)
            declare(graph, "pass", [&](PassBuilder& builder) {
                builder.keep();
                for (std::size_t i = pick(3); i > 0; --i)
                    builder.read(handles[pick(handles.size())], Access::ImageRead);
                const TextureHandle target = handles[pick(handles.size())];
                const bool isNewest = graph.resources()[target.resource].newestVersion == target.version;
                handles.push_back(isNewest && pick(2) == 0 ? builder.write(target, Access::ImageWrite)
                                                           : builder.create("made", kColor, Access::ImageWrite));
            });
        CompiledGraph compiled;
        try {
            compiled = compile(graph);
        } catch (const GraphError&) {
            continue; // read too late
        }
        ++compiledFrames;
        ASSERT_EQ(compiled.order.size(), graph.passes().size());
        std::vector<std::uint32_t> held(graph.resources().size(), 0);
        for (const CompiledPass& entry : compiled.order) {
            const Graph::Pass& pass = graph.passes()[entry.pass];
            for (const Graph::Use& use : pass.uses) ASSERT_EQ(held[use.resource], use.handed) << "seed " << seed;
            for (const Graph::Use& use : pass.uses)
                if (use.isWrite) held[use.resource] = use.version;
        }
    }
    EXPECT_GT(compiledFrames, 50); // otherwise hardly anything is tested
}

} // namespace
} // namespace tessera::graph::test
