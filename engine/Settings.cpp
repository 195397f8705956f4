#include "engine/Settings.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/Error.h"
#include "base/Names.h"
#include "engine/ChooseCulling.h"
#include "engine/ChooseLighting.h"
#include "engine/ChooseSamples.h"
#include "engine/ChooseView.h"

namespace tessera::engine {

namespace {

using frame::FrameSettings;

// ---- Where a value is ----------------------------------------------------------------------------------------------

auto in(Technique FrameRequest::*member) {
    return [member](auto& request) -> auto& {
        return request.*member;
    };
}
template <typename Value>
auto in(Value FrameSettings::*member) {
    return [member](auto& request) -> auto& {
        return request.settings.*member;
    };
}
template <typename Value>
auto in(Value culling::Settings::*member) {
    return [member](auto& request) -> auto& {
        return request.settings.culling.*member;
    };
}

// Values that may be left open are optional.
template <typename Value>
const Value* given(const Value& value) {
    return &value;
}
template <typename Value>
const Value* given(const std::optional<Value>& value) {
    return value ? &*value : nullptr;
}
template <typename Value>
constexpr bool kIsOptional = false;
template <typename Value>
constexpr bool kIsOptional<std::optional<Value>> = true;

// ---- Kinds of values -----------------------------------------------------------------------------------------------

constexpr std::string_view kOpen = "automatic";

template <typename Number>
std::optional<Number> parsed(const std::string& text) {
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || rest != end) return std::nullopt;
    return value;
}

/// The number with the fewest digits that is read as the same one, to the last bit.
std::string numberText(double value) {
    return fmt::format("{}", value);
}
std::string numberText(int value) {
    return fmt::format("{}", value);
}
std::string numberText(float value) {
    const std::string text = fmt::format("{}", value);
    // Read as a double and rounded to single, text beside the middle of two floats may end up at the other one.
    return static_cast<float>(parsed<double>(text).value_or(0.0)) == value ? text
                                                                           : numberText(static_cast<double>(value));
}

/// What every kind has in common. `textOf` and `valueOf` are of a value that is given.
template <typename Get, typename TextOf, typename ValueOf>
SettingValue valueIn(Get get, SettingKind kind, TextOf textOf, ValueOf valueOf, std::string_view open = kOpen) {
    using Value = std::remove_reference_t<decltype(get(std::declval<FrameRequest&>()))>;
    SettingValue value{std::move(kind), kIsOptional<Value> ? open : "", {}, {}, {}, {}};
    value.text = [get, textOf, open](const FrameRequest& request, const scenes::Scene*) {
        const auto* const now = given(get(request));
        return now ? textOf(*now) : std::string(open);
    };
    value.read = [get, valueOf, open](FrameRequest& request, const std::string& text, const TextSource& source) {
        if constexpr (kIsOptional<Value>) {
            if (text == open) {
                get(request).reset();
                return;
            }
        }
        get(request) = valueOf(text, source);
    };
    value.equal = [get](const FrameRequest& a, const FrameRequest& b) { return get(a) == get(b); };
    value.copy = [get](FrameRequest& to, const FrameRequest& from) { get(to) = get(from); };
    return value;
}

/// What a row of a table says of itself beside its name.
template <typename Row>
std::string_view meaningOf(const Row& row) {
    if constexpr (requires { row.summary; })
        return row.summary;
    else if constexpr (requires { row.meaning; })
        return row.meaning;
    else if constexpr (requires { row.lighting; })
        return row.lighting;
    else
        return "";
}

/// One of a table's rows; `key` is the row's value.
template <typename Get, typename Row, typename Key>
SettingValue choice(std::string_view name, Get get, std::span<const Row> table, Key Row::*key) {
    ChoiceKind kind;
    for (const Row& row : table) kind.entries.push_back({std::string(row.name), std::string(row.name), meaningOf(row)});
    const auto textOf = [table, key](const Key& value) {
        const auto row = std::ranges::find(table, value, key);
        return row == table.end() ? std::string() : std::string(row->name);
    };
    const auto valueOf = [name, table, key](const std::string& text, const TextSource&) {
        std::vector<std::string_view> names;
        for (const Row& row : table) {
            if (row.name == text) return row.*key;
            names.push_back(row.name);
        }
        throw InputError(fmt::format("unknown {} '{}': {}", name, text, suggestNames(text, names)));
    };
    return valueIn(get, std::move(kind), textOf, valueOf);
}

int wholeNumber(const std::string& text, const TextSource& source) {
    if (const std::optional<int> value = parsed<int>(text)) return *value;
    throw InputError(fmt::format("{} '{}' is not a whole number, such as 8", source.called, text));
}

/// One of some whole numbers.
template <typename Get>
SettingValue choice(Get get, std::span<const int> numbers, std::string_view unit = "") {
    ChoiceKind kind{{}, true};
    for (const int number : numbers)
        kind.entries.push_back({numberText(number), numberText(number) + std::string(unit), ""});
    const auto valueOf = [numbers](const std::string& text, const TextSource& source) {
        const int value = wholeNumber(text, source);
        if (std::ranges::find(numbers, value) == numbers.end())
            throw InputError(fmt::format("{} {}: give one of {}", source.called, value, fmt::join(numbers, ", ")));
        return value;
    };
    return valueIn(
        get, std::move(kind), [](int value) { return numberText(value); }, valueOf);
}

void requireBounds(const NumberKind& kind, double value, const TextSource& source) {
    if (value >= kind.least && value <= kind.most) return;
    const std::string bounds = std::isinf(kind.most)    ? fmt::format("{} or more", kind.least)
                               : std::isinf(kind.least) ? fmt::format("{} or less", kind.most)
                                                        : fmt::format("{} to {}", kind.least, kind.most);
    throw InputError(fmt::format("{} {} is {} {}; give {}", source.called, value,
                                 value < kind.least ? "below" : "above", value < kind.least ? kind.least : kind.most,
                                 bounds));
}

/// A float or a double.
template <typename Get>
SettingValue number(Get get, const NumberKind& kind) {
    using Value = std::remove_reference_t<decltype(get(std::declval<FrameRequest&>()))>;
    const auto valueOf = [kind](const std::string& text, const TextSource& source) {
        const std::optional<double> value = parsed<double>(text);
        if (!value || !std::isfinite(*value))
            throw InputError(fmt::format("{} '{}' is not a finite number, such as 1.5", source.called, text));
        requireBounds(kind, *value, source);
        return static_cast<Value>(*value);
    };
    return valueIn(
        get, kind, [](Value value) { return numberText(value); }, valueOf);
}

SettingValue onOff(bool FrameSettings::*member) {
    const auto valueOf = [](const std::string& text, const TextSource& source) {
        if (text == "on" || text == "off") return text == "on";
        constexpr std::string_view kNames[] = {"on", "off"};
        throw InputError(fmt::format("unknown {} '{}': {}", source.called, text, suggestNames(text, kNames)));
    };
    return valueIn(
        in(member), SwitchKind{}, [](bool isOn) { return std::string(isOn ? "on" : "off"); }, valueOf);
}

SettingValue pictureSize() {
    const auto textOf = [](const glm::ivec2& size) { return fmt::format("{}x{}", size.x, size.y); };
    const auto valueOf = [](const std::string& text, const TextSource& source) {
        if (const std::optional<glm::ivec2> size = frame::sizeIn(text)) return *size;
        throw InputError(fmt::format("{} '{}' is not WIDTHxHEIGHT in pixels, each 1 to {}, as in 1280x720",
                                     source.called, text, frame::kLargestSidePixels));
    };
    return valueIn(in(&FrameSettings::sizePixels), SizeKind{}, textOf, valueOf);
}

// ---- Settings that are more than a value of a kind -----------------------------------------------------------------

/// Views also go by their numbers.
SettingValue viewChoice() {
    SettingValue value = choice("view", in(&FrameSettings::view), frame::debugViewTable(), &frame::DebugViewInfo::view);
    std::vector<ChoiceKind::Entry>& entries = std::get<ChoiceKind>(value.kind).entries;
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (const int key = frame::debugViewTable()[i].key; key > 0) entries[i].label += fmt::format("  ({})", key);
    value.read = [read = value.read](FrameRequest& request, const std::string& text, const TextSource& source) {
        for (const frame::DebugViewInfo& info : frame::debugViewTable())
            if (info.key != 0 && std::to_string(info.key) == text) return read(request, std::string(info.name), source);
        if (!text.empty() && text.find_first_not_of("0123456789") == std::string::npos)
            throw InputError(fmt::format("unknown view '{}': views are numbered 1 to 7", text));
        read(request, text, source);
    };
    return value;
}

int cameraNamed(const scenes::Scene& scene, const std::string& name) {
    if (const std::optional<std::size_t> camera = scenes::cameraCalled(scene, name)) return int(*camera);
    std::vector<std::string_view> names;
    for (const scenes::Camera& camera : scene.cameras) names.push_back(camera.name);
    throw InputError(fmt::format("{}: unknown camera '{}': {}", scene.name, name, suggestNames(name, names)));
}

SettingValue sceneCamera() {
    SettingValue value = valueIn(
        in(&FrameSettings::camera), CameraKind{}, [](int index) { return numberText(index); },
        [](const std::string&, const TextSource&) { return 0; });
    value.text = [](const FrameRequest& request, const scenes::Scene* scene) {
        const std::size_t index = std::size_t(request.settings.camera);
        if (scene == nullptr || index >= scene->cameras.size()) return numberText(request.settings.camera);
        const std::string& name = scene->cameras[index].name;
        const bool isCalledSo = !name.empty() && scenes::cameraCalled(*scene, name) == index;
        return isCalledSo ? name : numberText(request.settings.camera);
    };
    value.read = [](FrameRequest& request, const std::string& text, const TextSource& source) {
        if (source.scene) request.settings.camera = cameraNamed(*source.scene, text);
    };
    return value;
}

SettingValue soloLight() {
    const auto valueOf = [](const std::string& text, const TextSource& source) {
        const int light = wholeNumber(text, source);
        const std::size_t count = source.scene ? source.scene->lights.size() : 0;
        if (source.scene && (light < 0 || std::size_t(light) >= count))
            throw InputError(fmt::format("{} {}: {} has {} light{}, counted from 0", source.called, light,
                                         source.scene->name, count, count == 1 ? "" : "s"));
        return light;
    };
    return valueIn(
        in(&FrameSettings::soloLight), NumberKind{.least = 0.0, .isWhole = true},
        [](int light) { return numberText(light); }, valueOf, "all");
}

template <typename Row>
std::string namesOf(std::span<const Row> table) {
    std::string names;
    for (const Row& row : table) names += (names.empty() ? "" : ", ") + std::string(row.name);
    return names;
}

/// Those of the G-buffer's channels as one pattern.
std::string viewNames() {
    std::string names;
    for (const frame::DebugViewInfo& info : frame::debugViewTable())
        if (!info.needsGBuffer) names += std::string(info.name) + ", ";
    return names + "or gbuffer.CHANNEL and gbuffer.CHANNEL.w as stored, CHANNEL one of " +
           namesOf(frame::channelTable());
}

// ---- The table -----------------------------------------------------------------------------------------------------

bool hasGBuffer(Technique technique) {
    return infoOf(technique).usesGBuffer();
}
bool hasSeveralSamples(Technique technique) {
    return infoOf(technique).multisamples();
}
bool takesItsMethod(const FrameRequest& request) {
    return takesMethod(request.technique, request.settings.culling.method.value());
}
bool takesItsSamples(const FrameRequest& request) {
    return takesSamples(infoOf(request.technique), request.settings.samples);
}
bool takesItsStage(const FrameRequest& request) {
    return infoOf(request.technique).choosesStage;
}
bool takesItsView(const FrameRequest& request) {
    return takesView(infoOf(request.technique), request.settings.view);
}

std::vector<Setting> makeTable() {
    return {
        {.name = "technique",
         .flag = "--technique",
         .key = "technique",
         .type = "NAME",
         .help = "One of " + namesOf(techniqueTable()),
         .isRemembered = true,
         .value = choice("technique", in(&FrameRequest::technique), techniqueTable(), &TechniqueInfo::technique)},
        {.name = "layout",
         .flag = "--layout",
         .key = "layout",
         .type = "NAME",
         .help = "G-buffer layout, one of " + namesOf(frame::layoutTable()),
         .label = "G-buffer",
         .heeds = hasGBuffer,
         .isRemembered = true,
         .value = choice("layout", in(&FrameSettings::layout), frame::layoutTable(), &frame::LayoutInfo::layout)},
        {.name = "culling",
         .flag = "--culling",
         .key = "culling",
         .type = "NAME",
         .help = "How lights are culled, one of " + namesOf(culling::methodTable()),
         .byItself = "the technique's own",
         .heeds = hasLightLists,
         .takes = takesItsMethod,
         .samePicture = true,
         .isRemembered = true,
         .value =
             choice("culling", in(&culling::Settings::method), culling::methodTable(), &culling::MethodInfo::method)},
        {.name = "tile",
         .flag = "--tile",
         .key = "tile",
         .type = "PIXELS",
         .help = "Side of a light-culling tile, 8, 16, 32 or 64",
         .byItself = "16",
         .heeds = hasLightLists,
         .refusal = "it has no light lists",
         .samePicture = true,
         .isRemembered = true,
         .value = choice(in(&culling::Settings::tilePixels), culling::kTileSides, " pixels")},
        {.name = "cull-on",
         .flag = "--cull-on",
         .key = "cullOn",
         .type = "NAME",
         .help = "Who builds the light lists, one of " + namesOf(culling::builderTable()),
         .byItself = "by backend",
         .label = "Lists built by",
         .heeds = hasLightLists,
         .refusal = "it has no light lists",
         .samePicture = true,
         .value = choice("cull-on", in(&culling::Settings::builder), culling::builderTable(),
                         &culling::BuilderInfo::builder)},
        {.name = "light-on",
         .flag = "--light-on",
         .key = "lightOn",
         .type = "NAME",
         .help = "What lights the G-buffer, one of " + namesOf(frame::lightingStageTable()),
         .byItself = "fragment",
         .label = "Light on",
         .heeds = [](Technique technique) { return infoOf(technique).choosesStage; },
         .refusal = "it lights in fragment shaders only",
         .takes = takesItsStage,
         .samePicture = true,
         .value = choice("light-on", in(&FrameSettings::lightOn), frame::lightingStageTable(),
                         &frame::LightingStageInfo::stage)},
        {.name = "size",
         .flag = "--size",
         .key = "size",
         .type = "WxH",
         .help = "Picture size in pixels",
         .panel = SettingPanel::None,
         .sameCost = true,
         .value = pictureSize()},
        {.name = "samples",
         .flag = "--samples",
         .key = "samples",
         .type = "N",
         .help = "Samples of a pixel, 1, 2 or 4; more than 1 without a G-buffer only",
         .heeds = hasSeveralSamples,
         .refusal = "it has a G-buffer",
         .takes = takesItsSamples,
         .isRemembered = true,
         .value = choice(in(&FrameSettings::samples), frame::kSampleCounts)},
        {.name = "camera",
         .flag = "--camera",
         .key = "camera",
         .type = "NAME",
         .help = "A camera of the scene, by name or counted from 0",
         .byItself = "its first",
         .panel = SettingPanel::None,
         .sameCost = true,
         .isOfScene = true,
         .isShared = true,
         .value = sceneCamera()},
        {.name = "time",
         .flag = "--time",
         .key = "time",
         .type = "SECONDS",
         .help = "Moves animated lights to this time",
         .panel = SettingPanel::None,
         .sameCost = true,
         .isShared = true,
         .value = number(in(&FrameSettings::timeSeconds), {})},
        {.name = "range tolerance",
         .flag = "--range-tolerance",
         .key = "rangeTolerance",
         .type = "EPS",
         .help = "Ends lights of A B C falloff where they fall to this; compare tells what it drops",
         .panel = SettingPanel::None,
         .value = number(in(&FrameSettings::rangeTolerance), {.least = 0.0})},
        {.name = "view",
         .flag = "--view",
         .key = "view",
         .type = "NAME",
         .help = "What to show: 1 to 7, or one of " + viewNames(),
         .panel = SettingPanel::View,
         .refusal = "it has no G-buffer",
         .takes = takesItsView,
         .comesBack = false,
         .value = viewChoice()},
        {.name = "solo",
         .flag = "--solo",
         .key = "solo",
         .type = "N",
         .help = "Only this light shines, counted from 0",
         .panel = SettingPanel::None,
         .isOfScene = true,
         .isWishable = false, // lights may be deleted
         .isShared = true,
         .value = soloLight()},
        {.name = "specular",
         .flag = "--specular",
         .key = "specular",
         .type = "on|off",
         .help = "off leaves the specular lobe out",
         .value = onOff(&FrameSettings::specular)},
        {.name = "filter",
         .flag = "--filter",
         .key = "filter",
         .type = "NAME",
         .help = "Textures by hardware, or exact: level 0 alone, by the sampler's nearest or linear filter in full "
                 "precision",
         .panel = SettingPanel::None,
         .value = choice("filter", in(&FrameSettings::filter), frame::textureFilterTable(),
                         &frame::TextureFilterInfo::filter)},
        {.name = "space",
         .flag = "--space",
         .key = "space",
         .type = "NAME",
         .help = "Lighting in world or view space; the pictures agree",
         .panel = SettingPanel::None,
         .value =
             choice("space", in(&FrameSettings::space), frame::lightingSpaceTable(), &frame::LightingSpaceInfo::space)},
        {.name = "prune",
         .flag = "--prune",
         .key = "prune",
         .type = "on|off",
         .help = "off keeps what the scene does not need; the picture is the same",
         .label = "Prune",
         .value = onOff(&FrameSettings::prune)},
        {.name = "exposure",
         .flag = "--exposure",
         .key = "exposureEV",
         .type = "EV",
         .help = "Multiplies the display picture by 2^EV",
         .group = "Display",
         .panel = SettingPanel::View,
         .sameCost = true,
         .isShared = true,
         .value = number(in(&FrameSettings::exposureEV), {.least = -frame::kMostExposureEV,
                                                          .most = frame::kMostExposureEV,
                                                          .sliderLeast = -10.0f,
                                                          .sliderMost = 10.0f,
                                                          .format = "%+.1f EV"})},
        {.name = "tone map",
         .flag = "--tonemap",
         .key = "toneMap",
         .type = "NAME",
         .help = "One of " + namesOf(frame::toneMapTable()),
         .group = "Display",
         .panel = SettingPanel::View,
         .sameCost = true,
         .isShared = true,
         .isRemembered = true,
         .value = choice("tone map", in(&FrameSettings::toneMap), frame::toneMapTable(), &frame::ToneMapInfo::toneMap)},
    };
}

bool isDrawable(const Setting& setting, const FrameRequest& request) {
    return setting.isDefault(request) || setting.takes == nullptr || setting.takes(request);
}

/// Why the request's technique does not take the setting's requested value, and which techniques do.
std::string refusalOf(const Setting& setting, const FrameRequest& request) {
    std::vector<std::string_view> able;
    FrameRequest other = request;
    for (const TechniqueInfo& info : techniqueTable()) {
        other.technique = info.technique;
        if (setting.isTaken(other)) able.push_back(info.name);
    }
    return fmt::format("technique {} does not take {} {}{}{}; {} do", infoOf(request.technique).name, setting.name,
                       setting.text(request), setting.refusal.empty() ? "" : ", since ", setting.refusal,
                       fmt::join(able, ", "));
}

// ---- What scenes ask for -------------------------------------------------------------------------------------------

std::string_view typeOf(const scenes::Wish& wish) {
    constexpr std::string_view kTypes[] = {"true or false", "a number", "text", "an array"};
    return kTypes[wish.index()];
}

std::string_view typeOf(const Setting& setting) {
    const SettingKind& kind = setting.value.kind;
    if (const auto* choice = std::get_if<ChoiceKind>(&kind)) return choice->ofNumbers ? "a number" : "text";
    if (std::holds_alternative<NumberKind>(kind)) return "a number";
    if (std::holds_alternative<SwitchKind>(kind)) return "true or false";
    return std::holds_alternative<SizeKind>(kind) ? "an array" : "text";
}

/// A wish as the command line would say it.
std::string textOf(const Setting& setting, const scenes::Wish& wish) {
    const std::string* const word = std::get_if<std::string>(&wish);
    const bool isOpen = word != nullptr && !setting.value.open.empty() && *word == setting.value.open;
    if (!isOpen && typeOf(wish) != typeOf(setting))
        throw InputError(fmt::format("is {}; {} is needed", typeOf(wish), typeOf(setting)));
    if (word != nullptr) return *word;
    if (const auto* list = std::get_if<std::vector<double>>(&wish)) return fmt::format("{}", fmt::join(*list, "x"));
    if (const auto* isOn = std::get_if<bool>(&wish)) return *isOn ? "on" : "off";
    return numberText(std::get<double>(wish));
}

} // namespace

