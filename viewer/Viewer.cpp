#include "viewer/Viewer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/EndRequest.h"
#include "base/Extension.h"
#include "renderer/frame/EnvironmentCache.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/Debug.h"
#include "viewer/panels/Frame.h"
#include "viewer/save/Recovery.h"
#include "viewer/save/Saver.h"
#include "viewer/session/DrawnLook.h"
#include "viewer/session/EnvironmentJob.h"
#include "viewer/session/Playback.h"
#include "viewer/session/PointAt.h"
#include "viewer/session/SceneEdits.h"
#include "viewer/session/SceneSource.h"
#include "viewer/session/SceneSwitch.h"
#include "viewer/show/Inspector.h"
#include "viewer/show/Measurements.h"
#include "viewer/window/Gui.h"

namespace tessera::viewer {
namespace {

constexpr double kRestSeconds = 0.15;        ///< without input or movement, after which the picture is drawn whole
constexpr double kShaderPeriodSeconds = 0.5; ///< how often the shader folder is looked at
constexpr double kLongestStepSeconds = 0.25; ///< of movements: a compile in between is no reason to fly away
constexpr double kNoticeSeconds = 6.0;
constexpr double kHurrySeconds = 0.05; ///< between pictures while input waits
constexpr double kKeepSeconds = 3.0;   ///< at rest, after which edits are kept in a file
/// Between writings of that file, for the time that the latest took: they take a twentieth of the time at most.
constexpr double kKeepShare = 20.0;
constexpr double kFailedKeepSeconds = 60.0; ///< until it is tried again
/// How often a signal to end is looked for while there are edits to keep before.
constexpr double kEndPeriodSeconds = 0.25;
/// Frames after the last event in which the user interface may still change: a list that opens is measured in one
/// frame and laid out in the next.
constexpr int kSettleFrames = 3;

/// Beside the settings.
std::optional<std::filesystem::path> recoveryFolder(const ViewerOptions& options) {
    if (!options.preferencesFile) return std::nullopt;
    return options.preferencesFile->parent_path() / "recovery";
}

glm::ivec2 windowSize(const ViewerOptions& options) {
    if (!options.pictureSize) return options.windowSize;
    return windowSizeFor(*options.pictureSize, options.preferences.showsPanel);
}

class Viewer {
public:
    explicit Viewer(const ViewerOptions& options)
        : options_(options), log_(options.log), window_(windowSize(options)), gui_(window_), screen_(window_.context()),
          saver_(state_, screen_, log_), recovery_(recoveryFolder(options)), measurements_([] { Window::wake(); }),
          environments_([] { Window::wake(); }), scenes_(options, state_, log_, [] { Window::wake(); }) {
        facts_.renderer = window_.context().capabilities().renderer;
        state_.firstWindowSize = window_.sizeScreen();
        layOut();
        scenes_.open(options.scene, options.load);
        if (const auto left = recovery_.left()) {
            state_.question = {Question::About::Recovering, left->string()};
            log_.line("edits were left in " + left->string());
        }
    }
    ~Viewer() { holdEnd(false); }

