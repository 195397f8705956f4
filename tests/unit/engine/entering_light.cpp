// Settings that affect the light entering surfaces, and the cache key of the diffused irradiance.
#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "engine/PrepareView.h"
#include "engine/Settings.h"
#include "scenes/Load.h"

namespace tessera::engine {
namespace {

/// Some values of a setting, as texts.
std::vector<std::string> someValues(const Setting& setting) {
    const SettingKind& kind = setting.value.kind;
    std::vector<std::string> values;
    if (const auto* choice = std::get_if<ChoiceKind>(&kind)) {
        for (const ChoiceKind::Entry& entry : choice->entries) values.push_back(entry.name);
    } else if (const auto* number = std::get_if<NumberKind>(&kind)) {
        for (const double value : {1.0, 2.0})
            values.push_back(std::to_string(int(std::clamp(value, number->least, number->most))));
    } else if (std::holds_alternative<SwitchKind>(kind)) {
        values = {"on", "off"};
    } else if (std::holds_alternative<SizeKind>(kind)) {
        values = {"64x48", "17x90"};
    } else {
        values = {"0"};
    }
    return values;
}

class EnteringLight : public testing::Test {
protected:
    EnteringLight() : scene_(scenes::loadScene("diffusion_truth")), bounds_(frame::surfaceBounds(scene_)) {
        scene_.cameras.push_back(scene_.cameras[0]);
        scene_.cameras.back().worldFromCamera[3].x += 0.01;
        usual_ = keyOf({});
    }
    /// Returns the diffusion key of the first object; 0 without diffusion.
    std::uint64_t keyOf(const ViewRequest& request) const {
        const frame::PreparedView prepared = prepareView(scene_, request.technique, request.settings, bounds_);
        if (prepared.diffusionViews.empty()) return 0;
        return frame::diffusionKey(scene_, prepared.diffusionObjects[0], prepared.diffusionViews[0], 0);
    }

    scenes::Scene scene_;
    std::vector<frame::SurfaceBounds> bounds_;
    std::uint64_t usual_ = 0;
};

TEST_F(EnteringLight, isKeptWhateverOtherSettingsSay) {
    ASSERT_NE(usual_, 0u);
    std::size_t tried = 0;
    for (const Setting& setting : settingTable()) {
        if (setting.entersLight || setting.key == "view") continue; // other views show no diffused irradiance
        std::vector<std::string> values = someValues(setting);
        if (setting.key == "camera") values = {"1"};
        for (const std::string& value : values) {
            for (const TechniqueInfo& technique : techniqueTable()) {
                ViewRequest request;
                request.technique = technique.technique;
                setting.read(request, value, {{}, &scene_});
                if (!setting.isSupported(request)) continue;
                EXPECT_EQ(keyOf(request), usual_) << setting.key << " " << value << " " << technique.name;
                ++tried;
                break;
            }
        }
    }
    EXPECT_GT(tried, 30u);
}

TEST_F(EnteringLight, isFoundAnewForEverySettingOfItsDiffusion) {
    std::size_t rows = 0;
    scenes::visitFields(frame::kDiffusionFields, [&](const auto& field) {
        const auto setting = std::ranges::find(settingTable(), std::string_view(field.name), &Setting::key);
        ASSERT_NE(setting, settingTable().end()) << field.name;
        EXPECT_TRUE(setting->entersLight) << field.name;
        for (const std::string& value : someValues(*setting)) {
            ViewRequest request;
            setting->read(request, value);
            EXPECT_EQ(keyOf(request) == usual_, setting->isDefault(request)) << field.name << " " << value;
        }
        ++rows;
    });
    EXPECT_EQ(rows, std::tuple_size_v<decltype(frame::kDiffusionFields)>);
}

} // namespace
} // namespace tessera::engine
