#include "viewer/Viewer.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/AtomicFile.h"
#include "base/EndRequest.h"
#include "renderer/frame/EnvironmentCache.h"
#include "renderer/gpu/Bands.h"
#include "renderer/gpu/Commands.h"
#include "renderer/gpu/Debug.h"
#include "viewer/panels/Frame.h"
#include "viewer/panels/ProgressBox.h"
#include "viewer/panels/ShownText.h"
#include "viewer/save/Recovery.h"
#include "viewer/save/Saver.h"
#include "viewer/session/EnvironmentJob.h"
#include "viewer/session/FileTypes.h"
#include "viewer/session/Playback.h"
#include "viewer/session/PointAt.h"
#include "viewer/session/SceneEdits.h"
#include "viewer/session/SceneSource.h"
#include "viewer/session/SceneSwitch.h"
#include "viewer/show/Inspector.h"
#include "viewer/show/Measurements.h"
#include "viewer/show/PictureDrawing.h"
#include "viewer/window/Gui.h"

namespace tessera::viewer {
namespace {

constexpr double kShaderPeriodSeconds = 0.5; ///< how often the shader folder is looked at
constexpr double kLongestStepSeconds = 0.25; ///< of movements: a compile in between is no reason to fly away
constexpr double kNoticeSeconds = 6.0;
constexpr double kBackgroundSeconds = 0.25; ///< between what is told of a load
constexpr double kHurrySeconds = 0.05;      ///< between pictures while input waits
constexpr double kKeepSeconds = 3.0;        ///< at rest, after which edits are kept in a file
/// Between writings of that file, for the time that the latest took: they take a twentieth of the time at most.
constexpr double kKeepShare = 20.0;
constexpr double kFailedKeepSeconds = 60.0; ///< until it is tried again
/// How often a signal to end is looked for while there are edits to keep before.
constexpr double kEndPeriodSeconds = 0.25;

/// Beside the settings.
std::optional<std::filesystem::path> recoveryFolder(const ViewerOptions& options) {
    if (!options.preferencesFile) return std::nullopt;
    return options.preferencesFile->parent_path() / "recovery";
}

glm::ivec2 windowSize(const ViewerOptions& options) {
    if (!options.pictureSize) return options.windowSize;
    return windowSizeFor(*options.pictureSize, options.preferences.showsPanel ? options.preferences.panelWidth : 0.0f);
}

class Viewer {
public:
    explicit Viewer(const ViewerOptions& options)
        : options_(options), log_(options.log), window_(windowSize(options)), gui_(window_), screen_(window_.context()),
          drawing_(state_, facts_, screen_, window_, log_, pulse_,
                   {[this](const std::string& text) { fail(text); }, [this] { tellProgress(); }}),
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
    bool awaitsRest() const {
        return !drawing_.isSettled() || drawing_.lacksLight() || drawing_.tellsRate() || inspector_.awaitsRest();
    }
    /// A minimised window shows nothing; a pending picture waits.
    bool isVisible() const {
        const glm::ivec2 pixels = window_.sizePixels();
        return !window_.isMinimised() && pixels.x > 0 && pixels.y > 0;
    }
    bool hasPicturePlace() const { return isVisible() && areaPixels().width > 0 && areaPixels().height > 0; }
    bool isDue() const {
        if (window_.hasActivity() || scenes_.hasResult() || environments_.hasResult() || pulse_.settleFrames > 0)
            return true;
        if (isVisible() && isBackgroundBusy() && now() >= backgroundToldAt_) return true;
        if (isVisible() && (!window_.input().empty() || measurements_.hasResult() || isNoticeOver())) return true;
        return hasPicturePlace() &&
               (isMoving(state_) || inspector_.isBusy() || (awaitsRest() && now() >= pulse_.restAt));
    }
    /// How long nothing needs to happen; negative: until something does.
    double idleSeconds() const {
        if (isDue() || notedEnd() != 0) return 0.0;
        double seconds = -1.0;
        const auto atMost = [&](double most) { seconds = seconds < 0.0 ? most : std::min(seconds, most); };
        if (awaitsRest() && hasPicturePlace()) atMost(std::max(pulse_.restAt - now(), 0.0));
        if (isVisible() && !state_.notice.text.empty() && !state_.notice.isError)
            atMost(std::max(saidUntil_ - now(), 0.0));
        if (isVisible() && isBackgroundBusy()) atMost(std::max(backgroundToldAt_ - now(), 0.0));
        if (screen_.renderer() && !screen_.renderer()->programs().tree().isEmbedded()) atMost(kShaderPeriodSeconds);
        if (hasEdits()) atMost(kEndPeriodSeconds);
        if (state_.open && recovery_.isBehind(*state_.open)) atMost(std::max(keepAt() - now(), 0.0));
        return seconds;
    }

