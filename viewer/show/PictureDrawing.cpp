#include "viewer/show/PictureDrawing.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/EndRequest.h"
#include "viewer/session/DrawnLook.h"
#include "viewer/session/Playback.h"

namespace tessera::viewer {

PictureDrawing::PictureDrawing(State& state, Facts& facts, Screen& screen, Window& window, const EventLog& log,
                               Pulse& pulse, std::function<void(const std::string&)> fails)
    : state_(state), facts_(facts), screen_(screen), window_(window), log_(log), pulse_(pulse),
      fails_(std::move(fails)) {}

bool PictureDrawing::isWhole() const {
    return !state_.open || screen_.scaleOf(wanted_) >= restScale();
}

bool PictureDrawing::lacksLight() const {
    return state_.open && screen_.shows(wanted_) && screen_.lacksLight(wanted_, Screen::Reach::All);
}

double PictureDrawing::restScale() const {
    return state_.automaticScale ? 1.0 : double(state_.fixedScale);
}

double PictureDrawing::movingScale() const {
    return state_.automaticScale ? screen_.movingScale() : double(state_.fixedScale);
}

bool PictureDrawing::update(glm::ivec2 sizePixels) {
    const bool wasAnnounced = facts_.isPreparing || facts_.isSpreading;
    facts_.isPreparing = facts_.isSpreading = false;
    const bool wasSpreading = std::exchange(facts_.spreading, std::nullopt).has_value();
    if (wasSpreading) pulse_.another(); // until the line says so no more
    if (!wasAnnounced) announcements_ = 0;
    if (!state_.open || sizePixels.x < 1 || sizePixels.y < 1) return false;
    wanted_.looks = {drawnLook(state_, 0), drawnLook(state_, 1)};
    for (Look& look : wanted_.looks) look.settings.sizePixels = sizePixels;
    wanted_.sides = state_.sides();
    if (wanted_.sides == 1) wanted_.looks[1] = wanted_.looks[0];
    wanted_.keepsRadiance =
        state_.compare != Compare::Off || state_.inspects || std::ranges::any_of(wanted_.looks, showsCounts);
    wanted_.sceneRevision = state_.open->revision();
    wanted_.sceneEdits = state_.open->edits();
    const double have = screen_.scaleOf(wanted_);
    const bool rests = !isMoving(state_) && Window::nowSeconds() >= pulse_.restAt;
    const bool isAtRest = rests && have > 0.0;
    if (rests && facts_.picturesPerSecond) {
        facts_.picturesPerSecond.reset();
        pulse_.another();
    }
    if (have >= restScale() && isAtRest && screen_.lacksLight(wanted_, Screen::Reach::All))
        return spreadSlice(Screen::Reach::All);
    if (have >= restScale() || (have > 0.0 && have >= movingScale() && isMoving(state_))) return false;
    if (have > 0.0 && !isAtRest) return false;
    if (isAtRest && !isDescribed_) return false; // the whole picture may take long: say first what this one is
    if (isAtRest && screen_.lacksLight(wanted_, Screen::Reach::Seen)) return spreadSlice(Screen::Reach::Seen);
    if (have == 0.0) pulse_.stirred(Window::nowSeconds());
    // A scale that is fixed is that of all pictures: none is better.
    const Screen::Stay stay = isAtRest || !state_.automaticScale ? Screen::Stay::Stays : Screen::Stay::Passes;
    if (isToBeAnnounced(stay)) return false;
    return drawAt(isAtRest ? restScale() : movingScale(), stay, isAtRest);
}

bool PictureDrawing::spreadSlice(Screen::Reach reach) {
    try {
        const engine::SpreadProgress progress = screen_.spreadSlice(wanted_, reach);
        if (progress.isDone())
            log_.line(progress.isOfAll ? "spread light everywhere" : "spread light in view");
        else
            facts_.spreading = progress;
    } catch (const std::exception& error) {
        fails_(error.what());
    }
    return false;
}

bool PictureDrawing::isToBeAnnounced(Screen::Stay stay) {
    constexpr int kFrames = 2; // the interface of this frame is laid out already
    if (announcements_ >= kFrames) return false;
    facts_.isPreparing = screen_.isNewKind(wanted_);
    facts_.isSpreading = !facts_.isPreparing && stay == Screen::Stay::Stays && screen_.spreadsAnew(wanted_);
    if (!facts_.isPreparing && !facts_.isSpreading) return false;
    ++announcements_;
    pulse_.another();
    return true;
}

bool PictureDrawing::isInterrupted(bool isAtRest) {
    constexpr int kWanderings = 2;
    window_.poll();
    if (window_.shouldClose() || window_.input().isUrgent() || notedEnd() != 0) return true;
    return isAtRest && window_.hasActivity() && (window_.isButtonHeld() || givenUp_ < kWanderings);
}

bool PictureDrawing::drawAt(double scale, Screen::Stay stay, bool isAtRest) {
    const bool mayGiveUp = isAtRest || screen_.isSlow(wanted_);
    const auto givesUp = [this, isAtRest] { return isInterrupted(isAtRest); };
    const double startedAt = Window::nowSeconds();
    const bool isNewKind = screen_.isNewKind(wanted_);
    try {
        Screen::Drawn drawn = screen_.draw(wanted_, scale, stay, mayGiveUp ? std::function<bool()>(givesUp) : nullptr);
        if (drawn.gaveUp) {
            ++givenUp_;
            log_.line(fmt::format("gave up scale {:.4g}", scale));
            return false;
        }
        givenUp_ = 0;
        if (isNewKind) ++kinds_;
        facts_.ms = drawn.ms;
        facts_.scale = drawn.scale;
        facts_.sizePixels = drawn.sizePixels;
        facts_.shadows = std::move(drawn.shadows);
        facts_.targetBytes = screen_.renderer()->backend().poolBytes();
        ++pictures_;
        for (int side = 0; side < wanted_.sides; ++side)
            state_.timings.add({pictures_, 1000.0 * startedAt, drawn.sideMs[std::size_t(side)], drawn.scale, side,
                                drawn.passes[std::size_t(side)], kinds_, drawn.isUnlike, !isAtRest});
        facts_.picturesPerSecond = state_.timings.picturesPerSecond();
        pulse_.another(); // the figures of this frame are shown by the next
        if (state_.notice.isError && state_.notice.text == drawingFault_) state_.notice = {};
        note(missingTextures_, std::move(drawn.missingTextures));
        if (drawn.unseenSpread) note(unseenSpread_, std::move(*drawn.unseenSpread));
        const Look& look = wanted_.looks[0];
        log_.line(fmt::format("drawn {} scale {:.4g} size {}x{} ms {:.1f} technique {} view {}", pictures_, drawn.scale,
                              drawn.sizePixels.x, drawn.sizePixels.y, drawn.ms, infoOf(look.technique).name,
                              frame::debugViewInfo(look.settings.view).name));
        return true;
    } catch (const std::exception& error) {
        drawingFault_ = error.what();
        fails_(drawingFault_);
        return false;
    }
}

void PictureDrawing::note(std::string& said, std::string lacks) {
    if (lacks == said) return;
    said = std::move(lacks);
    if (!said.empty() && !state_.notice.isError) state_.notice = {said, false};
}

} // namespace tessera::viewer