    void run() {
        try {
            while (!isLeaving()) {
                window_.wait(idleSeconds());
                if (notedEnd() != 0) return endNow();
                if (isLeaving()) break;
                attempt([this] { watchShaders(); });
                if (isDue()) frame();
                holdEnd(hasEdits());
                attempt([this] { keepEdits(); });
            }
        } catch (...) {
            endWithEdits();
            throw;
        }
        recovery_.forget();
        scenes_.remember(window_.sizeScreen());
        log_.line("closed");
    }

private:
    // ---- When to draw ----
    double now() const { return Window::nowSeconds(); }
    bool isMoving() const { return state_.open && (!state_.open->rig().isAtRest() || plays(state_)); }
    bool isWhole() const { return !state_.open || screen_.scaleOf(wanted_) >= restScale(); }
    /// Whether light is left to spread over what other cameras see; while one is flown nobody waits for it.
    bool lacksLight() const {
        return state_.open && screen_.shows(wanted_) && screen_.lacksLight(wanted_, Screen::Reach::All);
    }
    bool awaitsRest() const { return !isWhole() || lacksLight() || inspector_.awaitsRest(); }
    double restScale() const { return state_.automaticScale ? 1.0 : double(state_.fixedScale); }
    double movingScale() const { return state_.automaticScale ? screen_.movingScale() : double(state_.fixedScale); }
    /// A minimised window shows nothing; a pending picture waits.
    bool isVisible() const {
        const glm::ivec2 pixels = window_.sizePixels();
        return !window_.isMinimised() && pixels.x > 0 && pixels.y > 0;
    }
    bool hasPicturePlace() const { return isVisible() && areaPixels().width > 0 && areaPixels().height > 0; }
    bool isDue() const {
        if (window_.hasActivity() || scenes_.hasResult() || environments_.hasResult() || settleFrames_ > 0) return true;
        if (isVisible() && (!window_.input().empty() || measurements_.hasResult() || isNoticeOver())) return true;
        return hasPicturePlace() && (isMoving() || inspector_.isBusy() || (awaitsRest() && now() >= restAt_));
    }
    /// How long nothing needs to happen; negative: until something does.
    double idleSeconds() const {
        if (isDue() || notedEnd() != 0) return 0.0;
        double seconds = -1.0;
        const auto atMost = [&](double most) { seconds = seconds < 0.0 ? most : std::min(seconds, most); };
        if (awaitsRest() && hasPicturePlace()) atMost(std::max(restAt_ - now(), 0.0));
        if (isVisible() && !state_.notice.text.empty() && !state_.notice.isError)
            atMost(std::max(saidUntil_ - now(), 0.0));
        if (screen_.renderer() && !screen_.renderer()->programs().tree().isEmbedded()) atMost(kShaderPeriodSeconds);
        if (hasEdits()) atMost(kEndPeriodSeconds);
        if (state_.open && recovery_.isBehind(*state_.open)) atMost(std::max(keepAt() - now(), 0.0));
        return seconds;
    }

    // ---- Edits that are not saved ----
    bool hasEdits() const { return state_.open && state_.open->isEdited(); }
    double keepAt() const { return std::max(restAt_ + kKeepSeconds, nextKeepAt_); }
    /// Keeps them for the case that the program ends unasked; while nobody waits for a picture, and not too often.
    void keepEdits() {
        if (!state_.open || !recovery_.isBehind(*state_.open) || now() < keepAt()) return;
        const double started = now();
        nextKeepAt_ = started + kFailedKeepSeconds;
        recovery_.keep(*state_.open);
        nextKeepAt_ = now() + kKeepShare * (now() - started);
    }
    /// The program ends, and nobody can be asked any more.
    void endWithEdits() {
        try {
            if (state_.open) recovery_.keep(*state_.open);
        } catch (const std::exception& error) {
            options_.warn(error.what());
        }
        scenes_.remember(window_.sizeScreen());
    }
    void endNow() {
        endWithEdits();
        endAsNoted();
    }

    // ---- Scenes ----
    bool isLeaving() {
        if (!window_.shouldClose()) return false;
        if (isDiscarding_ || mayLeave({Question::About::Quitting, {}})) return true;
        window_.keepOpen();
        return false;
    }

    /// Edits that are not saved are left behind only by an answer.
    bool mayLeave(const Question& question) {
        if (!hasEdits()) return true;
        state_.question = question;
        settleFrames_ = kSettleFrames;
        log_.line("edits are not saved");
        return false;
    }

    void open(const std::string& source) {
        if (mayLeave({Question::About::Opening, source})) load(source);
    }

    /// Reads the open scene again: its materials and pictures are others.
    void openVariant(const std::string& variant) {
        if (!state_.open) return;
        const Question question{Question::About::Opening, state_.open->source(), variant};
        if (mayLeave(question)) load(question.scene, question.variant);
    }

