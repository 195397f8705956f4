#include "validation/FloorBench.h"

#include <algorithm>
#include <cassert>

#include "passes/recipes/PreparedFrame.h"
#include "validation/FloorLights.h"
#include "validation/TimeSamples.h"

namespace tessera::validation {

std::optional<FloorFigures::Store> FloorFigures::fastestStore() const {
    const auto fastest = std::min_element(stores.begin(), stores.end(),
                                          [](const Store& a, const Store& b) { return a.nsPerPair < b.nsPerPair; });
    return fastest == stores.end() ? std::nullopt : std::optional(*fastest);
}

std::optional<double> FloorFigures::floorMs(double neededEvaluations) const {
    if (neededEvaluations == 0.0) return geometryMs;
    const std::optional<Store> store = fastestStore();
    if (!store) return {};
    return geometryMs + neededEvaluations * store->nsPerPair * 1e-6;
}

FloorBench::FloorBench(recipes::Renderer& renderer, const frame::FrameSettings& settings)
    : sizePixels_(settings.sizePixels), geometry_(renderer, settings) {
    frame::FrameSettings lit = settings;
    lit.culling = {};
    lit.view = frame::View::Final;
    const recipes::PreparedFrame frame = recipes::prepareFrame(renderer.scene(), recipes::Technique::Forward, lit);
    if (!frame.spec.features.litModels() || frame.lights.texels.empty()) return;
    lighting_.emplace(renderer.programs(), frame.spec);
    few_ = floorLights(frame.lights, kFewLights);
    many_ = floorLights(frame.lights, kManyLights);
}

std::vector<TimedFrame> FloorBench::frames() {
    std::vector<TimedFrame> frames{[this](const glm::dvec3& eyeOffsetWS) { geometry_.draw(eyeOffsetWS); }};
    if (!lighting_) return frames;
    for (const LightStoreInfo& store : lightStoreTable()) {
        for (const frame::PackedLights* lights : {&few_, &many_}) {
            frames.emplace_back([this, &store, lights](const glm::dvec3&) {
                lighting_->setLights(*lights);
                lighting_->draw(store);
            });
        }
    }
    return frames;
}

FloorFigures FloorBench::figures(std::span<const std::vector<double>> timesMs) const {
    FloorFigures figures;
    figures.geometryMs = spreadOf(timesMs[0]).median;
    if (!lighting_) {
        figures.whyNoStores = "the scene has no lit surface, or no light in view";
        return figures;
    }
    assert(timesMs.size() == 1 + 2 * lightStoreTable().size());
    const double pairs = double(sizePixels_.x) * double(sizePixels_.y) * double(kManyLights - kFewLights);
    for (std::size_t i = 0; i < lightStoreTable().size(); ++i) {
        const double msPerPair = medianSlope(timesMs[1 + 2 * i], timesMs[2 + 2 * i], pairs);
        // Where the machine's unrest is larger than what the lights cost, the slope says nothing.
        if (msPerPair > 0.0) figures.stores.push_back({lightStoreTable()[i].name, msPerPair * 1e6});
    }
    if (figures.stores.empty())
        figures.whyNoStores =
            "96 lights a pixel took no longer than 32: the picture is too small or the machine too busy";
    return figures;
}

FloorFigures FloorBench::measure(const InterleaveOptions& options) {
    return figures(timeInterleaved(frames(), options));
}

} // namespace tessera::validation
