#include <gmock/gmock.h>

#include "Frames.h"

namespace tessera::graph::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Faults, staleWriteIsNamedWithBothWriters) {
    Graph graph;
    const TextureHandle v1 = draw(graph, "opaque", "image");
    const TextureHandle v2 = blend(graph, "fog", v1);
    blend(graph, "bloom", v2);
    blend(graph, "overlay", v1);
    EXPECT_THAT(faultsOf(graph),
                ElementsAre("pass 'overlay' writes version 1 of 'image' by a stale handle: pass 'fog' has already "
                            "written it (two writers of one version); write the handle that pass 'bloom' returned"));
}

TEST(Faults, twoWritersOfAnImportAreReported) {
    Graph graph;
    const BufferHandle history = graph.import("history", kBytes);
    for (const char* name : {"a", "b"})
        declare(graph, name, [&](PassBuilder& builder) { builder.write(history, Access::Upload); });
    EXPECT_THAT(faultsOf(graph),
                ElementsAre("pass 'b' writes version 0 of 'history' by a stale handle: pass 'a' has already written it "
                            "(two writers of one version); write the handle that pass 'a' returned"));
}

TEST(Faults, aVersionWithoutAProducerIsReported) {
    Graph graph;
    const TextureHandle image = draw(graph, "opaque", "image");
    consume(graph, "show", {TextureHandle{image.resource, 7}});
    consume(graph, "peek", {TextureHandle{image.resource, 0}});
    declare(graph, "fog", [&](PassBuilder& builder) { builder.write(TextureHandle{image.resource, 4}); });
    graph.output(TextureHandle{image.resource, 9});
    EXPECT_THAT(faultsOf(graph),
                ElementsAre("pass 'show' reads version 7 of 'image', which no pass produces",
                            "pass 'peek' reads version 0 of 'image', which no pass produces",
                            "pass 'fog' writes version 4 of 'image' before any pass has produced it; declare its "
                            "producer first",
                            "the frame outputs version 9 of 'image', which no pass produces"));
}

TEST(Faults, invalidHandleIsNamedWithItsPass) {
    Graph graph;
    declare(graph, "lighting", [](PassBuilder& builder) {
        builder.read(TextureHandle{});
        builder.read(BufferHandle{});
        EXPECT_FALSE(builder.write(TextureHandle{}));
        EXPECT_FALSE(builder.write(BufferHandle{}));
        builder.expect(TextureHandle{}, kColor);
    });
    graph.output(TextureHandle{});
    graph.output(BufferHandle{});
    EXPECT_THAT(
        faultsOf(graph),
        ElementsAre("pass 'lighting' reads an invalid texture handle: it was default-constructed and never filled in",
                    "pass 'lighting' reads an invalid buffer handle: it was default-constructed and never filled in",
                    "pass 'lighting' writes an invalid texture handle: it was default-constructed and never filled in",
                    "pass 'lighting' writes an invalid buffer handle: it was default-constructed and never filled in",
                    "pass 'lighting' expects something of an invalid texture handle: it was default-constructed and "
                    "never filled in",
                    "the frame outputs an invalid texture handle: it was default-constructed and never filled in",
                    "the frame outputs an invalid buffer handle: it was default-constructed and never filled in"));
}

TEST(Faults, handleOfAnotherGraphIsReported) {
    Graph other;
    draw(other, "a", "a");
    const TextureHandle stranger = draw(other, "b", "b");
    Graph graph;
    const BufferHandle lights = graph.import("lights", kBytes);
    consume(graph, "show", {stranger, TextureHandle{lights.resource, 0}});
    EXPECT_THAT(faultsOf(graph),
                ElementsAre("pass 'show' reads a texture handle of another graph: it names no resource of this one",
                            "pass 'show' reads 'lights' by a texture handle, but it is a buffer"));
}

