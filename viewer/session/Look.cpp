#include "viewer/session/Look.h"

#include <utility>

#include "passes/recipes/ChooseCulling.h"
#include "passes/recipes/ChooseLighting.h"
#include "passes/recipes/ChooseSamples.h"
#include "passes/recipes/ChooseView.h"

namespace tessera::viewer {
namespace {

template <typename Value, typename Takes>
void fit(std::optional<Value>& value, std::optional<Value>& aside, const Takes& takes) {
    if (value && !takes(*value)) aside = std::exchange(value, std::nullopt);
    if (!value && aside && takes(*aside)) value = std::exchange(aside, std::nullopt);
}

template <typename Value>
void bringBack(std::optional<Value>& value, std::optional<Value>& aside) {
    if (!value) value = aside;
    aside.reset();
}

/// One sample a pixel is what every technique does; more of them were asked for.
std::optional<int> severalSamples(const frame::FrameSettings& settings) {
    return settings.samples > 1 ? std::optional<int>(settings.samples) : std::nullopt;
}

} // namespace

Look possible(Look look) {
    frame::FrameSettings& settings = look.settings;
    PutAside& aside = look.aside;
    const recipes::TechniqueInfo& info = infoOf(look.technique);
    const auto hasLists = [&](auto) { return recipes::hasLightLists(look.technique); };
    std::optional<int> samples = severalSamples(settings);
    fit(settings.culling.method, aside.method,
        [&](culling::Method method) { return recipes::takesMethod(look.technique, method); });
    fit(settings.culling.tilePixels, aside.tilePixels, hasLists);
    fit(settings.culling.builder, aside.builder, hasLists);
    fit(settings.lightOn, aside.lightOn, [&](auto) { return recipes::infoOf(look.technique).choosesStage; });
    fit(samples, aside.samples, [&](int count) { return recipes::takesSamples(info, count); });
    settings.samples = samples.value_or(1);
    if (!recipes::takesView(info, settings.view)) settings.view = frame::View::Final;
    return look;
}

Look asked(Look look) {
    frame::FrameSettings& settings = look.settings;
    std::optional<int> samples = severalSamples(settings);
    bringBack(settings.culling.method, look.aside.method);
    bringBack(settings.culling.tilePixels, look.aside.tilePixels);
    bringBack(settings.culling.builder, look.aside.builder);
    bringBack(settings.lightOn, look.aside.lightOn);
    bringBack(samples, look.aside.samples);
    settings.samples = samples.value_or(1);
    return look;
}

Look rebased(const Look& now, const Look& before, const Look& base) {
    const Look chosen = asked(now), begun = asked(before);
    Look result = asked(base);
    const auto keep = [&](auto member) {
        if (chosen.settings.*member != begun.settings.*member) result.settings.*member = chosen.settings.*member;
    };
    using Settings = frame::FrameSettings;
    if (chosen.technique != begun.technique) result.technique = chosen.technique;
    keep(&Settings::samples);
    keep(&Settings::timeSeconds);
    keep(&Settings::layout);
    keep(&Settings::view);
    keep(&Settings::filter);
    keep(&Settings::space);
    keep(&Settings::prune);
    keep(&Settings::specular);
    keep(&Settings::rangeTolerance);
    keep(&Settings::culling);
    keep(&Settings::lightOn);
    keep(&Settings::exposureEV);
    keep(&Settings::toneMap);
    return possible(result);
}

} // namespace tessera::viewer
