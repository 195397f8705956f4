#include "renderer/frame/HookConstants.h"

#include <cassert>

namespace tessera::frame {

static_assert(HOOK_PARAMETERS_MOST == scenes::kMostHookParameters);

HookShape hookShape(const scenes::Hook& hook) {
    HookShape shape{hook.file, hook.contentHash, {}};
    for (const scenes::HookParameter& parameter : hook.parameters) shape.parameters.push_back(parameter.name);
    return shape;
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
