#include <stdexcept>

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include "renderer/gpu/ContextWays.h"

namespace tessera::gpu {
namespace {

std::string& glfwError() {
    static std::string text;
    return text;
}

[[noreturn]] void fail(const char* call) {
    throw std::runtime_error(
        fmt::format("{} failed, {}", call, glfwError().empty() ? "without a reason" : glfwError().c_str()));
}

/// Keeps GLFW initialised while a window exists.
class Library {
public:
    Library() {
        glfwSetErrorCallback([](int, const char* description) { glfwError() = description; });
        glfwError().clear();
        if (!glfwInit()) fail("glfwInit");
        ++users();
    }
    ~Library() {
        if (--users() == 0) glfwTerminate();
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

private:
    static int& users() {
        static int count = 0;
        return count;
    }
};

class WindowContext final : public Context {
public:
    explicit WindowContext(const ContextOptions& options)
        : Context("GLFW window", glfwGetProcAddress), window_(options) {
        makeCurrentImpl();
        initialise(options.debug);
        glfwSwapInterval(options.visible ? 1 : 0);
    }
    void swapBuffers() override { glfwSwapBuffers(window_.window); }
    void* windowHandle() const override { return window_.window; }

private:
    struct Window {
        explicit Window(const ContextOptions& options) {
            glfwDefaultWindowHints();
            glfwWindowHint(GLFW_CLIENT_API, GLFW_OPENGL_API);
            glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
            glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
            glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
            glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug);
            glfwWindowHint(GLFW_VISIBLE, options.visible);
            glfwWindowHint(GLFW_SCALE_TO_MONITOR, options.visible); // same apparent size on high-DPI displays
            glfwWindowHint(GLFW_DEPTH_BITS, 0); // images are rendered offscreen and copied into the window
            glfwWindowHint(GLFW_STENCIL_BITS, 0);
            window = glfwCreateWindow(options.width, options.height, options.title.c_str(), nullptr, nullptr);
            if (!window) fail("glfwCreateWindow");
        }
        ~Window() { glfwDestroyWindow(window); }
        Window(const Window&) = delete;
        Window& operator=(const Window&) = delete;
        GLFWwindow* window = nullptr;
    };

    void makeCurrentImpl() override {
        glfwMakeContextCurrent(window_.window);
        if (glfwGetCurrentContext() != window_.window) fail("glfwMakeContextCurrent");
    }

    void releaseImpl() override { glfwMakeContextCurrent(nullptr); }

    Library library_;
    Window window_;
};

} // namespace

std::unique_ptr<Context> createWindowContext(const ContextOptions& options, Answers& answers) {
    try {
        return std::make_unique<WindowContext>(options);
    } catch (const std::runtime_error& error) {
        answers.add("GLFW window", error);
        return nullptr;
    }
}

} // namespace tessera::gpu
