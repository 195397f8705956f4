#include "viewer/show/PictureDrawing.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/EndRequest.h"
#include "renderer/gpu/Bands.h"
#include "viewer/session/DrawnLook.h"
#include "viewer/session/Playback.h"
#include "viewer/show/DrawnShare.h"

namespace tessera::viewer {
namespace {

/// Images that take longer are refined in steps.
constexpr double kLongMs = 1000.0;
/// The same after a first image, whose time includes compiling shaders and thus predicts nothing.
constexpr double kLongFirstMs = 250.0;
constexpr double kQuietSeconds = 0.5;     ///< until progress is shown first,
constexpr double kProgressSeconds = 0.25; ///< and between updates

} // namespace

PictureDrawing::PictureDrawing(State& state, Facts& facts, Screen& screen, Window& window, const EventLog& log,
                               Pulse& pulse, Calls calls)
    : state_(state), facts_(facts), screen_(screen), window_(window), log_(log), pulse_(pulse),
      calls_(std::move(calls)) {}

bool PictureDrawing::isWhole() const {
    return !state_.open || (screen_.scaleOf(wanted_) >= restScale() && !lacksLights());
}

bool PictureDrawing::lacksLight() const {
    return state_.open && cancelled_ != wanted_ && screen_.shows(wanted_) &&
           screen_.lacksLight(wanted_, Screen::Reach::All);
}

bool PictureDrawing::lacksSmoothing() const {
    return state_.open && state_.smooths && isWhole() && cancelled_ != wanted_ && screen_.lacksSmoothing(wanted_);
}

void PictureDrawing::smooth() {
    try {
        const auto givesUp = [this] { return isInterrupted(true); };
        gaveUpAtRest_ = !screen_.smooth(wanted_, givesUp);
    } catch (const std::exception& error) {
        calls_.fails(error.what());
    }
    if (!screen_.isSmoothed()) return;
    log_.line("smoothed");
    pulse_.another();
}

double PictureDrawing::restScale() const {
    return state_.automaticScale ? 1.0 : double(state_.fixedScale);
}

double PictureDrawing::movingScale() const {
    return state_.automaticScale ? screen_.movingScale() : double(state_.fixedScale);
}

double PictureDrawing::nextScale() const {
    const double whole = restScale(), latest = facts_.scale;
    constexpr double kMostRefined = 0.25; // steps cost at most a third of the full image
    if (!state_.automaticScale || latest > kMostRefined) return whole;
    const bool isLong = wasUnlike_ ? facts_.ms > kLongFirstMs : screen_.predictedMs(whole) > kLongMs;
    return isLong ? *std::find_if(kScales.rbegin(), kScales.rend(), [&](double scale) { return scale >= 2.0 * latest; })
                  : whole;
}

void PictureDrawing::cancel() {
    cancelled_ = wanted_;
    log_.line(fmt::format("cancelled scale {:.4g}", screen_.scaleOf(wanted_)));
}

void PictureDrawing::noteShown() {
    if (!screen_.shows(wanted_)) return;
    facts_.scale = screen_.shownScale(wanted_);
    facts_.sizePixels = screen_.picture(0).display().sizePixels();
    for (int side = 1; side < wanted_.sides; ++side)
        facts_.sizePixels = glm::min(facts_.sizePixels, screen_.picture(side).display().sizePixels());
}

bool PictureDrawing::update(glm::ivec2 sizePixels) {
    gaveUpAtRest_ = false;
    if (std::exchange(facts_.progress, std::nullopt)) pulse_.another(); // to remove the progress box
    const bool wasAnnounced = facts_.isPreparing || facts_.isDiffusing;
    facts_.isPreparing = facts_.isDiffusing = false;
    const bool wasDiffusing = std::exchange(facts_.diffusion, std::nullopt).has_value();
    if (wasDiffusing) pulse_.another(); // to update the status line
    if (!wasAnnounced) announcements_ = 0;
    if (!state_.open || sizePixels.x < 1 || sizePixels.y < 1) return false;
    wanted_.looks = {drawnLook(state_, 0), drawnLook(state_, 1)};
    for (Look& look : wanted_.looks) look.settings.sizePixels = sizePixels;
    wanted_.sides = state_.sides();
    if (wanted_.sides == 1) wanted_.looks[1] = wanted_.looks[0];
    wanted_.keepsRadiance =
        state_.compare != Compare::Off || state_.inspects || std::ranges::any_of(wanted_.looks, showsCounts);
    wanted_.sceneRevision = state_.open->revision();
    wanted_.sceneEdits = state_.open->pictureEdits();
    if (cancelled_ && *cancelled_ != wanted_) cancelled_.reset();
    if (facts_.isCancelled != cancelled_.has_value()) pulse_.another();
    facts_.isCancelled = cancelled_.has_value();
    noteShown();
    const double have = screen_.scaleOf(wanted_);
    const bool rests = !isMoving(state_) && Window::nowSeconds() >= pulse_.restAt;
    const bool isAtRest = rests && have > 0.0;
    if (rests && facts_.picturesPerSecond) {
        facts_.picturesPerSecond.reset();
        pulse_.another();
    }
    if (!state_.smooths || wanted_.sides != 1) screen_.forgetSmoothing();
    if (cancelled_) return false;
    const bool isWholeNow = isWhole();
    if (isWholeNow && isAtRest && screen_.lacksLight(wanted_, Screen::Reach::All))
        return diffuseSlice(Screen::Reach::All);
    if (isWholeNow && isAtRest && lacksSmoothing()) smooth();
    if (isWholeNow || (have > 0.0 && have >= movingScale() && isMoving(state_))) return false;
    if (have > 0.0 && !isAtRest) return false;
    if (isAtRest && !isDescribed_) return false; // the full image may take long: show the figures of this one first
    const bool lacksLight = isAtRest && screen_.lacksLight(wanted_, Screen::Reach::Seen);
    // If diffusion takes long, a full-resolution image without it comes first.
    const bool isSmall = facts_.scale < restScale() && (screen_.diffusesAnew(wanted_) || wasDiffusing);
    if (lacksLight && !isSmall) return diffuseSlice(Screen::Reach::Seen);
    if (have == 0.0) pulse_.stirred(Window::nowSeconds());
    // A fixed scale applies to all images: none is better.
    const double scale = isAtRest ? nextScale() : movingScale();
    const Screen::Stay stay = isAtRest && (scale < restScale() || lacksLight) ? Screen::Stay::Refines
                              : isAtRest || !state_.automaticScale            ? Screen::Stay::Stays
                                                                              : Screen::Stay::Passes;
    if (isToBeAnnounced(stay)) return false;
    return drawAt(scale, stay, isAtRest);
}

bool PictureDrawing::diffuseSlice(Screen::Reach reach) {
    try {
        const engine::DiffusionProgress progress = screen_.diffuseSlice(wanted_, reach);
        if (progress.isDone())
            log_.line(progress.isOfAll ? "diffused light everywhere" : "diffused light in view");
        else
            facts_.diffusion = progress;
        if (facts_.diffusion && reach == Screen::Reach::Seen) {
            const double tiles = double(std::max<std::size_t>(progress.tiles, 1));
            facts_.progress = {"Diffusing light over surfaces", double(progress.doneTiles) / tiles, true};
        }
    } catch (const std::exception& error) {
        calls_.fails(error.what());
    }
    return false;
}

bool PictureDrawing::isToBeAnnounced(Screen::Stay stay) {
    constexpr int kFrames = 2; // the interface of this frame is already laid out
    if (announcements_ >= kFrames) return false;
    facts_.isPreparing = screen_.lacksPrograms(wanted_);
    facts_.isDiffusing = !facts_.isPreparing && stay == Screen::Stay::Stays && screen_.diffusesAnew(wanted_);
    if (!facts_.isPreparing && !facts_.isDiffusing) return false;
    facts_.progress = announced();
    ++announcements_;
    pulse_.another();
    return true;
}

Progress PictureDrawing::announced() const {
    return {facts_.isDiffusing ? "Diffusing light over surfaces" : "Preparing shaders", {}, true};
}

std::string PictureDrawing::drawingText(double scale) const {
    const std::string what = scale < 1.0 ? fmt::format("Drawing at scale {:.3g}", scale) : "Drawing the whole picture";
    if (wanted_.sides == 1) return what;
    return fmt::format("{}, {} side", what, screen_.drawingSide() == 0 ? "left" : "right");
}

std::optional<double> PictureDrawing::drawingShare() const {
    const gpu::BandProgress progress = gpu::bandProgress();
    double done = 0.0, all = 0.0;
    for (int side = 0; side < wanted_.sides; ++side) {
        if (!screen_.isDrawing(side)) continue;
        const FrameTimes* const before = state_.timings.latest(side);
        if (before == nullptr || before->kind != kinds_ || screen_.isNewKind(wanted_)) return std::nullopt;
        all += before->ms;
        if (side < screen_.drawingSide()) done += before->ms;
        if (side != screen_.drawingSide()) continue;
        const std::optional<double> share = drawnShare(before->passes, progress);
        if (!share) return std::nullopt;
        done += *share * before->ms;
    }
    if (!(all > 0.0)) return std::nullopt;
    return done / all;
}

void PictureDrawing::showProgress(double scale) {
    if (!calls_.showProgress || Window::nowSeconds() < nextProgress_) return;
    const std::optional<double> share = drawingShare();
    facts_.progress = screen_.lacksPrograms(wanted_) ? announced() : Progress{drawingText(scale), share, true};
    log_.line(fmt::format("progress {}{}", facts_.progress->text,
                          share ? fmt::format(" {:.0f} %", 100.0 * *share) : std::string()));
    calls_.showProgress();
    nextProgress_ = Window::nowSeconds() + kProgressSeconds;
}

bool PictureDrawing::isInterrupted(bool isAtRest) {
    constexpr int kWanderings = 2;
    window_.poll();
    if (window_.shouldClose() || window_.input().isUrgent() || notedEnd() != 0 || calls_.isOver()) return true;
    return isAtRest && window_.hasActivity() && (window_.isButtonHeld() || givenUp_ < kWanderings);
}

bool PictureDrawing::drawAt(double scale, Screen::Stay stay, bool isAtRest) {
    const bool mayGiveUp = isAtRest || screen_.isSlow(wanted_);
    const auto givesUp = [this, isAtRest, scale] {
        if (isInterrupted(isAtRest)) return true;
        showProgress(scale);
        return false;
    };
    const double startedAt = Window::nowSeconds();
    nextProgress_ = startedAt + kQuietSeconds;
    const bool isNewKind = screen_.isNewKind(wanted_);
    if (screen_.lacksPrograms(wanted_)) facts_.progress = announced(); // until aborted, or replaced by the progress
    try {
        // Reading lights waits for the GPU, which is too slow while something moves.
        const bool keepsLights = state_.inspects && isAtRest && scale >= restScale();
        Screen::Drawn drawn =
            screen_.draw(wanted_, scale, stay, keepsLights, mayGiveUp ? std::function<bool()>(givesUp) : nullptr);
        if (drawn.gaveUp) {
            ++givenUp_;
            gaveUpAtRest_ = isAtRest;
            log_.line(fmt::format("gave up scale {:.4g}", scale));
            return false;
        }
        givenUp_ = 0;
        facts_.progress.reset();
        wasUnlike_ = drawn.isUnlike;
        if (isNewKind) ++kinds_;
        facts_.ms = drawn.ms;
        noteShown();
        facts_.targetBytes = screen_.renderer()->backend().poolBytes();
        ++pictures_;
        for (std::size_t side = 0; side < std::size_t(wanted_.sides); ++side) {
            if (!drawn.isOfSide[side]) continue;
            facts_.shadows[side] = std::move(drawn.shadows[side]);
            state_.timings.add({pictures_, 1000.0 * startedAt, drawn.sideMs[side], drawn.scale, int(side),
                                drawn.passes[side], kinds_, drawn.isUnlike, !isAtRest});
        }
        facts_.picturesPerSecond = state_.timings.picturesPerSecond();
        pulse_.another(); // the next frame shows this one's figures
        if (state_.notice.isError && state_.notice.text == drawingFault_) state_.notice = {};
        note(missingTextures_, std::move(drawn.missingTextures));
        if (drawn.invisibleDiffusion) note(invisibleDiffusion_, std::move(*drawn.invisibleDiffusion));
        const Look& look = wanted_.looks[drawn.isOfSide[0] ? 0 : 1];
        log_.line(fmt::format("drawn {} scale {:.4g} size {}x{} ms {:.1f} technique {} view {}{}", pictures_,
                              drawn.scale, drawn.sizePixels.x, drawn.sizePixels.y, drawn.ms,
                              infoOf(look.technique).name, frame::debugViewInfo(look.settings.view).name,
                              drawn.lacksLight ? " lacks light" : ""));
        return true;
    } catch (const std::exception& error) {
        drawingFault_ = error.what();
        facts_.progress.reset();
        calls_.fails(drawingFault_);
        return false;
    }
}

void PictureDrawing::note(std::string& said, std::string lacks) {
    if (lacks == said) return;
    said = std::move(lacks);
    if (!said.empty() && !state_.notice.isError) state_.notice = {said, false};
}

} // namespace tessera::viewer