    /// Opens a scene in the place of this one, with its edits until then; or this one again, in a variant.
    void load(const std::string& source, const std::optional<std::string>& variant = {}) {
        editsLeft_ = state_.open ? state_.open->edits() : 0;
        loadingVariant_ = variant;
        scenes::LoadOptions load;
        if (variant && state_.open) {
            load = state_.open->load();
            load.import.variant = variant->empty() ? std::nullopt : variant;
        }
        scenes_.open(source, load);
    }

    void take(Answer answer) {
        const std::optional<Question> question = std::exchange(state_.question, std::nullopt);
        settleFrames_ = kSettleFrames;
        if (!question || answer == Answer::Cancel) return;
        if (question->about == Question::About::Recovering) {
            if (answer == Answer::Discard) return Recovery::discard(question->scene);
            recovering_ = question->scene;
            return load(recovering_);
        }
        if (answer == Answer::Keep) saver_.scene(); // where that fails nothing else happens
        if (question->about == Question::About::Opening) return load(question->scene, question->variant);
        isDiscarding_ = true;
        window_.close();
    }

    void adoptLoaded() {
        // The user was not asked about edits made during the load.
        const bool hasNewEdits = state_.open && state_.open->edits() != editsLeft_;
        if (scenes_.hasScene() && hasNewEdits && !mayLeave({Question::About::Opening, state_.loading, loadingVariant_}))
            return scenes_.discard();
        std::unique_ptr<OpenScene> scene = scenes_.take([this](const OpenScene& loaded) { screen_.open(loaded); });
        if (!scene) return;
        measurements_.clear(facts_);
        facts_.shadows = {};
        state_.timings.clear();
        environments_.discard(); // it was chosen for the scene before
        // What was asked about the edits of the scene before is settled.
        if (state_.question && state_.question->about != Question::About::Recovering) state_.question.reset();
        recovery_.forget();
        attempt([&] { adoptRecovered(*scene); });
        state_.open = std::move(scene);
    }

    /// Edits that were left are now this window's, and still not saved.
    void adoptRecovered(OpenScene& scene) {
        if (std::exchange(recovering_, {}) != scene.source()) return;
        scene.markUnsaved();
        std::erase(state_.recent, identityOf(scene.source()));
        const std::filesystem::path left = scene.source();
        recovery_.keep(scene);
        Recovery::discard(left);
        log_.line("recovered " + left.string());
    }

    static bool isEnvironmentFile(const std::string& file) {
        const std::string extension = extensionOf(file);
        return extension == ".hdr" || extension == ".exr";
    }

    /// For the scene that is open.
    void chooseEnvironment(const std::string& name) {
        if (!state_.open)
            throw std::runtime_error("there is no scene yet for " + name + " to surround; open one first");
        environments_.start(name);
        log_.line("loading environment " + name);
    }

    void adoptEnvironment() {
        std::optional<ChosenEnvironment> chosen = environments_.take();
        if (!chosen) return;
        if (!chosen->error.empty()) throw std::runtime_error(chosen->error);
        if (!chosen->warnings.empty()) state_.notice = {fmt::format("{}", fmt::join(chosen->warnings, "; ")), false};
        log_.line("environment " + chosen->name);
        state_.open->takeEnvironment(std::move(*chosen));
        settleFrames_ = kSettleFrames;
    }

    /// The title says which scene is open, and whether it has edits that were not saved.
    void nameWindow() {
        if (!state_.open) return;
        const std::string name = std::filesystem::path(state_.open->source()).filename().string();
        const std::string title = fmt::format("Tessera - {}{}", name, state_.open->isEdited() ? " *" : "");
        if (title != title_) window_.setTitle(title);
        title_ = title;
    }

    /// What goes wrong is shown, and the window goes on.
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
        settleFrames_ = kSettleFrames;
        log_.line("error " + text);
    }

    // ---- Shaders ----
    void watchShaders() {
        if (!screen_.renderer() || now() < nextShaderLook_) return;
        nextShaderLook_ = now() + kShaderPeriodSeconds;
        if (screen_.renderer()->programs().sourcesChanged()) reloadShaders();
    }

