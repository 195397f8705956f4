// Material layers in scene files, by the table that reader and writer share.
#include "scenes/MaterialLayers.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "scenes/write/ElementJson.h"

namespace tessera::scenes {
namespace {

/// A material whose layers have no default values, and the documented keys of each layer.
struct LayeredMaterial {
    Material material;
    std::vector<std::vector<std::string>> keys;
};
LayeredMaterial layeredMaterial() {
    LayeredMaterial layered;
    Material& material = layered.material;
    material.name = "layered";
    material.clearcoat = 0.5f;
    material.clearcoatPerceptualRoughness = 0.25f;
    material.clearcoatNormalScale = 2.0f;
    material.texture(TextureSlot::ClearcoatNormal).image = 0;
    material.sheenColor = {0.25f, 0.5f, 0.75f};
    material.sheenPerceptualRoughness = 0.125f;
    material.iridescence = 0.75f;
    material.iridescenceIor = 1.5f;
    material.iridescenceThicknessNm = 300.0f;
    material.iridescenceLeastThicknessNm = 200.0f;
    material.transmission = 1.0f;
    material.thicknessMetres = 0.5f;
    material.attenuationColor = {1.0f, 0.5f, 0.25f};
    material.attenuationDistanceMetres = 2.0f;
    material.dispersion = 0.25f;
    layered.keys = {{"clearcoat", "clearcoatPerceptualRoughness", "clearcoatNormalMap"},
                    {"sheenColor", "sheenPerceptualRoughness"},
                    {"iridescence", "iridescenceIor", "iridescenceThicknessNm", "iridescenceLeastThicknessNm"},
                    {"transmission", "thicknessMetres", "attenuationColor", "attenuationDistanceMetres", "dispersion"}};
    return layered;
}

TEST(MaterialLayers, areWrittenByTheirKeysAndReadBackWithoutFields) {
    const LayeredMaterial layered = layeredMaterial();
    const auto json = write::materialJson(layered.material, 1);
    std::vector<std::string> seen, expected;
    for (const std::vector<std::string>& keys : layered.keys) expected.insert(expected.end(), keys.begin(), keys.end());
    for (const auto& [key, value] : json.items())
        if (std::ranges::find(expected, key) != expected.end()) seen.push_back(key);
    EXPECT_EQ(seen, expected);                            // in that order
    EXPECT_FALSE(json.contains("fields")) << json.dump(); // all values were read back
    EXPECT_EQ(json["clearcoatNormalMap"].dump(), R"({"image":0,"scale":2.0})");
    EXPECT_EQ(json["sheenColor"].dump(), "[0.25,0.5,0.75]");
}

TEST(MaterialLayers, ofNoStrengthHaveNoKeys) {
    const LayeredMaterial layered = layeredMaterial();
    ASSERT_EQ(materialLayers().size(), layered.keys.size());
    for (std::size_t i = 0; i < layered.keys.size(); ++i) {
        Material material = layered.material;
        const auto clear = [&](auto member) {
            material.*member = std::remove_cvref_t<decltype(material.*member)>(0.0f);
        };
        std::visit(clear, materialLayers()[i].front().member);
        const auto json = write::materialJson(material, 1);
        for (std::size_t other = 0; other < layered.keys.size(); ++other)
            for (const std::string& key : layered.keys[other]) EXPECT_EQ(json.contains(key), other != i) << key;
    }
}

} // namespace
} // namespace tessera::scenes
