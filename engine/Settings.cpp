#include "engine/Settings.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <functional>

#include "engine/SettingRows.h"
#include "engine/SettingValues.h"

namespace tessera::engine {

namespace {

std::vector<Setting> makeTable() {
    std::vector<Setting> table;
    for (auto* const rows : {frameSettings, environmentSettings, shadowSettings, subsurfaceSettings, pictureSettings})
        for (Setting& row : rows()) table.push_back(std::move(row));
    return table;
}

bool isDrawable(const Setting& setting, const ViewRequest& request) {
    return setting.isDefault(request) || setting.supports == nullptr || setting.supports(request);
}

/// Why the request's technique does not support the setting's requested value, and which techniques do.
std::string refusalOf(const Setting& setting, const ViewRequest& request) {
    std::vector<std::string_view> able;
    ViewRequest other = request;
    for (const TechniqueInfo& info : techniqueTable()) {
        other.technique = info.technique;
        if (setting.isSupported(other)) able.push_back(info.name);
    }
    return fmt::format("technique {} does not support {} {}{}{}; {} do", infoOf(request.technique).name, setting.name,
                       setting.text(request), setting.refusal.empty() ? "" : ", since ", setting.refusal,
                       fmt::join(able, ", "));
}

/// "Only hard, pcf and pcss use it": lists the rows that satisfy `isOne`, at least one.
template <typename Row, typename IsOne>
std::string onlyUsedBy(std::span<const Row> table, const IsOne& isOne) {
    std::vector<std::string_view> able;
    for (const Row& row : table)
        if (isOne(row)) able.push_back(row.name);
    std::string names(able.front());
    for (std::size_t i = 1; i < able.size(); ++i)
        names += fmt::format("{}{}", i + 1 < able.size() ? ", " : " and ", able[i]);
    return fmt::format("Only {} {} it", names, able.size() == 1 ? "uses" : "use");
}

// ---- Options of scene files -----------------------------------------------------------------------------------------

std::string_view typeOf(const scenes::OptionValue& value) {
    constexpr std::string_view kTypes[] = {"true or false", "a number", "text", "an array"};
    return kTypes[value.index()];
}

std::string_view typeOf(const Setting& setting) {
    const SettingKind& kind = setting.value.kind;
    if (const auto* choice = std::get_if<ChoiceKind>(&kind)) return choice->ofNumbers ? "a number" : "text";
    if (std::holds_alternative<NumberKind>(kind)) return "a number";
    if (std::holds_alternative<SwitchKind>(kind)) return "true or false";
    return std::holds_alternative<SizeKind>(kind) ? "an array" : "text";
}

/// Converts an option of a scene file to its text on the command line.
std::string textOf(const Setting& setting, const scenes::OptionValue& value) {
    const std::string* const word = std::get_if<std::string>(&value);
    const bool isOpen = word != nullptr && !setting.value.open.empty() && *word == setting.value.open;
    const auto* const choice = std::get_if<ChoiceKind>(&setting.value.kind);
    const bool isCount = choice != nullptr && choice->orCount && std::holds_alternative<double>(value);
    if (!isOpen && !isCount && typeOf(value) != typeOf(setting))
        throw InputError(fmt::format("is {}; {} is needed", typeOf(value), typeOf(setting)));
    if (word != nullptr) return *word;
    if (const auto* list = std::get_if<std::vector<double>>(&value)) return fmt::format("{}", fmt::join(*list, "x"));
    if (const auto* isOn = std::get_if<bool>(&value)) return *isOn ? "on" : "off";
    return numberText(std::get<double>(value));
}

} // namespace

void Setting::read(ViewRequest& request, const std::string& text, const TextSource& source) const {
    value.read(request, text, {source.called.empty() ? name : source.called, source.scene, name});
}

std::string Setting::panelLabel() const {
    std::string text(label.empty() ? name : label);
    if (label.empty()) text.front() = char(std::toupper(static_cast<unsigned char>(text.front())));
    return text;
}

std::string Setting::whyIdle(const ViewRequest& request, const scenes::Scene* scene) const {
    if (ofEnvironment && scene != nullptr && !scene->environment) return "There is no environment; choose a map";
    if (ofLight != nullptr && request.settings.soloLight)
        return "One light is shown alone, which leaves the environment's out";
    const frame::EnvironmentLightInfo& light = infoOf(request.settings.environment.light);
    if (ofLight != nullptr && !(light.*ofLight))
        return fmt::format("{}; the environment light is {}",
                           onlyUsedBy(frame::environmentLightTable(), std::mem_fn(ofLight)), light.name);
    const auto isArea = [](const scenes::Light& one) { return scenes::infoOf(one.type).isArea; };
    if (ofAreaLights && scene != nullptr && std::ranges::none_of(scene->lights, isArea))
        return "There is no area light";
    const frame::AreaLightsInfo& area = infoOf(request.settings.area.lights);
    if (ofAreaMethod != nullptr && !(area.*ofAreaMethod))
        return fmt::format("{}; the area lights are {}",
                           onlyUsedBy(frame::areaLightsTable(), std::mem_fn(ofAreaMethod)), area.name);
    const frame::ShadowFilterInfo& filter = infoOf(request.settings.shadowFilter);
    if (ofFilters != nullptr && !(filter.*ofFilters))
        return fmt::format("{}; the shadow filter is {}",
                           onlyUsedBy(frame::shadowFilterTable(), std::mem_fn(ofFilters)), filter.name);
    return {};
}

std::string Setting::whyIgnored(const ViewRequest& request, std::span<const Technique> techniques) const {
    const auto isUsed = [this](Technique technique) { return isUsedBy(technique); };
    // With `supports` or a refusal, a technique either refuses a value or behaves that way by default; it ignores none.
    const bool mayCount = techniques.empty() || isDefault(request) || supports != nullptr || !refusal.empty();
    if (mayCount || std::ranges::any_of(techniques, isUsed)) return {};
    std::vector<std::string_view> names;
    for (const Technique technique : techniques) names.push_back(infoOf(technique).name);
    return fmt::format("{}; the technique{} {}",
                       onlyUsedBy(techniqueTable(), [&](const TechniqueInfo& info) { return isUsed(info.technique); }),
                       names.size() == 1 ? " is" : "s are", fmt::join(names, ", "));
}

bool Setting::isSupported(const ViewRequest& request) const {
    if (isDefault(request)) return true;
    return isDrawable(*this, request) && (refusal.empty() || isUsedBy(request.technique));
}

std::string Setting::range() const {
    if (const auto* number = std::get_if<NumberKind>(&value.kind)) {
        const bool isBounded = std::isfinite(number->least) && std::isfinite(number->most);
        return isBounded ? boundsText(*number) : "";
    }
    const auto* choice = std::get_if<ChoiceKind>(&value.kind);
    if (choice == nullptr || !choice->ofNumbers) return "";
    std::string text;
    for (const ChoiceKind::Entry& entry : choice->entries)
        text += (text.empty() ? "" : &entry == &choice->entries.back() ? " or " : ", ") + entry.name;
    return text;
}

std::span<const Setting> settingTable() {
    static const std::vector<Setting> table = makeTable();
    return table;
}

const Setting& settingOf(std::string_view key) {
    const auto found = std::ranges::find(settingTable(), key, &Setting::key);
    assert(found != settingTable().end());
    return *found;
}

void requireDrawable(const ViewRequest& request) {
    for (const Setting& setting : settingTable())
        if (!isDrawable(setting, request)) throw InputError(refusalOf(setting, request));
}

void requireSupported(const ViewRequest& request) {
    for (const Setting& setting : settingTable())
        if (!setting.isSupported(request)) throw InputError(refusalOf(setting, request));
}

void applyRequestedOptions(const scenes::Scene& scene, const std::string& file, ViewRequest& request,
                           const std::function<bool(const Setting& setting)>& isSaid) {
    const scenes::SceneOptions& options = scene.options;
    std::vector<std::string_view> keys{"clip", "defaultLight"};
    for (const Setting& setting : settingTable())
        if (setting.isRequestable) keys.push_back(setting.key);
    for (const auto& [key, value] : options.requested)
        if (std::ranges::find(keys, key) == keys.end())
            throw InputError(
                fmt::format("{}:/options: an options object has no key '{}'; {}", file, key, suggestNames(key, keys)));
    for (const Setting& setting : settingTable()) {
        const auto found = options.requested.find(setting.key);
        const bool isCamera = setting.key == "camera" && options.camera; // stored beside the other options
        if (found == options.requested.end() && !isCamera) continue;
        try {
            const std::string text = isCamera ? *options.camera : textOf(setting, found->second);
            if (!isSaid(setting)) setting.read(request, text, {{}, &scene});
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}:/options/{}: {}", file, setting.key, error.what()));
        }
    }
}

} // namespace tessera::engine
