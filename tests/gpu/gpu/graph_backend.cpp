#include "renderer/gpu/GraphBackend.h"

#include <algorithm>
#include <array>

#include <gmock/gmock.h>

#include "renderer/gpu/Commands.h"
#include "renderer/gpu/Program.h"
#include "tests/support/GlContext.h"

namespace tessera::gpu {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class DebugTest : public test::GlTest {};
class TimerTest : public test::GlTest {};

std::vector<StageSource> compute(const std::string& body) {
    return {{Stage::Compute, "#version 450 core\nlayout(local_size_x = 4) in;\n" + body}};
}

class GraphBackendTest : public test::GlTest {
protected:
    struct Doubled {
        graph::BufferHandle numbers;
    };
    struct Summed {
        graph::BufferHandle numbers, sum;
    };

    /// Two compute passes: the numbers 1 to 4, then the sum of their squares. `inSecond` runs within the second one.
    graph::Graph twoPasses(const std::function<void()>& inSecond = [] {}) {
        graph::Graph graph;
        const auto first = graph.addPass<Doubled>(
            "numbers",
            [](graph::PassBuilder& builder, Doubled& data) { data.numbers = builder.create("numbers", {16}); },
            [this](const Doubled& data, const graph::PassContext& context) {
                useProgram(count);
                bindStorageBuffer(0, context.buffer(data.numbers));
                dispatch(1);
            });
        const auto second = graph.addPass<Summed>(
            "sum of squares",
            [&](graph::PassBuilder& builder, Summed& data) {
                data.numbers = builder.read(first.numbers);
                data.sum = builder.create("sum", {32});
            },
            [this, inSecond](const Summed& data, const graph::PassContext& context) {
                useProgram(sum);
                bindStorageBuffer(0, context.buffer(data.numbers));
                bindStorageBuffer(1, context.buffer(data.sum));
                dispatch(1);
                inSecond();
            });
        output = second.sum;
        graph.output(output);
        return graph;
    }

    float run(const graph::Graph& graph) {
        const graph::CompiledGraph compiled = graph::compile(graph);
        graph::Execution execution(graph, compiled, backend);
        execution.run();
        memoryBarrier(graph::Barrier::TransferOrUpdate);
        return execution.buffer(output).downloadAs<float>(1)[0];
    }

    const Program count{"count",
                        compute("layout(binding = 0, std430) buffer N { float n[]; };\n"
                                "void main() { n[gl_LocalInvocationIndex] = float(gl_LocalInvocationIndex) + 1.0; }")};
    const Program sum{"sum", compute("layout(binding = 0, std430) buffer N { float n[]; };\n"
                                     "layout(binding = 1, std430) buffer S { float s[]; };\n"
                                     "void main() { s[0] = n[0]*n[0] + n[1]*n[1] + n[2]*n[2] + n[3]*n[3]; }")};
    GraphBackend backend;
    graph::BufferHandle output;
};

TEST_F(DebugTest, anErrorIsThrownWithItsDebugGroups) {
    const Buffer buffer("b", 16);
    const DebugGroup frame("frame");
    {
        const DebugGroup pass("lighting");
        bindStorageBuffer(100000, buffer); // no driver has so many slots
    }
    try {
        throwIfFailed("in a test");
        FAIL() << "expected an exception";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("OpenGL failed in a test: frame / lighting: "));
    }
    EXPECT_NO_THROW(throwIfFailed()); // reported once
}

TEST_F(DebugTest, anErrorIsFoundWithoutDebugOutputToo) {
    {
        const auto plain = Context::create({.kind = ContextKind::Egl, .debug = false});
        const Buffer buffer("b", 16);
        bindStorageBuffer(100000, buffer);
        try {
            throwIfFailed();
            FAIL() << "expected an exception";
        } catch (const std::runtime_error& error) {
            EXPECT_THAT(error.what(), HasSubstr("GL_INVALID_VALUE"));
        }
    }
    context().makeCurrent();
}

TEST_F(DebugTest, aDestructionInTheWrongOrderNeverHappensInAMovedFromObject) {
    Buffer first("first", 16);
    const Buffer second = std::move(first);
    EXPECT_NO_THROW(throwIfFailed());
    EXPECT_GT(second.id(), 0u);
}

