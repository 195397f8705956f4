#include "viewer/Viewer.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/EndRequest.h"
#include "renderer/frame/ComputedCache.h"
#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/Debug.h"
#include "viewer/Document.h"
#include "viewer/panels/Frame.h"
#include "viewer/panels/ProgressBox.h"
#include "viewer/panels/ShownText.h"
#include "viewer/session/DrawnLook.h"
#include "viewer/session/Playback.h"
#include "viewer/session/PointAt.h"
#include "viewer/session/Pulse.h"
#include "viewer/session/SceneEdits.h"
#include "viewer/show/Inspector.h"
#include "viewer/show/MaterialOutline.h"
#include "viewer/show/Measurements.h"
#include "viewer/show/PictureDrawing.h"
#include "viewer/show/ReloadShaders.h"
#include "viewer/show/ResourceCapture.h"
#include "viewer/show/SceneThumbnails.h"
#include "viewer/window/Gui.h"

namespace tessera::viewer {
namespace {

constexpr double kShaderPeriodSeconds = 0.5; ///< between checks of the shader folder and of a hook
constexpr double kLongestStepSeconds = 0.25; ///< longest time step of movements, so that a compile pause causes no jump
constexpr double kNoticeSeconds = 6.0;
constexpr double kBackgroundSeconds = 0.25; ///< between progress updates of a load
constexpr double kHurrySeconds = 0.05;      ///< between images while input is pending
constexpr double kEndPeriodSeconds = 0.25;  ///< between checks for a signal to end

glm::ivec2 windowSize(const ViewerOptions& options) {
    if (!options.pictureSize) return options.windowSize;
    return windowSizeFor(*options.pictureSize, options.preferences.showsPanel ? options.preferences.panelWidth : 0.0f);
}

class Viewer {
public:
    explicit Viewer(const ViewerOptions& options)
        : log_(options.log), window_(windowSize(options)), gui_(window_), screen_(window_.context()),
          drawing_(state_, facts_, screen_, window_, log_, pulse_,
                   {[this](const std::string& text) { fail(text); }, [this] { showProgress(); },
                    [this] { return document_.hasResult(); }}),
          saver_(state_, screen_, log_), measurements_([] { Window::wake(); }),
          document_({options, state_, facts_, window_, log_, pulse_, screen_, drawing_, saver_, measurements_},
                    [this](const std::string& text) { fail(text); }) {
        facts_.renderer = window_.context().capabilities().renderer;
        state_.firstWindowSize = window_.sizeScreen();
        layOut();
        document_.begin();
    }
    ~Viewer() { holdEnd(false); }

    void run() {
        // Defers signals to end: an immediate end would lose settings, recent files and edits.
        holdEnd(true);
        try {
            while (!document_.isLeaving()) {
                window_.wait(idleSeconds());
                if (notedEnd() != 0) return endNow();
                if (document_.isLeaving()) break;
                attempt([this] { watchShaders(); });
                if (isDue()) frame();
                attempt([this] { document_.keepEdits(); });
                document_.keepSettings();
            }
        } catch (...) {
            document_.endWithEdits();
            throw;
        }
        document_.close();
        log_.line("closed");
    }

private:
    // ---- When to draw ----
    double now() const { return Window::nowSeconds(); }
    bool awaitsRest() const {
        return !drawing_.isSettled() || drawing_.lacksLight() || drawing_.lacksSmoothing() || drawing_.showsRate() ||
               inspector_.awaitsRest() || outline_.awaitsRest() || capture_.awaitsRest();
    }
    double glidesFrom() const { return Gliding{window_.isButtonHeld(), isMoving(state_), facts_.ms, shownAt_}.from(); }
    /// A minimised window shows nothing; a pending image waits.
    bool isVisible() const {
        const glm::ivec2 pixels = window_.sizePixels();
        return !window_.isMinimised() && pixels.x > 0 && pixels.y > 0;
    }
    bool hasPicturePlace() const { return isVisible() && areaPixels().width > 0 && areaPixels().height > 0; }
    bool isDue() const {
        if (window_.hasActivity() || document_.hasResult()) return true;
        if (now() < glidesFrom()) return isVisible() && !window_.input().empty();
        if (pulse_.settleFrames > 0) return true;
        if (isVisible() && document_.isLoading() && now() >= backgroundShownAt_) return true;
        if (isVisible() && (!window_.input().empty() || measurements_.hasResult() || isNoticeOver() || isDimming()))
            return true;
        return hasPicturePlace() &&
               (isMoving(state_) || inspector_.isBusy() || (awaitsRest() && now() >= pulse_.restAt));
    }
    /// Time until the next frame or check, at most kEndPeriodSeconds: a signal does not end the wait for events.
    double idleSeconds() const {
        if (isDue() || notedEnd() != 0) return 0.0;
        double seconds = kEndPeriodSeconds;
        const auto atMost = [&](double most) { seconds = std::min(seconds, most); };
        if (const double wait = glidesFrom() - now(); wait > 0.0) atMost(wait);
        if (awaitsRest() && hasPicturePlace()) atMost(std::max(pulse_.restAt - now(), 0.0));
        if (isVisible() && !state_.notice.text.empty() && !state_.notice.isError)
            atMost(std::max(saidUntil_ - now(), 0.0));
        if (isVisible() && document_.isLoading()) atMost(std::max(backgroundShownAt_ - now(), 0.0));
        if (const auto keepAt = document_.keepAt()) atMost(std::max(*keepAt - now(), 0.0));
        return seconds;
    }