    void reloadShaders() {
        if (!screen_.renderer()) return;
        state_.shaderFaults = screen_.renderer()->programs().reload();
        // Programs that share a file share its faults.
        std::sort(state_.shaderFaults.begin(), state_.shaderFaults.end());
        state_.shaderFaults.erase(std::unique(state_.shaderFaults.begin(), state_.shaderFaults.end()),
                                  state_.shaderFaults.end());
        for (const std::string& fault : state_.shaderFaults) log_.line("shader error " + fault);
        if (state_.shaderFaults.empty()) log_.line("shaders reloaded");
        screen_.forget();
        settleFrames_ = kSettleFrames;
    }

    // ---- A frame ----
    void frame() {
        const double started = now();
        if (window_.takeActivity() || !window_.input().empty()) {
            settleFrames_ = kSettleFrames;
            restAt_ = started + kRestSeconds;
        }
        settleFrames_ = std::max(settleFrames_ - 1, 0);
        attempt([this] { adoptLoaded(); });
        attempt([this] { adoptEnvironment(); });
        if (std::string fault = frame::takeCacheFault(); !fault.empty()) {
            log_.line("note " + fault);
            if (!state_.notice.isError) state_.notice = {std::move(fault), false};
        }
        for (const std::string& file : window_.takeDrops())
            (isEnvironmentFile(file) ? state_.requests.environment : state_.requests.open) = file;
        if (!isVisible()) return; // input waits, so that no key that is let go is missed
        layOut();
        const std::vector<InputEvent> events = window_.input().takeFrame();
        for (const InputEvent& event : events)
            if (!heardAt_) heardAt_ = event.heardSeconds;
        gui_.beginFrame(events);
        controls_.handle(events, state_, area_, {gui_.wantsMouse(), gui_.wantsKeyboard()});
        state_.loadingEnvironment = environments_.choice();
        for (int side = 0; side < 2; ++side) facts_.shown[std::size_t(side)] = screen_.shownLook(side);
        drawInterface(state_, facts_, area_, uiScale());
        gui_.endFrame();
        screen_.takeEdits();
        serveRequests();
        nameWindow();
        advance(started);
        expireNotice();
        // More input waits: its result gets a picture, its single steps only now and then.
        if (!window_.input().empty() && started - shownAt_ < kHurrySeconds) return;
        const int givenUp = givenUp_;
        const bool drew = drawPictures();
        attempt([this] {
            if (screen_.renderer() && measurements_.update(facts_, state_, screen_, wanted_, isWhole()))
                settleFrames_ = std::max(settleFrames_, 1);
        });
        attempt([this] {
            if (!inspector_.update(facts_, state_, screen_, frames_, isWhole() && now() >= restAt_)) return;
            settleFrames_ = std::max(settleFrames_, 1);
            if (facts_.inspection && facts_.inspection->isSurfaceKnown)
                log_.line(fmt::format("inspected {}", fmt::join(inspectionLines(*facts_.inspection), "; ")));
        });
        show();
        isDescribed_ = !drew;
        if (facts_.isPreparing || facts_.isSpreading || givenUp_ > givenUp)
            return; // the picture that answers is yet to come
        const std::optional<double> heardAt = std::exchange(heardAt_, std::nullopt);
        if (heardAt && drew) log_.line(fmt::format("answered ms {:.1f}", 1000.0 * (shownAt_ - *heardAt)));
    }

    /// Screen coordinates, the units of the user interface, for one of a display of usual density.
    float uiScale() const { return gui_.scale(); }

    void layOut() {
        area_ = pictureArea(state_, window_.sizeScreen(), uiScale());
        state_.pictureAspect = area_.size.y > 0.0f ? double(area_.size.x) / double(area_.size.y) : 1.0;
    }

    /// The picture's place in pixels, from the lower left.
    gpu::Rectangle areaPixels() const { return inPixels(area_.corner, area_.size); }

