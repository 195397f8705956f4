#include "base/Error.h"
#include "tests/support/ErrorText.h"
#include "tests/unit/graph/Recorder.h"

namespace tessera::graph::test {
namespace {

using testing::ElementsAre;

struct Image {
    TextureHandle image;
};

TEST(Execution, passesRunInOrderBetweenBeginAndEnd) {
    Recorder backend;
    Graph graph;
    const auto first = graph.addPass<Image>(
        "first",
        [](PassBuilder& builder, Image& data) { data.image = builder.create("a", kColor, Access::ImageWrite); },
        [&](const Image&, const PassContext&) { backend.calls.push_back("first runs"); });
    const auto second = graph.addPass<Image>(
        "second",
        [&](PassBuilder& builder, Image& data) {
            builder.read(first.image);
            data.image = builder.create("b", kColor);
        },
        [&](const Image&, const PassContext&) { backend.calls.push_back("second runs"); });
    draw(graph, "culled", "c");
    graph.output(second.image);
    run(graph, backend);
    EXPECT_THAT(backend.calls, ElementsAre("allocate 2", "begin first after a barrier", "first runs", "end first",
                                           "begin second after a barrier", "second runs", "end second",
                                           "begin end of frame after a barrier", "end end of frame"));
}

TEST(Execution, frameWithoutStoresNeverEndsInABarrier) {
    Recorder backend;
    Graph graph;
    graph.output(draw(graph, "shade", "image"));
    run(graph, backend);
    EXPECT_THAT(backend.calls, ElementsAre("allocate 1", "begin shade", "end shade"));
}

TEST(Execution, handlesResolveToTheirAllocationOrImport) {
    Recorder backend;
    Graph graph;
    const Place windowPlace;
    const Place lightsPlace;
    const TextureHandle window = graph.import("window", kColor, &standIn<gpu::Texture>(windowPlace));
    const BufferHandle lights = graph.import("lights", kBytes, &standIn<gpu::Buffer>(lightsPlace));
    const TextureHandle image = draw(graph, "shade", "image");
    bool ran = false;
    struct Data {
        TextureHandle source;
        TextureHandle target;
    };
    const auto present = graph.addPass<Data>(
        "present",
        [&](PassBuilder& builder, Data& data) {
            data.source = builder.read(image);
            builder.read(lights);
            data.target = builder.write(window);
        },
        [&](const Data& data, const PassContext& context) {
            EXPECT_EQ(&context.texture(data.source), &standIn<gpu::Texture>(backend.places[0]));
            EXPECT_EQ(&context.texture(data.target), &standIn<gpu::Texture>(windowPlace));
            EXPECT_EQ(&context.texture(window), &standIn<gpu::Texture>(windowPlace));
            EXPECT_EQ(&context.buffer(lights), &standIn<gpu::Buffer>(lightsPlace));
            ran = true;
        });
    graph.output(present.target);
    graph.output(image);
    const CompiledGraph compiled = compile(graph);
    Execution execution(graph, compiled, backend);
    execution.run();
    EXPECT_TRUE(ran);
    EXPECT_EQ(&execution.texture(image), &standIn<gpu::Texture>(backend.places[0]));
    EXPECT_EQ(&execution.texture(present.target), &standIn<gpu::Texture>(windowPlace));
    EXPECT_EQ(&execution.buffer(lights), &standIn<gpu::Buffer>(lightsPlace));
}

/// A kept pass with a growable buffer of this declared size, which `body` may query.
struct Grown {
    BufferHandle list;
};
Grown growing(Graph& graph, std::size_t bytes, const std::function<void(const Grown&, const PassContext&)>& body) {
    return graph.addPass<Grown>(
        "count",
        [&](PassBuilder& builder, Grown& data) {
            data.list = builder.create("list", BufferDesc{bytes, true}, Access::Upload);
            builder.keep();
        },
        [body](const Grown& data, const PassContext& context) { body(data, context); });
}

TEST(Execution, aGrowingBufferHasTheSizeOfItsFirstWriter) {
    Recorder backend;
    Graph graph;
    std::vector<std::size_t> held;
    const auto grow = [&](std::size_t bytes) {
        return growing(graph, 0, [&held, bytes](const Grown& data, const PassContext& context) {
            context.allocate(data.list, bytes);
            held.push_back(context.bytes(data.list));
        });
    };
    graph.output(grow(100).list);
    const Grown second = grow(0);
    graph.output(second.list);
    const Grown known = growing(graph, 7, [&](const Grown& data, const PassContext& context) {
        EXPECT_EQ(&context.buffer(data.list), &standIn<gpu::Buffer>(backend.places[6]));
        held.push_back(context.bytes(data.list));
    });
    const CompiledGraph compiled = compile(graph);
    EXPECT_EQ(compiled.resources[known.list.resource].physical, -1) << "its memory is kept by name";
    Execution execution(graph, compiled, backend);
    for (int run = 0; run < 2; ++run) {
        execution.run();
        EXPECT_EQ(execution.bytes(second.list), 0u);
    }
    EXPECT_THAT(held, ElementsAre(100u, 0u, 7u, 100u, 0u, 7u));
    EXPECT_THAT(backend.calls, testing::IsSupersetOf({"room for 100 bytes in list 0", "room for 0 bytes in list 1",
                                                      "room for 7 bytes in list 2"}));
}

TEST(Execution, aBufferThatGrowsIsNotResolvedBeforeItHasRoomNorGivenRoomTwice) {
    Recorder backend;
    const auto errorOf = [&](std::size_t bytes, const std::function<void(const Grown&, const PassContext&)>& body) {
        Graph graph;
        growing(graph, bytes, body);
        return errorOfRun<std::logic_error>(graph, backend);
    };
    EXPECT_EQ(errorOf(0, [](const Grown& data, const PassContext& context) { context.buffer(data.list); }),
              "pass 'count': requested 'list' before any pass set its size in bytes");
    const auto twice = [](const Grown& data, const PassContext& context) {
        context.allocate(data.list, 1);
        context.allocate(data.list, 2);
    };
    EXPECT_EQ(errorOf(0, twice), "pass 'count': makes room in 'list', which has room already");
    EXPECT_THAT(errorOf(8, twice), testing::HasSubstr("makes room in 'list', whose bytes are known"));
}

TEST(Execution, handleThatThePassDidNotDeclareIsNotResolved) {
    Recorder backend;
    Graph graph;
    const TextureHandle secret = draw(graph, "other", "secret");
    graph.output(secret);
    failingPass(graph, [&](const PassContext& context) { context.texture(secret); });
    EXPECT_EQ(
        errorOfRun<std::logic_error>(graph, backend),
        "pass 'broken': requested version 1 of 'secret', which it did not declare; read or write it in its setup");
}

TEST(Execution, versionThatThePassDidNotDeclareIsNotResolved) {
    Recorder backend;
    Graph graph;
    const TextureHandle v1 = draw(graph, "opaque", "image");
    TextureHandle v2;
    keptPass(
        graph, "peek", [&](const PassContext& context) { context.texture(v2); },
        [&](PassBuilder& builder) { builder.read(v1); });
    v2 = blend(graph, "fog", v1);
    EXPECT_EQ(errorOfRun<std::logic_error>(graph, backend),
              "pass 'peek': requested version 2 of 'image', which it did not declare; read or write it in its setup");
}

TEST(Execution, invalidHandleIsNotResolved) {
    Recorder backend;
    Graph graph;
    failingPass(graph, [](const PassContext& context) { context.buffer(BufferHandle{}); });
    EXPECT_EQ(errorOfRun<std::logic_error>(graph, backend), "pass 'broken': requested an invalid buffer handle");
}

TEST(Execution, failureCarriesThePassNameAndKeepsItsKind) {
    Recorder backend;
    Graph input;
    failingPass(input, [](const PassContext&) { throw InputError("wood.png is truncated"); });
    EXPECT_EQ(errorOfRun<InputError>(input, backend), "pass 'broken': wood.png is truncated");
    Graph failure;
    failingPass(failure, [](const PassContext&) { throw std::bad_alloc(); });
    EXPECT_EQ(errorOfRun<std::runtime_error>(failure, backend), "pass 'broken': std::bad_alloc");
    Graph odd;
    failingPass(odd, [](const PassContext&) { throw 7; });
    EXPECT_EQ(errorOfRun<std::runtime_error>(odd, backend), "pass 'broken': an exception of unknown type");
}

TEST(Execution, passThatThrowsIsEndedAndNothingRunsAfterIt) {
    Recorder backend;
    Graph graph;
    failingPass(graph, [](const PassContext&) { throw std::runtime_error("no"); });
    consume(graph, "never", {});
    EXPECT_EQ(errorOfRun<std::runtime_error>(graph, backend), "pass 'broken': no");
    EXPECT_THAT(backend.calls, ElementsAre("allocate 0", "begin broken", "end broken"));
}

/// A frame that stores an image and writes a history, then fails before it samples the image.
Graph failingAfterAStore(TextureHandle& image) {
    Graph graph;
    const TextureHandle history = graph.persist("history", kColor, 7);
    declare(graph, "store", [&](PassBuilder& builder) {
        image = builder.create("image", kColor, Access::ImageWrite);
        graph.output(builder.write(history, Access::ImageWrite));
    });
    failingPass(graph, [](const PassContext&) { throw InputError("no"); });
    consume(graph, "show", {image});
    graph.output(image);
    return graph;
}

TEST(Execution, aFrameThatThrowsIsEndedWithTheBarriersOfThePassesThatDidNotRun) {
    Recorder backend;
    TextureHandle image;
    const Graph graph = failingAfterAStore(image);
    const CompiledGraph compiled = compile(graph);
    ASSERT_EQ(compiled.after & Barrier::TextureFetch, Barrier::None) << "'show' would have issued it";
    Execution execution(graph, compiled, backend);
    EXPECT_THROW(execution.run(), InputError);
    EXPECT_THAT(backend.calls, ElementsAre("persistent history", "allocate 1", "history holds nothing",
                                           "begin store after a barrier", "end store", "begin broken", "end broken",
                                           "begin end of frame after a barrier", "end end of frame"));
    EXPECT_EQ(backend.issued, compiled.after | Barrier::TextureFetch);
    EXPECT_THROW(execution.texture(image), std::logic_error) << "its contents are unknown";
}

TEST(Execution, aFailureAtTheEndOfTheFrameNeverHidesThatOfAPass) {
    Recorder backend;
    backend.failsAtEnd = true;
    TextureHandle image;
    EXPECT_EQ(errorOfRun<std::runtime_error>(failingAfterAStore(image), backend), "pass 'store': GL_INVALID_OPERATION");
    EXPECT_EQ(backend.calls.back(), "end end of frame");
}

TEST(Execution, firstOfTwoFailuresIsTheOneReported) {
    Recorder backend;
    backend.failsAtEnd = true;
    Graph graph;
    failingPass(graph, [](const PassContext&) { throw std::runtime_error("the cause"); });
    EXPECT_EQ(errorOfRun<std::runtime_error>(graph, backend), "pass 'broken': the cause");
    Graph quiet;
    failingPass(quiet, [](const PassContext&) {});
    EXPECT_EQ(errorOfRun<std::runtime_error>(quiet, backend), "pass 'broken': GL_INVALID_OPERATION");
}

TEST(Execution, importThatTheFrameUsesIsNotMissing) {
    Recorder backend;
    const Place place;
    const auto errorOf = [&](const gpu::Texture* history, const gpu::Buffer* lights) {
        Graph graph;
        const TextureHandle shown = graph.import("history", kColor, history);
        graph.import("lights", kBytes, lights);
        consume(graph, "show", {shown});
        const CompiledGraph compiled = compile(graph);
        return tessera::test::errorText<std::logic_error>([&] { Execution(graph, compiled, backend); });
    };
    EXPECT_EQ(errorOf(nullptr, nullptr), "the frame uses the imported texture 'history', but was declared without it");
    EXPECT_EQ(errorOf(&standIn<gpu::Texture>(place), nullptr), "") << "the lights are not used";
}

TEST(Execution, onlyOutputsAreHandedOutAfterTheRun) {
    Recorder backend;
    Graph graph;
    const TextureHandle gbuffer = draw(graph, "gbuffer", "normal");
    const TextureHandle opaque = draw(graph, "shade", "image", {gbuffer});
    const TextureHandle image = blend(graph, "fog", opaque);
    graph.output(image);
    const CompiledGraph compiled = compile(graph);
    Execution execution(graph, compiled, backend);
    const auto errorOf = [&](TextureHandle handle) {
        return tessera::test::errorText<std::logic_error>([&] { execution.texture(handle); });
    };
    EXPECT_EQ(errorOf(image), "an execution got a request for 'image' before run()");
    execution.run();
    EXPECT_EQ(errorOf(image), "");
    for (const auto& [handle, name] : {std::pair(opaque, "image"), {gbuffer, "normal"}})
        EXPECT_EQ(errorOf(handle), std::string("an execution got a request for version 1 of '") + name +
                                       "', which is no output of the frame, so that other data may have replaced it; "
                                       "declare it with Graph::output()");
    EXPECT_EQ(errorOf(TextureHandle{}), "an execution got a request for an invalid texture handle");
}

} // namespace
} // namespace tessera::graph::test
