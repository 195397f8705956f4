#include "validation/bench/GroupTruth.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/Rendering.h"
#include "validation/compare/ShownTriangles.h"
#include "validation/figures/ErrorFigures.h"

namespace tessera::validation {

frame::FrameSettings exactSettings(frame::FrameSettings settings, frame::TextureFilter filter) {
    settings.layout = frame::exactLayout().layout;
    settings.rangeTolerance = 0.0;
    settings.filter = filter;
    settings.culling = {};
    settings.lightOn.reset();
    settings.shadowFilter = frame::ShadowFilter::Traced;
    settings.display = false;
    return settings;
}

BenchTruth chooseTruth(std::optional<BenchTruth> requested, const frame::FrameSettings& settings, double lightsAPixel,
                       std::string& why) {
    why.clear();
    if (requested) {
        if (*requested == BenchTruth::Reference) requireReferenceSupports(settings);
        if (*requested == BenchTruth::Forward) why = "forward was requested";
        return *requested;
    }
    const double pairs = double(settings.sizePixels.x) * double(settings.sizePixels.y) * lightsAPixel;
    if (settings.view != frame::DebugView::Final)
        why = "the reference renders the view final only";
    else if (pairs > kAffordablePairs)
        why = fmt::format("the reference would try {:.1e} pairs of a point and a light, which takes minutes; it "
                          "does so on request",
                          pairs);
    return why.empty() ? BenchTruth::Reference : BenchTruth::Forward;
}

GroupTruth::GroupTruth(engine::Renderer& renderer, BenchTruth truth, const frame::FrameSettings& settings,
                       frame::TextureFilter filter, const std::function<void()>& rowDone)
    : renderer_(renderer), filter_(filter), settings_(exactSettings(settings, filter)) {
    settings_.shadowSamples = std::max(settings_.shadowSamples, kTruthShadowSamples);
    if (truth == BenchTruth::Forward) {
        picture_ = toPicture(renderer.render(engine::Technique::Forward, settings_));
        return;
    }
    reference_ = referencePicture(renderer, settings_, rowDone, Alternatives::Definition);
    excluded_ = shownTriangles(renderer, settings_, reference_->ids).excluded;
    picture_ = reference_->picture;
}

Picture GroupTruth::pictureFor(const Picture& shown) const {
    return reference_ ? reference_->nearestTo(shown) : picture_;
}

Picture GroupTruth::pictureOn(engine::Renderer& renderer, const frame::FrameSettings& settings,
                              const Picture& shown) const {
    return reference_ ? referencePicture(
                            renderer, settings, [] {}, Alternatives::Definition)
                            .nearestTo(shown)
                      : toPicture(renderer.render(engine::Technique::Forward, settings));
}

Picture GroupTruth::pictureOf(engine::Technique technique, const frame::FrameSettings& settings) const {
    frame::FrameSettings compared = settings;
    compared.filter = filter_;
    compared.display = false;
    return toPicture(renderer_.render(technique, compared));
}

BenchError GroupTruth::errorOf(const Picture& picture, std::map<std::string, std::string>& why) const {
    const ErrorFigures figures = errorFigures(picture, pictureFor(picture), excluded_);
    BenchError error;
    const auto take = [&](const char* name, double value) -> std::optional<double> {
        if (std::isfinite(value)) return value;
        why[std::string("error.") + name] = "no pixel could be compared";
        return {};
    };
    error.relMse = take("relMse", figures.relMse);
    error.maxRel = take("maxRel", figures.maxRel);
    error.p99Rel = take("p99Rel", figures.p99Rel);
    error.p999Rel = take("p999Rel", figures.p999Rel);
    error.bias = take("bias", figures.bias);
    error.flip = figures.flip;
    if (!error.flip) why["error.flip"] = figures.flipReason;
    error.excluded = figures.excluded;
    return error;
}

} // namespace tessera::validation
