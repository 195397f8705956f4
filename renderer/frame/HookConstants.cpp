#include "renderer/frame/HookConstants.h"

#include <cassert>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tessera::frame {

static_assert(HOOK_PARAMETERS_MOST == scenes::kMostHookParameters);

HookShape hookShape(const scenes::Hook& hook) {
    HookShape shape{hook.file, hook.contentHash, {}, hook.changesSurfaces, hook.movesVertices};
    for (const scenes::HookParameter& parameter : hook.parameters) shape.parameters.push_back(parameter.name);
    return shape;
}

shader::Defines hookDefines(const HookShape& hook) {
    return {{"HOOK_HASH", fmt::format("{:#010x}u", std::uint32_t(hook.contentHash))},
            {"HOOK_SURFACE", hook.changesSurfaces ? "1" : "0"},
            {"HOOK_VERTEX", hook.movesVertices ? "1" : "0"},
            {std::string(shader::kHookFile), hook.file},
            {std::string(shader::kHookParameters), fmt::format("{}", fmt::join(hook.parameters, " "))}};
}

shared::HookConstants hookConstants(const scenes::Hook& hook, double timeSeconds) {
    assert(hook.parameters.size() <= scenes::kMostHookParameters);
    shared::HookConstants constants{};
    constants.numbers[0].x = float(timeSeconds);
    for (std::size_t i = 0; i < hook.parameters.size(); ++i)
        constants.numbers[(i + 1) / 4][glm::length_t((i + 1) % 4)] = hook.parameters[i].value;
    return constants;
}

} // namespace tessera::frame
