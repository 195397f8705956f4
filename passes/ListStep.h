#pragma once
#include <string>
#include <vector>

#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// One step of building light lists on the GPU: the compute shader shaders/passes/light_<name>, spread over a grid of
/// items (shaders/lib/lists/list_items.glsl).
class ListStep {
public:
    /// What works on an item: a whole workgroup, as many lanes as FrameSpec::culling says, or one.
    enum class Lanes { Group, AsChosen, One };
    ListStep(const frame::FrameSpec& spec, std::string name, Lanes lanes);

    /// Lights are items in rows of this many.
    static constexpr std::uint32_t kLightsARow = 1024;

    const shader::ProgramDesc& program() const { return program_; }

    /// Lists of many lights take several rounds over them, each a pass of its own: x the first light of a round, y one
    /// beyond its last, as the uniform block ListRound holds them. At least one round, though there be no lights.
    static std::vector<glm::uvec4> rounds(const frame::FrameSpec& spec);

    /// Runs the pass's program of a number, which is this step's, for items (0, 0) .. (columns - 1, rows - 1). What it
    /// reads and writes must be bound.
    void run(const graph::PassContext& context, glm::uvec2 items, std::size_t program = 0) const;

private:
    shader::ProgramDesc program_;
    std::uint32_t itemsAGroup_ = 1; ///< of a workgroup, along x
};

} // namespace tessera::passes
