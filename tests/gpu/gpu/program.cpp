#include "renderer/gpu/Program.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/support/GlContext.h"

namespace tessera::gpu {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

class ProgramTest : public test::GlTest {};

std::vector<StageSource> computeStage(const std::string& body) {
    return {{Stage::Compute, "#version 450 core\nlayout(local_size_x = 1) in;\n" + body}};
}

TEST_F(ProgramTest, aFaultyStageIsNamedWithTheDriversLog) {
    try {
        const Program program("broken", computeStage("void main() { undeclaredName = 1.0; }"));
        FAIL() << "expected a ShaderError";
    } catch (const ShaderError& error) {
        EXPECT_EQ(error.program(), "broken");
        ASSERT_EQ(error.stageLogs().size(), 1u);
        EXPECT_EQ(error.stageLogs()[0].stage, Stage::Compute);
        EXPECT_THAT(error.stageLogs()[0].text, HasSubstr("undeclaredName"));
        EXPECT_THAT(error.what(), HasSubstr("a compute shader cannot be compiled:\n"));
        EXPECT_THAT(error.what(), EndsWith("\nIt is program 'broken'."));
        EXPECT_TRUE(error.linkLog().empty());
    }
}

TEST_F(ProgramTest, aProgramThatDoesNotLinkIsNamed) {
    const std::vector<StageSource> sources{
        {Stage::Vertex, "#version 450 core\nout vec4 a;\nvoid main() { a = vec4(1.0); gl_Position = a; }"},
        {Stage::Fragment, "#version 450 core\nin vec2 a;\nout vec4 c;\nvoid main() { c = a.xyxy; }"}};
    try {
        const Program program("unlinked", sources);
        FAIL() << "expected a ShaderError";
    } catch (const ShaderError& error) {
        EXPECT_TRUE(error.stageLogs().empty());
        EXPECT_THAT(error.what(), HasSubstr("a shader program cannot be linked:\n"));
        EXPECT_THAT(error.what(), EndsWith("\nIt is program 'unlinked'."));
    }
}

TEST_F(ProgramTest, aStageThatSamplesMoreTexturesThanTheDriverOffersIsRefused) {
    const auto stage = [](int textures) {
        return computeStage(fmt::format("layout(binding = 0) uniform sampler2D some[{0}];\n"
                                        "layout(binding = 0, std430) buffer Sum {{ vec4 sum; }};\n"
                                        "void main() {{ for (int i = 0; i < {0}; ++i) "
                                        "sum += texelFetch(some[i], ivec2(0), 0); }}",
                                        textures));
    };
    EXPECT_EQ(Program("full", stage(16)).sampledTextures(Stage::Compute), 16);
    try {
        const Program program("greedy", stage(1000)); // some drivers refuse it themselves
        FAIL() << "expected a ShaderError";
    } catch (const ShaderError& error) {
        EXPECT_THAT(error.what(), EndsWith("\nIt is program 'greedy'."));
    }
}

TEST_F(ProgramTest, blocksReportTheirMembersAndTheirSize) {
    const Program program("blocks", computeStage(R"(
struct Light { vec3 positionVS; float rangeMetres; vec4 weights[2]; };
layout(binding = 2, std140) uniform View { mat4 clipFromView; float timeSeconds; vec4 planes[3]; };
layout(binding = 5, std430) buffer Lights { uint count; Light lights[]; };
void main() {
    count = uint(timeSeconds + planes[2].x + clipFromView[1].y + lights[3].rangeMetres + lights[1].positionVS.x
                 + lights[0].weights[1].y);
})"));
    const auto view = program.blockMembers("View", BlockKind::Uniform);
    ASSERT_EQ(view.size(), 3u);
    EXPECT_EQ(view[0].name, "clipFromView");
    EXPECT_EQ(view[0].matrixStride, 16u);
    EXPECT_EQ(view[1].name, "timeSeconds");
    EXPECT_EQ(view[1].offset, 64u);
    EXPECT_EQ(view[2].name, "planes[0]");
    EXPECT_EQ(view[2].offset, 80u);
    EXPECT_EQ(view[2].arrayStride, 16u);
    EXPECT_EQ(program.blockBytes("View", BlockKind::Uniform), 128u);
    EXPECT_EQ(program.blockSlot("View", BlockKind::Uniform), 2);

    const auto lights = program.blockMembers("Lights", BlockKind::Storage);
    ASSERT_EQ(lights.size(), 4u);
    EXPECT_EQ(lights[1].name, "lights[0].positionVS");
    EXPECT_EQ(lights[1].offset, 16u);
    EXPECT_EQ(lights[1].topArrayStride, 48u);
    EXPECT_EQ(lights[2].offset, 28u);
    EXPECT_EQ(lights[3].name, "lights[0].weights[0]");
    EXPECT_EQ(lights[3].arrayStride, 16u);
    EXPECT_EQ(program.blockSlot("Lights", BlockKind::Storage), 5);

    EXPECT_TRUE(program.blockMembers("Nothing", BlockKind::Uniform).empty());
    EXPECT_EQ(program.blockBytes("Nothing", BlockKind::Storage), 0u);
    EXPECT_EQ(program.blockSlot("Nothing", BlockKind::Storage), -1);
    EXPECT_EQ(program.samplerUnit("nothing"), -1);
}

TEST_F(ProgramTest, oneOfTheSameNameAndSourcesIsCompiledOnceWhereItsContextKeepsThem) {
    const std::vector<StageSource> sources = computeStage("void main() {}"), others = computeStage("void main() { }");
    std::uint32_t first = 0;
    {
        const Program program("kept", sources);
        first = program.id();
    }
    EXPECT_EQ(Program("kept", sources).id(), first);
    EXPECT_NE(Program("kept", others).id(), first);
    EXPECT_NE(Program("of another name", sources).id(), first);
    {
        const auto plain = Context::create({.kind = ContextKind::Egl});
        const Program one("kept", sources), two("kept", sources);
        EXPECT_NE(one.id(), two.id()) << "this context is not set to keep them";
        plain->keepPrograms();
        const Program three("kept", sources);
        EXPECT_EQ(Program("kept", sources).id(), three.id());
        plain->forgetPrograms();
        EXPECT_NE(Program("kept", sources).id(), three.id());
    }
    context().makeCurrent();
}

} // namespace
} // namespace tessera::gpu
