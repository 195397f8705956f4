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

/// Decides when pictures of what the user chose are drawn, and at which scale; tells what it did.
class PictureDrawing {
public:
    /// What it calls.
    struct Calls {
        std::function<void(const std::string&)> fails; ///< shows an error
        /// Shows Facts::progress over the window as it was, while a picture is being drawn: between bands (Bands.h).
        std::function<void()> tells;
        std::function<bool()> isOver; ///< something was loaded that comes in the place of what the picture shows
    };
    /// All must outlive the object.
    PictureDrawing(State& state, Facts& facts, Screen& screen, Window& window, const EventLog& log, Pulse& pulse,
                   Calls calls);

    /// Draws changed pictures of a size: at reduced resolution while something moves, at full resolution at rest.
    /// Returns whether it drew.
    bool update(glm::ivec2 sizePixels);
    /// The window has shown the figures of the latest picture with it, or not yet.
    void setDescribed(bool isDescribed) { isDescribed_ = isDescribed; }

    const Screen::Wanted& wanted() const { return wanted_; }
    std::uint64_t pictures() const { return pictures_; } ///< that were drawn
    int givenUp() const { return givenUp_; }             ///< since the latest of them
    /// The latest update() gave up a picture at rest.
    bool gaveUpAtRest() const { return gaveUpAtRest_; }
    bool isWhole() const;
    /// Nothing is left to draw: it is whole, or the user wants no more of it.
    bool isSettled() const { return isWhole() || cancelled_ == wanted_; }
    /// Leaves the picture as far as it is drawn, until it would be another, or resume().
    void cancel();
    void resume() { cancelled_.reset(); }
    /// Whether light is left to spread over what other cameras see; while one is flown nobody waits for it.
    bool lacksLight() const;
    /// Whether shifted pictures are left to draw that smooth the edges of the one at rest.
    bool lacksSmoothing() const;
    /// Whether the window still tells how fast pictures follow one another, which is wrong at rest.
    bool tellsRate() const { return facts_.picturesPerSecond.has_value(); }

private:
    double restScale() const;
    /// Whether the whole picture has yet to be drawn with what an inspected pixel tells of lights.
    bool lacksLights() const { return state_.inspects && screen_.shows(wanted_) && !screen_.knowsLights(wanted_); }
    /// Tells how large the wanted pictures are that the window shows.
    void noteShown();
    double movingScale() const;
    /// The scale of the next picture at rest: the whole one, or, where that takes long, one with twice the sides.
    double nextScale() const;
    /// Tells now and then how far the picture is that is drawn at a scale.
    void tellProgress(double scale);
    Progress announced() const;
    std::string drawingText(double scale) const;
    std::optional<double> drawingShare() const;
    /// Draws no picture, but has light for the next one; the line below the picture says how far it is.
    bool spreadSlice(Screen::Reach reach);
    /// The next of the shifted pictures.
    void smooth();
    /// Before the first picture of a kind, and before one that stays for which light is spread anew, the window shows
    /// for one frame why it will wait.
    bool isToBeAnnounced(Screen::Stay stay);
    /// Whether something came while a picture is drawn that is more urgent. A picture of moving things is worth having
    /// though they have moved on. The whole one is not; but a pointer that only wanders may give it up twice at most.
    bool isInterrupted(bool isAtRest);
    bool drawAt(double scale, Screen::Stay stay, bool isAtRest);
    /// Says what a picture lacks where the one before did not.
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
    std::uint64_t kinds_ = 0; ///< of pictures, one after the other
    int announcements_ = 0;   ///< frames for which the next picture has been announced
    int givenUp_ = 0;
    bool gaveUpAtRest_ = false;
    bool wasUnlike_ = false;                     ///< the latest picture took more than later ones like it will
    double nextTold_ = 0.0;                      ///< when progress is told next
    std::optional<Screen::Wanted> cancelled_;    ///< is drawn no further
    std::string drawingFault_;                   ///< why the latest picture that failed did
    std::string missingTextures_, unseenSpread_; ///< of the latest picture; a notice has said so
};

} // namespace tessera::viewer
