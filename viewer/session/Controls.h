#pragma once
#include <optional>
#include <span>
#include <vector>

#include "viewer/edit/LightDrag.h"
#include "viewer/session/State.h"
#include "viewer/window/Input.h"

namespace tessera::viewer {

/// Most lights with a marker when all are marked, in the order of the scene: more would hide the image and take a frame
/// to draw. The selected light always has one.
inline constexpr std::size_t kMostMarkers = 4096;
/// Most selected lights whose outlines are shown, besides the one with handles.
inline constexpr std::size_t kMostFigures = 64;

/// The viewport: the image's place in the window, in screen coordinates from the upper left.
struct PictureArea {
    glm::vec2 corner{0.0f};
    glm::vec2 size{0.0f};
    float scale = 1.0f; ///< of lengths in it; 1 on a display of standard density
    bool contains(const glm::vec2& point) const;
};

/// The part of the viewport that shows a side: left or right of the divider, or all of it.
PictureArea partOf(const State& state, const PictureArea& area, int side);

/// Converts a point of the window to an image position, a fraction of the image size, and back.
glm::vec2 placeAt(const State& state, const PictureArea& area, const glm::vec2& point);
glm::vec2 pointOf(const State& state, const PictureArea& area, const glm::vec2& place);

/// Maps an open scene to the viewport, in screen coordinates from its upper left. The area must not be empty.
PictureView viewOf(const State& state, const PictureArea& area);

/// Outline and handles of the selected light; none without a selected light or an image, or if it is magnified.
std::optional<LightFigure> selectedFigure(const State& state, const PictureArea& area);

/// Its handle that a press at a point of the window grabs; its marker wins if the handle is not closer.
std::optional<LightHandle> handleUnder(const State& state, const PictureArea& area, const glm::vec2& point);

/// The marker of a light.
struct LightMarker {
    int light = scenes::kNone;
    glm::dvec2 place{0.0}; ///< in the viewport
    bool isSun = false;    ///< of a directional light, which has no position: at the viewport's right edge
};

/// The markers of an open scene in a viewport that is not empty: of the selected lights, then, if State::showsMarkers,
/// of all others up to kMostMarkers; none if it is magnified. Suns only if all are marked: one below the other, as many
/// as fit.
std::vector<LightMarker> lightMarkers(const State& state, const PictureArea& area);

/// The figures of the other selected lights, up to kMostFigures.
std::vector<LightFigure> otherFigures(const State& state, const PictureArea& area);

/// Whether a press at a point of the window grabs the divider of a split comparison.
bool isAtDivider(const State& state, const PictureArea& area, const glm::vec2& point);

/// Whether a press at a point of the window grabs the edge of the panels, which lies inside the viewport.
bool isAtPanelEdge(const State& state, const PictureArea& area, const glm::vec2& point);

/// Converts user input on the image into camera movements and state changes.
class Controls {
public:
    /// Input that belongs to widgets instead of the image.
    struct Claims {
        bool mouse = false;    ///< the pointer is over a panel
        bool keyboard = false; ///< text is being typed
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
    int button_ = 0; ///< that started the drag
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
