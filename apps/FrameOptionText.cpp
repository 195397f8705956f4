#include "apps/FrameOptionText.h"

#include <fmt/format.h>

namespace tessera::app {

std::string frameOptionText(const FrameOptions& options) {
    std::string text;
    for (const engine::Setting& setting : engine::settingTable()) {
        const auto said = options.said(setting.key);
        if (!said) continue;
        engine::ViewRequest request;
        if (!setting.isOfScene) setting.read(request, *said); // so that 1.0 and 1 are the same command
        text += fmt::format(" {} {}", setting.flag, shellWord(setting.isOfScene ? *said : setting.text(request)));
    }
    if (options.lights) text += fmt::format(" --lights {}", *options.lights);
    if (options.clip) text += " --clip " + shellWord(*options.clip);
    text += viewer::hookText(options.hookValues);
    text += viewer::importText(options.import);
    if (options.defaultCamera) text += " --default-camera";
    text += viewer::poseText(options.pose);
    if (options.environment) text += " --environment " + shellWord(*options.environment);
    text += viewer::backgroundText(options.background);
    if (options.noDefaultLight) text += " --no-default-light";
    return text;
}

} // namespace tessera::app
