#pragma once
#include <string>
#include <vector>

#include "renderer/frame/FrameHandles.h"

namespace tessera::passes {

/// One step of building light lists on the GPU: the compute shader shaders/passes/light_<name>.glsl, dispatched over a
/// grid of items (shaders/lib/lists/list_items.glsl).
class ListStep {
public:
    /// Invocations per item: a whole workgroup, as many lanes as FrameSpec::culling chose, or one.
    enum class Lanes { Group, AsChosen, One };
    ListStep(const frame::FrameSpec& spec, std::string name, Lanes lanes);

    /// Lights per row, where lights are the items.
    static constexpr std::uint32_t kLightsARow = 1024;

    const shader::ProgramDesc& program() const { return program_; }

    /// Splits many lights into rounds, each in separate passes: x first light, y one past the last, in the layout of
    /// the uniform block ListRound. At least one round, even without lights.
    static std::vector<glm::uvec4> rounds(const frame::FrameSpec& spec);

    /// Dispatches this step for `items` columns and rows; `program` is its index in the pass. Resources of the step
    /// must be bound.
    void run(const graph::PassContext& context, glm::uvec2 items, std::size_t program = 0) const;

private:
    shader::ProgramDesc program_;
    std::uint32_t itemsAGroup_ = 1; ///< items of a workgroup, along x
};

} // namespace tessera::passes
