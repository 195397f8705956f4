#pragma once
#include <optional>
#include <span>
#include <vector>

#include "viewer/edit/LightDrag.h"
#include "viewer/session/State.h"
#include "viewer/window/Input.h"

namespace tessera::viewer {

/// Lights that have a marker where all are marked, the scene's first: more would hide the picture, and take a frame to
/// draw. The selected one always has one.
inline constexpr std::size_t kMostMarkers = 4096;
/// Lights that are selected beside the one that has handles, and show their outlines.
inline constexpr std::size_t kMostFigures = 64;

/// Where the picture is in the window, screen coordinates from the upper left.
struct PictureArea {
    glm::vec2 corner{0.0f};
    glm::vec2 size{0.0f};
    float scale = 1.0f; ///< of lengths in it, for one on a display of usual density
    bool contains(const glm::vec2& point) const;
};

/// The part of the picture's place that shows a side: what lies left or right of the divider, or all.
PictureArea partOf(const State& state, const PictureArea& area, int side);

/// The place of the picture, a share of its size, that is shown at a point of the window, and back.
glm::vec2 placeAt(const State& state, const PictureArea& area, const glm::vec2& point);
glm::vec2 pointOf(const State& state, const PictureArea& area, const glm::vec2& place);

/// What the picture of an open scene shows where, from its upper left in screen coordinates. The area is not empty.
PictureView viewOf(const State& state, const PictureArea& area);

/// Outline and handles of the selected light; none where no light is selected, there is no picture, or it is magnified.
std::optional<LightFigure> selectedFigure(const State& state, const PictureArea& area);

/// Its handle that a press at a point of the window takes; its marker is taken before one that is no nearer.
std::optional<LightHandle> handleUnder(const State& state, const PictureArea& area, const glm::vec2& point);

/// Where a light is marked.
struct LightMarker {
    int light = scenes::kNone;
    glm::dvec2 place{0.0}; ///< in the picture
    bool isSun = false;    ///< of a directional light, which has no place in the scene: at the picture's right side
};

/// The markers of an open scene in a picture that is not empty: of the selected lights, then, where the state says so,
/// of all others up to kMostMarkers; none where it is magnified. Suns only where all are marked: one below the other,
/// as many as there is room for.
std::vector<LightMarker> lightMarkers(const State& state, const PictureArea& area);

/// The figures of the other lights that are selected, up to kMostFigures.
std::vector<LightFigure> otherFigures(const State& state, const PictureArea& area);

/// Whether a press at a point of the window takes the divider between two pictures side by side.
bool isAtDivider(const State& state, const PictureArea& area, const glm::vec2& point);

/// Whether a press at a point of the window takes the edge of the panels, which lies in the picture.
bool isAtPanelEdge(const State& state, const PictureArea& area, const glm::vec2& point);

/// Turns the user's input on the picture into movements of the camera and changes of the state.
class Controls {
public:
    /// Input that belongs to widgets and not to the picture.
    struct Claims {
        bool mouse = false;    ///< the pointer is at a panel
        bool keyboard = false; ///< text is typed
    };
    void handle(std::span<const InputEvent> events, State& state, const PictureArea& area, const Claims& claims);

private:
    enum class Drag { None, Rotate, Pan, Zoom, Divider, PanelEdge, Light, Handle, Environment, Magnified };
    void scroll(const InputEvent& event, State& state, const PictureArea& area);
    void press(const InputEvent& event, State& state, const PictureArea& area, const Claims& claims);
    void release(const InputEvent& event, State& state, const PictureArea& area);
    void click(const InputEvent& event, State& state, const PictureArea& area);
    void move(const InputEvent& event, State& state, const PictureArea& area);
    void key(const InputEvent& event, State& state, const Claims& claims);
    void takeHandle(const LightHandle& handle, State& state, const PictureArea& area, const glm::vec2& point);
    void dragHandle(State& state, const PictureArea& area, const glm::vec2& point);
    void endDrag(State& state);

    Drag drag_ = Drag::None;
    int button_ = 0; ///< that began the drag
    glm::vec2 pointer_{0.0f};
    glm::vec2 pressedAt_{0.0f};
    struct Click {
        glm::vec2 place;
        double heardSeconds;
    };
    std::optional<Click> clicked_;    ///< the latest, unless it was the second of two
    std::optional<LightDrag> handle_; ///< of Drag::Handle
    int handledLight_ = scenes::kNone;
    FlyKeys flying_;
};

} // namespace tessera::viewer
