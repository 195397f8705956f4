#include "viewer/session/Keys.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include <GLFW/glfw3.h>

#include "engine/ChooseView.h"
#include "renderer/frame/DebugViews.h"
#include "viewer/session/Playback.h"
#include "viewer/session/PointAt.h"
#include "viewer/session/SceneEdits.h"

namespace tessera::viewer {
namespace {

constexpr float kExposureStepEV = 0.5f;

void showNumbered(State& state, int number) {
    for (const frame::DebugViewInfo& info : frame::debugViewTable())
        if (info.key == number) state.active().settings.view = info.view;
    state.active() = possible(state.active());
}

/// Selects the technique `step` places on in the table, wrapping around.
void stepTechnique(State& state, int step) {
    const int count = int(engine::techniqueTable().size());
    Look& look = state.active();
    look.technique = engine::techniqueTable()[std::size_t((int(look.technique) + step + count) % count)].technique;
    look = possible(look);
}

void changeMode(State& state) {
    if (!state.open) return;
    CameraRig& rig = state.open->rig();
    rig.setMode(rig.mode() == CameraRig::Mode::Orbit ? CameraRig::Mode::Fly : CameraRig::Mode::Orbit);
}

void changeExposure(State& state, float stepEV) {
    float& exposureEV = state.active().settings.exposureEV;
    exposureEV =
        std::clamp(std::round(exposureEV / stepEV) * stepEV + stepEV, -frame::kMostExposureEV, frame::kMostExposureEV);
}

constexpr double kQuarter = 0.5 * std::numbers::pi;
constexpr AxisView kAxisViews[] = {
    {"Front", "from the front, along -Z", GLFW_KEY_1, GLFW_KEY_KP_1, {}},
    {"Side", "from the right side, along -X", GLFW_KEY_2, GLFW_KEY_KP_3, {kQuarter, 0.0, 0.0}},
    {"Top", "from above, along -Y", GLFW_KEY_3, GLFW_KEY_KP_7, {0.0, -kQuarter, 0.0}},
};

template <std::size_t kView>
void viewAlongAxis(State& state) {
    const AxisView& view = kAxisViews[kView];
    if (state.open) state.open->jumpToHeading(std::string("look ") + view.meaning, view.heading, state.pictureAspect);
}

constexpr int kNone = 0;
constexpr int kShift = GLFW_MOD_SHIFT;
constexpr int kControl = GLFW_MOD_CONTROL;

constexpr KeyBinding kBindings[] = {
    {GLFW_KEY_F1, kNone, "F1 or H", "this help", [](State& s) { s.showsHelp = !s.showsHelp; }, "Window"},
    {GLFW_KEY_H, kNone, "", "", [](State& s) { s.showsHelp = !s.showsHelp; }},
    {GLFW_KEY_ESCAPE, kNone, "Esc", "close the help, cancel long work, or close the latest message or resource",
     [](State& s) {
         if (!s.showsHelp && s.isCancellable) {
             s.requests.cancel = true;
         } else if (!s.showsHelp && s.notice.text.empty() && s.shaderFaults.empty()) {
             s.resource = {};
         } else if (!s.showsHelp) {
             s.notice = {};
             s.shaderFaults.clear();
         }
         s.showsHelp = false;
     }},
    {GLFW_KEY_ENTER, kNone, "Enter", "resume drawing after Esc", [](State& s) { s.requests.resume = true; }},
    {GLFW_KEY_TAB, kNone, "Tab", "hide or show the panels", [](State& s) { s.showsPanel = !s.showsPanel; }},
    {GLFW_KEY_TAB, kShift, "Shift+Tab", "fold all panels", [](State& s) { s.foldsPanels = true; }},
    {GLFW_KEY_Q, kControl, "Ctrl+Q", "quit", [](State& s) { s.requests.quit = true; }},
    {GLFW_KEY_1, kNone, "1 to 7", "the numbered views; 7 is the lit picture", [](State& s) { showNumbered(s, 1); },
     "Picture"},
    {GLFW_KEY_2, kNone, "", "", [](State& s) { showNumbered(s, 2); }},
    {GLFW_KEY_3, kNone, "", "", [](State& s) { showNumbered(s, 3); }},
    {GLFW_KEY_4, kNone, "", "", [](State& s) { showNumbered(s, 4); }},
    {GLFW_KEY_5, kNone, "", "", [](State& s) { showNumbered(s, 5); }},
    {GLFW_KEY_6, kNone, "", "", [](State& s) { showNumbered(s, 6); }},
    {GLFW_KEY_7, kNone, "", "", [](State& s) { showNumbered(s, 7); }},
    {GLFW_KEY_T, kNone, "T", "the next technique; with Shift the one before", [](State& s) { stepTechnique(s, 1); }},
    {GLFW_KEY_T, kShift, "", "", [](State& s) { stepTechnique(s, -1); }},
    {GLFW_KEY_X, kNone, "X", "compare: off, split, difference",
     [](State& s) { s.compare = Compare((int(s.compare) + 1) % 3); }},
    {GLFW_KEY_Z, kNone, "Z", "panels set the other side of a comparison",
     [](State& s) { s.activeSide = s.compare == Compare::Off ? 0 : 1 - s.activeSide; }},
    {GLFW_KEY_LEFT_BRACKET, kNone, "[ and ]", "exposure down and up by half a step",
     [](State& s) { changeExposure(s, -kExposureStepEV); }},
    {GLFW_KEY_RIGHT_BRACKET, kNone, "", "", [](State& s) { changeExposure(s, kExposureStepEV); }},
    {GLFW_KEY_I, kNone, "I", "inspect pixels: values below the pointer, enlarged",
     [](State& s) {
         s.inspects = !s.inspects;
         s.pinnedPlace.reset();
     }},
    {GLFW_KEY_P, kNone, "P", "pin the values of the inspected pixel",
     [](State& s) { s.requests.pinInspection = s.inspects; }},
    {GLFW_KEY_C, kControl | kShift, "Ctrl+Shift+C", "copy the values of the inspected pixel",
     [](State& s) { s.requests.copyInspection = s.inspects; }},
    {GLFW_KEY_0, kControl, "Ctrl+0", "show all of the picture again, after Ctrl + wheel",
     [](State& s) { s.magnification = {}; }},
    {GLFW_KEY_SPACE, kNone, "Space", "play or pause the animation", togglePlaying},
    {GLFW_KEY_F5, kNone, "F5", "read the shaders again", [](State& s) { s.requests.reloadShaders = true; }},
    {GLFW_KEY_C, kNone, "C", "camera: orbit or fly", changeMode, "Camera"},
    {GLFW_KEY_F, kNone, "F", "frame the selected light or material, else the whole scene", frameSelection},
    {GLFW_KEY_F, kShift, "Shift+F", "all of the scene in view",
     [](State& s) {
         if (s.open) s.open->jumpToAll(s.pictureAspect);
     }},
    {GLFW_KEY_HOME, kNone, "Home", "back to the scene's camera",
     [](State& s) {
         if (s.open) s.open->jumpHome();
     }},
    {GLFW_KEY_1, kControl, "Ctrl+1, 2, 3", "look from the front, the side, above; on the number pad 1, 3, 7",
     viewAlongAxis<0>},
    {GLFW_KEY_2, kControl, "", "", viewAlongAxis<1>},
    {GLFW_KEY_3, kControl, "", "", viewAlongAxis<2>},
    {GLFW_KEY_KP_1, kNone, "", "", viewAlongAxis<0>},
    {GLFW_KEY_KP_3, kNone, "", "", viewAlongAxis<1>},
    {GLFW_KEY_KP_7, kNone, "", "", viewAlongAxis<2>},
    {GLFW_KEY_M, kNone, "M", "mark where lights are", [](State& s) { s.showsMarkers = !s.showsMarkers; }, "Lights"},
    {GLFW_KEY_L, kNone, "L", "only the selected light shines, or all again",
     [](State& s) {
         std::optional<int>& solo = s.active().settings.soloLight;
         solo = solo || s.selectedLight == scenes::kNone ? std::nullopt : std::optional<int>(s.selectedLight);
     }},
    {GLFW_KEY_DELETE, kNone, "Del", "delete the selected lights", deleteSelectedLights},
    {GLFW_KEY_F2, kNone, "F2", "rename the selected light", beginRenaming},
    {GLFW_KEY_A, kControl, "Ctrl+A", "select all lights", selectAllLights},
    {GLFW_KEY_Z, kControl, "Ctrl+Z", "undo the latest edit, or jump of the camera", undo, "Edits"},
    {GLFW_KEY_Z, kControl | kShift, "Ctrl+Shift+Z", "redo; also Ctrl+Y", redo},
    {GLFW_KEY_Y, kControl, "", "", redo},
    {GLFW_KEY_F12, kNone, "F12", "save the picture as PNG; with Shift as EXR",
     [](State& s) { s.requests.savePng = true; }, "Files"},
    {GLFW_KEY_F12, kShift, "", "", [](State& s) { s.requests.saveExr = true; }},
    {GLFW_KEY_O, kControl, "Ctrl+O", "open a scene or an environment",
     [](State& s) { s.requests.showOpenDialog = true; }},
    {GLFW_KEY_S, kControl, "Ctrl+S", "save the scene with its edits", [](State& s) { s.requests.saveScene = true; }},
    {GLFW_KEY_S, kControl | kShift, "Ctrl+Shift+S", "save the scene or the picture under a name of your choice",
     [](State& s) { s.requests.showSaveDialog = true; }},
    {GLFW_KEY_C, kControl, "Ctrl+C", "copy the command that renders this picture",
     [](State& s) { s.requests.copyCommand = true; }},
};

constexpr GestureHelp kGestures[] = {
    {"Left drag", "turn about the pivot, or look around when flying; also with Shift"},
    {"Shift + right drag", "turns the environment; the angle stands beside the pointer"},
    {"Right drag", "move across the picture; also the middle button, and Alt + left drag"},
    {"Ctrl + left drag, wheel", "nearer and farther; the wheel towards the pointer"},
    {"Ctrl + wheel", "magnifies pixels; then the wheel goes on with that, and drags move the picture"},
    {"W A S D, Q E", "fly: forward, left, back, right; down, up. Shift is fast, the wheel sets the speed"},
    {"Click", "picks the material of the surface"},
    {"Double click", "slides the surface into the middle, and turns about it from then on"},
    {"Drag a light's marker", "moves the light across the picture; one of its arms, along x, y or z"},
    {"Drag a light's handle", "square: a side, radius or length, with Shift one side alone; round: its direction"},
    {"Drag the divider", "split view"},
    {"Drag the panels' edge", "makes them wider or narrower"},
    {"Ctrl or Shift + click", "on a light's name: selects several, or all between; what is edited then is that of all"},
    {"Double click", "on a light's name: renames it"},
    {"Drop a file", "anywhere: opens a scene (.gltf, .glb, .obj, .json), or takes an environment (.hdr, .exr)"},
};

} // namespace

std::span<const KeyBinding> keyBindings() {
    return kBindings;
}

std::span<const AxisView> axisViews() {
    return kAxisViews;
}

std::span<const GestureHelp> gestureHelp() {
    return kGestures;
}

bool pressKey(State& state, int key, int modifiers) {
    const int held = modifiers & (GLFW_MOD_SHIFT | GLFW_MOD_CONTROL);
    const auto found = std::find_if(std::begin(kBindings), std::end(kBindings), [&](const KeyBinding& binding) {
        return binding.key == key && binding.modifiers == held;
    });
    if (found == std::end(kBindings)) return false;
    found->act(state);
    return true;
}

} // namespace tessera::viewer