    // ---- What takes long ----
    /// Something is loaded on another thread, of which the window tells how far it is.
    bool isBackgroundBusy() const { return !state_.loading.empty() || !environments_.choice().empty(); }
    void noteBackground() {
        facts_.background.reset();
        backgroundToldAt_ = now() + kBackgroundSeconds;
        const auto nameOf = [](const std::string& source) { return std::filesystem::path(source).filename().string(); };
        if (!state_.loading.empty()) {
            const std::optional<double> share = scenes_.filteredShare();
            const char* const what = share ? "Filtering the environment of" : "Loading";
            facts_.background = {fmt::format("{} {}", what, nameOf(state_.loading)), share, false};
        } else if (const std::string choice = environments_.choice(); !choice.empty()) {
            const std::optional<double> share = environments_.filteredShare();
            facts_.background = {fmt::format("{} {}", share ? "Filtering" : "Loading", nameOf(choice)), share, true};
        }
    }
    bool isCancellable() const {
        const std::optional<Progress>& told = facts_.progress ? facts_.progress : facts_.background;
        return told && told->canCancel;
    }
    void cancel() {
        if (facts_.progress) return drawing_.cancel();
        log_.line("cancelled environment " + environments_.choice());
        environments_.discard();
        pulse_.settle();
    }
    /// In the middle of a picture that takes long.
    void tellProgress() {
        const gpu::BetweenBands between;
        paint();
        gui_.drawOver([this](ImDrawList& list) { drawProgress(*facts_.progress, area_, uiScale(), list); });
        present();
    }

    // ---- Edits that are not saved ----
    bool hasEdits() const { return state_.open && state_.open->isEdited(); }
    double keepAt() const { return std::max(pulse_.restAt + kKeepSeconds, nextKeepAt_); }
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
        pulse_.settle();
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
        pulse_.settle();
        if (!question || answer == Answer::Cancel) return;
        if (question->about == Question::About::Recovering) {
            if (answer == Answer::Discard) return Recovery::discard(question->scene);
            recovering_ = question->scene;
            return load(recovering_);
        }
        if (answer == Answer::Keep && !saveScene()) return; // where that fails nothing else happens
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
        drawing_.resume();
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

    /// A file that was dropped or chosen. Of what is no file that the viewer knows, loading tells why.
    void openFile(const std::string& file) {
        const FileType* const type = fileTypeOf(file);
        if (type != nullptr && type->opens == FileType::Opens::Environment) return chooseEnvironment(file);
        open(file);
    }

    // ---- Files ----
    static std::filesystem::path startFolder() {
        std::error_code error;
        return std::filesystem::current_path(error);
    }

    void askWhatToOpen() {
        const std::vector<std::string> folders = foldersOf(state_.recent);
        std::error_code error;
        const bool hasRecent = !folders.empty() && std::filesystem::is_directory(folders.front(), error);
        state_.files.emplace(FileDialog::Purpose::Open,
                             hasRecent ? std::filesystem::path(folders.front()) : startFolder());
        pulse_.settle();
        log_.line("asks what to open");
    }

    /// With a reason: the folder of the path cannot be written, so another is proposed.
    void askWhereToSave(const std::filesystem::path& path, const std::string& reason = {}) {
        const std::filesystem::path given = path.has_parent_path() ? path.parent_path() : startFolder();
        const std::filesystem::path folder = reason.empty() ? given : homeFolder().value_or(given);
        state_.files.emplace(FileDialog::Purpose::Save, folder, path.filename().string(), reason);
        pulse_.settle();
        if (!reason.empty()) log_.line("error " + reason);
        log_.line("asks where to save");
    }

    /// Asks for another name where no file can be written under this one.
    bool mayWrite(const std::string& path) {
        try {
            requireWritable(path);
            return true;
        } catch (const std::exception& error) {
            askWhereToSave(path, error.what());
            return false;
        }
    }

    /// Whether it was saved, under a free name.
    bool saveScene() {
        const std::string path = saver_.freeName(".json");
        if (!mayWrite(path)) return false;
        saver_.scene(path);
        return true;
    }

    void savePicture(glm::ivec2 size, const char* ending) {
        if (const std::string path = saver_.freeName(ending); mayWrite(path)) saver_.picture(size, path);
    }

    void saveAs(const std::string& path, glm::ivec2 size) {
        if (!mayWrite(path)) return;
        const FileType* const type = fileTypeOf(path);
        if (type != nullptr && type->saves == FileType::Saves::Scene) return saver_.scene(path);
        saver_.picture(size, path);
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
        pulse_.settle();
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
        pulse_.settle();
        log_.line("error " + text);
    }

    // ---- Shaders ----
    void watchShaders() {
        if (!screen_.renderer() || now() < nextShaderLook_) return;
        nextShaderLook_ = now() + kShaderPeriodSeconds;
        if (screen_.renderer()->programs().sourcesChanged()) reloadShaders(false);
    }

