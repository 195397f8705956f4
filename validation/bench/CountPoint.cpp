#include "validation/bench/CountPoint.h"

#include <algorithm>
#include <numeric>

#include "engine/PrepareView.h"
#include "renderer/gpu/SampleCounter.h"
#include "validation/culling/LightOracle.h"
#include "validation/lower_bound/LowerBoundGeometry.h"

namespace tessera::validation {

namespace {

using engine::Technique;

/// Fragments that pass the depth test in the order in which forward shades them.
std::uint64_t forwardFragments(engine::Renderer& renderer, const frame::FrameSettings& settings) {
    LowerBoundGeometry geometry(renderer, settings);
    gpu::SampleCounter counter;
    counter.begin();
    geometry.draw(glm::dvec3(0.0));
    counter.end();
    return counter.samples();
}

/// The number of lights that each covered pixel visits, from the debug view `lights`, ascending.
std::vector<std::uint64_t> visitedByPixel(engine::Renderer& renderer, const BenchPoint& point) {
    frame::FrameSettings settings = point.settings;
    settings.view = frame::DebugView::Lights;
    const engine::RenderedFrame counts = renderer.render(point.technique, settings);
    std::vector<std::uint64_t> visited;
    for (std::size_t i = 0; i < counts.radiance.size(); i += 4) {
        if (counts.radiance[i + 3] > 0.0f) visited.push_back(std::uint64_t(counts.radiance[i]));
    }
    std::sort(visited.begin(), visited.end());
    return visited;
}

/// Clears the counts of the oracle, which covers only the depth buffer. Transparent surfaces are lit too, so with them
/// the counts, and the lower bound from them, would be too small.
void forgetCounts(BenchResult& result) {
    BenchCounters& counters = result.counters;
    counters.lightEvaluations = counters.neededEvaluations = counters.neededLitEvaluations = {};
    counters.evaluatedP99 = counters.evaluatedMax = counters.fragments = {};
    counters.evaluatedMean = counters.tightness = {};
    for (const char* figure : {"lightEvaluations", "neededEvaluations", "neededLitEvaluations", "evaluatedMean",
                               "evaluatedP99", "evaluatedMax", "fragments", "tightness"})
        result.why[figure] = "transparent surfaces are lit too, and not counted";
}

} // namespace

void countPoint(engine::Renderer& renderer, const BenchPoint& point, BenchResult& result) {
    LightOracleFigures oracle = judgeLights(renderer, point.technique, point.settings);
    const frame::PreparedView prepared = engine::prepareView(renderer.scene(), point.technique, point.settings);
    const graph::Plan plan = engine::planFrame(renderer.scene(), point.technique, point.settings);
    if (prepared.spec.culling.method != culling::Method::None) {
        result.builder = infoOf(prepared.spec.culling.builder).name;
        result.normalTest = infoOf(prepared.spec.culling.normals).name;
    }

    BenchCounters& counters = result.counters;
    counters.fragments = oracle.covered;
    counters.lightEvaluations = oracle.evaluated + oracle.everywhere;
    if (infoOf(point.technique).geometry == engine::Geometry::Shaded) {
        // Forward also lights fragments that a nearer surface covers later.
        counters.fragments = forwardFragments(renderer, point.settings);
        counters.lightEvaluations = *counters.fragments * prepared.lights.texels.size();
    }
    if (infoOf(point.technique).addsByBlending) {
        // Pixels visit the lights whose volumes cover them, so only the rasteriser can count them.
        const std::vector<std::uint64_t> visited = visitedByPixel(renderer, point);
        counters.lightEvaluations = std::accumulate(visited.begin(), visited.end(), std::uint64_t(0));
        oracle.evaluated = *counters.lightEvaluations - std::min(*counters.lightEvaluations, oracle.everywhere);
        oracle.evaluatedP99 = visited.empty() ? 0 : visited[(visited.size() * 99 + 99) / 100 - 1];
        oracle.evaluatedMax = visited.empty() ? 0 : visited.back();
    }
    counters.neededEvaluations = oracle.needed + oracle.everywhere;
    counters.neededLitEvaluations = oracle.neededLit + oracle.everywhereLit;
    counters.tightness = oracle.tightness();
    if (!counters.tightness) result.why["tightness"] = "no light that ends somewhere reaches a visible surface";
    counters.evaluatedMean = oracle.perPixel(oracle.evaluated + oracle.everywhere);
    counters.evaluatedP99 = oracle.evaluatedP99;
    counters.evaluatedMax = oracle.evaluatedMax;
    counters.listEntries = oracle.entries;
    counters.listBytes = oracle.listBytes;
    counters.falseNegatives = oracle.falseNegatives;
    if (prepared.spec.features[frame::Feature::Blend]) forgetCounts(result);
    for (const auto& [name, value] : plan.counters) {
        if (name == "triangles") counters.triangles = value;
        if (name == "draws") counters.draws = value;
        if (name == "gbufferBytesPerPixel" && infoOf(point.technique).usesGBuffer())
            counters.gbufferBytes = value * oracle.covered;
    }
}

} // namespace tessera::validation
