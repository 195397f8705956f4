#pragma once
#include <string>

#include "renderer/frame/FrameResources.h"
#include "renderer/frame/FrameSpec.h"

namespace tessera::passes {

/// One step of building light lists on the GPU: shaders/passes/light_<name>, spread over a grid of items by compute or
/// by fragment shaders, as FrameSpec::culling says (shaders/lib/list_items.glsl).
class ListStep {
public:
    /// What works on an item in compute shaders: a whole workgroup, as many lanes as FrameSpec::culling says, or one.
    enum class Lanes { Group, AsChosen, One };
    ListStep(const frame::FrameSpec& spec, std::string name, Lanes lanes);

    /// Lights are items in rows of this many.
    static constexpr std::uint32_t kLightsARow = 1024;

    const shader::ProgramDesc& program() const { return program_; }

    /// Whether lists of the frame take several rounds over its lights, and how many lights one of them takes.
    static bool inRounds(const frame::FrameSpec& spec) { return spec.lights > lightsARound(spec); }
    static std::size_t lightsARound(const frame::FrameSpec& spec);

    /// Runs the step for items (0, 0) .. (columns - 1, rows - 1). What it reads and writes must be bound.
    void run(const frame::FrameResources& resources, glm::uvec2 items) const;
    /// The same in rounds over the frame's lights.
    void runRounds(const frame::FrameSpec& spec, const frame::FrameResources& resources, glm::uvec2 items) const;

private:
    shader::ProgramDesc program_;
    std::uint32_t itemsAGroup_ = 1; ///< of a compute workgroup, along x; 0: fragments
};

} // namespace tessera::passes