void Setting::read(FrameRequest& request, const std::string& text, const TextSource& source) const {
    value.read(request, text, {source.called.empty() ? name : source.called, source.scene});
}

std::string Setting::panelLabel() const {
    std::string text(label.empty() ? name : label);
    if (label.empty()) text.front() = char(std::toupper(static_cast<unsigned char>(text.front())));
    return text;
}

bool Setting::isTaken(const FrameRequest& request) const {
    if (isDefault(request)) return true;
    return isDrawable(*this, request) && (refusal.empty() || isHeededBy(request.technique));
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

void requireDrawable(const FrameRequest& request) {
    for (const Setting& setting : settingTable())
        if (!isDrawable(setting, request)) throw InputError(refusalOf(setting, request));
}

void requireTaken(const FrameRequest& request) {
    for (const Setting& setting : settingTable())
        if (!setting.isTaken(request)) throw InputError(refusalOf(setting, request));
}

void takeWishes(const scenes::Scene& scene, const std::string& file, FrameRequest& request,
                const std::function<bool(const Setting& setting)>& isSaid) {
    const scenes::SceneOptions& options = scene.options;
    std::vector<std::string_view> keys{"defaultLight"};
    for (const Setting& setting : settingTable())
        if (setting.isWishable) keys.push_back(setting.key);
    for (const auto& [key, wish] : options.wishes)
        if (std::ranges::find(keys, key) == keys.end())
            throw InputError(
                fmt::format("{}:/options: an options object has no key '{}'; {}", file, key, suggestNames(key, keys)));
    for (const Setting& setting : settingTable()) {
        const auto found = options.wishes.find(setting.key);
        const bool isCamera = setting.key == "camera" && options.camera; // which the scene needs to know itself
        if (found == options.wishes.end() && !isCamera) continue;
        try {
            const std::string text = isCamera ? *options.camera : textOf(setting, found->second);
            if (!isSaid(setting)) setting.read(request, text, {{}, &scene});
        } catch (const InputError& error) {
            throw InputError(fmt::format("{}:/options/{}: {}", file, setting.key, error.what()));
        }
    }
}

} // namespace tessera::engine
