#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/gpu/Context.h"
#include "viewer/window/Input.h"

struct GLFWwindow;

namespace tessera::viewer {

/// The viewer's window: its OpenGL context, its input and its size. Must be used on the thread that created it, except
/// for wake().
class Window {
public:
    /// Opens a visible window of this size, or as much as fits the screen. Throws std::runtime_error without a display
    /// or OpenGL 4.5.
    explicit Window(glm::ivec2 sizeScreen);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    gpu::Context& context() { return *context_; }
    GLFWwindow* handle() const { return window_; }

    bool shouldClose() const;
    void close();
    void keepOpen(); ///< cancels a request to close
    void setClipboard(const std::string& text);
    void setTitle(const std::string& title);
    glm::ivec2 sizeScreen() const; ///< screen coordinates, those of the pointer
    glm::ivec2 sizePixels() const; ///< of the framebuffer; 0 while the window is minimised
    float contentScale() const;    ///< recommended scale of the interface
    bool isMinimised() const;

    bool isButtonHeld() const; ///< of the mouse, at the latest poll
    /// Moves pending events of the window system into the queue, without waiting.
    void poll();
    /// The same, after waiting for an event, for wake(), or for this time, >= 0.
    void wait(double timeoutSeconds);
    /// Ends wait(), from any thread, while a window exists.
    static void wake();

    InputQueue& input() { return input_; }
    const InputQueue& input() const { return input_; }
    /// Files dropped onto the window since the last call.
    std::vector<std::string> takeDrops();
    /// Whether a new frame is needed since the last call: for input, a new size, or damage.
    bool takeActivity();
    bool hasActivity() const { return activity_; }
    static double nowSeconds();

private:
    void installCallbacks();
    void note(const InputEvent& event);

    std::unique_ptr<gpu::Context> context_;
    GLFWwindow* window_ = nullptr;
    InputQueue input_;
    std::vector<std::string> drops_;
    glm::vec2 pointer_{0.0f};
    bool activity_ = true;
};

} // namespace tessera::viewer
