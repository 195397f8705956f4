#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "viewer/save/Recovery.h"
#include "viewer/save/Saver.h"
#include "viewer/session/EnvironmentJob.h"
#include "viewer/session/Pulse.h"
#include "viewer/session/SceneSwitch.h"
#include "viewer/show/Measurements.h"
#include "viewer/show/PictureDrawing.h"
#include "viewer/window/Window.h"

namespace tessera::viewer {

/// The open scene as the window's document: what comes in its place, where it is saved, what is asked about edits that
/// are not saved, and where those are kept for the case that the program ends unasked.
class Document {
public:
    struct Parts {
        const ViewerOptions& options;
        State& state;
        Facts& facts;
        Window& window;
        const EventLog& log;
        Pulse& pulse;
        Screen& screen;
        PictureDrawing& drawing;
        Saver& saver;
        Measurements& measurements;
    };
    /// `fail` is told of faults that keep nothing from going on.
    Document(const Parts& parts, std::function<void(const std::string&)> fail);

    /// Opens the first scene, and asks about edits that a run before left.
    void begin();

    // ---- Another scene ----
    /// Of files that were dropped on the window one is to be opened, and the user is told of the others.
    void takeDrops();
    /// These may ask first; a variant only where edits cannot go on in it.
    void open(const std::string& source);
    /// A file that was dropped or chosen. Of what is no file that the viewer knows, loading tells why.
    void openFile(const std::string& file);
    void openVariant(const std::string& variant);
    void take(Answer answer);
    /// For the scene that is open. Throws where there is none.
    void chooseEnvironment(const std::string& name);
    /// What was chosen and is not there yet; empty: nothing.
    std::string loadingEnvironment() const { return environments_.choice(); }
    void cancelEnvironment();
    /// Something is loaded on another thread.
    bool isLoading() const { return !state_.loading.empty() || !environments_.choice().empty(); }
    /// How far that is.
    std::optional<Progress> loadingProgress() const;
    /// Whether a scene or an environment waits for the next two.
    bool hasResult() const { return scenes_.hasResult() || environments_.hasResult(); }
    /// Throw what loading throws.
    void adoptLoaded();
    void adoptEnvironment();
    /// The title says which scene is open, and whether it has edits that were not saved.
    void nameWindow();

    // ---- Files ----
    /// Opens the dialog of files.
    void askWhatToOpen();
    /// With a reason: the folder of the path cannot be written, so another is proposed.
    void askWhereToSave(const std::filesystem::path& path, const std::string& reason = {});
    /// These ask for another name where no file can be written under theirs. Whether it was saved, under a free name.
    bool saveScene();
    void savePicture(glm::ivec2 size, const char* ending);
    void saveAs(const std::string& path, glm::ivec2 size);
    /// Puts the command that renders the picture on the clipboard. It draws a file, so edits are saved before.
    void copyCommand(glm::ivec2 size);

    // ---- Edits that are not saved ----
    bool hasEdits() const { return state_.open && state_.open->isEdited(); }
    /// When keepEdits() has something to do, in seconds of Window::nowSeconds().
    std::optional<double> keepAt() const;
    /// Keeps them for the case that the program ends unasked; while nobody waits for a picture, and not too often.
    void keepEdits();
    /// The same of settings and recent files.
    void keepSettings();

    // ---- The end ----
    /// Whether the window closes. May ask instead.
    bool isLeaving();
    /// All that is to be kept is saved.
    void close();
    /// The program ends, and nobody can be asked any more: what close() saves, and edits that are not saved.
    void endWithEdits();

private:
    bool mayLeave(const Question& question);
    void load(const std::string& source, const std::optional<std::string>& variant = {});
    void adoptRecovered(OpenScene& scene);
    bool mayWrite(const std::string& path);
    void writeScene(const std::string& path);

    const ViewerOptions& options_;
    State& state_;
    Facts& facts_;
    Window& window_;
    const EventLog& log_;
    Pulse& pulse_;
    Screen& screen_;
    PictureDrawing& drawing_;
    Saver& saver_;
    Measurements& measurements_;
    std::function<void(const std::string&)> fail_;
    std::string title_;
    std::string recovering_; ///< the file of edits that is being opened
    double nextKeepAt_ = 0.0, nextSettingsAt_ = 0.0;
    bool isDiscarding_ = false;                 ///< the window closes without another question
    std::uint64_t editsLeft_ = 0;               ///< of the open scene, when the one that is loading was asked for
    std::optional<std::string> loadingVariant_; ///< of load()
    bool keepsEdits_ = false;                   ///< what is loading is to go on with the edits of the open scene
    Recovery recovery_;
    EnvironmentJob environments_;
    SceneSwitch scenes_; ///< last: its thread ends before what it wakes
};

} // namespace tessera::viewer
