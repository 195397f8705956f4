#include "viewer/window/Gui.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <GLFW/glfw3.h>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>

#include "viewer/window/Fonts.h"
#include "viewer/window/Theme.h"

namespace tessera::viewer {
namespace {

/// Height of a line of text. Dear ImGui's default font is designed for this size.
constexpr float kFontPixels = 13.0f;

void apply(const InputEvent& event, ImGuiIO& io) {
    switch (event.kind) {
    case InputEvent::Kind::Move:
        break;
    case InputEvent::Kind::Button:
        if (event.code < IM_ARRAYSIZE(io.MouseDown)) io.MouseDown[event.code] = event.down;
        break;
    case InputEvent::Kind::Scroll:
        io.MouseWheelH += event.scroll.x;
        io.MouseWheel += event.scroll.y;
        break;
    case InputEvent::Kind::Key:
        if (event.code >= 0 && event.code < IM_ARRAYSIZE(io.KeysDown)) io.KeysDown[event.code] = event.down;
        break;
    case InputEvent::Kind::Character:
        io.AddInputCharacter(static_cast<unsigned int>(event.code));
        return;
    case InputEvent::Kind::Focus:
        io.AddFocusEvent(event.down);
        // Key releases are not reported while another window has the focus.
        if (!event.down) std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false);
        return;
    }
}

bool anyDown(const ImGuiIO& io, int left, int right) {
    return io.KeysDown[left] || io.KeysDown[right];
}

} // namespace

Gui::Gui(Window& window) : window_(window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    const bool input = ImGui_ImplGlfw_InitForOpenGL(window.handle(), false);
    if (!input || !ImGui_ImplOpenGL3_Init("#version 450 core"))
        throw std::runtime_error("Dear ImGui cannot draw into the window; update the graphics driver");
    applyScale(window.contentScale());
}

Gui::~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Gui::applyScale(float scale) {
    scale_ = scale;
    applyFonts(letters_, std::floor(kFontPixels * scale), ranges_);
    applyTheme(scale);
}

void Gui::beginFrame(std::span<const InputEvent> events) {
    ImGui_ImplOpenGL3_NewFrame(); // the first call creates the GPU resources
    if (letters_.takeNew() || window_.contentScale() != scale_) {
        // Only the font texture: Dear ImGui 1.86 assumes that recreated buffers keep their size.
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        applyScale(window_.contentScale());
        ImGui_ImplOpenGL3_CreateFontsTexture();
    }
    ImGui_ImplGlfw_NewFrame();
    ImGuiIO& io = ImGui::GetIO();
    // The backend sets the current pointer and buttons; a frame uses those at the time of its events.
    io.MousePos = {position_.x, position_.y};
    std::copy(std::begin(buttonsDown_), std::end(buttonsDown_), std::begin(io.MouseDown));
    for (const InputEvent& event : events) {
        if (event.kind != InputEvent::Kind::Character && event.kind != InputEvent::Kind::Focus)
            io.MousePos = {event.position.x, event.position.y};
        apply(event, io);
    }
    position_ = {io.MousePos.x, io.MousePos.y};
    std::copy(std::begin(io.MouseDown), std::end(io.MouseDown), std::begin(buttonsDown_));
    io.KeyCtrl = anyDown(io, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
    io.KeyShift = anyDown(io, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
    io.KeyAlt = anyDown(io, GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
    io.KeySuper = anyDown(io, GLFW_KEY_LEFT_SUPER, GLFW_KEY_RIGHT_SUPER);
    ImGui::NewFrame();
}

void Gui::endFrame() {
    ImGui::Render();
}

void Gui::draw() {
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Gui::drawOver(const std::function<void(ImDrawList&)>& fill) {
    ImDrawList list(ImGui::GetDrawListSharedData());
    list._ResetForNewFrame();
    list.PushTextureID(ImGui::GetIO().Fonts->TexID);
    list.PushClipRectFullScreen();
    fill(list);
    ImDrawList* lists[] = {&list};
    ImDrawData data = *ImGui::GetDrawData(); // with this window's position and size
    data.CmdLists = lists;
    data.CmdListsCount = 1;
    data.TotalIdxCount = list.IdxBuffer.Size;
    data.TotalVtxCount = list.VtxBuffer.Size;
    ImGui_ImplOpenGL3_RenderDrawData(&data);
}

bool Gui::wantsMouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool Gui::wantsKeyboard() const {
    return ImGui::GetIO().WantTextInput;
}

} // namespace tessera::viewer
