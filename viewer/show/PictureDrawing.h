#pragma once
#include <functional>
#include <optional>
#include <string>

#include "viewer/session/EventLog.h"
#include "viewer/session/Facts.h"
#include "viewer/session/Pulse.h"
#include "viewer/show/Screen.h"
#include "viewer/window/Window.h"

namespace tessera::viewer {

/// Decides when images of the user's settings are drawn, and at which scale; reports what it did.
class PictureDrawing {
public:
    /// Callbacks.
    struct Calls {
        std::function<void(const std::string&)> fails; ///< shows an error
        /// Shows Facts::progress over the unchanged window while an image is being drawn: between bands (Bands.h).
        std::function<void()> showProgress;
        std::function<bool()> isOver; ///< something was loaded that replaces the contents of the image
    };
    /// All must outlive the object.
    PictureDrawing(State& state, Facts& facts, Screen& screen, Window& window, const EventLog& log, Pulse& pulse,
                   Calls calls);

    /// Draws changed images of a size: at reduced resolution while something moves, at full resolution when idle.
    /// Returns whether it drew.
    bool update(glm::ivec2 sizePixels);
    /// Whether the status line has shown the timings of the latest image.
    void setDescribed(bool isDescribed) { isDescribed_ = isDescribed; }

    const Screen::Wanted& wanted() const { return wanted_; }
    std::uint64_t pictures() const { return pictures_; } ///< number of drawn images
    int givenUp() const { return givenUp_; }             ///< aborted draws since the latest image
    /// The latest update() aborted an idle image.
    bool gaveUpAtRest() const { return gaveUpAtRest_; }
    bool isWhole() const;
    /// Nothing is left to draw: the image has full resolution, or the user cancelled it.
    bool isSettled() const { return isWhole() || cancelled_ == wanted_; }
    /// Stops drawing the current image, until its settings change or resume().
    void cancel();
    void resume() { cancelled_.reset(); }
    /// Whether irradiance is left to diffuse for other cameras, so that flying does not have to wait for it.
    bool lacksLight() const;
    /// Whether shifted images that antialias the idle one are left to draw.
    bool lacksSmoothing() const;
    /// Whether the window still shows the frame rate, which is wrong when idle.
    bool showsRate() const { return facts_.picturesPerSecond.has_value(); }

private:
    double restScale() const;
    /// Whether the image must be drawn again with the light lists that the inspector needs.
    bool lacksLights() const { return state_.inspects && screen_.shows(wanted_) && !screen_.hasLights(wanted_); }
    /// Records scale and size of the displayed images.
    void noteShown();
    double movingScale() const;
    /// The scale of the next idle image: full or, if that takes long, at least twice the latest one.
    double nextScale() const;
    /// Reports from time to time how far the image at a scale is drawn.
    void showProgress(double scale);
    Progress announced() const;
    std::string drawingText(double scale) const;
    std::optional<double> drawingShare() const;
    /// Diffuses a slice of irradiance for the next image, but draws none; the status line shows the progress.
    bool diffuseSlice(Screen::Reach reach);
    /// Draws the next of the shifted images.
    void smooth();
    /// Before the first image of a kind, and before an image that stays and recomputes its diffused irradiance, the
    /// window shows for one frame why it will wait.
    bool isToBeAnnounced(Screen::Stay stay);
    /// Whether more urgent input is pending during a draw. Hovering never interrupts an image drawn while something
    /// moves, which is useful even if outdated; it interrupts an idle image at most twice.
    bool isInterrupted(bool isAtRest);
    bool drawAt(double scale, Screen::Stay stay, bool isAtRest);
    /// Reports what an image lacks, unless the previous one lacked it too.
    void note(std::string& said, std::string lacks);

    State& state_;
    Facts& facts_;
    Screen& screen_;
    Window& window_;
    const EventLog& log_;
    Pulse& pulse_;
    Calls calls_;
    Screen::Wanted wanted_;
    bool isDescribed_ = true;
    std::uint64_t pictures_ = 0;
    std::uint64_t kinds_ = 0; ///< number of the latest image's kind
    int announcements_ = 0;   ///< frames in which the next image has been announced
    int givenUp_ = 0;
    bool gaveUpAtRest_ = false;
    bool wasUnlike_ = false;                           ///< the latest image cost more than later ones of its kind will
    double nextProgress_ = 0.0;                        ///< when progress is shown next
    std::optional<Screen::Wanted> cancelled_;          ///< not drawn any further
    std::string drawingFault_;                         ///< error of the latest image that failed
    std::string missingTextures_, invisibleDiffusion_; ///< of the latest image; reported by a notice
};

} // namespace tessera::viewer
