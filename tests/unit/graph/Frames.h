#pragma once
#include <functional>
#include <string>
#include <vector>

#include "renderer/graph/Compile.h"
#include "renderer/graph/Graph.h"

/// Helpers that declare frames in tests.
namespace tessera::graph::test {

inline constexpr TextureDesc kColor{.format = Format::Rgba16Float, .width = 64, .height = 32};
inline constexpr TextureDesc kDepth{.format = Format::Depth32Float, .width = 64, .height = 32};
inline constexpr BufferDesc kBytes{.bytes = 256};

struct None {};

/// Adds a pass with an empty body.
inline void declare(Graph& graph, const std::string& name, const std::function<void(PassBuilder&)>& setup) {
    graph.addPass<None>(
        name, [&](PassBuilder& builder, None&) { setup(builder); }, [](const None&, const PassContext&) {});
}

/// Adds a pass that creates a texture from its inputs.
inline TextureHandle draw(Graph& graph, const std::string& name, const std::string& output,
                          const std::vector<TextureHandle>& inputs = {}, const TextureDesc& desc = kColor) {
    TextureHandle handle;
    declare(graph, name, [&](PassBuilder& builder) {
        for (const TextureHandle input : inputs) builder.read(input);
        handle = builder.create(output, desc,
                                formatInfo(desc.format).depth ? Access::DepthAttachment : Access::ColorAttachment);
    });
    return handle;
}

/// Adds a pass that blends into a texture.
inline TextureHandle blend(Graph& graph, const std::string& name, TextureHandle target,
                           const std::vector<TextureHandle>& inputs = {}) {
    TextureHandle handle;
    declare(graph, name, [&](PassBuilder& builder) {
        for (const TextureHandle input : inputs) builder.read(input);
        handle = builder.write(target);
    });
    return handle;
}

/// Adds a pass that only reads and is kept.
inline void consume(Graph& graph, const std::string& name, const std::vector<TextureHandle>& inputs) {
    declare(graph, name, [&](PassBuilder& builder) {
        for (const TextureHandle input : inputs) builder.read(input);
        builder.keep();
    });
}

inline std::vector<std::string> orderOf(const Graph& graph, const CompiledGraph& compiled) {
    std::vector<std::string> names;
    for (const CompiledPass& pass : compiled.order) names.push_back(graph.passes()[pass.pass].name);
    return names;
}

inline std::vector<std::string> faultsOf(const Graph& graph) {
    try {
        compile(graph);
    } catch (const GraphError& error) {
        return error.faults();
    }
    return {};
}

/// Returns the faults of a frame with a single pass, "p".
inline std::vector<std::string> faultsOfPass(const std::function<void(PassBuilder&)>& setup) {
    Graph graph;
    declare(graph, "p", setup);
    return faultsOf(graph);
}

} // namespace tessera::graph::test