TEST(Faults, expectationThatIsNotMetIsReported) {
    Graph graph;
    const TextureHandle image = draw(graph, "opaque", "image");
    declare(graph, "tonemap", [&](PassBuilder& builder) {
        builder.read(image);
        builder.expect(image, {.format = Format::Rgba32Float, .width = 65, .height = 32, .samples = 4});
        builder.expect(image, {.format = Format::Rgba16Float, .width = 0, .height = 31});
        builder.expect(image, kColor);
        builder.expect(image, {.format = Format::Rgba16Float, .width = 0, .height = 0, .samples = 0});
    });
    EXPECT_THAT(faultsOf(graph),
                ElementsAre("pass 'tonemap' expects 'image' to have format RGBA32F, but it has RGBA16F",
                            "pass 'tonemap' expects 'image' to have size 65 x 32, but it has 64 x 32",
                            "pass 'tonemap' expects 'image' to have samples 4, but it has 1",
                            "pass 'tonemap' expects 'image' to have size any x 31, but it has 64 x 32"));
}

TEST(Faults, accessThatTheFormatForbidsIsReported) {
    const auto faults = faultsOfPass([](PassBuilder& builder) {
        const TextureHandle color = builder.create("color", kColor, Access::DepthAttachment);
        const TextureHandle depth = builder.create("depth", kDepth, Access::ColorAttachment);
        builder.create("depth image", kDepth, Access::ImageWrite);
        builder.create("srgb", {.format = Format::Srgb8Alpha8, .width = 1, .height = 1}, Access::ImageWrite);
        builder.read(color, Access::DepthTest);
        builder.read(depth, Access::ImageRead);
    });
    EXPECT_THAT(faults,
                ElementsAre("pass 'p' writes 'color' as DepthAttachment, but RGBA16F is a colour format; use "
                            "ColorAttachment",
                            "pass 'p' writes 'depth' as ColorAttachment, but D32F is a depth format; use "
                            "DepthAttachment",
                            "pass 'p' writes 'depth image' as ImageWrite, but D32F is no image format of OpenGL; use "
                            "DepthAttachment",
                            "pass 'p' writes 'srgb' as ImageWrite, but SRGB8_ALPHA8 is no image format of OpenGL; use "
                            "ColorAttachment",
                            "pass 'p' reads 'color' as DepthTest, but RGBA16F is a colour format; use Sampled",
                            "pass 'p' reads 'depth' as ImageRead, but D32F is no image format of OpenGL; use Sampled"));
}

TEST(Faults, accessOfTheOtherKindIsReported) {
    const auto faults = faultsOfPass([](PassBuilder& builder) {
        const TextureHandle color = builder.create("color", kColor, Access::StorageWrite);
        const BufferHandle lights = builder.create("lights", kBytes, Access::ImageWrite);
        builder.read(color, Access::UniformRead);
        builder.read(lights, Access::Sampled);
    });
    EXPECT_THAT(
        faults,
        ElementsAre("pass 'p' writes 'color' as StorageWrite, but it is a texture, and that access is of "
                    "buffers",
                    "pass 'p' writes 'lights' as ImageWrite, but it is a buffer, and that access is of textures",
                    "pass 'p' reads 'color' as UniformRead, but it is a texture, and that access is of buffers",
                    "pass 'p' reads 'lights' as Sampled, but it is a buffer, and that access is of textures"));
}

TEST(Faults, accessInTheWrongDirectionIsReported) {
    const auto faults = faultsOfPass([](PassBuilder& builder) {
        const TextureHandle color = builder.create("color", kColor, Access::Sampled);
        builder.read(color, Access::Upload);
    });
    EXPECT_THAT(faults, ElementsAre("pass 'p' writes 'color' as Sampled, which is an access for reading; use read()",
                                    "pass 'p' reads 'color' as Upload, which is an access for writing; use write()"));
}

