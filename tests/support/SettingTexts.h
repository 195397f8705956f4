#pragma once
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "engine/Settings.h"

namespace tessera::test {

/// Valid values of a setting as text, including its default and its unset value; all names of a choice. Values that
/// depend on a scene are valid for one with two cameras and a light.
inline std::vector<std::string> textsOf(const engine::Setting& setting) {
    std::vector<std::string> texts{setting.text(engine::ViewRequest())};
    if (!setting.value.open.empty()) texts.emplace_back(setting.value.open);
    const engine::SettingKind& kind = setting.value.kind;
    if (const auto* choice = std::get_if<engine::ChoiceKind>(&kind)) {
        for (const engine::ChoiceKind::Entry& entry : choice->entries) texts.push_back(entry.name);
    } else if (const auto* number = std::get_if<engine::NumberKind>(&kind)) {
        const double least = std::isfinite(number->least) ? number->least : -1e7;
        const double most = std::isfinite(number->most) ? number->most : 1e7;
        texts.push_back(fmt::format("{}", least));
        if (!setting.isOfScene) texts.push_back(fmt::format("{}", most));
        if (!number->isWhole) texts.push_back(fmt::format("{}", least + (most - least) / 3.0));
    } else if (std::holds_alternative<engine::SwitchKind>(kind)) {
        texts.insert(texts.end(), {"on", "off"});
    } else if (std::holds_alternative<engine::SizeKind>(kind)) {
        texts.insert(texts.end(), {"641x359", "1x16384"});
    } else {
        texts.emplace_back("1");
    }
    return texts;
}

/// A request that differs from the default in this setting.
inline engine::ViewRequest changedIn(const engine::Setting& setting, const scenes::Scene& scene) {
    engine::ViewRequest request;
    for (const std::string& text : textsOf(setting)) {
        setting.read(request, text, {{}, &scene});
        if (!setting.isDefault(request)) return request;
    }
    throw std::logic_error(fmt::format("{} has one value only", setting.name));
}

/// A scene of two cameras and a light, for settings that name a camera or a light.
inline scenes::Scene sceneOfTwoCameras() {
    scenes::Scene scene;
    scene.name = "two";
    scene.cameras.resize(2);
    scene.cameras[0].name = "front";
    scene.cameras[1].name = "side";
    scene.lights.resize(1);
    return scene;
}

} // namespace tessera::test
