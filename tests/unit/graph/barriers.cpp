#include <gmock/gmock.h>

#include "Frames.h"

namespace tessera::graph::test {
namespace {

using testing::ElementsAre;

std::vector<Barrier> barriersOf(const CompiledGraph& compiled) {
    std::vector<Barrier> barriers;
    for (const CompiledPass& pass : compiled.order) barriers.push_back(pass.before);
    return barriers;
}

TextureHandle imageStore(Graph& graph, const std::string& pass, const std::string& name) {
    TextureHandle handle;
    declare(graph, pass, [&](PassBuilder& builder) { handle = builder.create(name, kColor, Access::ImageWrite); });
    return handle;
}

BufferHandle bufferStore(Graph& graph, const std::string& pass, const std::string& name,
                         Access access = Access::StorageWrite) {
    BufferHandle handle;
    declare(graph, pass, [&](PassBuilder& builder) { handle = builder.create(name, kBytes, access); });
    return handle;
}

template <typename HandleType>
void readKept(Graph& graph, HandleType handle, Access access) {
    declare(graph, "read", [&](PassBuilder& builder) {
        builder.read(handle, access);
        builder.keep();
    });
}

TEST(Barriers, rasterisedFrameNeverNeedsOne) {
    Graph graph;
    const TextureHandle depth = draw(graph, "prepass", "depth", {}, kDepth);
    const TextureHandle a = draw(graph, "gbuffer", "a", {depth});
    const TextureHandle b = draw(graph, "lighting", "b", {a});
    graph.output(blend(graph, "fog", b, {depth}));
    const CompiledGraph compiled = compile(graph);
    EXPECT_THAT(barriersOf(compiled), ElementsAre(Barrier::None, Barrier::None, Barrier::None, Barrier::None));
    EXPECT_EQ(compiled.after, Barrier::None);
}

TEST(Barriers, bitIsThatOfTheLaterAccess) {
    constexpr Barrier kTransfer = Barrier::TransferOrUpdate | Barrier::Framebuffer;
    for (const auto& [access, expected] : {std::pair(Access::Sampled, Barrier::TextureFetch),
                                           {Access::ImageRead, Barrier::ShaderImage},
                                           {Access::Download, kTransfer}}) {
        Graph graph;
        readKept(graph, imageStore(graph, "store", "image"), access);
        EXPECT_EQ(compile(graph).order[1].before, expected) << int(access);
    }
    for (const auto& [access, expected] : {std::pair(Access::ColorAttachment, Barrier::Framebuffer),
                                           {Access::ImageWrite, Barrier::ShaderImage},
                                           {Access::Upload, kTransfer}}) {
        Graph graph;
        const TextureHandle image = imageStore(graph, "store", "image");
        declare(graph, "write",
                [&, &access = access](PassBuilder& builder) { graph.output(builder.write(image, access)); });
        EXPECT_EQ(compile(graph).order[1].before, expected) << int(access);
    }
    for (const auto& [access, expected] : {std::pair(Access::UniformRead, Barrier::Uniform),
                                           {Access::StorageRead, Barrier::ShaderStorage},
                                           {Access::TexelRead, Barrier::TextureFetch},
                                           {Access::VertexRead, Barrier::VertexAttribute},
                                           {Access::IndexRead, Barrier::ElementArray},
                                           {Access::IndirectRead, Barrier::Command},
                                           {Access::Download, kTransfer}}) {
        Graph graph;
        readKept(graph, bufferStore(graph, "store", "lists"), access);
        EXPECT_EQ(compile(graph).order[1].before, expected) << int(access);
    }
}

TEST(Barriers, bitIsNotRepeatedUntilTheNextStore) {
    Graph graph;
    const BufferHandle lists = bufferStore(graph, "cull", "lists");
    readKept(graph, lists, Access::StorageRead);
    readKept(graph, lists, Access::StorageRead);
    readKept(graph, lists, Access::TexelRead);
    BufferHandle again;
    declare(graph, "again", [&](PassBuilder& builder) { again = builder.write(lists); });
    readKept(graph, again, Access::StorageRead);
    EXPECT_THAT(barriersOf(compile(graph)),
                ElementsAre(Barrier::ShaderStorage, Barrier::ShaderStorage, Barrier::None, Barrier::TextureFetch,
                            Barrier::ShaderStorage, Barrier::ShaderStorage));
}

TEST(Barriers, oneBitServesEveryStoreBeforeIt) {
    Graph graph;
    const TextureHandle a = imageStore(graph, "a", "a");
    const TextureHandle b = imageStore(graph, "b", "b");
    consume(graph, "read a", {a});
    consume(graph, "read b", {b});
    EXPECT_THAT(barriersOf(compile(graph)),
                ElementsAre(Barrier::ShaderImage, Barrier::None, Barrier::TextureFetch, Barrier::None));
}

TEST(Barriers, storeAfterAFetchWaitsForIt) {
    Graph graph;
    const BufferHandle uploaded = bufferStore(graph, "upload", "lights", Access::Upload);
    readKept(graph, uploaded, Access::TexelRead);
    declare(graph, "sort", [&](PassBuilder& builder) { graph.output(builder.write(uploaded)); });
    EXPECT_THAT(barriersOf(compile(graph)), ElementsAre(Barrier::None, Barrier::None, Barrier::ShaderStorage));
}

TEST(Barriers, tenantsOfOneAllocationShareTheirHazards) {
    Graph graph;
    const TextureHandle stored = imageStore(graph, "store", "stored");
    readKept(graph, stored, Access::ImageRead);
    const TextureHandle drawn = draw(graph, "draw", "drawn");
    const TextureHandle result = draw(graph, "use", "result", {drawn});
    graph.output(result);
    const CompiledGraph aliased = compile(graph);
    ASSERT_EQ(aliased.resources[drawn.resource].aliasOf, int(stored.resource));
    EXPECT_THAT(barriersOf(aliased),
                ElementsAre(Barrier::ShaderImage, Barrier::ShaderImage, Barrier::Framebuffer, Barrier::TextureFetch));
    EXPECT_THAT(barriersOf(compile(graph, {.cull = true, .alias = false})),
                ElementsAre(Barrier::ShaderImage, Barrier::ShaderImage, Barrier::None, Barrier::None));
}

TEST(Barriers, storesAreMadeVisibleAfterTheFrame) {
    Graph graph;
    const TextureHandle image = imageStore(graph, "store", "image");
    consume(graph, "show", {image});
    graph.output(image);
    const CompiledGraph compiled = compile(graph);
    EXPECT_EQ(compiled.after & Barrier::TransferOrUpdate, Barrier::TransferOrUpdate);
    EXPECT_EQ(compiled.after & Barrier::TextureFetch, Barrier::None) << "was issued before 'show'";
}

} // namespace
} // namespace tessera::graph::test
