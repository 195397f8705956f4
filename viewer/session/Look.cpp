#include "viewer/session/Look.h"

namespace tessera::viewer {

Look possible(Look look) {
    for (const engine::Setting& setting : engine::settingTable()) {
        if (!setting.isSupported(look)) {
            if (setting.comesBack) look.aside.insert_or_assign(std::string(setting.key), setting.text(look));
            setting.reset(look);
        }
        const auto aside = look.aside.find(setting.key);
        if (aside == look.aside.end() || !setting.isDefault(look)) continue;
        engine::ViewRequest tried = look;
        setting.read(tried, aside->second);
        if (!setting.isSupported(tried)) continue;
        setting.value.copy(look, tried);
        look.aside.erase(aside);
    }
    return look;
}

Look requested(Look look) {
    for (const engine::Setting& setting : engine::settingTable()) {
        const auto aside = look.aside.find(setting.key);
        if (aside != look.aside.end() && setting.isDefault(look)) setting.read(look, aside->second);
    }
    look.aside.clear();
    return look;
}

scenes::EnvironmentView environmentSeenBy(const Look& look) {
    const frame::EnvironmentSettings& settings = look.settings.environment;
    return {settings.rotationDegrees, settings.intensity};
}

void setEnvironmentSeenBy(Look& look, const scenes::EnvironmentView& view) {
    frame::EnvironmentSettings& settings = look.settings.environment;
    settings.rotationDegrees = view.rotationDegrees;
    settings.intensity = view.intensity;
}

Look rebased(const Look& now, const Look& before, const Look& base) {
    const Look chosen = requested(now), begun = requested(before);
    Look result = requested(base);
    for (const engine::Setting& setting : engine::settingTable())
        if (!setting.isOfScene && !setting.value.equal(chosen, begun)) setting.value.copy(result, chosen);
    return possible(result);
}

} // namespace tessera::viewer
