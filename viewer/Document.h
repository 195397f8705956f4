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

/// The open scene as the window's document: loads and saves scenes, confirms the loss of unsaved edits, and autosaves
/// them in case the program ends unexpectedly.
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
    /// `fail` receives non-fatal errors.
    Document(const Parts& parts, std::function<void(const std::string&)> fail);

    /// Opens the first scene, and offers to recover edits left by an earlier run.
    void begin();

    // ---- Opening ----
    /// Opens one of the files dropped on the window, and reports the others to the user.
    void takeDrops();
    /// These may first ask about unsaved edits; a variant only if it cannot keep them.
    void open(const std::string& source);
    /// Opens a dropped or chosen file. Loading reports unknown file types.
    void openFile(const std::string& file);
    void openVariant(const std::string& variant);
    void take(Answer answer);
    /// Loads an environment for the open scene. Throws std::runtime_error without one.
    void chooseEnvironment(const std::string& name);
    /// The chosen environment while it is loading; empty: none.
    std::string loadingEnvironment() const { return environments_.choice(); }
    void cancelEnvironment();
    /// Whether anything is being loaded on another thread.
    bool isLoading() const { return !state_.loading.empty() || !environments_.choice().empty(); }
    /// Progress of that load.
    std::optional<Progress> loadingProgress() const;
    /// Whether a loaded scene or environment waits for the next two functions.
    bool hasResult() const { return scenes_.hasResult() || environments_.hasResult(); }
    /// Both throw what loading throws.
    void adoptLoaded();
    void adoptEnvironment();
    /// Shows the open scene's name in the window title, with * for unsaved edits.
    void nameWindow();

    // ---- Files ----
    /// Opens the file dialog.
    void showOpenDialog();
    /// Opens the save dialog. With a reason, the path's folder is not writable and the home folder is proposed.
    void showSaveDialog(const std::filesystem::path& path, const std::string& reason = {});
    /// These ask for another name if the path is not writable. saveScene() uses a free name; returns whether it saved.
    bool saveScene();
    void savePicture(glm::ivec2 size, const char* ending);
    void saveAs(const std::string& path, glm::ivec2 size);
    /// Copies the command that renders the image to the clipboard. It renders a file, so edits are saved first.
    void copyCommand(glm::ivec2 size);

    // ---- Unsaved edits ----
    bool hasEdits() const { return state_.open && state_.open->isEdited(); }
    /// When keepEdits() is due, in seconds of Window::nowSeconds(); none: nothing to save.
    std::optional<double> keepAt() const;
    /// Autosaves edits in case the program ends unexpectedly; only while the image is idle, and not too often.
    void keepEdits();
    /// Likewise saves settings and recent files.
    void keepSettings();

    // ---- Closing ----
    /// Whether the window closes now. May ask about unsaved edits instead.
    bool isLeaving();
    /// Normal end: saves settings, and deletes the autosave.
    void close();
    /// End without questions: saves settings, and autosaves unsaved edits.
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
    std::string recovering_; ///< recovery file that is being opened
    double nextKeepAt_ = 0.0, nextSettingsAt_ = 0.0;
    bool isDiscarding_ = false;                 ///< the window closes without another question
    std::uint64_t editsLeft_ = 0;               ///< edits of the open scene when the current load began
    std::optional<std::string> loadingVariant_; ///< argument of load()
    bool keepsEdits_ = false;                   ///< the current load carries over the edits of the open scene
    Recovery recovery_;
    EnvironmentJob environments_;
    SceneSwitch scenes_; ///< declared last: its thread ends before the other members
};

} // namespace tessera::viewer
