#include "engine/Settings.h"

#include <set>

#include <gmock/gmock.h>

#include "base/Error.h"
#include "scenes/Fingerprint.h"
#include "scenes/Load.h"
#include "scenes/write/SceneText.h"
#include "tests/support/ErrorText.h"
#include "tests/support/SettingTexts.h"
#include "tests/support/TempFolder.h"

namespace tessera::engine {
namespace {

using test::changedIn;
using test::sceneOfTwoCameras;
using test::textsOf;
using testing::HasSubstr;

std::string refusal(const auto& work) {
    return test::errorText<InputError>(work);
}

/// The members in which two requests differ: those that users set, then the others. A new member of a struct does not
/// compile here until it is listed.
struct Differences {
    std::vector<bool> ofUsers, ofOthers;
};
Differences differences(const ViewRequest& a, const ViewRequest& b) {
    const auto members = [](const ViewRequest& request) {
        const auto& [technique, settings] = request;
        const auto& [sizePixels, wholePixels, samples, samplePlaces, camera, timeSeconds, eyeOffsetWS, offsetPixels,
                     layout, view, idsOfNearest, filter, space, prune, specular, rangeTolerance, soloLight, shadows,
                     shadowFilter, shadowSamples, shadowMaps, shadowTerminator, subsurface, diffusion, environment,
                     area, refraction, glassDepth, culling, lightOn, snapPixels, texturesAStage, hasClosedBodies,
                     softwareBackend, display, exposureEV, toneMap] = settings;
        const auto& [method, tilePixels, builder, normals, lanes] = culling;
        const auto& [sideTexels, gaussians, half] = diffusion;
        const auto& [light, lightSamples, compensates, rotationDegrees, intensity, backdrop] = environment;
        const auto& [areaLights, areaSamples] = area;
        const auto& [widthTexels, resolutionTexels, budgetMiB, cascades] = shadowMaps;
        return std::pair(std::tuple(technique, sizePixels, samples, camera, timeSeconds, layout, view, filter, space,
                                    prune, specular, rangeTolerance, soloLight, shadows, shadowFilter, shadowSamples,
                                    widthTexels, resolutionTexels, budgetMiB, cascades, shadowTerminator, subsurface,
                                    sideTexels, gaussians, half, light, lightSamples, compensates, rotationDegrees,
                                    intensity, backdrop, areaLights, areaSamples, refraction, glassDepth, method,
                                    tilePixels, builder, normals, lightOn, exposureEV, toneMap),
                         std::tuple(wholePixels, samplePlaces, eyeOffsetWS, offsetPixels, idsOfNearest, snapPixels,
                                    texturesAStage, hasClosedBodies, softwareBackend, display, lanes));
    };
    const auto differ = []<std::size_t... kIndex>(const auto& x, const auto& y, std::index_sequence<kIndex...>) {
        return std::vector<bool>{!(std::get<kIndex>(x) == std::get<kIndex>(y))...};
    };
    const auto membersA = members(a), membersB = members(b);
    using Users = std::tuple_size<decltype(membersA.first)>;
    using Others = std::tuple_size<decltype(membersA.second)>;
    return {differ(membersA.first, membersB.first, std::make_index_sequence<Users::value>()),
            differ(membersA.second, membersB.second, std::make_index_sequence<Others::value>())};
}

TEST(Settings, everyMemberThatUsersSetIsChangedByExactlyOneRowAndNoOtherMemberIs) {
    const ViewRequest standard;
    std::vector<int> changes(differences(standard, standard).ofUsers.size(), 0);
    for (const Setting& setting : settingTable()) {
        const Differences changed = differences(changedIn(setting, sceneOfTwoCameras()), standard);
        EXPECT_EQ(std::ranges::count(changed.ofUsers, true), 1) << setting.name;
        EXPECT_EQ(std::ranges::count(changed.ofOthers, true), 0) << setting.name;
        for (std::size_t i = 0; i < changes.size(); ++i) changes[i] += changed.ofUsers[i] ? 1 : 0;
    }
    EXPECT_EQ(changes, std::vector<int>(changes.size(), 1)) << "by member, in the order of differences()";
}

TEST(Settings, theTextOfAValueIsReadAsTheSameOne) {
    const scenes::Scene scene = sceneOfTwoCameras();
    for (const Setting& setting : settingTable()) {
        const ViewRequest changed = changedIn(setting, scene);
        for (const std::string& text : textsOf(setting)) {
            SCOPED_TRACE(fmt::format("{} {}", setting.flag, text));
            ViewRequest first, second = changed;
            setting.read(first, text, {{}, &scene});
            for (const scenes::Scene* names : {static_cast<const scenes::Scene*>(nullptr), &scene}) {
                setting.read(second, setting.text(first, names), {{}, &scene});
                EXPECT_EQ(first, second) << setting.text(first, names);
            }
        }
    }
}

TEST(Settings, theDefaultIsThatOfTheStructAndIsSupportedByEveryTechnique) {
    const scenes::Scene scene = sceneOfTwoCameras();
    for (const Setting& setting : settingTable()) {
        SCOPED_TRACE(setting.name);
        ViewRequest request = changedIn(setting, scene);
        EXPECT_FALSE(setting.isDefault(request));
        setting.read(request, setting.text(ViewRequest()), {{}, &scene});
        EXPECT_EQ(request, ViewRequest());
        request = changedIn(setting, scene);
        setting.reset(request);
        EXPECT_EQ(request, ViewRequest());
        for (const TechniqueInfo& info : techniqueTable()) EXPECT_TRUE(setting.isSupported({info.technique, {}}));
    }
}

TEST(Settings, everyRowHasNamesOfItsOwnAndWordsForHelp) {
    std::set<std::string_view> names, flags, keys;
    for (const Setting& setting : settingTable()) {
        EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
        EXPECT_TRUE(flags.insert(setting.flag).second && setting.flag.starts_with("--")) << setting.flag;
        EXPECT_TRUE(keys.insert(setting.key).second) << setting.key;
        EXPECT_EQ(&settingOf(setting.key), &setting);
        EXPECT_FALSE(setting.type.empty() || setting.help.empty()) << setting.name;
        EXPECT_TRUE(setting.group == "Frame" || setting.group == "Environment" || setting.group == "Shadows" ||
                    setting.group == "Subsurface scattering" || setting.group == "Display")
            << setting.name;
        const bool isRefused = setting.supports != nullptr || !setting.refusal.empty();
        EXPECT_FALSE(isRefused && setting.usedBy == nullptr && setting.supports == nullptr) << setting.name;
        const bool hasWidget = std::holds_alternative<ChoiceKind>(setting.value.kind) || setting.value.open.empty();
        EXPECT_TRUE(setting.panel == SettingPanel::None || hasWidget)
            << setting.name << ": no widget can leave it open";
    }
}

TEST(Settings, invalidValuesAreRefusedByTheNameThatTheUserWrote) {
    for (const Setting& setting : settingTable()) {
        const scenes::Scene scene = sceneOfTwoCameras();
        ViewRequest request;
        for (const char* text : {"", "nix", "on|off", "-1e999"}) {
            const std::string fault = refusal([&] { setting.read(request, text, {setting.flag, &scene}); });
            EXPECT_THAT(fault, HasSubstr(fmt::format("'{}'", text))) << setting.name;
            EXPECT_TRUE(fault.find(setting.flag) != fault.npos || fault.find(setting.name) != fault.npos) << fault;
        }
        const auto* number = std::get_if<NumberKind>(&setting.value.kind);
        for (const double beyond : {number ? number->least - 0.5 : 0.0, number ? number->most + 0.5 : 0.0}) {
            if (!std::isfinite(beyond) || number == nullptr || number->isWhole) continue;
            const std::string text = fmt::format("{}", beyond);
            EXPECT_THAT(refusal([&] {
                            setting.read(request, text, {setting.flag, nullptr});
                        }),
                        HasSubstr(fmt::format("{} {} is ", setting.flag, text)));
        }
        EXPECT_EQ(request, ViewRequest());
    }
    ViewRequest request;
    EXPECT_EQ(refusal([&] { settingOf("tile").read(request, "7"); }), "tile 7: give one of 8, 16, 32, 64");
    EXPECT_EQ(refusal([&] {
                  settingOf("exposureEV").read(request, "121", {"--exposure", nullptr});
              }),
              "--exposure 121 is above 120; give -120 to 120");
    EXPECT_EQ(refusal([&] { settingOf("rangeTolerance").read(request, "-1"); }),
              "range tolerance -1 is below 0; give 0 or more");
}

TEST(Settings, wholeNumbersOfAnySizeAreAnsweredWithTheRange) {
    ViewRequest request;
    const std::string digits(400, '9'); // more than a double holds
    const auto refused = [&](const char* key, const std::string& text, const scenes::Scene* scene = nullptr) {
        return refusal([&] { settingOf(key).read(request, text, {{}, scene}); });
    };
    EXPECT_EQ(refused("shadowSamples", "2147483648"), "shadow samples 2147483648 is above 1024; give 1 to 1024");
    EXPECT_EQ(refused("shadowSamples", "-99999999999"), "shadow samples -99999999999 is below 1; give 1 to 1024");
    EXPECT_THAT(refused("shadowSamples", digits), HasSubstr("is above 1024; give 1 to 1024"));
    EXPECT_EQ(refused("tile", "99999999999"), "tile 99999999999: give one of 8, 16, 32, 64");
    EXPECT_EQ(refused("shadows", "2147483648"), "shadows 2147483648 is above 2147483647; give 0 to 2147483647");
    const scenes::Scene scene = sceneOfTwoCameras();
    EXPECT_THAT(refused("solo", "99999999999", &scene), HasSubstr("counted from 0"));
    EXPECT_THAT(refused("solo", "-" + digits, &scene), HasSubstr("counted from 0"));
    EXPECT_EQ(refused("solo", digits), "") << "not known without the scene";
    EXPECT_GE(*request.settings.soloLight, int(scene.lights.size()));
}

TEST(Settings, theRangeIsThatOfTheKind) {
    EXPECT_EQ(settingOf("shadowSamples").range(), "1 to 1024");
    EXPECT_EQ(settingOf("shadowBudget").range(), "0.001 to 1024");
    EXPECT_EQ(settingOf("samples").range(), "1, 2 or 4");
    for (const char* key : {"rangeTolerance", "solo", "time", "technique", "shadows", "size", "prune"})
        EXPECT_EQ(settingOf(key).range(), "") << key;
}

TEST(Settings, shadowsAreThoseOfSomeLightsOrOfTheFirstFew) {
    const Setting& shadows = settingOf("shadows");
    using Kind = scenes::ShadowRequest::Kind;
    ViewRequest request;
    EXPECT_EQ(shadows.text(request), "scene");
    for (const auto& [text, value] : std::initializer_list<std::pair<const char*, scenes::ShadowRequest>>{
             {"none", {Kind::None}}, {"all", {Kind::All}}, {"0", {Kind::First, 0}}, {"16", {Kind::First, 16}}}) {
        shadows.read(request, text);
        EXPECT_EQ(request.settings.shadows, value);
        EXPECT_EQ(shadows.text(request), text);
    }
    EXPECT_EQ(refusal([&] { shadows.read(request, "-1"); }), "shadows -1 is below 0; give 0 or more");
    EXPECT_EQ(refusal([&] { shadows.read(request, "al"); }),
              "unknown shadows 'al': give none, scene, all or a number N, for the first N lights; did you mean 'all'?");
    EXPECT_EQ(refusal([&] { shadows.read(request, "1.5"); }),
              "unknown shadows '1.5': give none, scene, all or a number N, for the first N lights");
    scenes::Scene scene;
    scene.options.requested["shadows"] = 3.0;
    applyRequestedOptions(scene, "s.json", request);
    EXPECT_EQ(request.settings.shadows, (scenes::ShadowRequest{Kind::First, 3}));
}

TEST(Settings, ofShadowsSayWithWhichFiltersTheyChangeSomething) {
    ViewRequest request;
    EXPECT_EQ(settingOf("shadowWidth").whyIdle(request), "Only pcf uses it; the shadow filter is traced");
    EXPECT_EQ(settingOf("shadowBudget").whyIdle(request),
              "Only hard, pcf and pcss use it; the shadow filter is traced");
    EXPECT_EQ(settingOf("shadowSamples").whyIdle(request), "");
    EXPECT_EQ(settingOf("exposureEV").whyIdle(request), "");
}

TEST(Settings, ofAnEnvironmentSayWhereASceneHasNone) {
    ViewRequest request;
    request.settings.environment.light = frame::EnvironmentLight::Sampled;
    scenes::Scene scene;
    for (const std::string_view key : {"environmentLight", "environmentSamples", "environmentCompensation",
                                       "environmentRotation", "environmentIntensity", "backdrop"})
        EXPECT_EQ(settingOf(key).whyIdle(request, &scene), "There is no environment; choose a map") << key;
    EXPECT_EQ(settingOf("refraction").whyIdle(request, &scene), "") << "glass shows surfaces too";
    EXPECT_EQ(settingOf("environmentRotation").whyIdle(request), "") << "of no scene";
    scene.environment.emplace();
    for (const Setting& setting : settingTable())
        if (setting.panel == SettingPanel::Environment && setting.key != "environmentSamples") {
            EXPECT_EQ(setting.whyIdle(request, &scene), "") << setting.name;
        }
}

TEST(Settings, ofAnEnvironmentsLightSayWithWhichOfItsWaysTheyChangeSomething) {
    const Setting &samples = settingOf("environmentSamples"), &compensation = settingOf("environmentCompensation");
    ViewRequest request;
    EXPECT_EQ(samples.whyIdle(request), "Only sampled uses it; the environment light is split_sum");
    EXPECT_EQ(compensation.whyIdle(request), "");
    request.settings.environment.light = frame::EnvironmentLight::Sampled;
    for (const Setting* setting : {&samples, &compensation}) EXPECT_EQ(setting->whyIdle(request), "") << setting->name;
    request.settings.environment.light = frame::EnvironmentLight::Off;
    EXPECT_EQ(compensation.whyIdle(request), "Only split_sum and sampled use it; the environment light is off");
    request.settings.environment.light = frame::EnvironmentLight::Sampled;
    request.settings.soloLight = 0;
    for (const Setting* setting : {&samples, &compensation})
        EXPECT_EQ(setting->whyIdle(request), "One light is shown alone, which leaves the environment's out")
            << setting->name;
    for (const char* key : {"environmentIntensity", "environmentRotation", "backdrop"})
        EXPECT_EQ(settingOf(key).whyIdle(request), "") << key << ": it is still seen";
}

TEST(Settings, ofAreaLightsSayWhereASceneHasNone) {
    const Setting &lights = settingOf("areaLights"), &samples = settingOf("areaSamples");
    ViewRequest request;
    EXPECT_EQ(lights.whyIdle(request), "") << "of no scene";
    EXPECT_EQ(samples.whyIdle(request), "Only sampled uses it; the area lights are ltc");
    request.settings.area.lights = frame::AreaLights::Sampled;
    scenes::Scene scene;
    scene.lights.emplace_back();
    for (const Setting* setting : {&lights, &samples}) {
        EXPECT_EQ(setting->whyIdle(request, &scene), "There is no area light");
        EXPECT_EQ(setting->whyIdle(request), "");
    }
    scene.lights[0].type = scenes::LightType::Tube;
    for (const Setting* setting : {&lights, &samples}) EXPECT_EQ(setting->whyIdle(request, &scene), "");
}

TEST(Settings, areIgnoredWhereEveryTechniqueIgnoresThem) {
    ViewRequest request;
    settingOf("layout").read(request, "packed");
    const auto why = [&](const char* key, const std::vector<Technique>& techniques) {
        return settingOf(key).whyIgnored(request, techniques);
    };
    const std::string able = "Only deferred, deferred_volumes, tiled_deferred and clustered_deferred use it";
    EXPECT_EQ(why("layout", {Technique::Forward}), able + "; the technique is forward");
    EXPECT_EQ(why("layout", {Technique::ForwardPrepass, Technique::Forward}),
              able + "; the techniques are forward_prepass, forward");
    EXPECT_EQ(why("layout", {Technique::Forward, Technique::Deferred}), "") << "one of them stores surfaces";
    EXPECT_EQ(why("layout", {}), "") << "of no technique";
    settingOf("tile").read(request, "8");
    EXPECT_EQ(why("tile", {Technique::Forward}), "") << "it is refused";
    settingOf("culling").read(request, "none");
    EXPECT_EQ(why("culling", {Technique::Forward}), "") << "it is what the technique does";
    EXPECT_EQ(why("exposureEV", {Technique::Forward}), "") << "every technique uses it";
    settingOf("layout").reset(request);
    EXPECT_EQ(why("layout", {Technique::Forward}), "") << "nothing is requested";
}

TEST(Settings, aTechniqueRefusesUnsupportedValuesAndNamesThoseThatSupportThem) {
    ViewRequest request{Technique::Forward, {}};
    request.settings.culling.tilePixels = 32;
    EXPECT_EQ(refusal([&] { requireSupported(request); }),
              "technique forward does not support tile 32, since it has no light lists; tiled_deferred, forward_plus, "
              "clustered_deferred, clustered_forward do");
    request.settings.culling = {culling::Method::Zbin, {}, {}, {}, {}};
    EXPECT_EQ(refusal([&] { requireSupported(request); }),
              "technique forward does not support culling zbin; clustered_deferred, clustered_forward do");
    request.technique = Technique::ClusteredForward;
    EXPECT_EQ(refusal([&] { requireSupported(request); }), "");
}

// ---- Settings requested by scenes ----------------------------------------------------------------------------------

/// Converts a setting's text to the value in a scene file.
scenes::OptionValue optionValueOf(const Setting& setting, const std::string& text) {
    if (text == setting.value.open) return text;
    const auto* choice = std::get_if<ChoiceKind>(&setting.value.kind);
    if (std::holds_alternative<NumberKind>(setting.value.kind) || (choice && choice->ofNumbers)) return std::stod(text);
    if (std::holds_alternative<SwitchKind>(setting.value.kind)) return text == "on";
    if (!std::holds_alternative<SizeKind>(setting.value.kind)) return text;
    const glm::dvec2 size(frame::sizeIn(text).value());
    return std::vector<double>{size.x, size.y};
}

ViewRequest requestedBy(const scenes::Scene& scene) {
    ViewRequest request;
    applyRequestedOptions(scene, "s.json", request);
    return request;
}

TEST(Settings, optionsOfASceneApplyAlsoAfterSavingAndFingerprinting) {
    const tessera::test::TempFolder folder;
    const std::string base = folder
                                 .write("base.json", R"({"tessera": 1, "base": {"file": "builtin:room"},
        "cameras": [{"name": "front", "position": [0, 1, 4], "target": [0, 1, 0]},
                    {"name": "side", "position": [4, 1, 0], "target": [0, 1, 0]}]})")
                                 .string();
    scenes::Scene scene = scenes::loadScene(base);
    const scenes::SceneOrigin origin = scenes::originOf(base, {}, scene);
    std::set<std::uint64_t> fingerprints{scenes::fingerprint(scene)};
    for (const Setting& setting : settingTable()) {
        if (!setting.isRequestable) continue;
        scene.options = {};
        const ViewRequest requested = changedIn(setting, scene);
        const std::string text = setting.text(requested, &scene);
        SCOPED_TRACE(fmt::format("{} {}", setting.key, text));
        if (setting.key == "camera")
            scene.options.camera = text;
        else
            scene.options.requested[std::string(setting.key)] = optionValueOf(setting, text);
        EXPECT_EQ(requestedBy(scene), requested);
        EXPECT_TRUE(fingerprints.insert(scenes::fingerprint(scene)).second);
        const std::filesystem::path file = folder.path() / "saved.json";
        folder.write("saved.json", scenes::sceneText(scene, origin, file));
        const scenes::Scene saved = scenes::loadScene(file.string());
        EXPECT_EQ(saved.options, scene.options);
        EXPECT_EQ(requestedBy(saved), requested);
        ViewRequest said;
        applyRequestedOptions(saved, "s.json", said, [&](const Setting& other) { return &other == &setting; });
        EXPECT_EQ(said, ViewRequest()) << "what the user said goes before";
    }
}

TEST(Settings, anOptionThatCannotBeIsNamedByFileAndKey) {
    const auto refusedOption = [](const char* key, const scenes::OptionValue& option) {
        scenes::Scene scene = sceneOfTwoCameras();
        scene.options.requested[key] = option;
        return refusal([&] { requestedBy(scene); });
    };
    EXPECT_EQ(refusedOption("exposure", 1.0),
              "s.json:/options: an options object has no key 'exposure'; did you mean 'exposureEV'?");
    EXPECT_THAT(refusedOption("solo", 0.0), HasSubstr("s.json:/options: an options object has no key 'solo'"));
    EXPECT_EQ(refusedOption("defaultLigth", true),
              "s.json:/options: an options object has no key 'defaultLigth'; did you mean 'defaultLight'?");
    EXPECT_EQ(refusedOption("size", std::vector<double>{1.5, 1}),
              "s.json:/options/size: size '1.5x1' is not WIDTHxHEIGHT in pixels, each 1 to 16384, as in 1280x720");
    EXPECT_EQ(refusedOption("layout", "pakced"),
              "s.json:/options/layout: unknown layout 'pakced': did you mean 'packed'?");
    EXPECT_EQ(refusedOption("layout", 1.0), "s.json:/options/layout: is a number; text is needed");
    EXPECT_EQ(refusedOption("exposureEV", "bright"), "s.json:/options/exposureEV: is text; a number is needed");
    EXPECT_EQ(refusedOption("prune", "off"), "s.json:/options/prune: is text; true or false is needed");
    EXPECT_EQ(refusedOption("exposureEV", 200.0),
              "s.json:/options/exposureEV: exposure 200 is above 120; give -120 to 120");
}

} // namespace
} // namespace tessera::engine
