#include "apps/FrameOptionText.h"

#include <fmt/format.h>

namespace tessera::app {

std::string frameOptionText(const FrameOptions& options) {
    std::string text;
    const auto add = [&text](const char* flag, const auto& value) {
        if (value) text += fmt::format(" {} {}", flag, shellWord(fmt::format("{}", *value)));
    };
    add("--technique", options.technique);
    add("--layout", options.layout);
    add("--culling", options.culling);
    add("--tile", options.tile);
    add("--cull-on", options.cullOn);
    add("--light-on", options.lightOn);
    add("--size", options.size);
    add("--samples", options.samples);
    add("--camera", options.camera);
    add("--time", options.timeSeconds);
    add("--lights", options.lights);
    add("--range-tolerance", options.rangeTolerance);
    add("--view", options.view);
    add("--solo", options.solo);
    add("--specular", options.specular);
    add("--filter", options.filter);
    add("--space", options.space);
    add("--prune", options.prune);
    text += viewer::poseText(options.pose);
    add("--exposure", options.exposureEV);
    add("--tonemap", options.toneMap);
    if (options.noDefaultLight) text += " --no-default-light";
    return text;
}

} // namespace tessera::app