TEST(Faults, attachmentsThatDifferInSizeOrSamplesAreReported) {
    const auto faults = faultsOfPass([](PassBuilder& builder) {
        builder.create("normal", kColor);
        builder.create("small", {.format = Format::Rgba8Unorm, .width = 32, .height = 32});
        builder.create("depth", {.format = Format::Depth32Float, .width = 64, .height = 32, .samples = 4},
                       Access::DepthAttachment);
        builder.create("tiles", {.format = Format::R32Uint, .width = 8, .height = 4}, Access::ImageWrite);
    });
    EXPECT_THAT(faults, ElementsAre("pass 'p' attaches 'normal' (64 x 32) and 'small' (32 x 32), which "
                                    "must be equal in size and samples",
                                    "pass 'p' attaches 'normal' (64 x 32) and 'depth' (64 x 32, 4 "
                                    "samples), which must be equal in size and samples"));
}

TEST(Faults, twoDepthTexturesOrOneAttachedTwiceAreReported) {
    Graph graph;
    const TextureHandle first = draw(graph, "prepass", "depth", {}, kDepth);
    declare(graph, "shade", [&](PassBuilder& builder) {
        builder.read(first, Access::DepthTest);
        builder.create("other depth", kDepth, Access::DepthAttachment);
        const TextureHandle color = builder.create("color", kColor);
        builder.write(color);
    });
    EXPECT_THAT(faultsOf(graph),
                ElementsAre("pass 'shade' attaches two depth textures or parts, of 'depth' and 'other depth'",
                            "pass 'shade' attaches 'color' twice"));
}

TEST(Faults, twoLayersOfOneDepthArrayInAPassAreReported) {
    const auto faults = faultsOfPass([](PassBuilder& builder) {
        TextureDesc desc = kDepth;
        desc.shape = Shape::Array;
        desc.layers = 2;
        const TextureHandle first = builder.create("shadows", desc, Access::DepthAttachment, {0, 0});
        builder.write(first, Access::DepthAttachment, {0, 1});
    });
    EXPECT_THAT(faults, ElementsAre("pass 'p' attaches two depth textures or parts, of 'shadows' and 'shadows'"));
}

TEST(Faults, resourcesOutsideTheFrameHaveUniqueNamesAndDoNotGrow) {
    Graph graph;
    graph.import("lights", BufferDesc{16, true});
    graph.persist("history", kColor, 1);
    graph.persist("history", kDepth, 1);
    EXPECT_THAT(faultsOf(graph),
                ElementsAre("buffer 'lights', imported, cannot grow: only a buffer that the frame creates does",
                            "two resources that live across frames are named 'history'"));
}

constexpr TextureDesc kAtlas{
    .format = Format::Rgba16Float, .width = 64, .height = 32, .levels = 3, .layers = 4, .shape = Shape::Array};

TEST(Faults, partThatATextureLacksIsReported) {
    const auto faults = faultsOfPass([](PassBuilder& builder) {
        const TextureHandle atlas = builder.create("atlas", kAtlas, Access::ColorAttachment, {3, 0});
        builder.read(atlas, Access::ImageRead, {0, 4});
        builder.read(atlas, Access::ImageRead, {2, 3});
        builder.read(atlas, Access::Sampled);
    });
    EXPECT_THAT(faults, testing::IsSupersetOf({"pass 'p' writes level 3, layer 0 of 'atlas', which has 3 and 4",
                                               "pass 'p' reads level 0, layer 4 of 'atlas', which has 3 and 4"}));
}

TEST(Faults, layersOfOneTextureMayBeAttachedTogether) {
    const auto faults = faultsOfPass([](PassBuilder& builder) {
        const TextureHandle first = builder.create("atlas", kAtlas, Access::ColorAttachment, {1, 0});
        const TextureHandle second = builder.write(first, Access::ColorAttachment, {1, 1});
        builder.create("half", {.format = Format::Rgba16Float, .width = 32, .height = 16});
        builder.keep();
        builder.write(second, Access::ColorAttachment, {1, 0});
    });
    EXPECT_THAT(faults, ElementsAre("pass 'p' attaches 'atlas' twice"));
}

