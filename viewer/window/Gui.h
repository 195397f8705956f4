#pragma once
#include <array>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "viewer/window/Letters.h"
#include "viewer/window/Window.h"

struct ImDrawList;

namespace tessera::viewer {

/// Dear ImGui on a window: its input and its style. It keeps no settings file; sizes below are for a display of
/// standard density and scale with the window's.
class Gui {
public:
    explicit Gui(Window& window);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;

    /// Adds glyphs for the letters of a text, from the next frame on.
    void learn(std::string_view text) { letters_.note(text); }
    /// Begins a frame with these events.
    void beginFrame(std::span<const InputEvent> events);
    /// Ends the frame; nothing is drawn yet.
    void endFrame();
    /// Draws it into the bound window framebuffer.
    void draw();
    /// Draws what `fill` adds over it, before the next frame begins.
    void drawOver(const std::function<void(ImDrawList&)>& fill);

    bool wantsMouse() const;    ///< the pointer is over a panel, or drags something of one
    bool wantsKeyboard() const; ///< text is being typed into a field
    float scale() const { return scale_; }

private:
    void applyScale(float scale);
    Window& window_;
    float scale_ = 0.0f;
    Letters letters_;
    std::vector<std::uint16_t> ranges_; ///< of applyFonts()
    glm::vec2 position_{-1.0f};         ///< of the pointer after the latest frame's events
    std::array<bool, 5> buttonsDown_{};
};

} // namespace tessera::viewer
