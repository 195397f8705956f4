#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "viewer/edit/LightListing.h"
#include "viewer/edit/Scatter.h"
#include "viewer/session/FileDialog.h"
#include "viewer/session/Inspection.h"
#include "viewer/session/Look.h"
#include "viewer/session/Magnification.h"
#include "viewer/session/OpenScene.h"
#include "viewer/session/Preferences.h"
#include "viewer/session/Question.h"
#include "viewer/session/ResourceView.h"
#include "viewer/session/Timings.h"

namespace tessera::viewer {

/// One image; two images with a divider; or their difference.
enum class Compare : std::uint8_t { Off, Split, Difference };

/// What was selected last.
enum class Selected : std::uint8_t { Light, Material };

/// The rows of the light list, cached because sorting many lights is slow.
struct ListedLights {
    std::uint64_t edits = 0; ///< of the scene,
    LightListing listing;    ///< and the listing, when they were made
    std::vector<ListedLight> rows;
};

/// A light whose name is being typed.
struct RenamedLight {
    int light = scenes::kNone;
    std::string name;
    bool isBegun = false; ///< the field has or had the keyboard
};

/// A square of the window that shows pixels of a side's image enlarged, in screen coordinates.
struct Loupe {
    int side = 0;
    glm::vec2 corner{0.0f};
    float size = 0.0f;
};

/// A rectangle of the window, screen coordinates.
struct Box {
    glm::vec2 corner{0.0f}, size{0.0f};
    bool meets(const Box& other) const {
        return glm::all(glm::lessThan(corner, other.corner + other.size)) &&
               glm::all(glm::lessThan(other.corner, corner + size));
    }
};

/// A line for the user: a finished action, or an error with its remedy.
struct Notice {
    std::string text;
    bool isError = false;
    bool outlivesLoad = false; ///< describes the scene that is being loaded, and stays afterwards
};

/// A shader error, and the programs that have it: they share files.
struct ShownFault {
    std::string text;
    std::vector<std::string> programs; ///< names with their defines
};

/// Requests of panels and keys that are more than a change of the state; served between two frames.
struct Requests {
    std::optional<std::string> open;   ///< a scene
    std::optional<std::string> chosen; ///< a dropped or chosen file: a scene or an environment
    std::optional<std::string> saveAs; ///< the scene or the image, by the extension
    bool showOpenDialog = false;
    bool showSaveDialog = false;
    std::optional<std::string> variant;     ///< of the open scene's models; empty: none
    std::optional<std::string> environment; ///< as given to --environment
    std::optional<std::string> clip;        ///< as given to --clip
    bool reloadShaders = false;
    bool savePng = false;
    bool saveExr = false;
    bool saveScene = false;
    bool saveTrace = false;
    bool copyCommand = false;
    bool copyInspection = false; ///< the values of the inspected pixel
    bool pinInspection = false;
    bool measureLights = false;
    bool addLight = false;
    bool scatter = false;               ///< replaces the scene's lights by those that `State::scatter` describes
    std::optional<glm::vec2> pick;      ///< image position, a fraction of its size from the upper left
    std::optional<glm::vec2> turnAbout; ///< the same, of the surface that orbits shall turn about
    std::optional<Answer> answer;       ///< to State::question
    bool cancel = false;                ///< the current long operation
    bool resume = false;                ///< the cancelled drawing
    bool quit = false;
};

/// The state of the viewer: everything that panels show and change.
struct State {
    std::unique_ptr<OpenScene> open; ///< none until the first scene has been loaded
    std::string loading;             ///< scene that is being loaded
    std::string loadingEnvironment;  ///< environment that is being loaded
    std::vector<std::string> recent; ///< files, the latest first
    std::vector<std::string> maps;   ///< sources of environments used since the program started, the latest first

    std::array<Look, 2> looks; ///< left of the divider, or the only one; and right of it
    int activeSide = 0;        ///< side that panels and keys change
    Compare compare = Compare::Off;
    float divider = 0.5f; ///< fraction of the image width
    float amplification = 16.0f;
    bool fitsCountColors = true; ///< heat colours end at the largest count