    /// A part of the window, given in screen coordinates from the upper left.
    gpu::Rectangle inPixels(const glm::vec2& cornerScreen, const glm::vec2& sizeScreen) const {
        const glm::vec2 density = glm::vec2(window_.sizePixels()) / glm::max(glm::vec2(window_.sizeScreen()), 1.0f);
        const glm::ivec2 corner = glm::round(cornerScreen * density);
        const glm::ivec2 size = glm::round(sizeScreen * density);
        return {corner.x, window_.sizePixels().y - corner.y - size.y, size.x, size.y};
    }

    void serveRequests() {
        const Requests requests = std::exchange(state_.requests, {});
        attempt([&] {
            if (requests.answer) take(*requests.answer);
        });
        attempt([&] {
            if (requests.open) open(*requests.open);
        });
        attempt([&] {
            if (requests.variant) openVariant(*requests.variant);
        });
        attempt([&] {
            if (requests.environment) chooseEnvironment(*requests.environment);
        });
        attempt([&] {
            if (requests.clip && state_.open) chooseClip(state_, *requests.clip);
        });
        attempt([&] { serveSceneRequests(requests); });
        attempt([&] {
            if (requests.reloadShaders) reloadShaders();
        });
        if (requests.quit) window_.close();
    }

    void serveSceneRequests(const Requests& requests) {
        const gpu::Rectangle place = areaPixels();
        if (!state_.open || place.width < 1 || place.height < 1) return;
        const glm::ivec2 size(place.width, place.height);
        if (requests.savePng) saver_.picture(size, ".png");
        if (requests.saveExr) saver_.picture(size, ".exr");
        if (requests.saveScene) saver_.scene();
        if (requests.saveTrace) saver_.trace();
        if (requests.copyCommand) copyCommand(size);
        if (requests.scatter) replaceByScattered(state_);
        if (requests.pick) log_.line("picked " + selectMaterialAt(state_, *requests.pick, size));
        if (requests.turnAbout && turnAboutPlace(state_, *requests.turnAbout, size)) log_.line("turns about a surface");
        if (!requests.measureLights) return;
        Look look = state_.active();
        look.settings.sizePixels = size;
        measurements_.judgeLights(facts_, screen_, look);
    }

