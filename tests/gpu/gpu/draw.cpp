#include <gmock/gmock.h>

#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/Program.h"
#include "renderer/gpu/VertexArray.h"
#include "tests/support/GlContext.h"

namespace tessera::gpu {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* kFullscreenVertex = R"(#version 450 core
layout(location = 0) out vec2 uv;
void main() {
    uv = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0;
    gl_Position = vec4(uv * 2.0 - 1.0, 0.5, 1.0);
})";

Program fullscreen(const std::string& fragmentBody) {
    const std::vector<StageSource> sources{
        {Stage::Vertex, kFullscreenVertex},
        {Stage::Fragment, "#version 450 core\nlayout(location = 0) in vec2 uv;\nlayout(location = 0) out vec4 color;\n"
                          "void main() { " +
                              fragmentBody + " }"}};
    return Program("full screen", sources);
}

class DrawTest : public test::GlTest {
protected:
    Texture target{"target", {graph::Format::Rgba32Float, 4, 2, 1}};
    Texture depth{"depth", {graph::Format::Depth32Float, 4, 2, 1}};
    FramebufferCache framebuffers;
};
class FramebufferTest : public test::GlTest {};

TEST_F(DrawTest, aFullscreenTriangleCoversEveryPixelFromTheLowerLeft) {
    bindFramebuffer(framebuffers.get(target));
    setState({});
    const Program coordinates = fullscreen("color = vec4(gl_FragCoord.xy, 0.0, 1.0);");
    useProgram(coordinates);
    drawFullscreenTriangle();
    const std::vector<glm::vec4> texels = target.downloadAs<glm::vec4>();
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x)
            EXPECT_EQ(texels[std::size_t(y * 4 + x)], glm::vec4(float(x) + 0.5f, float(y) + 0.5f, 0.0f, 1.0f));
}

TEST_F(DrawTest, clipDepthRunsFromZeroToOneAndNearerIsGreater) {
    const Framebuffer& framebuffer = framebuffers.get(target, &depth);
    bindFramebuffer(framebuffer);
    clearColor(0, glm::vec4(0.0f));
    clearDepth(0.25f);
    const Program white = fullscreen("color = vec4(1.0);"); // draws at depth 0.5
    useProgram(white);
    setState({.depthTest = DepthTest::Less, .depthWrite = true});
    drawFullscreenTriangle();
    EXPECT_THAT(target.downloadAs<float>(), Each(0.0f));
    setState({.depthTest = DepthTest::Greater, .depthWrite = true});
    drawFullscreenTriangle();
    EXPECT_THAT(target.downloadAs<float>(), Each(1.0f));
    EXPECT_THAT(depth.downloadAs<float>(), Each(0.5f));
}

TEST_F(DrawTest, clearsIgnoreWriteMasksAndRestoreThem) {
    bindFramebuffer(framebuffers.get(target, &depth));
    clearColor(0, glm::vec4(0.0f));
    clearDepth(0.0f);
    setState({.depthTest = DepthTest::Always, .depthWrite = false, .colorWrite = false});
    clearColor(0, glm::vec4(2.0f));
    clearDepth(0.75f);
    const Program white = fullscreen("color = vec4(1.0);");
    useProgram(white);
    drawFullscreenTriangle();
    EXPECT_THAT(target.downloadAs<float>(), Each(2.0f));
    EXPECT_THAT(depth.downloadAs<float>(), Each(0.75f));
}