    bool isPlaying = false;     ///< time advances
    float speed = 1.0f;         ///< of the scene's time relative to the clock
    bool repeatsClip = true;    ///< at its end; otherwise it stops there
    bool automaticScale = true; ///< lower resolution while something moves
    float fixedScale = 1.0f;    ///< without automaticScale
    bool smooths = true;        ///< antialiases the idle image
    bool showsPanel = true;
    float panelWidth = kUsualPanelWidth;  ///< as Preferences::panelWidth
    std::map<std::string, bool> sections; ///< as Preferences::sections
    std::optional<Selected> reveals;      ///< whose panel is to scroll into view
    bool foldsPanels = false;             ///< folds all panels in the next frame
    bool showsHelp = false;
    int selectedLight = scenes::kNone; ///< edited by panels and handles
    std::set<int> selectedLights;      ///< all selected ones, if that one is among them
    int selectedMaterial = scenes::kNone;
    Selected selectedLast = Selected::Light;
    Scatter scatter;      ///< settings of the next scattering
    TypeChooser types;    ///< of the open scene's lights
    LightListing listing; ///< search, order and groups of the light list
    std::optional<ListedLights> listed;
    std::optional<RenamedLight> renamed; ///< its name is being typed

    double pictureAspect = 1.0;                ///< width over height of the viewport
    std::optional<glm::ivec2> firstWindowSize; ///< initial size, screen coordinates

    bool showsMarkers = false;             ///< of lights
    bool isDragging = false;               ///< something in the image, or the camera, is being dragged
    bool isDividerHeld = false;            ///< the divider is being dragged
    bool isPanelEdgeHeld = false;          ///< the panels' edge is being dragged
    std::optional<int> heldHandle;         ///< dragged handle of the selected light: LightHandle::number
    bool inspects = false;                 ///< the inspector is on
    std::optional<glm::vec2> pointedPlace; ///< in the image, a fraction of its size; none: the pointer is elsewhere
    std::optional<glm::vec2> pinnedPlace;  ///< inspected while the pointer is elsewhere
    std::vector<Loupe> loupes;             ///< of this frame
    std::vector<PinnedInspection> pins;
    Magnification magnification;
    std::optional<Box> inspectorBox; ///< of this frame: the values of the inspected pixel
    std::string dragText;            ///< value that the current drag sets, as text
    bool isCancellable = false;      ///< an operation takes long, and the window offers Esc to cancel it
    bool showsMaterial = false;      ///< a panel shows the selected material
    bool wantsThumbnails = false;    ///< a panel lists the built-in scenes
    bool wantsPlan = false;          ///< a panel shows the plan of the active side's frame
    ResourceView resource;
    std::string command; ///< renders the image, on request
    Timings timings;

    std::optional<Question> question; ///< everything else waits for its answer
    std::optional<FileDialog> files;  ///< file dialog; it waits for a question

    Notice notice;
    std::vector<ShownFault> shaderFaults;
    Requests requests;

    /// The image position that is inspected.
    std::optional<glm::vec2> inspectedPlace() const {
        if (!inspects) return std::nullopt;
        return pointedPlace ? pointedPlace : pinnedPlace;
    }
    /// Whether a dialog is open; the image and its keys wait.
    bool hasDialog() const { return question || files; }
    /// Whether keys must wait for the dialog's field, which does not have the keyboard yet.
    bool keysWait() const { return files && !question && files->keysWait(); }
    /// The selected light and those selected with it.
    std::set<int> allSelectedLights() const;
    bool isLightSelected(int index) const;
    int sides() const { return compare == Compare::Off ? 1 : 2; }
    Look& active() { return looks[std::size_t(activeSide)]; }
    const Look& active() const { return looks[std::size_t(activeSide)]; }
    /// Copies the settings that both sides share (engine::Setting::isShared), such as camera, time and exposure.
    void shareSettings();
    /// Makes both sides rotate and scale the environment as the open scene does: OpenScene::environmentView().
    void viewEnvironmentBy(const scenes::EnvironmentView& view);
    /// Detects changes of the selection since the last call, whatever made them: its panel is to scroll into view.
    void noteSelection();

private:
    int notedLight_ = scenes::kNone, notedMaterial_ = scenes::kNone;
};

} // namespace tessera::viewer
