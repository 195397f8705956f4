#include "viewer/Document.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/AtomicFile.h"
#include "viewer/save/SaveScene.h"
#include "viewer/session/FileTypes.h"
#include "viewer/session/MapChoices.h"
#include "viewer/session/SceneSource.h"

namespace tessera::viewer {
namespace {

constexpr double kKeepSeconds = 3.0; ///< of idle time, after which edits are autosaved
/// Pause between autosaves, relative to the duration of the latest: they take a twentieth of the time at most.
constexpr double kKeepShare = 20.0;
constexpr double kFailedKeepSeconds = 60.0; ///< before a failed autosave is retried
constexpr double kSettingsSeconds = 2.0;    ///< between checks for changed settings

/// Next to the preferences file.
std::optional<std::filesystem::path> recoveryFolder(const ViewerOptions& options) {
    if (!options.preferencesFile) return std::nullopt;
    return options.preferencesFile->parent_path() / "recovery";
}

std::filesystem::path startFolder() {
    std::error_code error;
    return std::filesystem::current_path(error);
}

} // namespace

Document::Document(const Parts& parts, std::function<void(const std::string&)> fail)
    : options_(parts.options), state_(parts.state), facts_(parts.facts), window_(parts.window), log_(parts.log),
      pulse_(parts.pulse), screen_(parts.screen), drawing_(parts.drawing), saver_(parts.saver),
      measurements_(parts.measurements), fail_(std::move(fail)), recovery_(recoveryFolder(parts.options)),
      environments_([] { Window::wake(); }), scenes_(parts.options, parts.state, parts.log, [] { Window::wake(); }) {}

void Document::begin() {
    scenes_.open(options_.scene, options_.load);
    if (const auto left = recovery_.left()) {
        state_.question = {Question::About::Recovering, left->string()};
        log_.line("edits were left in " + left->string());
    }
}

bool Document::isLeaving() {
    if (!window_.shouldClose()) return false;
    if (isDiscarding_ || mayLeave({Question::About::Quitting, {}})) return true;
    window_.keepOpen();
    return false;
}

/// Unsaved edits are discarded only after the user has confirmed it.
bool Document::mayLeave(const Question& question) {
    if (!hasEdits()) return true;
    state_.question = question;
    pulse_.settle();
    log_.line("edits are not saved");
    return false;
}

void Document::open(const std::string& source) {
    if (mayLeave({Question::About::Opening, source})) load(source);
}

void Document::openFile(const std::string& file) {
    const FileType* const type = fileTypeOf(file);
    if (type != nullptr && type->opens == FileType::Opens::Environment) return chooseEnvironment(file);
    open(file);
}

void Document::takeDrops() {
    const std::vector<std::string> files = window_.takeDrops();
    if (files.empty()) return;
    Dropped dropped = takeDropped(files);
    state_.files.reset();
    state_.requests.chosen = std::move(dropped.taken);
    if (dropped.left.empty()) return;
    log_.line("note " + dropped.left);
    if (!state_.notice.isError) state_.notice = {.text = std::move(dropped.left), .outlivesLoad = true};
}

/// Reloads the open scene with other materials and textures, and carries its edits over.
void Document::openVariant(const std::string& variant) {
    if (!state_.open) return;
    load(state_.open->source(), variant);
    keepsEdits_ = true;
}

/// Starts loading a scene, or a variant of the open one, and notes the edit count to detect edits made meanwhile.
void Document::load(const std::string& source, const std::optional<std::string>& variant) {
    editsLeft_ = state_.open ? state_.open->edits() : 0;
    loadingVariant_ = variant;
    keepsEdits_ = false;
    scenes::LoadOptions load;
    if (variant && state_.open) {
        load = state_.open->load();
        load.import.variant = variant->empty() ? std::nullopt : variant;
    }
    scenes_.open(source, load);
}

void Document::take(Answer answer) {
    const std::optional<Question> question = std::exchange(state_.question, std::nullopt);
    pulse_.settle();
    if (!question || answer == Answer::Cancel) return;
    if (question->about == Question::About::Recovering) {
        if (answer == Answer::Discard) return Recovery::discard(question->scene);
        recovering_ = question->scene;
        return load(recovering_);
    }
    if (answer == Answer::Keep && !saveScene()) return; // if saving fails, nothing else happens
    if (question->about == Question::About::Opening) {
        const bool isVariant = question->variant && state_.open; // of the scene that was just saved
        return load(isVariant ? state_.open->source() : question->scene, question->variant);
    }
    isDiscarding_ = true;
    window_.close();
}

void Document::adoptLoaded() {
    const scenes::Scene* const loaded = scenes_.scene();
    const bool goesOn = keepsEdits_ && loaded != nullptr && state_.open && state_.open->source() == state_.loading &&
                        state_.open->canGoOnAs(*loaded);
    // No dialog has covered edits made during the load, nor edits that a variant cannot keep.
    const bool isUnconfirmed = state_.open && (keepsEdits_ || state_.open->edits() != editsLeft_);
    if (loaded != nullptr && isUnconfirmed && !goesOn &&
        !mayLeave({Question::About::Opening, state_.loading, loadingVariant_}))
        return scenes_.discard();
    std::unique_ptr<OpenScene> scene = scenes_.take([this](const OpenScene& shown) { screen_.open(shown); });
    if (!scene) return;
    measurements_.clear(facts_);
    drawing_.resume();
    facts_.shadows = {};
    state_.timings.clear();
    if (!goesOn) environments_.discard(); // it was chosen for the previous scene
    // A pending question about the previous scene's edits is obsolete.
    if (state_.question && state_.question->about != Question::About::Recovering) state_.question.reset();
    try {
        if (goesOn) scene->goOnFrom(*state_.open);
        recovery_.forget();
        adoptRecovered(*scene);
    } catch (const std::exception& error) {
        fail_(error.what());
    }
    state_.open = std::move(scene);
    state_.viewEnvironmentBy(state_.open->environmentView());
}

/// The recovered edits now belong to this window and still count as unsaved.
void Document::adoptRecovered(OpenScene& scene) {
    if (std::exchange(recovering_, {}) != scene.source()) return;
    scene.markUnsaved();
    std::erase(state_.recent, identityOf(scene.source()));
    const std::filesystem::path left = scene.source();
    recovery_.keep(scene);
    Recovery::discard(left);
    log_.line("recovered " + left.string());
}

void Document::chooseEnvironment(const std::string& name) {
    if (!state_.open) throw std::runtime_error("there is no scene yet for " + name + " to surround; open one first");
    environments_.start(name);
    log_.line("loading environment " + name);
}

void Document::adoptEnvironment() {
    std::optional<ChosenEnvironment> chosen = environments_.take();
    if (!chosen) return;
    if (!chosen->error.empty()) throw std::runtime_error(chosen->error);
    if (!chosen->warnings.empty()) state_.notice = {fmt::format("{}", fmt::join(chosen->warnings, "; ")), false};
    log_.line("environment " + chosen->name);
    state_.open->takeEnvironment(std::move(*chosen));
    noteMap(state_.maps, state_.open->scene());
    pulse_.settle();
}

std::optional<Progress> Document::loadingProgress() const {
    const auto progress = [](const std::optional<EnvironmentShare>& share, const char* of, const std::string& source,
                             bool canCancel) {
        const char* const verb = !share ? "Loading" : share->isFiltering ? "Filtering" : "Computing";
        const std::string name = std::filesystem::path(source).filename().string();
        return Progress{fmt::format("{} {}{}", verb, share ? of : "", name),
                        share ? std::optional(share->done) : std::nullopt, canCancel};
    };
    if (!state_.loading.empty())
        return progress(scenes_.environmentShare(), "the environment of ", state_.loading, false);
    const std::string choice = environments_.choice();
    if (choice.empty()) return std::nullopt;
    return progress(environments_.share(), "", choice, true);
}

void Document::cancelEnvironment() {
    log_.line("cancelled environment " + environments_.choice());
    environments_.discard();
    pulse_.settle();
}

void Document::nameWindow() {
    if (!state_.open) return;
    const std::string name = std::filesystem::path(state_.open->source()).filename().string();
    const std::string title = fmt::format("Tessera - {}{}", name, state_.open->isEdited() ? " *" : "");
    if (title != title_) window_.setTitle(title);
    title_ = title;
}

void Document::showOpenDialog() {
    const std::vector<std::string> folders = foldersOf(state_.recent);
    std::error_code error;
    const bool hasRecent = !folders.empty() && std::filesystem::is_directory(folders.front(), error);
    state_.files.emplace(FileDialog::Purpose::Open, hasRecent ? std::filesystem::path(folders.front()) : startFolder());
    pulse_.settle();
    log_.line("shows the open dialog");
}

void Document::showSaveDialog(const std::filesystem::path& path, const std::string& reason) {
    const std::filesystem::path given = path.has_parent_path() ? path.parent_path() : startFolder();
    const std::filesystem::path folder = reason.empty() ? given : homeFolder().value_or(given);
    state_.files.emplace(FileDialog::Purpose::Save, folder, path.filename().string(), reason);
    pulse_.settle();
    if (!reason.empty()) log_.line("error " + reason);
    log_.line("shows the save dialog");
}

/// Opens the dialog for another name if this path is not writable.
bool Document::mayWrite(const std::string& path) {
    try {
        requireWritable(path);
        return true;
    } catch (const std::exception& error) {
        showSaveDialog(path, error.what());
        return false;
    }
}

/// Restarts the load of a variant from the new file: it was based on the scene's previous file.
void Document::writeScene(const std::string& path) {
    saver_.scene(path);
    if (keepsEdits_ && !state_.loading.empty()) openVariant(*loadingVariant_);
}

bool Document::saveScene() {
    const std::string path = saver_.freeName(".json");
    if (!mayWrite(path)) return false;
    writeScene(path);
    return true;
}

void Document::savePicture(glm::ivec2 size, const char* ending) {
    if (const std::string path = saver_.freeName(ending); mayWrite(path)) saver_.picture(size, path);
}

void Document::saveAs(const std::string& path, glm::ivec2 size) {
    if (!mayWrite(path)) return;
    const FileType* const type = fileTypeOf(path);
    if (type == nullptr || type->saves != FileType::Saves::Scene) return saver_.picture(size, path);
    writeScene(path);
}

void Document::copyCommand(glm::ivec2 size) {
    if (hasEdits() && !saveScene()) return;
    state_.command = saver_.command(size);
    window_.setClipboard(state_.command);
    state_.notice = {"Copied: " + state_.command, false};
}

std::optional<double> Document::keepAt() const {
    if (!state_.open || !recovery_.isBehind(*state_.open)) return std::nullopt;
    return std::max(pulse_.restAt + kKeepSeconds, nextKeepAt_);
}

void Document::keepEdits() {
    const std::optional<double> at = keepAt();
    const double started = Window::nowSeconds();
    if (!at || started < *at) return;
    nextKeepAt_ = started + kFailedKeepSeconds;
    recovery_.keep(*state_.open);
    const double ended = Window::nowSeconds();
    nextKeepAt_ = ended + kKeepShare * (ended - started);
}

void Document::keepSettings() {
    const double now = Window::nowSeconds();
    if (now < std::max(pulse_.restAt, nextSettingsAt_)) return;
    nextSettingsAt_ = now + kSettingsSeconds;
    scenes_.remember(window_.sizeScreen());
}

void Document::endWithEdits() {
    try {
        if (state_.open) recovery_.keep(*state_.open);
    } catch (const std::exception& error) {
        options_.warn(error.what());
    }
    scenes_.remember(window_.sizeScreen());
}

void Document::close() {
    recovery_.forget();
    scenes_.remember(window_.sizeScreen());
}

} // namespace tessera::viewer
