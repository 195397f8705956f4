#pragma once
#include <span>

#include "viewer/session/State.h"
#include "viewer/window/Input.h"

namespace tessera::viewer {

/// Lights that have a marker where all are marked, the scene's first: more would hide the picture, and take a frame to
/// draw. The selected one always has one.
inline constexpr std::size_t kMostMarkers = 4096;

/// Where the picture is in the window, screen coordinates from the upper left.
struct PictureArea {
    glm::vec2 corner{0.0f};
    glm::vec2 size{0.0f};
    bool contains(const glm::vec2& point) const;
};

/// The part of the picture's place that shows a side: what lies left or right of the divider, or all.
PictureArea partOf(const State& state, const PictureArea& area, int side);

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
    enum class Drag { None, Rotate, Pan, Zoom, Divider, Light, Environment };
    void press(const InputEvent& event, State& state, const PictureArea& area, const Claims& claims);
    void release(const InputEvent& event, State& state, const PictureArea& area);
    void move(const InputEvent& event, State& state, const PictureArea& area);
    void key(const InputEvent& event, State& state, const Claims& claims);

    Drag drag_ = Drag::None;
    int button_ = 0; ///< that began the drag
    glm::vec2 pointer_{0.0f};
    glm::vec2 pressedAt_{0.0f};
    FlyKeys flying_;
};

} // namespace tessera::viewer
