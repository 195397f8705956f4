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

/// The viewer's window: its OpenGL context, its input and its size. To be used on the thread that made it, but for
/// wake().
class Window {
public:
    /// A visible window of this size, or as much of it as the screen has. Throws std::runtime_error where there is no
    /// display or no OpenGL 4.5.
    explicit Window(glm::ivec2 sizeScreen);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    gpu::Context& context() { return *context_; }
    GLFWwindow* handle() const { return window_; }

    bool shouldClose() const;
    void close();
    void keepOpen(); ///< though it was asked to close
    void setClipboard(const std::string& text);
    void setTitle(const std::string& title);
    glm::ivec2 sizeScreen() const; ///< screen coordinates, those of the pointer
    glm::ivec2 sizePixels() const; ///< of the framebuffer; 0 while the window is minimised
    float contentScale() const;    ///< how much larger than usual things should be drawn
    bool isMinimised() const;

    bool isButtonHeld() const; ///< of the mouse, as heard last
    /// Moves pending events of the window system into the queue, without waiting.
    void poll();
    /// The same, after waiting for something to happen, for wake(), or for this long: 0 or more.
    void wait(double timeoutSeconds);
    /// Ends wait(), from any thread, while a window exists.
    static void wake();

    InputQueue& input() { return input_; }
    const InputQueue& input() const { return input_; }
    /// Files dropped onto the window since the last call.
    std::vector<std::string> takeDrops();
    /// Whether something happened since the last call that asks for a new frame: input, a new size, damage.
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
