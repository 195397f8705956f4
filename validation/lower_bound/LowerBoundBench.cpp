#include "validation/lower_bound/LowerBoundBench.h"

#include <algorithm>
#include <cassert>

#include "engine/PrepareView.h"
#include "validation/lower_bound/LowerBoundLights.h"
#include "validation/timing/TimeSamples.h"

namespace tessera::validation {

std::optional<LowerBoundFigures::Store> LowerBoundFigures::fastestStore() const {
    const auto fastest = std::min_element(stores.begin(), stores.end(),
                                          [](const Store& a, const Store& b) { return a.nsPerPair < b.nsPerPair; });
    return fastest == stores.end() ? std::nullopt : std::optional(*fastest);
}

std::optional<double> LowerBoundFigures::lowerBoundMs(double evaluations) const {
    if (evaluations == 0.0) return geometryMs;
    const std::optional<Store> store = fastestStore();
    if (!store) return {};
    return geometryMs + evaluations * store->nsPerPair * 1e-6;
}

LowerBoundBench::LowerBoundBench(engine::Renderer& renderer, const frame::FrameSettings& settings)
    : sizePixels_(settings.sizePixels), stores_(lightStores(gpu::Context::current()->capabilities())),
      geometry_(renderer, settings) {
    frame::FrameSettings lit = settings;
    lit.culling = {};
    lit.view = frame::DebugView::Final;
    const frame::PreparedView frame = engine::prepareView(renderer.scene(), engine::Technique::Forward, lit);
    if (!frame.spec.features.litModels() || frame.lights.texels.empty()) return;
    lighting_.emplace(renderer.programs(), frame.spec);
    few_ = lowerBoundLights(frame.lights, kFewLights);
    many_ = lowerBoundLights(frame.lights, kManyLights);
}

std::size_t LowerBoundBench::kindsOf(std::span<const LightStoreInfo> stores) {
    return 1 + 2 * stores.size();
}

std::vector<TimedFrame> LowerBoundBench::frames() {
    std::vector<TimedFrame> frames{[this](const glm::dvec3& eyeOffsetWS) { geometry_.draw(eyeOffsetWS); }};
    if (!lighting_) return frames;
    for (const LightStoreInfo& store : stores_) {
        for (const frame::PackedLights* lights : {&few_, &many_}) {
            frames.emplace_back([this, &store, lights](const glm::dvec3&) {
                lighting_->setLights(*lights);
                lighting_->draw(store);
            });
        }
    }
    return frames;
}

LowerBoundFigures LowerBoundBench::figures(std::span<const std::vector<double>> timesMs) const {
    LowerBoundFigures figures;
    const TimeSpread geometry = spreadOf(timesMs[0]);
    figures.geometryMs = geometry.median;
    figures.geometryMsP95 = geometry.p95;
    figures.rounds = int(timesMs[0].size());
    if (!lighting_) {
        figures.whyNoStores = "the scene has no lit surface, or no light in view";
        return figures;
    }
    assert(timesMs.size() == kindsOf(stores_));
    const double pairs = double(sizePixels_.x) * double(sizePixels_.y) * double(kManyLights - kFewLights);
    for (std::size_t i = 0; i < stores_.size(); ++i) {
        const TimeSpread msPerPair = slopeSpread(timesMs[1 + 2 * i], timesMs[2 + 2 * i], pairs);
        // If the machine's noise is larger than the cost of the lights, the slope is meaningless.
        if (msPerPair.median > 0.0)
            figures.stores.push_back({stores_[i].name, msPerPair.median * 1e6, msPerPair.p95 * 1e6});
    }
    if (figures.stores.empty())
        figures.whyNoStores =
            "96 lights a pixel took no longer than 32: the picture is too small or the machine too busy";
    return figures;
}

LowerBoundFigures LowerBoundBench::figuresOf(std::vector<std::vector<double>> timesMs) {
    InterleaveOptions more;
    more.warmUpRounds = 1; // rounds kept from an earlier run have drawn nothing in this one
    more.rounds = kLeastRounds - int(timesMs[0].size());
    if (more.rounds > 0) {
        const std::vector<std::vector<double>> others = timeInterleaved(frames(), more);
        for (std::size_t kind = 0; kind < timesMs.size(); ++kind)
            timesMs[kind].insert(timesMs[kind].end(), others[kind].begin(), others[kind].end());
    }
    return figures(timesMs);
}

LowerBoundFigures LowerBoundBench::measure(const InterleaveOptions& options) {
    return figures(timeInterleaved(frames(), options));
}

} // namespace tessera::validation
