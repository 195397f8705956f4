#include "viewer/show/Measurements.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/Error.h"
#include "engine/ChooseSamples.h"
#include "engine/PrepareView.h"
#include "engine/Rendering.h"
#include "viewer/session/DrawnLook.h"

namespace tessera::viewer {
namespace {

constexpr int kJudgedShare = 4; ///< divides the image's sides: the oracle tries every light at every pixel

Picture radianceOf(const DrawnPicture& picture) {
    return engine::toPicture(engine::readBack(picture.radiance()->texture(), nullptr));
}

} // namespace

bool Measurements::update(Facts& facts, const State& state, const Screen& screen, const Screen::Wanted& wanted,
                          bool isWhole) {
    bool changed = false;
    if (std::optional<validation::ErrorFigures> figures = figureJob_.take()) {
        facts.figures = *figures;
        changed = true;
    }
    if (state.compare == Compare::Off) measured_.reset();
    if ((isWhole || !facts.plan) && state.wantsPlan) changed |= updatePlan(facts, state, screen, wanted);
    if (isWhole && screen.shows(wanted)) changed |= updateCounts(facts, screen, wanted);
    if (isWhole && state.compare != Compare::Off && screen.shows(wanted))
        changed |= updateFigures(facts, screen, wanted);
    facts.figuresAreOld = figureJob_.isBusy() || measured_ != wanted;
    return changed;
}

bool Measurements::updatePlan(Facts& facts, const State& state, const Screen& screen, const Screen::Wanted& wanted) {
    const engine::Renderer& renderer = *screen.renderer();
    const Planned now{wanted.looks[std::size_t(state.activeSide)], wanted.sceneRevision};
    if (planned_ == now) return false;
    planned_ = now;
    try {
        facts.plan = engine::planFrame(renderer.scene(), now.look.technique,
                                       engine::settingsOn(screen.capabilities(), now.look.settings));
    } catch (const InputError&) { // the frame itself failed, and the window shows why
        facts.plan.reset();
    }
    return true;
}

bool Measurements::updateCounts(Facts& facts, const Screen& screen, const Screen::Wanted& wanted) {
    if (counted_ == wanted) return false;
    counted_ = wanted;
    facts.mostCounts = {};
    bool isCounted = false;
    for (int side = 0; side < wanted.sides; ++side) {
        const Look& look = wanted.looks[std::size_t(side)];
        const DrawnPicture& shown = screen.picture(side);
        if (!showsCounts(look) || !shown.isThere() || shown.radiance() == nullptr) continue;
        const Picture picture = radianceOf(shown);
        float most = 0.0f;
        for (std::size_t i = 0; i < picture.pixelCount(); ++i) most = std::max(most, picture.pixel(i)[0]);
        facts.mostCounts[std::size_t(side)] = {look.settings.view, most};
        isCounted = true;
    }
    // If both sides show the same view, their colours have the same scale.
    auto& [left, right] = facts.mostCounts;
    if (left && right && left->view == right->view) left->most = right->most = std::max(left->most, right->most);
    return isCounted;
}

bool Measurements::updateFigures(Facts& facts, const Screen& screen, const Screen::Wanted& wanted) {
    if (measured_ == wanted || figureJob_.isBusy()) return false;
    const DrawnPicture& a = screen.picture(0);
    const DrawnPicture& b = screen.picture(1);
    if (!a.isThere() || !b.isThere() || a.radiance() == nullptr || b.radiance() == nullptr) return false;
    if (a.radiance()->sizePixels() != b.radiance()->sizePixels()) return false;
    measured_ = wanted;
    facts.figuresAreOld = true;
    figureJob_.start(radianceOf(a), radianceOf(b));
    return true;
}

void Measurements::judgeLights(Facts& facts, Screen& screen, const Look& look) {
    frame::FrameSettings settings = look.settings;
    settings.sizePixels = glm::max(settings.sizePixels / kJudgedShare, glm::ivec2(1));
    settings.view = frame::DebugView::Final; // other views may build no lists
    facts.lights = validation::judgeLights(*screen.renderer(), look.technique, settings);
    const culling::Choice culling =
        engine::prepareView(screen.renderer()->scene(), look.technique, settings).spec.culling;
    facts.lightsOf = fmt::format("at {}x{}, 1/{} of the picture's sides: {}, {}, tile {}", settings.sizePixels.x,
                                 settings.sizePixels.y, kJudgedShare, infoOf(look.technique).name,
                                 infoOf(culling.method).name, culling.tilePixels);
    facts.lightsLook = look;
}

void Measurements::clear(Facts& facts) {
    planned_.reset();
    counted_.reset();
    measured_.reset();
    facts.mostCounts = {};
    facts.plan.reset();
    facts.lights.reset();
    facts.figures.reset();
}

} // namespace tessera::viewer
