#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passes/recipes/Techniques.h"
#include "renderer/frame/FrameSettings.h"

namespace tessera::validation {

/// What `tessera bench` runs through: the Cartesian product of these lists. An empty list stands for one entry, what
/// the settings of the command line say.
struct BenchMatrix {
    std::vector<recipes::Technique> techniques;
    std::vector<culling::Method> methods; ///< empty: every method that the technique takes
    std::vector<int> tilesPixels;
    std::vector<frame::LayoutInfo> layouts;
    std::vector<int> lights;
    std::vector<glm::ivec2> sizesPixels;
};

/// Reads the matrix of a JSON object of arrays with the keys technique, culling, tile, layout, lights and size.
/// `source` names it in messages. Throws InputError that names the key or value and the nearest valid ones.
BenchMatrix parseMatrix(std::string_view json, const std::string& source);

/// One frame to measure. Frames of one scene, light count and size are measured in turn, in one run.
struct BenchPoint {
    std::string scene; ///< name or path
    std::optional<int> lights;
    recipes::Technique technique = recipes::Technique::Forward;
    frame::FrameSettings settings;
};

struct SkippedPoint {
    std::string what;
    std::string why;
};

struct BenchPlan {
    std::vector<BenchPoint> points; ///< those measured in turn follow one another
    std::vector<SkippedPoint> skipped;
};

/// The matrix over one scene. `settings` and `lights` hold where the matrix says nothing.
BenchPlan planBench(const BenchMatrix& matrix, const std::string& scene, std::optional<int> lights,
                    const frame::FrameSettings& settings);

/// "clustered_deferred, cluster, 16".
std::string pointName(const BenchPoint& point);

} // namespace tessera::validation
