#include "validation/bench/AreaKey.h"

#include "engine/Settings.h"

namespace tessera::validation {

std::span<const AreaSetting> areaSettingTable() {
    static constexpr AreaSetting table[] = {{"areaSamples", "samples {}"}};
    return table;
}

AreaKey areaKeyOf(const frame::FrameSettings& settings) {
    AreaKey key{std::string(infoOf(settings.area.lights).name), {}};
    if (infoOf(settings.area.lights).takesSamples)
        for (const AreaSetting& row : areaSettingTable())
            key.values.push_back({row.key, engine::settingOf(row.key).text({.settings = settings})});
    return key;
}

std::string areaText(const AreaKey& key) {
    return "area lights " + key.method + changedTexts(key.values, areaSettingTable());
}

} // namespace tessera::validation