TEST(Faults, shapeThatNoTextureCanHaveIsReported) {
    const auto faultOf = [](const TextureDesc& desc) {
        Graph graph;
        graph.import("t", desc);
        const std::vector<std::string> faults = faultsOf(graph);
        return faults.empty() ? std::string() : faults.front();
    };
    EXPECT_EQ(faultOf(kAtlas), "");
    EXPECT_EQ(faultOf({.width = 4, .height = 2, .levels = 4}),
              "texture 't', imported, cannot be (4 x 2, 4 levels): it can have 1 to 3 levels");
    EXPECT_EQ(faultOf({.width = 4, .height = 2, .layers = 2}),
              "texture 't', imported, cannot be (4 x 2): only an array has layers");
    EXPECT_EQ(faultOf({.width = 4, .height = 2, .layers = 6, .shape = Shape::Cube}),
              "texture 't', imported, cannot be (4 x 2, a cube): a cube has 6 layers, as wide as high");
    EXPECT_EQ(faultOf({.width = 4, .height = 4, .samples = 4, .layers = 2, .shape = Shape::Array}),
              "texture 't', imported, cannot be (4 x 4, 2 layers, 4 samples): with several samples it has one level "
              "and one layer");
}

TEST(Faults, bytesOfATextureAreThoseOfAllItsLevelsAndLayers) {
    EXPECT_EQ(descBytes(kAtlas), std::size_t(64 * 32 + 32 * 16 + 16 * 8) * 4 * 8);
    EXPECT_EQ(descBytes(TextureDesc{.format = Format::R8Uint, .width = 5, .height = 1, .levels = 3}), 5u + 2u + 1u);
}

TEST(Faults, samplingARenderTargetIsReported) {
    Graph graph;
    const TextureHandle image = draw(graph, "opaque", "image");
    declare(graph, "fog", [&](PassBuilder& builder) {
        builder.read(image);
        builder.write(image);
    });
    EXPECT_THAT(faultsOf(graph), ElementsAre("pass 'fog' samples 'image' while it draws into it"));
}

TEST(Faults, anImageOfAnAttachedPartIsReported) {
    Graph graph;
    const TextureHandle atlas = draw(graph, "opaque", "atlas", {}, kAtlas);
    declare(graph, "load", [&](PassBuilder& builder) {
        builder.read(atlas, Access::ImageRead, {1, 0});
        builder.read(atlas, Access::ImageRead, {1, 2});
        builder.write(atlas, Access::ColorAttachment, {1, 2});
        builder.keep();
    });
    declare(graph, "store", [&](PassBuilder& builder) {
        const TextureHandle image = builder.create("image", kColor, Access::ImageWrite);
        builder.write(image, Access::ColorAttachment);
        builder.keep();
    });
    EXPECT_THAT(faultsOf(graph),
                ElementsAre("pass 'load' uses 'atlas' as ImageRead while it draws into that part of it",
                            "pass 'store' uses 'image' as ImageWrite while it draws into that part of it"));
}

TEST(Faults, aStoreBesideAReadOfAnotherKindIsReported) {
    Graph graph;
    const TextureHandle atlas = draw(graph, "opaque", "atlas", {}, kAtlas);
    declare(graph, "mips", [&](PassBuilder& builder) {
        builder.read(atlas, Access::Sampled);
        builder.write(atlas, Access::ImageWrite, {1, 0});
        builder.keep();
    });
    const BufferHandle lists = graph.import("lists", kBytes);
    declare(graph, "sort", [&](PassBuilder& builder) {
        builder.read(lists, Access::TexelRead);
        builder.read(lists, Access::IndirectRead);
        builder.write(lists, Access::StorageWrite);
        builder.keep();
    });
    EXPECT_THAT(faultsOf(graph),
                ElementsAre("pass 'mips' reads 'atlas' as Sampled and writes it as ImageWrite, and nothing orders the "
                            "two within a pass; read it as ImageRead or in a pass of its own",
                            "pass 'sort' reads 'lists' as TexelRead and writes it as StorageWrite, and nothing orders "
                            "the two within a pass; read it as StorageRead or in a pass of its own",
                            "pass 'sort' reads 'lists' as IndirectRead and writes it as StorageWrite, and nothing "
                            "orders the two within a pass; read it as StorageRead or in a pass of its own"));
}

