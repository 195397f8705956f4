#include "viewer/session/Look.h"

#include "passes/recipes/ChooseCulling.h"
#include "passes/recipes/ChooseLighting.h"
#include "passes/recipes/ChooseSamples.h"
#include "passes/recipes/ChooseView.h"

namespace tessera::viewer {

Look possible(Look look) {
    frame::FrameSettings& settings = look.settings;
    const recipes::TechniqueInfo& info = infoOf(look.technique);
    if (settings.culling.method && !recipes::takesMethod(look.technique, *settings.culling.method))
        settings.culling.method.reset();
    if (!recipes::hasLightLists(look.technique)) {
        settings.culling.tilePixels.reset();
        settings.culling.builder.reset();
    }
    if (!recipes::takesLightingStage(look.technique)) settings.lightOn.reset();
    if (!recipes::takesSamples(info, settings.samples)) settings.samples = 1;
    if (!recipes::takesView(info, settings.view)) settings.view = frame::View::Final;
    return look;
}

Look rebased(const Look& now, const Look& before, const Look& base) {
    Look result = base;
    const auto keep = [&](auto member) {
        if (now.settings.*member != before.settings.*member) result.settings.*member = now.settings.*member;
    };
    using Settings = frame::FrameSettings;
    if (now.technique != before.technique) result.technique = now.technique;
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
