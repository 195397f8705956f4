#pragma once
#include <string>

#include "renderer/frame/FrameResources.h"
#include "renderer/frame/FrameSpec.h"

namespace tessera::passes {

/// One step of building light lists on the GPU: shaders/passes/light_<name>, spread over a grid of items by compute or
/// by fragment shaders, as FrameSpec::culling says (shaders/lib/list_items.glsl).
class ListStep {
public:
    /// What works on an item: as many lanes as FrameSpec::culling says, or one.
    enum class Lanes { Many, One };
    ListStep(const frame::FrameSpec& spec, std::string name, Lanes lanes);

    /// Lights are items in rows of this many.
    static constexpr std::uint32_t kLightsARow = 1024;

    const shader::ProgramDesc& program() const { return program_; }

    /// Runs the step for items (0, 0) .. (columns - 1, rows - 1). What it reads and writes must be bound.
    void run(const frame::FrameResources& resources, glm::uvec2 items) const;

private:
    shader::ProgramDesc program_;
    std::uint32_t itemsAGroup_ = 1; ///< of a compute workgroup, along x; 0: fragments
};

} // namespace tessera::passes
