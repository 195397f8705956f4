#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scenes/Scene.h"
#include "validation/bench/BenchMatrix.h"
#include "validation/bench/BenchResult.h"

namespace tessera::validation {

/// One frame to measure.
struct BenchPoint {
    PointKey key;
    engine::Technique technique = engine::Technique::Forward;
    frame::FrameSettings settings;
};

/// Points of one scene, light count and size: measured in turn, in one run.
struct PlannedGroup {
    std::string scene;               ///< name or path
    std::optional<int> lightsToLoad; ///< requested number; unset: the scene's default
    int lights = 0;                  ///< number after loading
    std::size_t triangles = 0;
    std::uint64_t fingerprint = 0; ///< of the loaded scene (scenes/Fingerprint.h)
    glm::ivec2 sizePixels{0};
    std::vector<BenchPoint> points;
    bool keepsPictures = false;      ///< set for the scene's group with the most work
    frame::FrameSettings settings{}; ///< from the command line, with the group's size; used for the truth
};

struct BenchPlan {
    std::vector<PlannedGroup> groups;
    std::vector<SkippedPoint> skipped;
};

/// Loads the plan's scene with a number of lights, or with its default number.
using SceneLoader = std::function<scenes::Scene(std::optional<int> lights)>;

/// Adds the matrix over one scene to the plan. `settings` and `lights` apply where the matrix has no values.
/// Unsupported combinations are listed as skipped. Points that resolve to the same frame, and groups of the same scene,
/// light count and size, are measured once. Throws InputError as loading and preparing frames do.
void addToPlan(BenchPlan& plan, const BenchMatrix& matrix, const std::string& scene, std::optional<int> lights,
               const frame::FrameSettings& settings, const SceneLoader& load);

} // namespace tessera::validation