    // ---- Long operations ----
    void noteBackground() {
        facts_.background = document_.loadingProgress();
        backgroundShownAt_ = now() + kBackgroundSeconds;
    }
    bool isCancellable() const { return facts_.shownProgress() && facts_.shownProgress()->canCancel; }
    void cancel() { facts_.isLoadFirst() ? document_.cancelEnvironment() : drawing_.cancel(); }
    /// Shows progress in the middle of a long draw.
    void showProgress() {
        const gpu::BetweenBands between;
        noteBackground();
        paint();
        gui_.drawOver([this](ImDrawList& list) {
            drawProgress(*facts_.shownProgress(), area_, state_.inspectorBox, uiScale(), list);
        });
        present();
    }

    void endNow() {
        document_.endWithEdits();
        endAsNoted();
    }

    /// Runs an action. Its error is shown in the window, which continues.
    template <class Action>
    void attempt(const Action& act) {
        try {
            act();
        } catch (const std::exception& error) {
            fail(error.what());
        }
    }

    void fail(const std::string& text) {
        state_.notice = {text, true};
        pulse_.settle();
        log_.line("error " + text);
    }

    // ---- Shaders ----
    void watchShaders() {
        if (!screen_.renderer() || !screen_.renderer()->programs().watchesFiles() || now() < nextShaderLook_) return;
        nextShaderLook_ = now() + kShaderPeriodSeconds;
        if (screen_.renderer()->programs().sourcesChanged()) reloadShaders(false);
    }

    void reloadShaders(bool isRequested) {
        if (!screen_.renderer()) return;
        viewer::reloadShaders(screen_.renderer()->programs(), state_, log_, isRequested);
        screen_.forget();
        outline_.forget();
        capture_.forget();
        drawing_.resume();
        pulse_.settle();
    }

    // ---- A frame ----
    void frame() {
        const double started = now();
        if (window_.takeActivity() || !window_.input().empty()) {
            pulse_.settle();
            pulse_.stirred(started);
        }
        pulse_.settleFrames = std::max(pulse_.settleFrames - 1, 0);
        attempt([this] { document_.adoptLoaded(); });
        attempt([this] { document_.adoptEnvironment(); });
        if (std::string fault = frame::takeCacheFault(); !fault.empty()) {
            log_.line("note " + fault);
            if (!state_.notice.isError) state_.notice = {std::move(fault), false};
        }
        document_.takeDrops();
        if (!isVisible()) return; // input stays queued, so that no key release is lost
        layOut();
        const std::vector<InputEvent> events = window_.input().takeFrame(state_.keysWait());
        for (const InputEvent& event : events)
            if (!heardAt_) heardAt_ = event.heardSeconds;
        learnLetters();
        state_.isCancellable = isCancellable(); // according to the progress box on screen
        noteBackground();
        gui_.beginFrame(events);
        controls_.handle(events, state_, area_, {gui_.wantsMouse(), gui_.wantsKeyboard()});
        state_.loadingEnvironment = document_.loadingEnvironment();
        for (int side = 0; side < 2; ++side) facts_.shown[std::size_t(side)] = screen_.shownLook(side);
        drawInterface(state_, facts_, area_, uiScale());
        gui_.endFrame();
        screen_.takeEdits();
        serveRequests();
        document_.nameWindow();
        advance(started);
        expireNotice();
        // More input is pending: its result gets an image, intermediate steps only every kHurrySeconds.
        if (!window_.input().empty() && started - shownAt_ < kHurrySeconds) return;
        const int givenUp = drawing_.givenUp();
        const gpu::Rectangle place = areaPixels();
        const bool drew = drawing_.update({place.width, place.height});
        // The next frame, which processes the pending input, begins at once. This one has nothing new to show.
        if (drawing_.gaveUpAtRest()) return;
        attempt([this] {
            if (screen_.renderer() &&
                measurements_.update(facts_, state_, screen_, drawing_.wanted(), drawing_.isWhole()))
                pulse_.another();
        });
        attempt([this] {
            screen_.colorCounts(
                [this](int side, frame::DebugView view) { return countColorsLog2(state_, facts_, side, view); });
        });
        attempt([this] {
            if (!inspector_.update(facts_, state_, screen_, drawing_.pictures(),
                                   drawing_.isSettled() && now() >= pulse_.restAt))
                return;
            pulse_.another();
            if (facts_.inspection && facts_.inspection->isSurfaceKnown)
                log_.line(fmt::format("inspected {}", fmt::join(inspectionLines(*facts_.inspection), "; ")));
        });
        const bool isAtRest = !drew && drawing_.isSettled() && now() >= pulse_.restAt;
        const auto givesUp = [this] {
            window_.poll();
            return window_.shouldClose() || window_.hasActivity() || notedEnd() != 0;
        };
        attempt([this] {
            if (!state_.wantsThumbnails || !facts_.thumbnails.empty()) return;
            facts_.thumbnails = thumbnails_.textures();
            pulse_.another();
        });
        attempt([&] {
            if (!capture_.update(facts_, state_, screen_, drawing_.wanted(), isAtRest, givesUp)) return;
            pulse_.another();
            if (facts_.resource) log_.line("captured " + facts_.resource->contents->text());
        });
        attempt([&] {
            if (!outline_.update(facts_, state_, screen_, drawing_.wanted().looks[0], isAtRest, givesUp)) return;
            pulse_.another();
            if (const auto& found = facts_.materialOutline)
                log_.line("outlined " + state_.open->scene().materials[std::size_t(found->material)].name);
        });
        show();
        drawing_.setDescribed(!drew);
        if (facts_.isPreparing || facts_.isDiffusing || drawing_.givenUp() > givenUp)
            return; // the image that answers the input is still to come
        const std::optional<double> heardAt = std::exchange(heardAt_, std::nullopt);
        if (heardAt && drew) log_.line(fmt::format("answered ms {:.1f}", 1000.0 * (shownAt_ - *heardAt)));
    }