TEST_F(DrawTest, blendsComputeTheirFormula) {
    bindFramebuffer(framebuffers.get(target));
    const Program half = fullscreen("color = vec4(2.0, 2.0, 2.0, 0.5);");
    useProgram(half);
    const auto result = [&](Blend blend) {
        clearColor(0, glm::vec4(4.0f, 4.0f, 4.0f, 1.0f));
        setState({.blend = blend});
        drawFullscreenTriangle();
        return target.downloadAs<glm::vec4>().front();
    };
    EXPECT_EQ(result(Blend::None), glm::vec4(2.0f, 2.0f, 2.0f, 0.5f));
    EXPECT_EQ(result(Blend::Additive), glm::vec4(6.0f, 6.0f, 6.0f, 1.5f));
    EXPECT_EQ(result(Blend::AlphaPremultiplied), glm::vec4(4.0f, 4.0f, 4.0f, 1.0f));
    EXPECT_EQ(result(Blend::AlphaStraight), glm::vec4(3.0f, 3.0f, 3.0f, 1.0f));
}

TEST_F(DrawTest, whatTransmitsKeepsOfEachChannelWhatItsSecondOutputSays) {
    bindFramebuffer(framebuffers.get(target));
    const std::vector<StageSource> sources{{Stage::Vertex, kFullscreenVertex}, {Stage::Fragment, R"(#version 450 core
layout(location = 0, index = 0) out vec4 color;
layout(location = 0, index = 1) out vec4 kept;
void main() { color = vec4(2.0, 2.0, 2.0, 0.5); kept = vec4(0.0, 0.5, 2.0, 7.0); }
)"}};
    const Program glass("glass", sources);
    useProgram(glass);
    const auto result = [&](Blend blend) {
        clearColor(0, glm::vec4(4.0f, 4.0f, 4.0f, 1.0f));
        setState({.blend = blend});
        drawFullscreenTriangle();
        return target.downloadAs<glm::vec4>().front();
    };
    EXPECT_EQ(result(Blend::Transmitting), glm::vec4(2.0f, 4.0f, 10.0f, 1.0f));
    EXPECT_EQ(result(Blend::AlphaStraight), glm::vec4(3.0f, 3.0f, 3.0f, 1.0f)) << "which ignores the second output";
}

TEST_F(DrawTest, srgbTargetsEncode) {
    const Texture srgb("srgb", {graph::Format::Srgb8Alpha8, 1, 1, 1});
    bindFramebuffer(framebuffers.get(srgb));
    setState({});
    const Program grey = fullscreen("color = vec4(0.5);");
    useProgram(grey);
    drawFullscreenTriangle();
    // IEC 61966-2-1: linear 0.5 is 187.5 of 255; drivers round either way. Alpha stays linear.
    const std::vector<std::uint8_t> texel = srgb.downloadAs<std::uint8_t>();
    EXPECT_NEAR(texel[0], 187.5, 0.5);
    EXPECT_NEAR(texel[3], 127.5, 0.5);
}

/// Two quads of one triangle pair each, distinguished by an instance attribute, as scenes are drawn.
class GeometryTest : public DrawTest {
protected:
    GeometryTest() {
        const std::vector<StageSource> sources{{Stage::Vertex, R"(#version 450 core
layout(location = 0) in vec2 position;
layout(location = 1) in uint drawId;
layout(location = 2) in vec4 tint;
layout(location = 0) flat out uint id;
layout(location = 1) flat out vec4 colorOfVertex;
void main() {
    id = drawId;
    colorOfVertex = tint;
    gl_Position = vec4(position, 0.5, 1.0);
})"},
                                               {Stage::Fragment, R"(#version 450 core
layout(location = 0) flat in uint id;
layout(location = 1) flat in vec4 colorOfVertex;
layout(location = 0) out vec4 color;
void main() { color = vec4(float(id), colorOfVertex.gba); })"}};
        program.emplace("geometry", sources);
    }
    const std::vector<glm::vec2> corners{{-1, -1}, {0, -1}, {0, 1}, {-1, 1}, {0, -1}, {1, -1}, {1, 1}, {0, 1}};
    const std::vector<std::uint8_t> tints = [] {
        std::vector<std::uint8_t> bytes;
        for (int i = 0; i < 8; ++i) bytes.insert(bytes.end(), {0, 255, 0, 255});
        return bytes;
    }();
    const Buffer positions = Buffer::of("positions", corners);
    const Buffer tintBuffer = Buffer::of("tints", tints);
    const Buffer ids = Buffer::of("ids", std::vector<std::uint32_t>{0, 10, 20, 30});
    const Buffer indices = Buffer::of("indices", std::vector<std::uint32_t>{9, 9, 9, 0, 1, 2, 0, 2, 3});
    const std::vector<VertexAttribute> attributes{
        {.location = 0, .components = 2, .buffer = &positions, .stride = sizeof(glm::vec2)},
        {.location = 1,
         .components = 1,
         .type = VertexType::Uint32,
         .buffer = &ids,
         .stride = 4,
         .divisor = 1,
         .integer = true},
        {.location = 2, .components = 4, .type = VertexType::Uint8Normalised, .buffer = &tintBuffer, .stride = 4}};
    const VertexArray vertexArray{"quads", attributes, &indices};
    std::optional<Program> program;

    void begin(const PipelineState& state = {.cullFace = CullFace::Back}) {
        bindFramebuffer(framebuffers.get(target));
        clearColor(0, glm::vec4(-1.0f));
        setState(state);
        useProgram(*program);
        bindVertexArray(vertexArray);
    }
    std::vector<float> firstRowIds() const {
        std::vector<float> row;
        const std::vector<glm::vec4> texels = target.downloadAs<glm::vec4>();
        for (std::size_t x = 0; x < 4; ++x) row.push_back(texels[x].x);
        return row;
    }
};

TEST_F(GeometryTest, indexedDrawsHonourFirstIndexBaseVertexAndBaseInstance) {
    begin();
    drawIndexed(3, 6, 0, 2);
    drawIndexed(3, 6, 4, 3);
    EXPECT_THAT(firstRowIds(), ElementsAre(20, 20, 30, 30));
    EXPECT_EQ(target.downloadAs<glm::vec4>().front(), glm::vec4(20.0f, 1.0f, 0.0f, 1.0f));
}

TEST_F(GeometryTest, indirectDrawsEqualDirectOnes) {
    const Buffer commands =
        Buffer::of("commands", std::vector<DrawIndexedCommand>{{}, {6, 1, 3, 0, 1}, {6, 1, 3, 4, 2}, {}});
    begin();
    drawIndexedIndirect(commands, 1, 2);
    EXPECT_THAT(firstRowIds(), ElementsAre(10, 10, 20, 20));
}

TEST_F(GeometryTest, counterClockwiseIsTheFrontUnlessMirrored) {
    begin({.cullFace = CullFace::Back, .frontFaceClockwise = true});
    drawIndexed(3, 6);
    EXPECT_THAT(firstRowIds(), Each(-1.0f));
    begin({.cullFace = CullFace::Front});
    drawIndexed(3, 6);
    EXPECT_THAT(firstRowIds(), Each(-1.0f));
    begin({.cullFace = CullFace::Front, .frontFaceClockwise = true});
    drawIndexed(3, 6);
    EXPECT_THAT(firstRowIds(), ElementsAre(0, 0, -1, -1));
}

TEST_F(GeometryTest, theScissorHoldsUntilTheNextFramebuffer) {
    begin();
    setScissor({1, 0, 2, 2});
    clearColor(0, glm::vec4(5.0f));
    EXPECT_THAT(firstRowIds(), ElementsAre(-1, 5, 5, -1));
    begin();
    EXPECT_THAT(firstRowIds(), Each(-1.0f));
}

TEST_F(DrawTest, aBlitResolvesSamples) {
    const Texture many("many", {graph::Format::Rgba32Float, 4, 2, 4});
    const Framebuffer& source = framebuffers.get(many);
    bindFramebuffer(source);
    clearColor(0, glm::vec4(3.0f));
    blit(source, framebuffers.get(target), true, false);
    EXPECT_THAT(target.downloadAs<float>(), Each(3.0f));
}

TEST_F(FramebufferTest, incompleteAttachmentsAreNamed) {
    const Texture color("radiance", {graph::Format::Rgba16Float, 4, 4, 1});
    const Texture other("normals", {graph::Format::Rgba8Unorm, 4, 4, 4});
    const Texture small("small", {graph::Format::Rgba8Unorm, 2, 4, 1});
    const auto faultOf = [](const Attachments& attachments) {
        try {
            FramebufferCache().get(attachments);
        } catch (const std::runtime_error& error) {
            return std::string(error.what());
        }
        return std::string("no exception");
    };
    EXPECT_EQ(faultOf({{&color}, &color}),
              "a framebuffer cannot be made: a texture of this format cannot be attached there "
              "(colour 0 = 'radiance' 4 x 4 RGBA16F, 1 sample; depth = 'radiance' 4 x 4 "
              "RGBA16F, 1 sample)");
    EXPECT_THAT(faultOf({{&color, nullptr, &other}, nullptr}),
                HasSubstr("the attachments' samples differ (colour 0 = 'radiance'"));
    EXPECT_THAT(faultOf({{&color, &small}, nullptr}), HasSubstr("the attachments' sizes differ"));
    EXPECT_THAT(faultOf({{}, nullptr}), HasSubstr("nothing is attached"));
}

TEST_F(FramebufferTest, everyPartOfATextureIsDrawnIntoAloneAndReadBack) {
    for (const graph::Shape shape : {graph::Shape::Array, graph::Shape::Cube}) {
        const Texture texture(
            "parts",
            {.format = graph::Format::Rgba32Float, .width = 4, .height = 4, .levels = 3, .layers = 6, .shape = shape});
        FramebufferCache cache;
        const auto valueOf = [](int level, int layer) { return glm::vec4(float(level), float(layer), 0.5f, 1.0f); };
        for (int level = 0; level < 3; ++level) {
            for (int layer = 0; layer < 6; ++layer) {
                const Framebuffer& framebuffer = cache.get(Attachments{{graph::Target(&texture, {level, layer})}, {}});
                EXPECT_EQ(framebuffer.width(), 4 >> level);
                bindFramebuffer(framebuffer);
                clearColor(0, valueOf(level, layer));
            }
        }
        EXPECT_EQ(cache.size(), 18u);
        for (int level = 0; level < 3; ++level) {
            for (int layer = 0; layer < 6; ++layer)
                EXPECT_THAT(texture.downloadAs<glm::vec4>(level, layer), testing::Each(valueOf(level, layer)));
        }
        const std::vector<glm::vec4> uploaded(4, glm::vec4(9.0f));
        texture.upload(1, uploaded, 5);
        EXPECT_EQ(texture.downloadAs<glm::vec4>(1, 5), uploaded);
        EXPECT_THAT(texture.downloadAs<glm::vec4>(1, 4), testing::Each(valueOf(1, 4)));
    }
}

TEST_F(FramebufferTest, aFramebufferNeverOutlivesItsTexturesInTheCache) {
    FramebufferCache cache;
    const Texture depth("depth", {graph::Format::Depth32Float, 4, 4, 1});
    {
        const Texture color("color", {graph::Format::Rgba8Unorm, 4, 4, 1});
        const Framebuffer* first = &cache.get(color, &depth);
        EXPECT_EQ(&cache.get(color, &depth), first);
        EXPECT_EQ(cache.size(), 1u);
        EXPECT_EQ(cache.get({{}, &depth}).width(), 4);
        EXPECT_EQ(cache.size(), 2u);
    }
    // GL reuses the deleted texture's name for the next one; the cache must distinguish the two.
    const Texture next("next", {graph::Format::Rgba8Unorm, 4, 4, 1});
    cache.get(next, &depth);
    EXPECT_EQ(cache.size(), 2u);
}

} // namespace
} // namespace tessera::gpu
