#include "viewer/window/Window.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include <GLFW/glfw3.h>

namespace tessera::viewer {
namespace {

Window& windowOf(GLFWwindow* window) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(window));
}

/// Throws if there is no display, as on remote machines: a driver error would be misleading.
void requireDisplay() {
#if !defined(_WIN32) && !defined(__APPLE__)
    for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY"}) {
        const char* const value = std::getenv(name);
        if (value != nullptr && *value != '\0') return;
    }
    throw std::runtime_error("there is no display for the viewer's window: neither DISPLAY nor WAYLAND_DISPLAY is set; "
                             "start it where windows are shown, or make pictures with tessera render");
#endif
}

/// The letter of a key in the keyboard layout; 0 if it has none.
int letterOn(int key, int scancode) {
    const char* const name = glfwGetKeyName(key, scancode);
    if (name == nullptr || name[0] == '\0' || name[1] != '\0') return 0;
    const char letter = name[0] >= 'a' && name[0] <= 'z' ? char(name[0] - 'a' + 'A') : name[0];
    return letter >= 'A' && letter <= 'Z' ? letter : 0;
}

/// Work area of the primary screen, in its coordinates; 0 x 0 if unknown.
struct WorkArea {
    glm::ivec2 corner{0}, size{0};
};
WorkArea workArea() {
    WorkArea area;
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor())
        glfwGetMonitorWorkarea(monitor, &area.corner.x, &area.corner.y, &area.size.x, &area.size.y);
    return area;
}

std::unique_ptr<gpu::Context> makeContext(glm::ivec2 size) {
    requireDisplay();
    // Clamps the size before the window exists: settings may exceed the screen, and so would the driver's buffers.
    const WorkArea area = glfwInit() == GLFW_TRUE ? workArea() : WorkArea{};
    gpu::ContextOptions options;
    options.kind = gpu::ContextKind::Window;
    options.visible = true;
    options.width = area.size.x > 0 ? std::min(size.x, area.size.x) : size.x;
    options.height = area.size.y > 0 ? std::min(size.y, area.size.y) : size.y;
    return gpu::Context::create(options);
}

} // namespace

Window::Window(glm::ivec2 sizeScreen) : context_(makeContext(sizeScreen)) {
    window_ = static_cast<GLFWwindow*>(context_->windowHandle());
    const WorkArea area = workArea();
    const bool isKnown = area.size.x > 0 && area.size.y > 0;
    if (isKnown && (sizeScreen.x > area.size.x || sizeScreen.y > area.size.y))
        glfwSetWindowPos(window_, area.corner.x, area.corner.y);
    glm::dvec2 pointer(0.0);
    glfwGetCursorPos(window_, &pointer.x, &pointer.y);
    pointer_ = pointer;
    installCallbacks();
}

Window::~Window() = default;

void Window::installCallbacks() {
    glfwSetWindowUserPointer(window_, this);
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
        Window& self = windowOf(window);
        self.pointer_ = {float(x), float(y)};
        self.note({InputEvent::Kind::Move});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int modifiers) {
        windowOf(window).note({InputEvent::Kind::Button, button, action == GLFW_PRESS, false, modifiers});
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double x, double y) {
        InputEvent event{InputEvent::Kind::Scroll};
        const auto isHeld = [window](int key) { return glfwGetKey(window, key) == GLFW_PRESS; };
        if (isHeld(GLFW_KEY_LEFT_CONTROL) || isHeld(GLFW_KEY_RIGHT_CONTROL)) event.modifiers = GLFW_MOD_CONTROL;
        event.scroll = {float(x), float(y)};
        windowOf(window).note(event);
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int scancode, int action, int modifiers) {
        InputEvent event{InputEvent::Kind::Key, key, action != GLFW_RELEASE, action == GLFW_REPEAT, modifiers};
        event.letter = letterOn(key, scancode);
        windowOf(window).note(event);
    });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned int character) {
        windowOf(window).note({InputEvent::Kind::Character, int(character)});
    });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int focused) {
        windowOf(window).note({InputEvent::Kind::Focus, 0, focused == GLFW_TRUE});
    });
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
        Window& self = windowOf(window);
        self.drops_.insert(self.drops_.end(), paths, paths + count);
        self.activity_ = true;
    });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) { windowOf(window).activity_ = true; });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { windowOf(window).activity_ = true; });
    glfwSetWindowCloseCallback(window_, [](GLFWwindow* window) { windowOf(window).activity_ = true; });
}

void Window::note(const InputEvent& event) {
    InputEvent placed = event;
    placed.position = pointer_;
    placed.heardSeconds = nowSeconds();
    input_.push(placed);
    activity_ = true;
}

bool Window::shouldClose() const {
    return glfwWindowShouldClose(window_) != 0;
}

void Window::close() {
    glfwSetWindowShouldClose(window_, GLFW_TRUE);
}

void Window::keepOpen() {
    glfwSetWindowShouldClose(window_, GLFW_FALSE);
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(window_, title.c_str());
}

void Window::setClipboard(const std::string& text) {
    glfwSetClipboardString(window_, text.c_str());
}

glm::ivec2 Window::sizeScreen() const {
    glm::ivec2 size(0);
    glfwGetWindowSize(window_, &size.x, &size.y);
    return size;
}

glm::ivec2 Window::sizePixels() const {
    glm::ivec2 size(0);
    glfwGetFramebufferSize(window_, &size.x, &size.y);
    return size;
}

float Window::contentScale() const {
    glm::vec2 scale(1.0f);
    glfwGetWindowContentScale(window_, &scale.x, &scale.y);
    return std::max(scale.x, scale.y);
}

bool Window::isMinimised() const {
    return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) != 0;
}

bool Window::isButtonHeld() const {
    for (int button = GLFW_MOUSE_BUTTON_1; button <= GLFW_MOUSE_BUTTON_LAST; ++button)
        if (glfwGetMouseButton(window_, button) == GLFW_PRESS) return true;
    return false;
}

void Window::poll() {
    glfwPollEvents();
}

void Window::wait(double timeoutSeconds) {
    glfwWaitEventsTimeout(timeoutSeconds);
}

void Window::wake() {
    glfwPostEmptyEvent();
}

std::vector<std::string> Window::takeDrops() {
    return std::exchange(drops_, {});
}

bool Window::takeActivity() {
    return std::exchange(activity_, false);
}

double Window::nowSeconds() {
    return glfwGetTime();
}

} // namespace tessera::viewer
