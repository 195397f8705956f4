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

/// How far a group is. What is kept of it survives the end of the program: rounds of timed frames, then points one by
/// one. A round is the least that can be measured, since all points take a turn in it.
struct GroupState {
    std::vector<std::vector<double>> roundsMs; ///< by round and kind of frame: the points', then the lower bound's
    BenchGroup group;                          ///< with the results of the finished points, in order
    bool isDone = false;
};

struct BenchOptions {
    int frames = 20;                                   ///< of each point
    std::optional<BenchTruth> against;                 ///< none: the reference where it is affordable
    std::optional<frame::TextureFilter> errorFilter{}; ///< of the frames whose error is measured; none: exact
    std::function<void(std::size_t steps)> progress = [](std::size_t) {};
    std::function<void(const GroupState&)> keep = [](const GroupState&) {}; ///< called whenever something is finished
    /// Where a picture goes: writes it and returns its file's name.
    std::function<std::string(const std::string& name, const DisplayImage&)> keepPicture;
};

/// Steps that `progress` will count for a group from the state it is in.
std::size_t stepsOf(const gpu::Capabilities& gl, const PlannedGroup& group, const GroupState& state,
                    const BenchOptions& options);

/// Measures what is missing of a group. The scene is loaded already, with the group's number of lights. Throws what
/// drawing throws, and InputError where the reference does not take the settings.
void measureGroup(gpu::Context& context, const scenes::Scene& scene, const PlannedGroup& group,
                  const BenchOptions& options, GroupState& state);

} // namespace tessera::validation
