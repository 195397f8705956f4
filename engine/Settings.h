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

/// Settings: the options of a frame, a row each. These follow from the rows: the command line with its help and
/// messages, the options of scene files and their schema, printed and copied commands, and the viewer's widgets,
/// comparisons and preferences (docs/add-a-setting.md).
namespace tessera::engine {

/// A request for a view of a scene: a technique, and the settings of its pictures.
struct ViewRequest {
    Technique technique = Technique::Deferred;
    frame::FrameSettings settings;
    bool operator==(const ViewRequest&) const = default;
};

/// One of some names, or of some whole numbers.
struct ChoiceKind {
    struct Entry {
        std::string name;         ///< as it is written
        std::string label;        ///< as the viewer shows it
        std::string_view meaning; ///< a tip of the viewer
    };
    std::vector<Entry> entries;
    bool ofNumbers = false;
    bool orCount = false; ///< or any whole number, 0 or more
};
struct NumberKind {
    double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
    bool isWhole = false;
    float sliderLeast = 0.0f, sliderMost = 0.0f; ///< of the viewer's slider; equal ones: all that is taken
    const char* format = "%.3f";                 ///< of the slider, for printf
};
struct SwitchKind {}; ///< on or off
struct SizeKind {};   ///< of a picture: 1280x720
struct CameraKind {}; ///< of the scene, by name or counted from 0
using SettingKind = std::variant<ChoiceKind, NumberKind, SwitchKind, SizeKind, CameraKind>;

/// Where a text comes from.
struct TextSource {
    std::string_view called{}; ///< the setting in messages, such as "--exposure"; empty: Setting::name
    /// The scene whose cameras and lights a text may name; null: not looked up yet.
    const scenes::Scene* scene = nullptr;
    std::string_view name{}; ///< Setting::name, which Setting::read() sets
};

/// A setting's value in a request, whatever its type. Texts are those of the command line: read() restores the value
/// from text(), to the last bit.
struct SettingValue {
    SettingKind kind;
    std::string_view open{}; ///< the text that leaves it open; empty: it is never open
    std::function<std::string(const ViewRequest& request, const scenes::Scene* scene)> text;
    std::function<void(ViewRequest& request, const std::string& text, const TextSource& source)> read;
    std::function<bool(const ViewRequest& a, const ViewRequest& b)> equal;
    std::function<void(ViewRequest& to, const ViewRequest& from)> copy;
};

enum class SettingPanel : std::uint8_t { None, Frame, Environment, Shadows, Skin, View };

/// A row of the table.
struct Setting {
    std::string_view name{};          ///< of messages: "range tolerance"
    std::string_view flag{};          ///< of the command line: "--range-tolerance"
    std::string_view key{};           ///< of scene files and of the viewer's preferences: "rangeTolerance"
    std::string_view type{};          ///< behind the flag in --help: "METRES"
    std::string help{};               ///< its line in --help, without range() and the default
    std::string byItself{};           ///< the default as --help words it, where the value alone is unclear
    std::string_view group = "Frame"; ///< in --help

    SettingPanel panel = SettingPanel::Frame; ///< of the viewer that shows it; None: it has a widget elsewhere, or none
    std::string_view label{};                 ///< there; empty: the name

    bool (*heeds)(Technique technique) = nullptr; ///< whether it changes anything of that technique's frames; null: all
    /// Why the other techniques refuse it: "it has no light lists"; empty: they ignore it.
    std::string_view refusal{};
    /// What of a shadow filter heeds it; null: it is heeded with any.
    bool frame::ShadowFilterInfo::*ofFilters = nullptr;
    bool ofEnvironment = false; ///< it changes nothing of a scene without an environment
    bool ofReference = false;   ///< no technique heeds it, the reference alone does
    /// Whether a way to find the environment's light reads the setting; null: all do.
    bool frame::EnvironmentLightInfo::*ofLight = nullptr;
    bool ofAreaLights = false; ///< it changes nothing of a scene without area lights
    /// Whether a way to find the light of area lights reads the setting; null: all do.
    bool frame::AreaLightsInfo::*ofAreaMethod = nullptr;
    bool (*takes)(const ViewRequest& request) = nullptr; ///< whether the technique can draw it; null: always

    bool samePicture = false; ///< changes how a picture is made and how fast, not the picture: comparisons drop a value
                              ///< that a technique refuses
    bool sameCost = false;    ///< a pixel costs about the same for every value
    bool entersLight = true;  ///< may change the light that enters surfaces: light that has spread over them is kept
                              ///< while only others change
    bool isOfScene = false;   ///< names things of one scene
    bool isWishable = true;   ///< scene files may ask for it
    bool isShared = false;    ///< by the two sides of the viewer's comparisons
    bool isOfFrame = false;   ///< all views of a frame have the same value, since they share what is made by it
    bool isRemembered = false; ///< by the viewer from one run to the next
    bool comesBack = true;     ///< the viewer restores its value when a technique takes it again

    SettingValue value;

    std::string text(const ViewRequest& request, const scenes::Scene* scene = nullptr) const {
        return value.text(request, scene);
    }
    /// Throws InputError that names the setting and its valid values.
    void read(ViewRequest& request, const std::string& text, const TextSource& source = {}) const;
    std::string panelLabel() const;
    /// "1 to 1024", "1, 2 or 4": the numbers that it takes; empty where they have no two ends, and of other kinds.
    std::string range() const;
    bool isDefault(const ViewRequest& request) const { return value.equal(request, ViewRequest()); }
    void reset(ViewRequest& request) const { value.copy(request, ViewRequest()); }
    bool isHeededBy(Technique technique) const { return heeds == nullptr || heeds(technique); }
    /// Why it changes nothing with the request's other settings, such as the shadow filter, or of the scene, unless
    /// that is null; empty: it may.
    std::string whyIdle(const ViewRequest& request, const scenes::Scene* scene = nullptr) const;
    /// Why the requested value changes nothing of frames of these techniques, which all ignore it; empty: it may, or
    /// some refuse it.
    std::string whyIgnored(const ViewRequest& request, std::span<const Technique> techniques) const;
    /// Whether the request's technique takes the requested value of this setting.
    bool isTaken(const ViewRequest& request) const;
};

/// In the order of --help.
std::span<const Setting> settingTable();
/// The row of that key, which must be there.
const Setting& settingOf(std::string_view key);

/// Throws InputError for the first setting that the request's technique does not take, with those that do.
void requireTaken(const ViewRequest& request);
/// The same for values that it cannot draw; settings that it ignores change nothing.
void requireDrawable(const ViewRequest& request);

/// Applies the options of the scene itself, except settings that the user gave (`isSaid`). Throws InputError
/// "FILE:/options/KEY: what"; `file` is the scene's file.
void takeWishes(
    const scenes::Scene& scene, const std::string& file, ViewRequest& request,
    const std::function<bool(const Setting& setting)>& isSaid = [](const Setting&) { return false; });

} // namespace tessera::engine
