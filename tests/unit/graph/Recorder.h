#pragma once
#include <gmock/gmock.h>

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "Frames.h"
#include "renderer/graph/Execute.h"

/// A backend that records its calls.
namespace tessera::graph::test {

/// Storage for a stand-in texture or buffer.
struct alignas(std::max_align_t) Place {};

/// Returns a stand-in for a texture or buffer; only its address matters.
template <typename Resource>
const Resource& standIn(const Place& place) {
    return reinterpret_cast<const Resource&>(place);
}

class Recorder : public Backend {
public:
    void allocate(std::span<const ResourceDesc> allocations) override {
        calls.push_back("allocate " + std::to_string(allocations.size()));
    }
    const gpu::Texture& texture(int physical) override { return standIn<gpu::Texture>(places[std::size_t(physical)]); }
    const gpu::Buffer& buffer(int physical) override { return standIn<gpu::Buffer>(places[std::size_t(physical)]); }
    const gpu::Buffer& growingBuffer(const std::string& name, int number, std::size_t bytes) override {
        calls.push_back("room for " + std::to_string(bytes) + " bytes in " + name + " " + std::to_string(number));
        return standIn<gpu::Buffer>(places[6]);
    }
    const gpu::Texture& persistentTexture(const std::string& name, const TextureDesc&) override {
        calls.push_back("persistent " + name);
        return standIn<gpu::Texture>(places.back());
    }
    const gpu::Buffer& persistentBuffer(const std::string& name, const BufferDesc&) override {
        calls.push_back("persistent " + name);
        return standIn<gpu::Buffer>(places.back());
    }
    void setRevision(const std::string& name, std::optional<std::uint64_t> revision) override {
        calls.push_back(name + " holds " + (revision ? std::to_string(*revision) : "nothing"));
    }
    void bindTargets(std::span<const Target> colors, const Target& depth) override {
        calls.push_back("targets " + std::to_string(colors.size()) + (depth.texture ? " and depth" : ""));
    }
    void bindConstants(std::uint32_t slot, std::span<const std::byte> bytes,
                       std::span<const gpu::Program* const> programs) override {
        calls.push_back("constants " + std::to_string(slot) + ", " + std::to_string(bytes.size()) + " bytes, " +
                        std::to_string(programs.size()) + " programs");
    }
    void beginPass(std::string_view name, Barrier barrier) override {
        calls.push_back("begin " + std::string(name) + (barrier == Barrier::None ? "" : " after a barrier"));
        issued = barrier;
    }
    void endPass(std::string_view name) override {
        calls.push_back("end " + std::string(name));
        if (failsAtEnd) throw std::runtime_error("GL_INVALID_OPERATION");
    }

    std::vector<std::string> calls;
    std::array<Place, 8> places{};
    Barrier issued = Barrier::None; ///< before the latest pass
    bool failsAtEnd = false;
};

/// Adds a kept pass with this body.
inline void keptPass(
    Graph& graph, const std::string& name, std::function<void(const PassContext&)> body,
    const std::function<void(PassBuilder&)>& setup = [](PassBuilder&) {}) {
    graph.addPass<None>(
        name,
        [&](PassBuilder& builder, None&) {
            setup(builder);
            builder.keep();
        },
        [body = std::move(body)](const None&, const PassContext& context) { body(context); });
}
inline void failingPass(Graph& graph, std::function<void(const PassContext&)> body) {
    keptPass(graph, "broken", std::move(body));
}

inline void run(const Graph& graph, Backend& backend, ProgramSource* programs = nullptr) {
    const CompiledGraph compiled = compile(graph);
    Execution(graph, compiled, backend, programs).run();
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

} // namespace tessera::graph::test
