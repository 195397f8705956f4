#pragma once
#include <compare>
#include <string>
#include <vector>

#include "renderer/gpu/Program.h"
#include "renderer/shader/Preprocess.h"

namespace tessera::shader {

/// One variant of a program: its entry files below shaders/ (unused stages empty) and its defines.
struct ProgramDesc {
    std::string name; ///< for messages and labels
    std::string vertex;
    std::string fragment;
    std::string compute;
    Defines defines;
    std::string geometry = {}; ///< between vertex and fragment
    auto operator<=>(const ProgramDesc&) const = default;

    /// Equal for equal variants, whatever the order of the defines: "lighting|v|f|||A=1;B=2".
    std::string key() const;
};

struct ExpandedStage {
    gpu::Stage stage;
    ExpandedSource source;
};

/// The stages of a variant as the driver gets them; needs no GL, so sources can be checked offline. Throws InputError
/// as expand() does, and when the description has neither a vertex nor a compute stage, or mixes compute with others.
std::vector<ExpandedStage> expandStages(const SourceTree& tree, const ProgramDesc& desc);
std::vector<gpu::StageSource> programSources(const SourceTree& tree, const ProgramDesc& desc);

} // namespace tessera::shader
