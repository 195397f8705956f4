#pragma once
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/Techniques.h"
#include "renderer/frame/FrameSettings.h"
#include "scenes/Scene.h"

/// Settings: the options of a frame, one row each. The rows define the command line with its help and messages, the
/// options of scene files and their schema, printed and copied commands, and the viewer's widgets, comparisons and
/// preferences (docs/add-a-setting.md).
namespace tessera::engine {

/// A requested view of a scene: technique and settings.
struct ViewRequest {
    Technique technique = Technique::Deferred;
    frame::FrameSettings settings;
    bool operator==(const ViewRequest&) const = default;
};

/// A choice among names or whole numbers.
struct ChoiceKind {
    struct Entry {
        std::string name;         ///< as written in text
        std::string label;        ///< as the viewer shows it
        std::string_view meaning; ///< tooltip in the viewer
    };
    std::vector<Entry> entries;
    bool ofNumbers = false;
    bool orCount = false; ///< also any whole number, 0 or more
};
struct NumberKind {
    double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
    bool isWhole = false;
    float sliderLeast = 0.0f, sliderMost = 0.0f; ///< of the viewer's slider; equal ones: the valid range
    const char* format = "%.3f";                 ///< of the slider, for printf
};
struct SwitchKind {}; ///< on or off
struct SizeKind {};   ///< of an image: 1280x720
struct CameraKind {}; ///< of the scene, by name or counted from 0
using SettingKind = std::variant<ChoiceKind, NumberKind, SwitchKind, SizeKind, CameraKind>;

/// Context of a setting's text.
struct TextSource {
    std::string_view called{}; ///< the setting in messages, such as "--exposure"; empty: Setting::name
    /// The scene whose cameras and lights a text may name; null: not looked up yet.
    const scenes::Scene* scene = nullptr;
    std::string_view name{}; ///< Setting::name, which Setting::read() sets
};

/// Access to a setting's value in a request, independent of its type. Texts are those of the command line: read()
/// restores the value from text(), to the last bit.
struct SettingValue {
    SettingKind kind;
    std::string_view open{}; ///< the text of an unset value; empty: it is always set
    std::function<std::string(const ViewRequest& request, const scenes::Scene* scene)> text;
    std::function<void(ViewRequest& request, const std::string& text, const TextSource& source)> read;
    std::function<bool(const ViewRequest& a, const ViewRequest& b)> equal;
    std::function<void(ViewRequest& to, const ViewRequest& from)> copy;
};

enum class SettingPanel : std::uint8_t { None, Frame, Environment, Shadows, Skin, View };

/// A row of the settings table.
struct Setting {
    std::string_view name{};          ///< in messages: "range tolerance"
    std::string_view flag{};          ///< of the command line: "--range-tolerance"
    std::string_view key{};           ///< of scene files and of the viewer's preferences: "rangeTolerance"
    std::string_view type{};          ///< after the flag in --help: "METRES"
    std::string help{};               ///< its line in --help, without range() and the default
    std::string byItself{};           ///< the default as --help words it, where the value alone is unclear
    std::string_view group = "Frame"; ///< in --help

    SettingPanel panel = SettingPanel::Frame; ///< viewer panel of the setting; None: it has a widget elsewhere, or none
    std::string_view label{};                 ///< in the panel; empty: the name

    bool (*usedBy)(Technique technique) = nullptr; ///< whether it affects frames of a technique; null: all
    /// Why the other techniques refuse it: "it has no light lists"; empty: they ignore it.
    std::string_view refusal{};
    /// Property that a shadow filter must have for the setting to matter; null: none.
    bool frame::ShadowFilterInfo::*ofFilters = nullptr;
    bool ofEnvironment = false; ///< no effect without an environment
    bool ofReference = false;   ///< affects the reference only
    /// Property that an environment light method must have for the setting to matter; null: none.
    bool frame::EnvironmentLightInfo::*ofLight = nullptr;
    bool ofAreaLights = false; ///< no effect without area lights
    /// Property that an area light method must have for the setting to matter; null: none.
    bool frame::AreaLightsInfo::*ofAreaMethod = nullptr;
    bool (*supports)(const ViewRequest& request) = nullptr; ///< whether the technique supports its value; null: always

    bool samePicture = false; ///< changes speed, not the image: comparisons drop a value that a technique refuses
    bool sameCost = false;    ///< a pixel costs about the same for every value
    bool entersLight = true;  ///< may change incident light; if only other settings change, diffused irradiance is kept
    bool isOfScene = false;   ///< refers to objects of one scene
    bool isRequestable = true; ///< scene files may set it
    bool isShared = false;     ///< by the two sides of the viewer's comparisons
    bool isOfFrame = false;    ///< must be equal for all views of a frame, which share data that depends on it
    bool isRemembered = false; ///< by the viewer from one run to the next
    bool comesBack = true;     ///< the viewer restores its value when a technique supports it again

    SettingValue value;

    std::string text(const ViewRequest& request, const scenes::Scene* scene = nullptr) const {
        return value.text(request, scene);
    }
    /// Throws InputError that names the setting and its valid values.
    void read(ViewRequest& request, const std::string& text, const TextSource& source = {}) const;
    std::string panelLabel() const;
    /// "1 to 1024", "1, 2 or 4": the valid numbers; empty if unbounded or not a number.
    std::string range() const;
    bool isDefault(const ViewRequest& request) const { return value.equal(request, ViewRequest()); }
    void reset(ViewRequest& request) const { value.copy(request, ViewRequest()); }
    bool isUsedBy(Technique technique) const { return usedBy == nullptr || usedBy(technique); }
    /// Why the setting has no effect, given the request's other settings, such as the shadow filter, and the scene
    /// unless null; empty: it may have one.
    std::string whyIdle(const ViewRequest& request, const scenes::Scene* scene = nullptr) const;
    /// Why all of these techniques ignore the requested value; empty: it may affect one, or one refuses it.
    std::string whyIgnored(const ViewRequest& request, std::span<const Technique> techniques) const;
    /// Whether the request's technique supports the requested value of this setting.
    bool isSupported(const ViewRequest& request) const;
};

/// All settings, in the order of --help.
std::span<const Setting> settingTable();
/// The setting of a key, which must exist.
const Setting& settingOf(std::string_view key);

/// Throws InputError for the first setting that the request's technique does not support, and names techniques that do.
void requireSupported(const ViewRequest& request);
/// The same for values that it cannot draw; settings that it ignores are accepted.
void requireDrawable(const ViewRequest& request);

/// Applies the options of the scene file, except settings given by the user (`isSaid`). Throws InputError
/// "FILE:/options/KEY: what"; `file` is the scene's file.
void applyRequestedOptions(
    const scenes::Scene& scene, const std::string& file, ViewRequest& request,
    const std::function<bool(const Setting& setting)>& isSaid = [](const Setting&) { return false; });

} // namespace tessera::engine
