#include <gmock/gmock.h>

#include <array>
#include <functional>

#include "Frames.h"
#include "renderer/graph/Execute.h"
#include "scenes/Error.h"

namespace tessera::graph::test {
namespace {

using testing::ElementsAre;

/// Stands for textures and buffers, of which only the address matters here.
template <typename Resource>
const Resource& standIn(const int& place) {
    return reinterpret_cast<const Resource&>(place);
}

class Recorder : public Backend {
public:
    void allocate(std::span<const ResourceDesc> allocations) override {
        calls.push_back("allocate " + std::to_string(allocations.size()));
    }
    const gpu::Texture& texture(int physical) override { return standIn<gpu::Texture>(places[std::size_t(physical)]); }
    const gpu::Buffer& buffer(int physical) override { return standIn<gpu::Buffer>(places[std::size_t(physical)]); }
    void beginPass(std::string_view name, Barrier barrier) override {
        calls.push_back("begin " + std::string(name) + (barrier == Barrier::None ? "" : " after a barrier"));
    }
    void endPass(std::string_view name) override {
        calls.push_back("end " + std::string(name));
        if (failsAtEnd) throw std::runtime_error("GL_INVALID_OPERATION");
    }

    std::vector<std::string> calls;
    std::array<int, 8> places{};
    bool failsAtEnd = false;
};

struct Image {
    TextureHandle image;
};

void failingPass(Graph& graph, std::function<void(const PassContext&)> body) {
    graph.addPass<None>(
        "broken", [](PassBuilder& builder, None&) { builder.keep(); },
        [body = std::move(body)](const None&, const PassContext& context) { body(context); });
}

template <typename Error>
std::string errorOfRun(const Graph& graph, Recorder& backend) {
    const CompiledGraph compiled = compile(graph);
    try {
        Execution(graph, compiled, backend).run();
    } catch (const Error& error) {
        EXPECT_NE(dynamic_cast<const std::nested_exception*>(&error), nullptr) << "the original is lost";
        return error.what();
    }
    return "no error";
}

TEST(Execution, passesAlwaysRunInOrderBetweenBeginAndEnd) {
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
    const CompiledGraph compiled = compile(graph);
    Execution(graph, compiled, backend).run();
    EXPECT_THAT(backend.calls, ElementsAre("allocate 2", "begin first after a barrier", "first runs", "end first",
                                           "begin second after a barrier", "second runs", "end second",
                                           "begin end of frame after a barrier", "end end of frame"));
}

TEST(Execution, frameWithoutStoresNeverEndsInABarrier) {
    Recorder backend;
    Graph graph;
    graph.output(draw(graph, "shade", "image"));
    const CompiledGraph compiled = compile(graph);
    Execution(graph, compiled, backend).run();
    EXPECT_THAT(backend.calls, ElementsAre("allocate 1", "begin shade", "end shade"));
}

TEST(Execution, handlesAlwaysResolveToTheirAllocationOrImport) {
    Recorder backend;
    Graph graph;
    const TextureHandle window = graph.import("window", kColor);
    const BufferHandle lights = graph.import("lights", kBytes);
    const TextureHandle image = draw(graph, "shade", "image");
    const int windowPlace = 0;
    const int lightsPlace = 0;
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
    const ImportedTexture windowImport{window, &standIn<gpu::Texture>(windowPlace)};
    const ImportedBuffer lightsImport{lights, &standIn<gpu::Buffer>(lightsPlace)};
    Execution execution(graph, compiled, backend, {&windowImport, 1}, {&lightsImport, 1});
    execution.run();
    EXPECT_TRUE(ran);
    EXPECT_EQ(&execution.texture(image), &standIn<gpu::Texture>(backend.places[0]));
    EXPECT_EQ(&execution.texture(present.target), &standIn<gpu::Texture>(windowPlace));
    EXPECT_EQ(&execution.buffer(lights), &standIn<gpu::Buffer>(lightsPlace));
}

TEST(Execution, handleThatThePassDidNotDeclareIsNeverResolved) {
    Recorder backend;
    Graph graph;
    const TextureHandle secret = draw(graph, "other", "secret");
    graph.output(secret);
    failingPass(graph, [&](const PassContext& context) { context.texture(secret); });
    EXPECT_EQ(
        errorOfRun<std::logic_error>(graph, backend),
        "pass 'broken': asked for version 1 of 'secret', which it did not declare; read or write it in its setup");
}

TEST(Execution, versionThatThePassDidNotDeclareIsNeverResolved) {
    Recorder backend;
    Graph graph;
    const TextureHandle v1 = draw(graph, "opaque", "image");
    TextureHandle v2;
    graph.addPass<None>(
        "peek",
        [&](PassBuilder& builder, None&) {
            builder.read(v1);
            builder.keep();
        },
        [&](const None&, const PassContext& context) { context.texture(v2); });
    v2 = blend(graph, "fog", v1);
    EXPECT_EQ(errorOfRun<std::logic_error>(graph, backend),
              "pass 'peek': asked for version 2 of 'image', which it did not declare; read or write it in its setup");
}

TEST(Execution, invalidHandleIsNeverResolved) {
    Recorder backend;
    Graph graph;
    failingPass(graph, [](const PassContext& context) { context.buffer(BufferHandle{}); });
    EXPECT_EQ(errorOfRun<std::logic_error>(graph, backend), "pass 'broken': asked for an invalid buffer handle");
}

TEST(Execution, failureAlwaysCarriesThePassNameAndKeepsItsKind) {
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

TEST(Execution, passThatThrowsIsAlwaysEndedAndNothingRunsAfterIt) {
    Recorder backend;
    Graph graph;
    failingPass(graph, [](const PassContext&) { throw std::runtime_error("no"); });
    consume(graph, "never", {});
    EXPECT_EQ(errorOfRun<std::runtime_error>(graph, backend), "pass 'broken': no");
    EXPECT_THAT(backend.calls, ElementsAre("allocate 0", "begin broken", "end broken"));
}

TEST(Execution, firstOfTwoFailuresIsAlwaysTheOneReported) {
    Recorder backend;
    backend.failsAtEnd = true;
    Graph graph;
    failingPass(graph, [](const PassContext&) { throw std::runtime_error("the cause"); });
    EXPECT_EQ(errorOfRun<std::runtime_error>(graph, backend), "pass 'broken': the cause");
    Graph quiet;
    failingPass(quiet, [](const PassContext&) {});
    EXPECT_EQ(errorOfRun<std::runtime_error>(quiet, backend), "pass 'broken': GL_INVALID_OPERATION");
}

TEST(Execution, importThatTheFrameUsesIsNeverMissing) {
    Recorder backend;
    Graph graph;
    const TextureHandle history = graph.import("history", kColor);
    const BufferHandle lights = graph.import("lights", kBytes);
    graph.import("unused", kColor);
    consume(graph, "show", {history});
    const CompiledGraph compiled = compile(graph);
    const auto errorOf = [&](std::span<const ImportedTexture> textures, std::span<const ImportedBuffer> buffers) {
        try {
            Execution(graph, compiled, backend, textures, buffers);
        } catch (const std::logic_error& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    const int place = 0;
    const ImportedTexture given{history, &standIn<gpu::Texture>(place)};
    const ImportedTexture null{history, nullptr};
    const ImportedBuffer unused{lights, &standIn<gpu::Buffer>(place)};
    const ImportedBuffer unknown{BufferHandle{}, &standIn<gpu::Buffer>(place)};
    const std::string missing = "the frame uses the imported texture 'history', but the execution was given none";
    EXPECT_EQ(errorOf({}, {}), missing);
    EXPECT_EQ(errorOf({&null, 1}, {}), missing);
    EXPECT_EQ(errorOf({&given, 1}, {&unused, 1}), "no error");
    EXPECT_EQ(errorOf({&given, 1}, {&unknown, 1}),
              "an execution was given a buffer for a handle that import() did not return");
}

TEST(Execution, onlyOutputsAreEverHandedOutAfterTheRun) {
    Recorder backend;
    Graph graph;
    const TextureHandle gbuffer = draw(graph, "gbuffer", "normal");
    const TextureHandle opaque = draw(graph, "shade", "image", {gbuffer});
    const TextureHandle image = blend(graph, "fog", opaque);
    graph.output(image);
    const CompiledGraph compiled = compile(graph);
    Execution execution(graph, compiled, backend);
    const auto errorOf = [&](TextureHandle handle) {
        try {
            execution.texture(handle);
        } catch (const std::logic_error& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    EXPECT_EQ(errorOf(image), "an execution was asked for 'image' before run()");
    execution.run();
    EXPECT_EQ(errorOf(image), "no error");
    EXPECT_EQ(errorOf(opaque), "an execution was asked for version 1 of 'image', which is no output of the frame, so "
                               "that other data may have replaced it; declare it with Graph::output()");
    EXPECT_EQ(errorOf(gbuffer), "an execution was asked for version 1 of 'normal', which is no output of the frame, so "
                                "that other data may have replaced it; declare it with Graph::output()");
    EXPECT_EQ(errorOf(TextureHandle{}), "an execution was asked for an invalid texture handle");
}

} // namespace
} // namespace tessera::graph::test
