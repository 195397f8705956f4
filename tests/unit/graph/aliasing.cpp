#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "Frames.h"

namespace tessera::graph::test {
namespace {

constexpr std::size_t kColorBytes = 64 * 32 * 8;

TEST(Aliasing, equalShapesWithDisjointLivesShareMemory) {
    Graph graph;
    const TextureHandle a = draw(graph, "1", "a");
    const TextureHandle b = draw(graph, "2", "b", {a});
    const TextureHandle c = draw(graph, "3", "c", {b});
    graph.output(c);
    const CompiledGraph compiled = compile(graph);
    EXPECT_EQ(compiled.resources[a.resource].aliasOf, -1);
    EXPECT_EQ(compiled.resources[b.resource].aliasOf, -1);
    EXPECT_EQ(compiled.resources[c.resource].aliasOf, int(a.resource));
    EXPECT_EQ(compiled.resources[c.resource].physical, compiled.resources[a.resource].physical);
    EXPECT_EQ(compiled.allocations.size(), 2u);
    EXPECT_EQ(compiled.bytes, 2 * kColorBytes);
    EXPECT_EQ(compiled.bytesWithoutAliasing, 3 * kColorBytes);
}

TEST(Aliasing, lifetimesRunFromFirstToLastUse) {
    Graph graph;
    const TextureHandle a = draw(graph, "0", "a");
    const TextureHandle b = draw(graph, "1", "b", {a});
    const TextureHandle c = draw(graph, "2", "c", {b});
    const TextureHandle d = draw(graph, "3", "d", {c, a});
    graph.output(d);
    const CompiledGraph compiled = compile(graph);
    EXPECT_EQ(compiled.resources[a.resource].first, 0);
    EXPECT_EQ(compiled.resources[a.resource].last, 3);
    EXPECT_EQ(compiled.resources[b.resource].first, 1);
    EXPECT_EQ(compiled.resources[b.resource].last, 2);
}

TEST(Aliasing, outputLivesToTheEndOfTheFrame) {
    Graph graph;
    const TextureHandle early = draw(graph, "0", "early");
    const TextureHandle a = draw(graph, "1", "a");
    const TextureHandle b = draw(graph, "2", "b", {a});
    const TextureHandle c = draw(graph, "3", "c", {b});
    graph.output(early);
    graph.output(c);
    const CompiledGraph compiled = compile(graph);
    EXPECT_EQ(compiled.resources[early.resource].last, 3);
    EXPECT_EQ(compiled.resources[c.resource].aliasOf, int(a.resource));
}

TEST(Aliasing, differentShapesNeverShareMemory) {
    Graph graph;
    TextureDesc wide = kColor;
    wide.width = 65;
    TextureDesc multisampled = kColor;
    multisampled.samples = 4;
    TextureHandle last = draw(graph, "0", "a");
    last = draw(graph, "1", "b", {last}, wide);
    last = draw(graph, "2", "c", {last}, multisampled);
    last = draw(graph, "3", "d", {last}, kDepth);
    graph.output(draw(graph, "4", "e", {last}, {.format = Format::Rgba16Unorm, .width = 64, .height = 32}));
    EXPECT_EQ(compile(graph).allocations.size(), 5u);
}

TEST(Aliasing, importedResourcesNeverTakePart) {
    Graph graph;
    const TextureHandle history = graph.import("history", kColor);
    const TextureHandle a = draw(graph, "0", "a", {history});
    consume(graph, "1", {a});
    graph.output(draw(graph, "2", "b"));
    const CompiledGraph compiled = compile(graph);
    EXPECT_EQ(compiled.resources[history.resource].physical, -1);
    EXPECT_EQ(compiled.resources[history.resource].first, 0);
    EXPECT_EQ(compiled.bytes, kColorBytes);
    EXPECT_EQ(compiled.bytesWithoutAliasing, 2 * kColorBytes);
}

TEST(Aliasing, withoutItEveryTransientHasItsOwnMemory) {
    Graph graph;
    const TextureHandle a = draw(graph, "0", "a");
    const TextureHandle b = draw(graph, "1", "b", {a});
    graph.output(draw(graph, "2", "c", {b}));
    const CompiledGraph compiled = compile(graph, {.cull = true, .alias = false});
    EXPECT_EQ(compiled.allocations.size(), 3u);
    EXPECT_EQ(compiled.bytes, compiled.bytesWithoutAliasing);
}

Graph randomFrame(std::mt19937& random) {
    const auto pick = [&](std::size_t count) { return std::size_t(random() % count); };
    const std::vector<TextureDesc> shapes{kColor, {.format = Format::R32Float, .width = 8, .height = 8}};
    Graph graph;
    std::vector<TextureHandle> textures{graph.import("import", kColor)};
    std::vector<BufferHandle> buffers{graph.import("import buffer", kBytes)};
    for (std::size_t passes = 3 + pick(15), pass = 0; pass < passes; ++pass)
        declare(graph, "pass", [&](PassBuilder& builder) {
            // Newest versions only, so that no frame has a cycle.
            const auto readable = [&](auto handle) {
                handle.version = graph.resources()[handle.resource].newestVersion;
                return handle;
            };
            for (std::size_t i = pick(4); i > 0; --i)
                builder.read(readable(textures[pick(textures.size())]), Access::ImageRead);
            for (std::size_t i = pick(3); i > 0; --i) builder.read(readable(buffers[pick(buffers.size())]));
            for (std::size_t i = pick(3); i > 0; --i)
                textures.push_back(builder.create("texture", shapes[pick(shapes.size())], Access::ImageWrite));
            if (pick(2) == 0) buffers.push_back(builder.create("buffer", BufferDesc{64 + 64 * pick(2)}));
            if (pick(4) == 0) builder.write(readable(textures[pick(textures.size())]), Access::ImageWrite);
            if (pick(5) == 0) builder.keep();
        });
    for (TextureHandle texture : textures) {
        texture.version = graph.resources()[texture.resource].newestVersion;
        if (pick(6) == 0) graph.output(texture);
    }
    return graph;
}

/// Positions at which a resource must keep its memory, derived from the declaration alone.
std::vector<bool> occupied(const Graph& graph, const CompiledGraph& compiled, std::uint32_t resource) {
    std::vector<bool> used(compiled.order.size(), false);
    for (std::size_t position = 0; position < used.size(); ++position)
        for (const Graph::Use& use : graph.passes()[compiled.order[position].pass].uses)
            if (use.resource == resource) used[position] = true;
    const bool isUsed = std::find(used.begin(), used.end(), true) != used.end();
    for (const Graph::Use& output : graph.outputs())
        if (output.resource == resource && isUsed) used.back() = true;
    const auto first = std::find(used.begin(), used.end(), true);
    const auto last = std::find(used.rbegin(), used.rend(), true).base();
    if (first != used.end()) std::fill(first, last, true);
    return used;
}

TEST(Aliasing, randomFramesNeverShareMemoryWhileBothLiveAndNeverWasteAny) {
    int shared = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        std::mt19937 random(seed);
        const Graph graph = randomFrame(random);
        const CompiledGraph compiled = compile(graph);
        std::vector<std::vector<bool>> lives;
        for (const CompiledResource& resource : compiled.resources)
            lives.push_back(occupied(graph, compiled, resource.resource));

        std::size_t bytes = 0;
        for (const ResourceDesc& allocation : compiled.allocations) bytes += descBytes(allocation);
        ASSERT_EQ(compiled.bytes, bytes) << "seed " << seed;

        for (const CompiledResource& a : compiled.resources) {
            if (a.physical < 0) continue;
            ASSERT_EQ(compiled.allocations[std::size_t(a.physical)], graph.resources()[a.resource].desc);
            if (a.aliasOf >= 0) {
                ++shared;
                ASSERT_EQ(compiled.resources[std::size_t(a.aliasOf)].physical, a.physical);
                ASSERT_EQ(compiled.resources[std::size_t(a.aliasOf)].aliasOf, -1);
            }
            for (const CompiledResource& b : compiled.resources)
                for (std::size_t position = 0; b.resource > a.resource && position < compiled.order.size(); ++position)
                    ASSERT_FALSE(a.physical == b.physical && lives[a.resource][position] && lives[b.resource][position])
                        << "seed " << seed << ": resources " << a.resource << " and " << b.resource;
        }

        // No packing needs fewer allocations of a shape than the most that live at once.
        for (const ResourceDesc& shape : compiled.allocations) {
            std::ptrdiff_t most = 0;
            for (std::size_t position = 0; position < compiled.order.size(); ++position)
                most = std::max(most, std::count_if(compiled.resources.begin(), compiled.resources.end(),
                                                    [&](const CompiledResource& resource) {
                                                        return resource.physical >= 0 &&
                                                               graph.resources()[resource.resource].desc == shape &&
                                                               lives[resource.resource][position];
                                                    }));
            ASSERT_EQ(std::count(compiled.allocations.begin(), compiled.allocations.end(), shape), most)
                << "seed " << seed;
        }
    }
    EXPECT_GT(shared, 200); // otherwise the frames were too simple to test anything
}

} // namespace
} // namespace tessera::graph::test
