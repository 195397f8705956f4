#include "renderer/shader/ProgramDesc.h"

#include <utility>

#include <fmt/format.h>

#include "base/Error.h"

namespace tessera::shader {

ProgramDesc screenProgram(std::string name, std::string fragment, Defines defines) {
    ProgramDesc program;
    program.name = std::move(name);
    program.vertex = "passes/fullscreen.vert";
    program.fragment = std::move(fragment);
    program.defines = std::move(defines);
    return program;
}

std::vector<ExpandedStage> expandStages(const SourceTree& tree, const ProgramDesc& desc) {
    const bool rasterises = !desc.vertex.empty();
    const bool computes = !desc.compute.empty();
    if (rasterises == computes || (computes && !(desc.fragment.empty() && desc.geometry.empty())))
        throw InputError(fmt::format("shader program '{}' needs either a vertex shader, with or without others "
                                     "after it, or a compute shader alone",
                                     desc.name));
    std::vector<ExpandedStage> stages;
    const auto add = [&](gpu::Stage stage, const std::string& path) {
        if (!path.empty()) stages.push_back({stage, expand(tree, path, desc.defines)});
    };
    add(gpu::Stage::Vertex, desc.vertex);
    add(gpu::Stage::Geometry, desc.geometry);
    add(gpu::Stage::Fragment, desc.fragment);
    add(gpu::Stage::Compute, desc.compute);
    return stages;
}

} // namespace tessera::shader
