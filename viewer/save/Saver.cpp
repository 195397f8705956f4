#include "viewer/save/Saver.h"

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "base/AtomicFile.h"
#include "base/Extension.h"
#include "base/PictureFile.h"
#include "engine/Rendering.h"
#include "validation/pictures/ShownPicture.h"
#include "viewer/save/ChromeTrace.h"
#include "viewer/save/RenderCommand.h"
#include "viewer/save/SaveScene.h"
#include "viewer/session/DrawnLook.h"
#include "viewer/session/FreePath.h"

namespace tessera::viewer {
namespace {

TraceFrame traced(const FrameTimes& frame) {
    TraceFrame result;
    result.number = frame.number;
    result.startSeconds = frame.startedMs / 1000.0;
    result.cpuMs = frame.ms;
    for (const gpu::PassTiming& pass : frame.passes) result.passes.push_back({pass.name, pass.cpuMs, pass.gpuMs});
    return result;
}

/// Joins images side by side, with black below lower ones.
DisplayImage besideOneAnother(std::span<const DisplayImage> images) {
    DisplayImage whole;
    for (const DisplayImage& image : images) {
        whole.width += image.width;
        whole.height = std::max(whole.height, image.height);
    }
    whole.rgb.resize(3 * whole.pixelCount());
    std::size_t left = 0;
    for (const DisplayImage& image : images) {
        const std::size_t bytes = 3 * std::size_t(image.width);
        for (std::size_t y = 0; y < std::size_t(image.height); ++y)
            std::copy_n(image.rgb.begin() + std::ptrdiff_t(y * bytes), bytes,
                        whole.rgb.begin() + std::ptrdiff_t(3 * (y * std::size_t(whole.width) + left)));
        left += std::size_t(image.width);
    }
    return whole;
}

} // namespace

std::string Saver::freeName(const char* ending) const {
    return freePath(savedStem(state_.open->source()), ending).string();
}

void Saver::report(const std::string& path) {
    state_.notice = {"Saved " + std::filesystem::absolute(path).string(), false};
    log_.line("saved " + path);
}

engine::RenderedFrame Saver::rendered(Look& look, glm::ivec2 sizePixels, bool display) {
    look.settings.sizePixels = sizePixels;
    look.settings.display = display;
    return screen_.renderer()->render(look.technique, look.settings);
}

void Saver::picture(glm::ivec2 sizePixels, const std::string& path) {
    if (extensionOf(path) == ".exr") {
        Look look = drawnLook(state_, state_.activeSide);
        writeExr(path, engine::toPicture(rendered(look, sizePixels, false)));
        return report(path);
    }
    std::vector<DisplayImage> sides;
    for (int side = 0; side < state_.sides(); ++side) {
        Look look = drawnLook(state_, side);
        const engine::RenderedFrame frame = rendered(look, sizePixels, true);
        sides.push_back(validation::shownPicture(frame, screen_.renderer()->shadows(), state_.open->scene().name,
                                                 look.technique, look.settings.view));
    }
    writePng(path, besideOneAnother(sides));
    report(path);
}

void Saver::scene(const std::string& path) {
    saveOpenScene(state_, path);
    report(path);
}

std::string Saver::command(glm::ivec2 sizePixels) {
    const OpenScene& open = *state_.open;
    assert(!open.isEdited());
    const Look look = drawnLook(state_, state_.activeSide);
    RenderRequest request;
    request.source = open.source();
    request.lights = open.load().lights;
    request.defaultLight = open.load().defaultLight;
    request.defaultCamera = open.load().defaultCamera;
    request.environment = open.load().environment;
    request.background = open.load().background;
    request.clip = open.load().clip;
    request.hookValues = open.load().hookValues;
    request.import = open.load().import;
    request.technique = look.technique;
    request.settings = look.settings;
    request.settings.sizePixels = sizePixels;
    request.pose = open.cameraChange();
    const std::string text = renderCommand(request, open.scene(), freeName(".exr"));
    log_.line("command " + text);
    return text;
}

void Saver::trace() {
    std::vector<TraceFrame> frames;
    for (const FrameTimes& frame : state_.timings.frames()) frames.push_back(traced(frame));
    const std::string path = freeName(".trace.json");
    writeFileAtomically(path, chromeTrace(frames, screen_.capabilities().renderer));
    report(path);
}

} // namespace tessera::viewer
