#include "validation/bench/EnvironmentKey.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/Settings.h"

namespace tessera::validation {

using frame::EnvironmentLight;

std::span<const EnvironmentSetting> environmentSettingTable() {
    static constexpr EnvironmentSetting table[] = {
        {"environmentSamples", "samples {}", [](EnvironmentLight light) { return light == EnvironmentLight::Sampled; },
         "the environment's light is not sampled"},
        {"environmentCompensation", "compensation {}",
         [](EnvironmentLight light) { return light != EnvironmentLight::Off; }, "there is no light of the environment"},
    };
    return table;
}

const std::string* EnvironmentKey::text(std::string_view key) const {
    const auto value = std::ranges::find(values, key, &Value::key);
    return value == values.end() ? nullptr : &value->text;
}

EnvironmentKey environmentKeyOf(const frame::FrameSettings& settings) {
    EnvironmentKey key{std::string(infoOf(settings.environment.light).name), {}};
    for (const EnvironmentSetting& row : environmentSettingTable())
        if (row.matters(settings.environment.light))
            key.values.push_back({row.key, engine::settingOf(row.key).text({.settings = settings})});
    return key;
}

std::string environmentText(const EnvironmentKey& key) {
    if (key.light == infoOf(EnvironmentLight::Off).name) return "no environment light";
    std::string text = "environment " + key.light;
    for (const EnvironmentSetting& row : environmentSettingTable()) {
        const std::string* const value = key.text(row.key);
        if (value && *value != engine::settingOf(row.key).text({}))
            text += ", " + fmt::format(fmt::runtime(row.format), *value);
    }
    return text;
}

} // namespace tessera::validation
