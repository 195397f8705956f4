#include "validation/bench/EnvironmentKey.h"

#include "engine/Settings.h"

namespace tessera::validation {

using frame::EnvironmentLight;

std::span<const EnvironmentSetting> environmentSettingTable() {
    static constexpr EnvironmentSetting table[] = {
        {"environmentSamples", "samples {}", [](EnvironmentLight light) { return infoOf(light).takesSamples; },
         "the environment's light is not sampled"},
        {"environmentCompensation", "compensation {}", [](EnvironmentLight light) { return infoOf(light).lights; },
         "there is no light of the environment"},
    };
    return table;
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
    return "environment " + key.light + changedTexts(key.values, environmentSettingTable());
}

} // namespace tessera::validation
