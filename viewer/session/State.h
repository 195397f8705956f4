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
#include "viewer/session/Look.h"
#include "viewer/session/Magnification.h"
#include "viewer/session/OpenScene.h"
#include "viewer/session/Preferences.h"
#include "viewer/session/Question.h"
#include "viewer/session/ResourceView.h"
#include "viewer/session/Timings.h"

namespace tessera::viewer {

/// One picture; two looks side by side with a divider; or how much they differ.
enum class Compare : std::uint8_t { Off, Split, Difference };

/// What was selected last.
enum class Selected : std::uint8_t { Light, Material };

/// The rows of the list of lights, which many lights take long to sort.
struct ListedLights {
    std::uint64_t edits = 0; ///< of the scene,
    LightListing listing;    ///< and how it was listed, when they were made
    std::vector<ListedLight> rows;
};

/// A light whose name is being typed.
struct RenamedLight {
    int light = scenes::kNone;
    std::string name;
    bool isBegun = false; ///< the field has the keyboard, or had it
};

/// A square of the window in which pixels of a side's picture are shown large, in screen coordinates.
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

/// What was told of a pixel, kept until it is removed.
struct PinnedInspection {
    glm::vec2 place{0.0f}; ///< in the picture, a share of its size
    std::vector<std::string> lines;
};

/// A line for the user: a finished action, or an error with its remedy.
struct Notice {
    std::string text;
    bool isError = false;
    bool outlivesLoad = false; ///< tells of what is being opened, and stays when that is there
};

/// A fault of shaders, and the programs that have it: files are shared.
struct ShownFault {
    std::string text;
    std::vector<std::string> programs; ///< names with their defines
};

/// What panels and keys ask for that is more than a change of the state; done between two frames.
struct Requests {
    std::optional<std::string> open;   ///< a scene
    std::optional<std::string> chosen; ///< a file that was dropped or chosen: a scene or an environment
    std::optional<std::string> saveAs; ///< the scene or the picture, as the name's end says
    bool askWhatToOpen = false;
    bool askWhereToSave = false;
    std::optional<std::string> variant;     ///< that the open scene's models are to show; empty: none
    std::optional<std::string> environment; ///< as --environment takes it
    std::optional<std::string> clip;        ///< as --clip takes it
    bool reloadShaders = false;
    bool savePng = false;
    bool saveExr = false;
    bool saveScene = false;
    bool saveTrace = false;
    bool copyCommand = false;
    bool copyInspection = false; ///< what is told of the pixel that is inspected
    bool pinInspection = false;
    bool measureLights = false;
    bool addLight = false;
    bool scatter = false;               ///< the lights that `State::scatter` describes, in the place of the scene's
    std::optional<glm::vec2> pick;      ///< a place in the picture, shares of its size from the upper left
    std::optional<glm::vec2> turnAbout; ///< the same: of the surface that orbits are to turn about
    std::optional<Answer> answer;       ///< to State::question
    bool cancel = false;                ///< what takes long
    bool resume = false;                ///< what was cancelled
    bool quit = false;
};

/// What the window shows and how: all that panels show and change.
struct State {
    std::unique_ptr<OpenScene> open; ///< none until the first scene has been loaded
    std::string loading;             ///< a scene that is on its way
    std::string loadingEnvironment;  ///< the same of an environment
    std::vector<std::string> recent; ///< files, the latest first
    std::vector<std::string> maps;   ///< the same of environments, since the program's start: their sources

    std::array<Look, 2> looks; ///< left of the divider, or all; and right of it
    int activeSide = 0;        ///< which of them panels and keys change
    Compare compare = Compare::Off;
    float divider = 0.5f; ///< share of the picture's width
    float amplification = 16.0f;
    bool fitsCountColors = true; ///< heat colours end at the largest count