    /// Adds glyphs for names of files and in scenes, which may be in any language.
    void learnLetters() {
        const TextVisitor learn = [this](std::string_view text) { gui_.learn(text); };
        visitShownText(state_, learn);
        const std::pair<const OpenScene*, std::string> now(state_.open.get(),
                                                           state_.open ? state_.open->source() : std::string());
        if (state_.open && learned_ != now) visitSceneText(*state_.open, learn);
        learned_ = now;
    }

    /// Screen coordinates per unit of the user interface; 1 on a display of standard density.
    float uiScale() const { return gui_.scale(); }

    void layOut() {
        area_ = pictureArea(state_, window_.sizeScreen(), uiScale());
        state_.pictureAspect = area_.size.y > 0.0f ? double(area_.size.x) / double(area_.size.y) : 1.0;
    }

    /// The viewport in pixels, from the lower left.
    gpu::Rectangle areaPixels() const { return inPixels(area_.corner, area_.size); }

    /// Converts a rectangle of the window from screen coordinates, counted from the upper left, to pixels.
    gpu::Rectangle inPixels(const glm::vec2& cornerScreen, const glm::vec2& sizeScreen) const {
        const glm::vec2 density = glm::vec2(window_.sizePixels()) / glm::max(glm::vec2(window_.sizeScreen()), 1.0f);
        const glm::ivec2 corner = glm::round(cornerScreen * density);
        const glm::ivec2 size = glm::round(sizeScreen * density);
        return {corner.x, window_.sizePixels().y - corner.y - size.y, size.x, size.y};
    }

    void serveRequests() {
        const Requests requests = std::exchange(state_.requests, {});
        attempt([&] {
            if (requests.answer) document_.take(*requests.answer);
        });
        attempt([&] {
            if (requests.open) document_.open(*requests.open);
        });
        attempt([&] {
            if (requests.chosen) document_.openFile(*requests.chosen);
        });
        if (requests.showOpenDialog) document_.showOpenDialog();
        attempt([&] {
            if (requests.variant) document_.openVariant(*requests.variant);
        });
        attempt([&] {
            if (requests.environment) document_.chooseEnvironment(*requests.environment);
        });
        attempt([&] {
            if (requests.clip && state_.open) chooseClip(state_, *requests.clip);
        });
        attempt([&] { serveSceneRequests(requests); });
        attempt([&] {
            if (requests.reloadShaders) reloadShaders(true);
        });
        if (requests.cancel && isCancellable()) cancel();
        if (requests.resume) drawing_.resume();
        if (requests.quit) window_.close();
    }

