#pragma once
#include <string>
#include <vector>

#include "apps/BenchJob.h"
#include "apps/Comparison.h"
#include "apps/Planning.h"
#include "base/Picture.h"
#include "python/SceneObject.h"
#include "python/Worker.h"

/// The module's functions, run on the worker's thread: the work of the commands of the same names, without their
/// printed tables. They throw the commands' exceptions, and Stopped.
namespace tessera::python {

/// A rendered image with the names of its scene, technique and view.
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

/// Parameters of a benchmark.
struct BenchRequest {
    app::BenchJobOptions options;
    std::string matrix; ///< JSON; empty: none
    std::string folder; ///< must exist
    bool resumes = false;
    std::string command; ///< its name in the record
};
/// The JSON that `tessera bench` writes into bench.json.
std::string benchJson(const BenchRequest& request, Job& job);

SceneFacts load(SceneObject& scene, Job& job);

} // namespace tessera::python