TEST(Faults, aStoreBesideAReadOfItsOwnKindIsNone) {
    const auto faults = faultsOfPass([](PassBuilder& builder) {
        builder.read(builder.create("sum", kColor, Access::ImageWrite), Access::ImageRead);
        builder.read(builder.create("counts", kBytes), Access::StorageRead);
        builder.read(builder.create("lights", kBytes, Access::Upload), Access::TexelRead);
        builder.create("drawn", kColor);
        builder.keep();
    });
    EXPECT_THAT(faults, IsEmpty());
}

TEST(Faults, depthThatIsTestedMayBeSampledToo) {
    Graph graph;
    const TextureHandle depth = draw(graph, "prepass", "depth", {}, kDepth);
    declare(graph, "fog", [&](PassBuilder& builder) {
        builder.read(depth, Access::DepthTest);
        builder.read(depth, Access::Sampled);
        graph.output(builder.create("image", kColor));
    });
    EXPECT_THAT(faultsOf(graph), IsEmpty());
}

TEST(Faults, emptyResourceIsNamedWithItsOrigin) {
    Graph graph;
    graph.import("window", TextureDesc{.format = Format::Rgba8Unorm, .width = 0, .height = 720});
    declare(graph, "cull", [](PassBuilder& builder) {
        builder.create("lists", BufferDesc{.bytes = 0});
        builder.create("image", {.width = 4, .height = 4, .samples = 0}, Access::ImageWrite);
    });
    EXPECT_THAT(faultsOf(graph),
                ElementsAre("texture 'window', imported, is empty (0 x 720): width, height and samples must be at "
                            "least 1",
                            "buffer 'lists', created by pass 'cull', is empty: it must have at least 1 byte, or grow",
                            "texture 'image', created by pass 'cull', is empty (4 x 4, 0 samples): width, height and "
                            "samples must be at least 1"));
}

TEST(Faults, staleOutputIsReportedAlsoWhenItsWriterWouldBeCulled) {
    Graph graph;
    const TextureHandle image = draw(graph, "opaque", "image");
    blend(graph, "overlay", image);
    graph.output(image);
    EXPECT_THAT(faultsOf(graph), ElementsAre("the frame outputs version 1 of 'image' by a stale handle: pass 'overlay' "
                                             "writes over it"));
}

TEST(Faults, allOfThemAreListedAtOnce) {
    Graph graph;
    const TextureHandle image = draw(graph, "opaque", "image");
    const TextureHandle whole = blend(graph, "fog", image);
    consume(graph, "compare", {image, whole});
    blend(graph, "overlay", image);
    try {
        compile(graph);
        FAIL() << "compiled";
    } catch (const GraphError& error) {
        ASSERT_EQ(error.faults().size(), 2u);
        EXPECT_STREQ(error.what(),
                     ("the render graph has 2 faults:\n" + error.faults()[0] + "\n" + error.faults()[1]).c_str());
    }
}

TEST(Faults, singleFaultIsOneLine) {
    EXPECT_STREQ(GraphError({"pass 'a' is odd"}).what(), "the render graph is faulty: pass 'a' is odd");
}

TEST(Faults, shapeOfAnInvalidHandleIsNotGuessed) {
    Graph graph;
    const BufferHandle lights = graph.import("lights", kBytes);
    EXPECT_THROW(graph.desc(TextureHandle{}), std::logic_error);
    EXPECT_THROW(graph.desc(TextureHandle{lights.resource, 0}), std::logic_error);
    EXPECT_EQ(graph.desc(graph.import("window", kColor)), kColor);
}

} // namespace
} // namespace tessera::graph::test