    void serveSceneRequests(const Requests& requests) {
        const gpu::Rectangle place = areaPixels();
        if (!state_.open || place.width < 1 || place.height < 1) return;
        const glm::ivec2 size(place.width, place.height);
        if (requests.savePng) document_.savePicture(size, ".png");
        if (requests.saveExr) document_.savePicture(size, ".exr");
        if (requests.saveScene) document_.saveScene();
        if (requests.showSaveDialog) document_.showSaveDialog(saver_.freeName(".json"));
        if (requests.saveAs) document_.saveAs(*requests.saveAs, size);
        if (requests.saveTrace) saver_.trace();
        if (requests.copyCommand) document_.copyCommand(size);
        if (requests.addLight) addLight(state_, screen_.meanLuminance());
        if (facts_.inspection && state_.inspectedPlace()) keepInspection(requests);
        if (requests.scatter) replaceByScattered(state_);
        if (requests.pick) log_.line("picked " + selectMaterialAt(state_, *requests.pick, size));
        if (requests.turnAbout && turnAboutPlace(state_, *requests.turnAbout, size)) log_.line("turns about a surface");
        if (!requests.measureLights) return;
        Look look = state_.active();
        look.settings.sizePixels = size;
        measurements_.judgeLights(facts_, screen_, look);
    }

    void keepInspection(const Requests& requests) {
        const std::vector<std::string> lines = inspectionLines(*facts_.inspection);
        keepPin(state_.pins, *state_.inspectedPlace(), lines, requests.pinInspection);
        if (requests.pinInspection) log_.line("pinned " + lines.front());
        if (!requests.copyInspection) return;
        window_.setClipboard(fmt::format("{}", fmt::join(lines, "\n")));
        state_.notice = {"Copied the values of pixel " + lines.front(), false};
    }

    /// Advances animations and damped movements.
    void advance(double started) {
        const double step = std::clamp(started - lastFrame_, 0.0, kLongestStepSeconds);
        lastFrame_ = started;
        if (!state_.open) return;
        if (!state_.open->rig().isAtRest() && area_.size.y >= 1.0f) {
            state_.open->rig().advance(step, area_.size.y);
            state_.open->applyRig();
        }
        state_.noteSelection();
        passTime(state_, step);
        state_.shareSettings();
        attempt([this] {
            if (state_.open->showTime(state_.active().settings.timeSeconds)) screen_.takeEdits();
        });
    }

    /// Removes messages after a while. Errors stay until dismissed.
    void expireNotice() {
        if (state_.notice.text != said_) {
            said_ = state_.notice.text;
            saidUntil_ = now() + kNoticeSeconds;
            pulse_.settle(); // its layout has changed
        } else if (isNoticeOver()) {
            state_.notice = {};
            pulse_.another();
        }
    }
    bool isNoticeOver() const { return !state_.notice.text.empty() && !state_.notice.isError && now() >= saidUntil_; }

    void show() {
        attempt([this] {
            if (state_.compare == Compare::Difference)
                screen_.prepareDifference(state_.amplification * std::exp2(state_.active().settings.exposureEV));
        });
        paint();
        present();
        shownAt_ = now();
    }

    /// Draws the images, and the interface with its latest layout.
    void paint() {
        const glm::ivec2 pixels = window_.sizePixels();
        screen_.show(pixels, areaPixels(), state_.compare, state_.divider, state_.magnification);
        if (const std::optional<glm::vec2> place = state_.inspectedPlace()) {
            for (const Loupe& loupe : state_.loupes)
                screen_.magnify(loupe.side, *place, inPixels(loupe.corner, glm::vec2(loupe.size)));
            gpu::bindWindowFramebuffer(pixels.x, pixels.y); // disables the scissor test
        }
        gui_.draw();
    }

    void present() {
        gpu::throwIfFailed("while the window was drawn");
        window_.context().debugLog().takeWarnings(); // advice on performance, ignored here
        window_.context().swapBuffers();
    }

    EventLog log_;
    Window window_;
    Gui gui_;
    State state_;
    Screen screen_; ///< declared after the state: destroyed before the scene it draws
    Controls controls_;
    Facts facts_;
    PictureArea area_;
    Pulse pulse_;
    double lastFrame_ = 0.0;
    double shownAt_ = 0.0;
    std::optional<double> heardAt_; ///< arrival time of the oldest input whose result is not yet shown
    double nextShaderLook_ = 0.0;
    double backgroundShownAt_ = 0.0;                   ///< when load progress is shown next
    std::pair<const OpenScene*, std::string> learned_; ///< the scene whose glyphs are loaded, and its file
    std::string said_;                                 ///< the latest notice
    double saidUntil_ = 0.0;
    PictureDrawing drawing_;
    Saver saver_;
    Measurements measurements_;
    Inspector inspector_;
    MaterialOutline outline_;
    ResourceCapture capture_;
    SceneThumbnails thumbnails_;
    Document document_; ///< declared last: its threads end before the window that they wake
};

} // namespace

void runViewer(const ViewerOptions& options) {
    Viewer(options).run();
}

} // namespace tessera::viewer