TEST_F(TimerTest, aFinishedStretchIsReadWithoutWaiting) {
    GpuTimer timer("t");
    EXPECT_FALSE(timer.latestMs());
    for (int i = 0; i < 20; ++i) { // more than the ring holds
        timer.begin();
        timer.end();
    }
    finish();
    const std::optional<double> ms = timer.latestMs();
    ASSERT_TRUE(ms);
    EXPECT_GE(*ms, 0.0);
    EXPECT_LT(*ms, 1000.0); // empty: far below a second on any machine, unless units are mistaken
}

TEST_F(GraphBackendTest, aGraphOfTwoPassesGivesItsResult) {
    const graph::Graph graph = twoPasses();
    EXPECT_EQ(run(graph), 1.0f + 4.0f + 9.0f + 16.0f);
}

TEST_F(GraphBackendTest, aFaultOfThePassIsThrownWithItsName) {
    const graph::Graph graph = twoPasses([] { bindStorageBuffer(100000, Buffer("b", 16)); });
    try {
        run(graph);
        FAIL() << "expected an exception";
    } catch (const std::runtime_error& error) {
        EXPECT_THAT(error.what(), HasSubstr("pass 'sum of squares'"));
        EXPECT_THAT(error.what(), HasSubstr("sum of squares: GL_INVALID_VALUE"));
    }
    EXPECT_EQ(run(twoPasses()), 30.0f); // the backend still works
}

TEST_F(GraphBackendTest, aPassThatThrowsIsClosed) {
    const graph::Graph graph = twoPasses([] { throw std::runtime_error("no lights"); });
    EXPECT_THROW(run(graph), std::runtime_error);
    EXPECT_EQ(run(twoPasses()), 30.0f);
}

TEST_F(GraphBackendTest, allocationsAreKeptAcrossFramesOfEqualShape) {
    const graph::Graph graph = twoPasses();
    const graph::CompiledGraph compiled = graph::compile(graph);
    backend.allocate(compiled.allocations);
    const std::uint32_t first = backend.buffer(0).id();
    backend.allocate(compiled.allocations);
    EXPECT_EQ(backend.buffer(0).id(), first);
    EXPECT_EQ(backend.poolBytes(), compiled.bytes);
    const std::vector<graph::ResourceDesc> texture{graph::TextureDesc{graph::Format::Rgba8Unorm, 4, 4, 1}};
    for (int frame = 0; frame < 10; ++frame) backend.allocate(texture);
    EXPECT_EQ(backend.poolBytes(), 64u);
    EXPECT_EQ(backend.texture(0).desc().width, 4);
}

TEST_F(GraphBackendTest, framesIdleAreCountedFromTheLastUseOfAnAllocation) {
    const std::vector<graph::ResourceDesc> often{graph::BufferDesc{16}}, seldom{graph::BufferDesc{32}};
    backend.allocate(often);
    backend.buffer(0).uploadValue(7u); // a new buffer holds 0
    for (int frame = 0; frame < 10; ++frame) backend.allocate(often);
    backend.allocate(seldom);
    backend.allocate(often);
    EXPECT_THAT(backend.buffer(0).downloadAs<std::uint32_t>(1), ElementsAre(7u));
}

TEST_F(GraphBackendTest, anAllocationIsFreedOneFrameAfterTheMostThatItMayBeIdle) {
    const std::vector<graph::ResourceDesc> shape{graph::BufferDesc{16}};
    for (const int most : {0, 1, 5}) {
        backend.setMostIdleFrames(most);
        backend.allocate(shape);
        for (int frame = 0; frame < most; ++frame) backend.allocate({});
        EXPECT_EQ(backend.poolBytes(), 16u) << most << " frames";
        backend.allocate({});
        EXPECT_EQ(backend.poolBytes(), 0u) << most << " frames and one more";
    }
}

