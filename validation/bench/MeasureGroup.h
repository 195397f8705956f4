#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "base/Picture.h"
#include "renderer/gpu/Context.h"
#include "validation/bench/BenchPlan.h"
#include "validation/bench/GroupTruth.h"

namespace tessera::validation {

/// The progress of a group. It outlives the program: rounds of timed frames, then points one by one. A round is the
/// smallest unit of measurement, since all points take a turn in it.
struct GroupState {
    std::vector<std::vector<double>> roundsMs; ///< by round and kind of frame: the points', then the lower bound's
    BenchGroup group;                          ///< with the results of the finished points, in order
    bool isDone = false;
};

struct BenchOptions {
    int frames = 20;                                   ///< timed frames per point
    std::optional<BenchTruth> against;                 ///< unset: chooseTruth() decides
    std::optional<frame::TextureFilter> errorFilter{}; ///< of the frames whose error is measured; unset: exact
    std::function<void(std::size_t steps)> progress = [](std::size_t) {};
    std::function<void(const GroupState&)> keep = [](const GroupState&) {}; ///< after each finished round or point
    /// Writes an image and returns its file name.
    std::function<std::string(const std::string& name, const DisplayImage&)> keepPicture;
};

/// Number of steps that `progress` will report for a group, from its current state.
std::size_t stepsOf(const gpu::Capabilities& gl, const PlannedGroup& group, const GroupState& state,
                    const BenchOptions& options);

/// Measures the missing parts of a group. `scene` is loaded with the group's number of lights. Throws what drawing
/// throws, and InputError if the reference does not support the settings.
void measureGroup(gpu::Context& context, const scenes::Scene& scene, const PlannedGroup& group,
                  const BenchOptions& options, GroupState& state);

} // namespace tessera::validation
