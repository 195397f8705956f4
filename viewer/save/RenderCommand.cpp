#include "viewer/save/RenderCommand.h"

#include <fmt/format.h>

#include "viewer/save/OptionText.h"

namespace tessera::viewer {
namespace {

/// The settings that differ from the program's defaults and from the scene's options.
std::string options(const RenderRequest& request, const scenes::Scene& scene) {
    std::string text;
    engine::ViewRequest byItself;
    engine::applyRequestedOptions(scene, request.source, byItself);
    for (const engine::Setting& setting : engine::settingTable())
        if (!setting.value.equal(request, byItself))
            text += fmt::format(" {} {}", setting.flag, shellWord(setting.text(request, &scene)));
    if (request.lights) text += fmt::format(" --lights {}", *request.lights);
    if (request.environment) text += " --environment " + shellWord(*request.environment);
    text += backgroundText(request.background);
    if (request.clip) text += " --clip " + shellWord(*request.clip);
    text += hookText(request.hookValues);
    if (!request.defaultLight) text += " --no-default-light";
    text += importText(request.import);
    if (request.defaultCamera) text += " --default-camera";
    return text + poseText(request.pose);
}

/// Prefixes paths that begin with a dash, so that they are not taken for options.
std::string argument(const std::string& path) {
    return shellWord(path.starts_with('-') ? "./" + path : path);
}

} // namespace

std::string renderCommand(const RenderRequest& request, const scenes::Scene& scene, const std::string& output) {
    return fmt::format("tessera render {}{} -o {}", argument(request.source), options(request, scene),
                       argument(output));
}

} // namespace tessera::viewer
