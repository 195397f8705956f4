#pragma once
#include <string>
#include <vector>

#include "apps/BenchJob.h"
#include "apps/Comparison.h"
#include "apps/Planning.h"
#include "base/Picture.h"
#include "python/SceneObject.h"
#include "python/Worker.h"

/// What the module's functions do on the worker's thread: what the commands of their names do, without files and
/// tables. They throw what those throw, and Stopped.
namespace tessera::python {

/// A rendered picture.
struct Rendered {
    Picture picture;    ///< linear
    DisplayImage shown; ///< as a display shows it
    std::string scene, technique, view;
};

Rendered render(SceneObject& scene, app::FrameOptions options, Job& job);

/// The JSON of `tessera compare --json -`.
std::string compareJson(SceneObject& scene, const app::ComparisonOptions& options, Job& job);

/// The JSON of `tessera plan --json -`.
std::string planJson(SceneObject& scene, const app::PlanningOptions& options, Job& job);

/// Where and of what a benchmark is made.
struct BenchWishes {
    app::BenchJobOptions options;
    std::string matrix; ///< JSON; empty: none
    std::string folder; ///< which exists
    bool resumes = false;
    std::string command; ///< as its record names it
};
/// The JSON that `tessera bench` writes into bench.json.
std::string benchJson(const BenchWishes& wishes, Job& job);

SceneFacts load(SceneObject& scene, Job& job);

} // namespace tessera::python