TEST_F(GraphBackendTest, framesThatAreNotCountedMakeNothingOlder) {
    const std::vector<graph::ResourceDesc> shape{graph::BufferDesc{16}};
    backend.allocate(shape);
    backend.persistentBuffer("kept", {32});
    const std::size_t bytes = backend.poolBytes();
    backend.setCountsIdleFrames(false);
    for (int frame = 0; frame < 10; ++frame) {
        backend.allocate({});
        backend.endFrame({});
    }
    backend.setCountsIdleFrames(true);
    for (int frame = 0; frame < backend.mostIdleFrames(); ++frame) {
        backend.allocate({});
        backend.endFrame({});
    }
    EXPECT_EQ(backend.poolBytes(), bytes);
    for (int frame = 0; frame < 2; ++frame) {
        backend.allocate({});
        backend.endFrame({});
    }
    EXPECT_EQ(backend.poolBytes(), 0u);
}

TEST_F(GraphBackendTest, aGrowingBufferIsReplacedSeldomAndOnlyWhereItIsTooSmall) {
    const auto marked = [&](std::size_t bytes) {
        return backend.growingBuffer("list", 1, bytes).downloadAs<std::uint32_t>(1).front() == 7u;
    };
    const std::size_t first = backend.growingBuffer("list", 1, 1000).bytes();
    backend.growingBuffer("list", 1, 1000).uploadValue(7u); // a new buffer holds 0
    EXPECT_GE(first, 1000u);
    EXPECT_EQ(backend.poolBytes(), first);
    EXPECT_TRUE(marked(first));
    EXPECT_TRUE(marked(4)) << "it never shrinks";
    EXPECT_EQ(backend.growingBuffer("list", 1, 4).bytes(), first);
    EXPECT_FALSE(marked(first + 1));
    std::size_t held = backend.growingBuffer("list", 1, 4).bytes(), bytes = 1000;
    int replaced = 0;
    for (; bytes < 100000; bytes += bytes / 100) {
        const std::size_t now = backend.growingBuffer("list", 1, bytes).bytes();
        ASSERT_GE(now, bytes);
        ASSERT_LE(now, std::max(held, bytes + bytes / 4));
        replaced += now != held;
        held = now;
    }
    EXPECT_LE(replaced, 21) << "a hundredfold by quarters: log 100 / log 1.25";
    const std::size_t second = backend.growingBuffer("list", 2, 16).bytes();
    EXPECT_EQ(backend.poolBytes(), held + second) << "buffers of one name are distinguished by their number";
}

TEST_F(GraphBackendTest, profiledPassesHaveATimeThatHoldsTheirWork) {
    backend.setProfiling(true);
    run(twoPasses());
    const std::vector<PassTiming> timings = backend.passTimings();
    ASSERT_EQ(timings.size(), 2u);
    EXPECT_EQ(timings[0].name, "numbers");
    EXPECT_EQ(timings[1].name, "sum of squares");
    for (const PassTiming& timing : timings) {
        ASSERT_TRUE(timing.gpuMs);
        EXPECT_GT(timing.cpuMs, 0.0);
        EXPECT_GE(*timing.gpuMs, timing.cpuMs);
    }
}

TEST_F(GraphBackendTest, unprofiledPassesOfASoftwareRasteriserNeverClaimAGpuTime) {
    for (int frame = 0; frame < 3; ++frame) run(twoPasses());
    finish();
    for (const PassTiming& timing : backend.passTimings())
        EXPECT_EQ(timing.gpuMs.has_value(), !context().capabilities().isSoftware) << timing.name;
}

TEST_F(GraphBackendTest, aTimeByProfilingIsGoneWithTheNextFrameWithout) {
    backend.setProfiling(true);
    run(twoPasses());
    for (const PassTiming& timing : backend.passTimings()) EXPECT_TRUE(timing.gpuMs) << timing.name;
    backend.setProfiling(false);
    for (int frame = 0; frame < 3; ++frame) run(twoPasses());
    finish();
    for (const PassTiming& timing : backend.passTimings())
        EXPECT_EQ(timing.gpuMs.has_value(), !context().capabilities().isSoftware) << timing.name;
}

