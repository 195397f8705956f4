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
    std::optional<int> lightsToLoad; ///< the scene's number of lights
    int lights = 0;                  ///< that it then has
    std::size_t triangles = 0;
    std::uint64_t fingerprint = 0; ///< of the scene so loaded (scenes/Fingerprint.h)
    glm::ivec2 sizePixels{0};
    std::vector<BenchPoint> points;
    bool keepsPictures = false;      ///< the group with most work of its scene
    frame::FrameSettings settings{}; ///< of the command line, with the group's size: what the truth shows
};

struct BenchPlan {
    std::vector<PlannedGroup> groups;
    std::vector<SkippedPoint> skipped;
};

/// Loads the plan's scene with so many lights, or as many as it wants.
using SceneLoader = std::function<scenes::Scene(std::optional<int> lights)>;

/// Adds the matrix over one scene to the plan. `settings` and `lights` hold where the matrix says nothing. What makes
/// no sense is listed as skipped; points that are one frame after defaults are resolved, and groups that are one scene,
/// are measured once. Throws InputError as loading and preparing frames do.
void addToPlan(BenchPlan& plan, const BenchMatrix& matrix, const std::string& scene, std::optional<int> lights,
               const frame::FrameSettings& settings, const SceneLoader& load);

} // namespace tessera::validation