    bool isPlaying = false;     ///< time goes on
    float speed = 1.0f;         ///< of that time against the clock's
    bool repeatsClip = true;    ///< at its end; otherwise it stays there
    bool automaticScale = true; ///< smaller pictures while something moves
    float fixedScale = 1.0f;    ///< otherwise
    bool smooths = true;        ///< the picture's edges, once it rests
    bool showsPanel = true;
    float panelWidth = kUsualPanelWidth;  ///< as Preferences::panelWidth
    std::map<std::string, bool> sections; ///< as Preferences::sections
    std::optional<Selected> reveals;      ///< whose panel is to come into view
    bool foldsPanels = false;             ///< all of them, in the next frame
    bool showsHelp = false;
    int selectedLight = scenes::kNone; ///< that panels and handles are about
    std::set<int> selectedLights;      ///< several, where that one is among them
    int selectedMaterial = scenes::kNone;
    Selected selectedLast = Selected::Light;
    Scatter scatter;      ///< settings of the next scattering
    TypeChooser types;    ///< of the open scene's lights
    LightListing listing; ///< how the list shows them
    std::optional<ListedLights> listed;
    std::optional<RenamedLight> renamed; ///< its name is a field

    double pictureAspect = 1.0;                ///< width over height of where the picture is
    std::optional<glm::ivec2> firstWindowSize; ///< screen coordinates, as the window opened

    bool showsMarkers = false;             ///< where lights are
    bool isDragging = false;               ///< something in the picture, or the camera
    bool isDividerHeld = false;            ///< it is dragged
    bool isPanelEdgeHeld = false;          ///< the same of the panels' edge
    std::optional<int> heldHandle;         ///< of the selected light, which is dragged: LightHandle::number
    bool inspects = false;                 ///< the picture's pixels, one after the other
    std::optional<glm::vec2> pointedPlace; ///< of the picture, a share of its size; none: the pointer is elsewhere
    std::optional<glm::vec2> pinnedPlace;  ///< that is inspected meanwhile
    std::vector<Loupe> loupes;             ///< of this frame
    std::vector<PinnedInspection> pins;
    Magnification magnification;
    std::optional<Box> inspectorBox; ///< of this frame: what is told of that pixel
    std::string dragText;            ///< what the drag in progress sets, for the user
    bool isCancellable = false;      ///< something takes long, and the window says that Esc cancels it
    bool showsMaterial = false;      ///< a panel shows the selected material
    bool wantsThumbnails = false;    ///< a panel lists the built-in scenes
    bool wantsPlan = false;          ///< a panel shows the plan of the active side's frame
    ResourceView resource;
    std::string command; ///< that renders the picture, on request
    Timings timings;

    std::optional<Question> question; ///< waits for an answer, and all else waits for that
    std::optional<FileDialog> files;  ///< asks for a file, and waits for a question

    Notice notice;
    std::vector<ShownFault> shaderFaults;
    Requests requests;

    /// The place of the picture that is inspected.
    std::optional<glm::vec2> inspectedPlace() const {
        if (!inspects) return std::nullopt;
        return pointedPlace ? pointedPlace : pinnedPlace;
    }
    /// The picture and its keys wait.
    bool isAsking() const { return question || files; }
    /// Keys are for the field of the dialog, which does not have the keyboard yet.
    bool keysWait() const { return files && !question && files->keysWait(); }
    /// The selected light, and those that are selected with it.
    std::set<int> allSelectedLights() const;
    bool isLightSelected(int index) const;
    int sides() const { return compare == Compare::Off ? 1 : 2; }
    Look& active() { return looks[std::size_t(activeSide)]; }
    const Look& active() const { return looks[std::size_t(activeSide)]; }
    /// What both sides share: where, when and how bright.
    void shareSettings();
    /// Has both sides turn and brighten the environment as the open scene does: OpenScene::environmentView().
    void viewEnvironmentBy(const scenes::EnvironmentView& view);
    /// Heeds what was selected since it was called last, wherever: its panel is to come into view.
    void noteSelection();

private:
    int notedLight_ = scenes::kNone, notedMaterial_ = scenes::kNone;
};

} // namespace tessera::viewer
