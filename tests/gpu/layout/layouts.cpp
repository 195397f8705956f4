// Structs shared by C++ and GLSL have the offsets that the driver reports.
#include <cstddef>

#include <gmock/gmock.h>

#include "renderer/frame/LightBuffer.h"
#include "shaders/bench/lower_bound.h"
#include "shaders/shared/display.h"
#include "shaders/shared/frame.h"
#include "shaders/shared/light.h"
#include "shaders/shared/material.h"
#include "tests/gpu/shaders/ShaderBench.h"

namespace tessera {
namespace {

using testing::ElementsAre;

/// Name, offset, and the stride of the array or of the matrix columns (0: neither).
using Place = std::tuple<std::string, std::size_t, std::size_t>;

constexpr std::size_t kOutputs = 23 + 2 * TEXTURE_SLOT_COUNT;

class LayoutTest : public test::GlTest {
protected:
    std::vector<Place> places(const std::string& block) {
        std::vector<Place> result;
        for (const gpu::BlockMember& member : program().blockMembers(block, gpu::BlockKind::Uniform))
            result.emplace_back(member.name, member.offset, member.arrayStride + member.matrixStride);
        return result;
    }
    std::size_t bytes(const std::string& block) { return program().blockBytes(block, gpu::BlockKind::Uniform); }
    const gpu::Program& program() { return bench.programs().get({"blocks.comp", "", "", "test/blocks.comp", {}}); }
    test::ShaderBench bench;
};

TEST_F(LayoutTest, viewConstantsLieExactlyWhereTheDriverReadsThem) {
    using shared::ViewConstants;
    EXPECT_EQ(bytes("ViewBlock"), sizeof(ViewConstants));
    EXPECT_THAT(places("ViewBlock"),
                ElementsAre(Place("view.clipFromLS", offsetof(ViewConstants, clipFromLS), sizeof(glm::vec4)),
                            Place("view.clipFromRWS", offsetof(ViewConstants, clipFromRWS), sizeof(glm::vec4)),
                            Place("view.worldFromLS", offsetof(ViewConstants, worldFromLS), sizeof(glm::vec4)),
                            Place("view.eyeLS", offsetof(ViewConstants, eyeLS), 0),
                            Place("view.rayDxLS", offsetof(ViewConstants, rayDxLS), 0),
                            Place("view.rayDyLS", offsetof(ViewConstants, rayDyLS), 0),
                            Place("view.forwardLS", offsetof(ViewConstants, forwardLS), 0),
                            Place("view.aheadFromDepth", offsetof(ViewConstants, aheadFromDepth), 0),
                            Place("view.background", offsetof(ViewConstants, background), 0),
                            Place("view.rayFromPixel", offsetof(ViewConstants, rayFromPixel), 0),
                            Place("view.depthKey", offsetof(ViewConstants, depthKey), 0),
                            Place("view.sizePixels", offsetof(ViewConstants, sizePixels), 0)));
}

TEST_F(LayoutTest, lightingConstantsLieExactlyWhereTheDriverReadsThem) {
    using shared::LightingConstants;
    EXPECT_EQ(bytes("LightingBlock"), sizeof(LightingConstants));
    EXPECT_THAT(places("LightingBlock"),
                ElementsAre(Place("lighting.lights", offsetof(LightingConstants, lights), 0),
                            Place("lighting.tileGrid", offsetof(LightingConstants, tileGrid), 0),
                            Place("lighting.slices", offsetof(LightingConstants, slices), 0)));
}

TEST_F(LayoutTest, materialConstantsLieExactlyWhereTheDriverReadsThem) {
    using shared::MaterialConstants;
    EXPECT_EQ(bytes("MaterialBlock"), sizeof(MaterialConstants));
    EXPECT_THAT(places("MaterialBlock"),
                ElementsAre(Place("material.baseColor", offsetof(MaterialConstants, baseColor), 0),
                            Place("material.emissive", offsetof(MaterialConstants, emissive), 0),
                            Place("material.microsurface", offsetof(MaterialConstants, microsurface), 0),
                            Place("material.specular", offsetof(MaterialConstants, specular), 0),
                            Place("material.mixed", offsetof(MaterialConstants, mixed), 0),
                            Place("material.anisotropy", offsetof(MaterialConstants, anisotropy), 0),
                            Place("material.clearcoat", offsetof(MaterialConstants, clearcoat), 0),
                            Place("material.sheen", offsetof(MaterialConstants, sheen), 0),
                            Place("material.kind", offsetof(MaterialConstants, kind), 0),
                            Place("material.uvRow0[0]", offsetof(MaterialConstants, uvRow0), sizeof(glm::vec4)),
                            Place("material.uvRow1[0]", offsetof(MaterialConstants, uvRow1), sizeof(glm::vec4)),
                            Place("material.clearcoatTurn", offsetof(MaterialConstants, clearcoatTurn), 0),
                            Place("material.transmission", offsetof(MaterialConstants, transmission), 0),
                            Place("material.attenuation", offsetof(MaterialConstants, attenuation), 0),
                            Place("material.film", offsetof(MaterialConstants, film), 0)));
}

TEST_F(LayoutTest, displayConstantsLieExactlyWhereTheDriverReadsThem) {
    using shared::DisplayConstants;
    EXPECT_EQ(bytes("DisplayBlock"), sizeof(DisplayConstants));
    EXPECT_THAT(places("DisplayBlock"), ElementsAre(Place("display.exposure", offsetof(DisplayConstants, exposure), 0),
                                                    Place("display.scales", offsetof(DisplayConstants, scales), 0)));
}

TEST_F(LayoutTest, blocksAreBoundWhereTheSharedListSays) {
    EXPECT_EQ(program().blockSlot("ViewBlock", gpu::BlockKind::Uniform), UNIFORM_VIEW);
    EXPECT_EQ(program().blockSlot("LightingBlock", gpu::BlockKind::Uniform), UNIFORM_LIGHTING);
    EXPECT_EQ(program().blockSlot("MaterialBlock", gpu::BlockKind::Uniform), UNIFORM_MATERIAL);
    EXPECT_EQ(program().blockSlot("DisplayBlock", gpu::BlockKind::Uniform), UNIFORM_PASS);
}

TEST_F(LayoutTest, theShaderReadsTheValuesThatCppWrote) {
    shared::ViewConstants view{};
    shared::LightingConstants lighting{};
    view.clipFromLS[3] = {1, 2, 3, 4};
    view.aheadFromDepth = {5, 6, 7, 8};
    lighting.lights = {9, 10, 11, 12};
    lighting.tileGrid = {13, 14, 15, 16};
    view.depthKey = {17, 18, 19, 20};
    view.sizePixels = {21, 22, 23, 24};
    lighting.slices = {25, 26, 27, 28};
    shared::MaterialConstants material{};
    material.kind = {1, 2, 3, 4};
    material.uvRow0[6] = {5, 6, 7, 8};
    material.uvRow1[6] = {9, 10, 11, 12};
    shared::DisplayConstants display{};
    display.exposure = {1.5f, 2.5f, 3.5f, 4.5f};
    display.scales = {5.5f, 6.5f, 7.5f, 8.5f};
    const gpu::Buffer viewBuffer("view", sizeof view), lightingBuffer("lighting", sizeof lighting),
        materialBuffer("material", sizeof material), displayBuffer("display", sizeof display);
    viewBuffer.uploadValue(view);
    lightingBuffer.uploadValue(lighting);
    materialBuffer.uploadValue(material);
    displayBuffer.uploadValue(display);
    gpu::bindUniformBuffer(UNIFORM_VIEW, viewBuffer);
    gpu::bindUniformBuffer(UNIFORM_LIGHTING, lightingBuffer);
    gpu::bindUniformBuffer(UNIFORM_MATERIAL, materialBuffer);
    gpu::bindUniformBuffer(UNIFORM_PASS, displayBuffer);
    const std::vector<glm::vec4> out = bench.run("test/blocks.comp", {}, {glm::vec4(0.0f)}, 1, kOutputs);
    EXPECT_EQ(out[1], view.clipFromLS[3]);
    EXPECT_EQ(out[8], view.aheadFromDepth);
    EXPECT_EQ(out[10], glm::vec4(lighting.lights));
    EXPECT_EQ(out[15], glm::vec4(material.kind));
    EXPECT_EQ(out[16 + 6], material.uvRow0[6]);
    EXPECT_EQ(out[16 + TEXTURE_SLOT_COUNT + 6], material.uvRow1[6]);
    EXPECT_EQ(out[16 + 2 * TEXTURE_SLOT_COUNT], display.exposure);
    EXPECT_EQ(out[18 + 2 * TEXTURE_SLOT_COUNT], glm::vec4(lighting.tileGrid));
    EXPECT_EQ(out[19 + 2 * TEXTURE_SLOT_COUNT], view.depthKey);
    EXPECT_EQ(out[20 + 2 * TEXTURE_SLOT_COUNT], glm::vec4(view.sizePixels));
    EXPECT_EQ(out[21 + 2 * TEXTURE_SLOT_COUNT], glm::vec4(lighting.slices));
    EXPECT_EQ(out.back(), display.scales);
}

TEST_F(LayoutTest, everyMemberOfALightIsExactlyOneTexelOfEveryStore) {
    static_assert(sizeof(shared::LightTexels) == LIGHT_TEXELS * sizeof(glm::vec4));
    static_assert(sizeof(shared::LightShapeTexels) == LIGHT_SHAPE_TEXELS * sizeof(glm::vec4));
    frame::PackedLights lights;
    lights.texels.resize(LIGHT_UNIFORM_LIGHTS); // as many as fit a uniform block
    lights.shapes.resize(LIGHT_UNIFORM_LIGHTS);
    lights.corners.resize(LIGHT_UNIFORM_LIGHTS);
    float next = 0.0f;
    for (std::size_t i = 0; i < lights.texels.size(); ++i)
        for (glm::vec4* member :
             {&lights.texels[i].position, &lights.texels[i].color, &lights.shapes[i].axis,
              &lights.shapes[i].attenuation, &lights.corners[i].outline, &lights.corners[i].corners[0],
              &lights.corners[i].corners[3], &lights.corners[i].shareEnds, &lights.corners[i].lastEnd})
            for (int k = 0; k < 4; ++k) (*member)[k] = next++;
    for (const scenes::LightType type : {scenes::LightType::Spot, scenes::LightType::Polygon}) {
        const bool hasCorners = type == scenes::LightType::Polygon;
        lights.features = {};
        lights.features.add(frame::featureOf(type));
        const frame::LightBuffer buffer(lights, lights.features);
        buffer.bind();
        const gpu::Buffer texels = gpu::Buffer::of("lights", lights.texels);
        const gpu::Buffer shapes = gpu::Buffer::of("light shapes", frame::shapeTexelsOf(lights, lights.features));
        gpu::bindUniformBuffer(UNIFORM_LIGHTS, texels);
        gpu::bindUniformBuffer(UNIFORM_LIGHT_SHAPES, shapes);
        gpu::bindStorageBuffer(STORAGE_LIGHTS, texels);
        gpu::bindStorageBuffer(STORAGE_LIGHT_SHAPES, shapes);
        for (const char* store : {"LIGHT_STORE_TEXEL", "LIGHT_STORE_UNIFORM", "LIGHT_STORE_STORAGE"}) {
            SCOPED_TRACE(store);
            const shader::Defines defines{
                {"HAS_LIGHT_SHAPES", "1"}, {"HAS_POLYGON_LIGHTS", hasCorners ? "1" : "0"}, {"LIGHT_STORE", store}};
            const std::size_t each = LIGHT_TEXELS + LIGHT_SHAPE_TEXELS + (hasCorners ? LIGHT_CORNER_TEXELS : 0);
            const std::vector<glm::vec4> out =
                bench.run("test/light_texels.comp", defines, {glm::vec4(0.0f)}, lights.texels.size(), each);
            for (std::size_t i = 0; i < lights.texels.size(); ++i) {
                EXPECT_EQ(out[each * i], lights.texels[i].position);
                EXPECT_EQ(out[each * i + 1], lights.texels[i].color);
                EXPECT_EQ(out[each * i + 2], lights.shapes[i].axis);
                EXPECT_EQ(out[each * i + 3], lights.shapes[i].attenuation);
                if (!hasCorners) continue;
                EXPECT_EQ(out[each * i + 4], lights.corners[i].outline);
                EXPECT_EQ(out[each * i + 5], lights.corners[i].corners[0]);
                EXPECT_EQ(out[each * i + 8], lights.corners[i].corners[3]);
                EXPECT_EQ(out[each * i + 9], lights.corners[i].shareEnds);
                EXPECT_EQ(out[each * i + 10], lights.corners[i].lastEnd);
            }
        }
    }
}

} // namespace
} // namespace tessera