    void reloadShaders(bool isAsked) {
        if (!screen_.renderer()) return;
        const shader::Reloading done = screen_.renderer()->programs().reload();
        std::map<std::string, std::vector<std::string>> programs; // by the fault that they share
        for (const shader::ShaderFault& fault : done.faults) {
            std::vector<std::string>& having = programs[fault.text];
            if (!fault.program.empty()) having.push_back(fault.program);
        }
        state_.shaderFaults.clear();
        for (auto& [text, having] : programs) {
            log_.line("shader error " + text);
            state_.shaderFaults.push_back({text, std::move(having)});
        }
        if (programs.empty()) {
            log_.line("shaders reloaded");
            if (done.programs > 0)
                state_.notice = {fmt::format("Shaders reloaded: {} program{} compiled", done.programs,
                                             done.programs == 1 ? "" : "s"),
                                 false};
            else if (isAsked)
                state_.notice = {"Shaders reloaded: nothing has changed in them", false};
        }
        screen_.forget();
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
        attempt([this] { adoptLoaded(); });
        attempt([this] { adoptEnvironment(); });
        if (std::string fault = frame::takeCacheFault(); !fault.empty()) {
            log_.line("note " + fault);
            if (!state_.notice.isError) state_.notice = {std::move(fault), false};
        }
        for (const std::string& file : window_.takeDrops()) {
            state_.files.reset();
            state_.requests.chosen = file;
        }
        if (!isVisible()) return; // input waits, so that no key that is let go is missed
        layOut();
        const std::vector<InputEvent> events = window_.input().takeFrame();
        for (const InputEvent& event : events)
            if (!heardAt_) heardAt_ = event.heardSeconds;
        learnLetters();
        state_.isCancellable = isCancellable(); // by what the window says
        noteBackground();
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
        const int givenUp = drawing_.givenUp();
        const gpu::Rectangle place = areaPixels();
        const bool drew = drawing_.update({place.width, place.height});
        attempt([this] {
            if (screen_.renderer() &&
                measurements_.update(facts_, state_, screen_, drawing_.wanted(), drawing_.isWhole()))
                pulse_.another();
        });
        attempt([this] {
            if (!inspector_.update(facts_, state_, screen_, drawing_.pictures(),
                                   drawing_.isSettled() && now() >= pulse_.restAt))
                return;
            pulse_.another();
            if (facts_.inspection && facts_.inspection->isSurfaceKnown)
                log_.line(fmt::format("inspected {}", fmt::join(inspectionLines(*facts_.inspection), "; ")));
        });
        show();
        drawing_.setDescribed(!drew);
        if (facts_.isPreparing || facts_.isSpreading || drawing_.givenUp() > givenUp)
            return; // the picture that answers is yet to come
        const std::optional<double> heardAt = std::exchange(heardAt_, std::nullopt);
        if (heardAt && drew) log_.line(fmt::format("answered ms {:.1f}", 1000.0 * (shownAt_ - *heardAt)));
    }

    /// Names of files and in scenes may be of any language.
    void learnLetters() {
        const TextVisitor learn = [this](std::string_view text) { gui_.learn(text); };
        visitShownText(state_, learn);
        const std::pair<const OpenScene*, std::string> now(state_.open.get(),
                                                           state_.open ? state_.open->source() : std::string());
        if (state_.open && learned_ != now) visitSceneText(*state_.open, learn);
        learned_ = now;
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
            if (requests.chosen) openFile(*requests.chosen);
        });
        if (requests.askWhatToOpen) askWhatToOpen();
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
        if (requests.savePng) savePicture(size, ".png");
        if (requests.saveExr) savePicture(size, ".exr");
        if (requests.saveScene) saveScene();
        if (requests.askWhereToSave) askWhereToSave(saver_.freeName(".json"));
        if (requests.saveAs) saveAs(*requests.saveAs, size);
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
        if (hasEdits() && !saveScene()) return;
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
            pulse_.settle(); // it is laid out anew
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

    /// The pictures, and the interface as it was laid out last.
    void paint() {
        const glm::ivec2 pixels = window_.sizePixels();
        screen_.show(pixels, areaPixels(), state_.compare, state_.divider);
        if (const std::optional<glm::vec2> place = state_.inspectedPlace()) {
            for (const Loupe& loupe : state_.loupes)
                screen_.magnify(loupe.side, *place, inPixels(loupe.corner, glm::vec2(loupe.size)));
            gpu::bindWindowFramebuffer(pixels.x, pixels.y); // without the scissor
        }
        gui_.draw();
    }

    void present() {
        gpu::throwIfFailed("while the window was drawn");
        window_.context().debugLog().takeWarnings(); // advice on performance, ignored here
        window_.context().swapBuffers();
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
    Pulse pulse_;
    double lastFrame_ = 0.0;
    double shownAt_ = 0.0;
    std::optional<double> heardAt_; ///< of the oldest input of which nothing was shown yet
    double nextShaderLook_ = 0.0;
    double backgroundToldAt_ = 0.0; ///< when it is told next how far that is
    std::string title_;
    std::pair<const OpenScene*, std::string> learned_; ///< the scene whose letters are known, and its file
    std::string recovering_;                           ///< the file of edits that is being opened
    double nextKeepAt_ = 0.0;
    bool isDiscarding_ = false;                 ///< the window closes without another question
    std::uint64_t editsLeft_ = 0;               ///< of the open scene, when the one that is loading was asked for
    std::optional<std::string> loadingVariant_; ///< of load()
    std::string said_;                          ///< the latest notice
    double saidUntil_ = 0.0;
    PictureDrawing drawing_;
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
