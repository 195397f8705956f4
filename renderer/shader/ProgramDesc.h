#pragma once
#include <string>
#include <vector>

#include "renderer/gpu/Program.h"
#include "renderer/graph/ProgramDesc.h"
#include "renderer/shader/Preprocess.h"

namespace tessera::shader {

using graph::Defines;
using graph::ProgramDesc;

/// A program that runs a fragment shader for every pixel of its targets: gpu::drawFullscreenTriangle().
ProgramDesc screenProgram(std::string name, std::string fragment, Defines defines = {});

struct ExpandedStage {
    gpu::Stage stage;
    ExpandedSource source;
};

/// Expands the stages of a variant. Needs no GL context, so sources can be checked offline. Throws InputError as
/// expand(), and if the description has neither a vertex nor a compute stage, or mixes compute with others.
std::vector<ExpandedStage> expandStages(const SourceTree& tree, const ProgramDesc& desc);

} // namespace tessera::shader