TEST_F(GraphBackendTest, constantsAreThoseOfTheirOwnDispatchHoweverManyThereAre) {
    const Program program{"copy", compute("layout(binding = 3, std140) uniform C { uvec4 value; };\n"
                                          "layout(binding = 0, std430) buffer N { uint n[]; };\n"
                                          "void main() { n[value.x] = value.y; }")};
    constexpr std::uint32_t kCount = 5000; // of 256 bytes each: some rounds of the ring
    const Buffer numbers("numbers", kCount * sizeof(std::uint32_t));
    bindStorageBuffer(0, numbers);
    useProgram(program);
    const Program* const programs[] = {&program};
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const std::array<std::uint32_t, 4> value{i, 7 * i + 1, 0, 0};
        backend.bindConstants(3, std::as_bytes(std::span(value)), programs);
        dispatch(1);
    }
    memoryBarrier(graph::Barrier::TransferOrUpdate);
    const std::vector<std::uint32_t> found = numbers.downloadAs<std::uint32_t>(kCount);
    for (std::uint32_t i = 0; i < kCount; ++i) ASSERT_EQ(found[i], 7 * i + 1);
}

TEST_F(GraphBackendTest, constantsOfAnotherSizeThanTheProgramsBlockAreRefused) {
    const Program program{"copy", compute("layout(binding = 3, std140) uniform C { uvec4 value[2]; };\n"
                                          "layout(binding = 0, std430) buffer N { uint n[]; };\n"
                                          "void main() { n[value[0].x] = value[1].y; }")};
    const Program* const programs[] = {&program};
    const std::array<std::uint32_t, 8> value{};
    EXPECT_NO_THROW(backend.bindConstants(3, std::as_bytes(std::span(value)), programs));
    EXPECT_NO_THROW(backend.bindConstants(4, std::as_bytes(std::span(value)), programs)) << "no block there";
    try {
        backend.bindConstants(3, std::as_bytes(std::span(value).first(4)), programs);
        FAIL() << "16 bytes are taken for 32";
    } catch (const std::logic_error& error) {
        EXPECT_STREQ(error.what(), "program 'copy' has a uniform block of 32 bytes at slot 3, and is given 16");
    }
}

TEST_F(GraphBackendTest, persistentResourcesKeepTheirContentsUntilTheirShapeChanges) {
    graph::TextureDesc desc{graph::Format::Rgba32Float, 4, 4};
    const auto runFrame = [&](std::uint64_t revision) {
        graph::Graph graph([&](const std::string& name, const graph::ResourceDesc& shape, std::uint64_t wanted) {
            return backend.holds(name, shape, wanted);
        });
        graph::TextureHandle history = graph.persist("history", desc, revision);
        const bool holds = graph.holds(history);
        struct Written {
            graph::TextureHandle history;
        };
        if (!holds) {
            history =
                graph
                    .addPass<Written>(
                        "write",
                        [&](graph::PassBuilder& builder, Written& data) { data.history = builder.write(history); },
                        [revision](const Written&, const graph::PassContext& context) {
                            context.bindTargets();
                            clearColor(0, glm::vec4(float(revision)));
                        })
                    .history;
        }
        graph.output(history);
        const graph::CompiledGraph compiled = graph::compile(graph);
        graph::Execution execution(graph, compiled, backend);
        execution.run();
        EXPECT_EQ(compiled.order.size(), holds ? 0u : 1u);
    };
    const auto value = [&] { return backend.persistentTexture("history", desc).downloadAs<glm::vec4>().front().x; };
    runFrame(3);
    EXPECT_EQ(value(), 3.0f);
    runFrame(3); // nothing runs
    EXPECT_EQ(value(), 3.0f);
    runFrame(4);
    EXPECT_EQ(value(), 4.0f);
    EXPECT_FALSE(backend.holds("history", desc, 3));
    const std::size_t bytes = backend.poolBytes();
    desc.width = 8;
    EXPECT_FALSE(backend.holds("history", desc, 4)) << "of another shape";
    runFrame(4);
    EXPECT_EQ(value(), 4.0f);
    EXPECT_EQ(backend.poolBytes(), bytes + 4 * 4 * 16);
    backend.forget("history");
    EXPECT_FALSE(backend.holds("history", desc, 4));
    runFrame(4);
    for (int i = 0; i < backend.mostIdleFrames(); ++i) backend.endFrame({});
    EXPECT_TRUE(backend.holds("history", desc, 4));
    backend.endFrame({});
    EXPECT_FALSE(backend.holds("history", desc, 4)) << "no frame has used it for long";
}

} // namespace
} // namespace tessera::gpu
