#include "passes/ListRoom.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/Error.h"
#include "passes/GpuLightListsPass.h"
#include "renderer/gpu/Buffer.h"
#include "tests/support/ErrorText.h"
#include "tests/support/GlContext.h"

namespace tessera::passes {
namespace {

/// Records requested sizes instead of allocating them, and returns the same buffer for everything.
class NotingContext final : public graph::PassContext {
public:
    const gpu::Texture& texture(graph::TextureHandle) const override { throw std::logic_error("no textures"); }
    const gpu::Buffer& buffer(graph::BufferHandle) const override { return held; }
    const gpu::Buffer& allocate(graph::BufferHandle, std::size_t bytes) const override {
        if (fault) fault();
        allocated = bytes;
        return held;
    }
    std::size_t bytes(graph::BufferHandle) const override { return allocated; }
    const gpu::Program& program(std::size_t) const override { throw std::logic_error("no programs"); }
    void bindTargets() const override {}

    std::function<void()> fault;
    const gpu::Buffer held{"held", 64};
    mutable std::size_t allocated = 0;

protected:
    void bindConstants(std::uint32_t, std::span<const std::byte>) const override {}
};

class ListRoomTest : public test::GlTest {
protected:
    const gpu::Capabilities& limits = context().capabilities();
    NotingContext pass;
};

TEST_F(ListRoomTest, asManyTexelsAsTheDriverReadsAreTakenAndOneMoreIsRefused) {
    const std::size_t most = limits.maxTextureBufferTexels;
    makeTexelRoom(pass, {}, "light entries", most, graph::Format::R32Uint);
    EXPECT_EQ(pass.allocated, most * 4);
    makeTexelRoom(pass, {}, "lights", most, graph::Format::Rgba32Float);
    EXPECT_EQ(pass.allocated, most * 16);
    EXPECT_EQ(test::errorText<InputError>(
                  [&] { makeTexelRoom(pass, {}, "light entries", most + 1, graph::Format::R32Uint); }),
              fmt::format("light entries would take {} texels, and this driver reads {}: larger tiles, another culling "
                          "method or fewer lights need less",
                          most + 1, most));
    EXPECT_EQ(pass.allocated, most * 16) << "nothing is taken for what is refused";
}

TEST_F(ListRoomTest, asManyBytesOfABlockAsTheDriverReadsAreTakenAndOneMoreIsRefused) {
    const std::size_t most = limits.maxStorageBlockBytes;
    makeBlockRoom(pass, {}, "light cells", most);
    EXPECT_EQ(pass.allocated, most);
    EXPECT_EQ(test::errorText<InputError>([&] { makeBlockRoom(pass, {}, "light cells", most + 1); }),
              fmt::format("light cells would take {} bytes, and this driver reads {}: larger tiles, another culling "
                          "method or fewer lights need less",
                          most + 1, most));
    EXPECT_EQ(pass.allocated, most);
}

TEST_F(ListRoomTest, asManyBytesAsShadersWriteAreNoFaultAndOneMoreIs) {
    const std::size_t most = limits.maxStorageBlockBytes;
    EXPECT_NO_THROW(requireWritable("light tiles", most));
    EXPECT_EQ(test::errorText<InputError>([&] { requireWritable("light tiles", most + 1); }),
              fmt::format("light tiles would take {} bytes, and shaders of this driver write {} at most: build them on "
                          "the CPU, or use larger tiles or fewer lights",
                          most + 1, most));
}

TEST_F(ListRoomTest, memoryThatRunsOutIsReportedWithTheRemedyAndAMistakeOfThePassAsItIs) {
    const auto take = [&] { makeBlockRoom(pass, {}, "light cells", 16); };
    pass.fault = [] { throw std::runtime_error("no memory for 'light_cells'"); };
    EXPECT_EQ(test::errorText<std::runtime_error>(take),
              "no memory for 'light_cells'; larger tiles, another culling method or fewer lights need less");
    pass.fault = [] { throw std::logic_error("not declared"); };
    EXPECT_EQ(test::errorText<std::logic_error>(take), "not declared");
}

TEST_F(ListRoomTest, listsBeyond32BitsAreCountedWithEveryBit) {
    frame::FrameSpec spec;
    spec.settings.sizePixels = {64, 64};
    spec.culling.method = culling::Method::Cluster;
    const frame::DrawnView drawn{};
    graph::Graph graph;
    GpuLightListsPass::add(graph, spec, {}, &drawn);
    const auto room = std::find_if(graph.passes().begin(), graph.passes().end(),
                                   [](const graph::Graph::Pass& declared) { return declared.name == "light_room"; });
    ASSERT_NE(room, graph.passes().end());
    pass.held.uploadValue(glm::uvec4(1u, 5u, 1u, 0u)); // the cells, and the low and high word of the entries
    EXPECT_THAT(test::errorText<InputError>([&] { room->execute(pass); }),
                testing::HasSubstr(fmt::format("light entries would take {} bytes", ((std::size_t(1) << 32) + 5) * 4)));
}

} // namespace
} // namespace tessera::passes