    void copyCommand(glm::ivec2 size) {
        state_.command = saver_.command(size);
        window_.setClipboard(state_.command);
        state_.notice = {"Copied: " + state_.command, false};
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

    /// Messages disappear after a while, errors when they are dismissed.
    void expireNotice() {
        if (state_.notice.text != said_) {
            said_ = state_.notice.text;
            saidUntil_ = now() + kNoticeSeconds;
            settleFrames_ = kSettleFrames; // it is laid out anew
        } else if (isNoticeOver()) {
            state_.notice = {};
            settleFrames_ = std::max(settleFrames_, 1);
        }
    }
    bool isNoticeOver() const { return !state_.notice.text.empty() && !state_.notice.isError && now() >= saidUntil_; }

    /// Draws changed pictures: at reduced resolution while something moves, at full resolution at rest. Returns whether
    /// it drew.
    bool drawPictures() {
        const gpu::Rectangle place = areaPixels();
        const bool wasAnnounced = facts_.isPreparing || facts_.isSpreading;
        facts_.isPreparing = facts_.isSpreading = false;
        const bool wasSpreading = std::exchange(facts_.spreading, std::nullopt).has_value();
        if (wasSpreading) settleFrames_ = std::max(settleFrames_, 1); // until the line says so no more
        if (!wasAnnounced) announcements_ = 0;
        if (!state_.open || place.width < 1 || place.height < 1) return false;
        wanted_.looks = {drawnLook(state_, 0), drawnLook(state_, 1)};
        for (Look& look : wanted_.looks) look.settings.sizePixels = {place.width, place.height};
        wanted_.sides = state_.sides();
        if (wanted_.sides == 1) wanted_.looks[1] = wanted_.looks[0];
        wanted_.keepsRadiance = state_.compare != Compare::Off || state_.inspects;
        wanted_.sceneRevision = state_.open->revision();
        wanted_.sceneEdits = state_.open->edits();
        const double have = screen_.scaleOf(wanted_);
        const bool isAtRest = !isMoving() && now() >= restAt_ && have > 0.0;
        if (have >= restScale() && isAtRest && screen_.lacksLight(wanted_, Screen::Reach::All))
            return spreadSlice(Screen::Reach::All);
        if (have >= restScale() || (have > 0.0 && have >= movingScale() && isMoving())) return false;
        if (have > 0.0 && !isAtRest) return false;
        if (isAtRest && !isDescribed_) return false; // the whole picture may take long: say first what this one is
        if (isAtRest && screen_.lacksLight(wanted_, Screen::Reach::Seen)) return spreadSlice(Screen::Reach::Seen);
        if (have == 0.0) restAt_ = now() + kRestSeconds;
        // A scale that is fixed is that of all pictures: none is better.
        const Screen::Stay stay = isAtRest || !state_.automaticScale ? Screen::Stay::Stays : Screen::Stay::Passes;
        if (isToBeAnnounced(stay)) return false;
        return drawAt(isAtRest ? restScale() : movingScale(), stay, isAtRest);
    }

    /// Draws no picture, but has light for the next one; the line below the picture says how far it is.
    bool spreadSlice(Screen::Reach reach) {
        attempt([&] {
            const engine::SpreadProgress progress = screen_.spreadSlice(wanted_, reach);
            if (progress.isDone())
                log_.line(progress.isOfAll ? "spread light everywhere" : "spread light in view");
            else
                facts_.spreading = progress;
        });
        return false;
    }

    /// Before the first picture of a kind, and before one that stays for which light is spread anew, the window shows
    /// for one frame why it will wait.
    bool isToBeAnnounced(Screen::Stay stay) {
        constexpr int kFrames = 2; // the interface of this frame is laid out already
        if (announcements_ >= kFrames) return false;
        facts_.isPreparing = screen_.isNewKind(wanted_);
        facts_.isSpreading = !facts_.isPreparing && stay == Screen::Stay::Stays && screen_.spreadsAnew(wanted_);
        if (!facts_.isPreparing && !facts_.isSpreading) return false;
        ++announcements_;
        settleFrames_ = std::max(settleFrames_, 1);
        return true;
    }

    /// Whether something came while a picture is drawn that is more urgent. A picture of moving things is worth having
    /// though they have moved on. The whole one is not; but a pointer that only wanders may give it up twice at most.
    bool isInterrupted(bool isAtRest) {
        constexpr int kWanderings = 2;
        window_.poll();
        if (window_.shouldClose() || window_.input().isUrgent() || notedEnd() != 0) return true;
        return isAtRest && window_.hasActivity() && (window_.isButtonHeld() || givenUp_ < kWanderings);
    }

    bool drawAt(double scale, Screen::Stay stay, bool isAtRest) {
        const bool mayGiveUp = isAtRest || screen_.isSlow(wanted_);
        const auto givesUp = [this, isAtRest] { return isInterrupted(isAtRest); };
        const double startedAt = now();
        try {
            Screen::Drawn drawn =
                screen_.draw(wanted_, scale, stay, mayGiveUp ? std::function<bool()>(givesUp) : nullptr);
            if (drawn.gaveUp) {
                ++givenUp_;
                log_.line(fmt::format("gave up scale {:.4g}", scale));
                return false;
            }
            givenUp_ = 0;
            facts_.ms = drawn.ms;
            facts_.scale = drawn.scale;
            facts_.sizePixels = drawn.sizePixels;
            facts_.shadows = std::move(drawn.shadows);
            facts_.targetBytes = screen_.renderer()->backend().poolBytes();
            ++frames_;
            for (int side = 0; side < wanted_.sides; ++side)
                state_.timings.add({frames_, 1000.0 * startedAt, drawn.sideMs[std::size_t(side)], drawn.scale, side,
                                    drawn.passes[std::size_t(side)]});
            settleFrames_ = std::max(settleFrames_, 1); // the figures of this frame are shown by the next
            if (state_.notice.isError && state_.notice.text == drawingFault_) state_.notice = {};
            note(missingTextures_, std::move(drawn.missingTextures));
            if (drawn.unseenSpread) note(unseenSpread_, std::move(*drawn.unseenSpread));
            const Look& look = wanted_.looks[0];
            log_.line(fmt::format("drawn {} scale {:.4g} size {}x{} ms {:.1f} technique {} view {}", frames_,
                                  drawn.scale, drawn.sizePixels.x, drawn.sizePixels.y, drawn.ms,
                                  infoOf(look.technique).name, frame::debugViewInfo(look.settings.view).name));
            return true;
        } catch (const std::exception& error) {
            drawingFault_ = error.what();
            fail(drawingFault_);
            return false;
        }
    }

    /// Says what a picture lacks where the one before did not.
    void note(std::string& said, std::string lacks) {
        if (lacks == said) return;
        said = std::move(lacks);
        if (!said.empty() && !state_.notice.isError) state_.notice = {said, false};
    }

    void show() {
        const glm::ivec2 pixels = window_.sizePixels();
        attempt([this] {
            if (state_.compare == Compare::Difference)
                screen_.prepareDifference(state_.amplification * std::exp2(state_.active().settings.exposureEV));
        });
        screen_.show(pixels, areaPixels(), state_.compare, state_.divider);
        if (const std::optional<glm::vec2> place = state_.inspectedPlace()) {
            for (const Loupe& loupe : state_.loupes)
                screen_.magnify(loupe.side, *place, inPixels(loupe.corner, glm::vec2(loupe.size)));
            gpu::bindWindowFramebuffer(pixels.x, pixels.y); // without the scissor
        }
        gui_.draw();
        gpu::throwIfFailed("while the window was drawn");
        window_.context().debugLog().takeWarnings(); // advice on performance, ignored here
        window_.context().swapBuffers();
        shownAt_ = now();
    }

    const ViewerOptions& options_;
    EventLog log_;
    Window window_;
    Gui gui_;
    State state_;
    Screen screen_; ///< after the state, whose scene it draws
    Controls controls_;
    Facts facts_;
    PictureArea area_;
    Screen::Wanted wanted_;
    int settleFrames_ = kSettleFrames;
    double restAt_ = 0.0;
    bool isDescribed_ = true; ///< the window has shown the figures of the latest picture with it
    double lastFrame_ = 0.0;
    double shownAt_ = 0.0;
    std::optional<double> heardAt_; ///< of the oldest input of which nothing was shown yet
    double nextShaderLook_ = 0.0;
    std::uint64_t frames_ = 0;
    int announcements_ = 0; ///< frames for which the next picture has been announced
    int givenUp_ = 0;       ///< pictures since the latest that was drawn
    std::string title_;
    std::string recovering_; ///< the file of edits that is being opened
    double nextKeepAt_ = 0.0;
    bool isDiscarding_ = false;                  ///< the window closes without another question
    std::uint64_t editsLeft_ = 0;                ///< of the open scene, when the one that is loading was asked for
    std::optional<std::string> loadingVariant_;  ///< of load()
    std::string said_;                           ///< the latest notice
    std::string drawingFault_;                   ///< why the latest picture that failed did
    std::string missingTextures_, unseenSpread_; ///< of the latest picture; a notice has said so
    double saidUntil_ = 0.0;
    Saver saver_;
    Recovery recovery_;
    Measurements measurements_;
    Inspector inspector_;
    EnvironmentJob environments_;
    SceneSwitch scenes_; ///< last: its thread ends before what it wakes
};

} // namespace

void runViewer(const ViewerOptions& options) {
    Viewer(options).run();
}

} // namespace tessera::viewer
