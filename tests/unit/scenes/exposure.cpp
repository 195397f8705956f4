#include "scenes/Exposure.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "scenes/Defaults.h"
#include "scenes/Illuminance.h"
#include "scenes/Load.h"
#include "tests/unit/scenes/GeneratedScenes.h"
#include "tests/unit/scenes/TempFolder.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::scenes {
namespace {

using namespace test;

constexpr double kExposureRounding = 1e-6;

/// A matte card of 1 m in the plane z = 0 before an orthographic camera. Its grid is so fine that one luminance per
/// triangle is enough.
Scene card() {
    constexpr int kSide = 16;
    Scene scene = tinyScene();
    scene.materials[0].model = MaterialModel::Lambert;
    scene.materials[0].baseColor = glm::vec4(1.0f);
    Mesh& mesh = scene.meshes[0];
    mesh = {};
    for (int y = 0; y <= kSide; ++y)
        for (int x = 0; x <= kSide; ++x) {
            mesh.positionsOS.emplace_back(float(x) / kSide - 0.5f, float(y) / kSide - 0.5f, 0.0f);
            mesh.normalsOS.emplace_back(0.0f, 0.0f, 1.0f);
        }
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const auto a = std::uint32_t(y * (kSide + 1) + x), b = a + 1, c = a + kSide + 1, d = c + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
        }
    Camera& camera = scene.cameras.emplace_back();
    camera.projection = Projection::Orthographic;
    camera.worldFromCamera[3] = {0.0, 0.0, 5.0, 1.0};
    return scene;
}

Light sun(double lux, double degrees = 0.0) {
    Light light;
    light.type = LightType::Directional;
    light.intensity = float(lux);
    const double angle = degrees * std::numbers::pi / 180.0;
    light.directionWS = {std::sin(angle), 0.0, -std::cos(angle)};
    return light;
}

double luminanceSeen(const Scene& scene) {
    return estimatedLuminance(scene, scene.cameras[0], 1.0).value();
}

TEST(Exposure, aMatteCardUnderASunHasTheLuminanceOfItsClosedForm) {
    Scene scene = card();
    for (const double degrees : {0.0, 60.0, 120.0}) {
        scene.lights = {sun(3.0, degrees)};
        const double cosine = std::max(std::cos(degrees * std::numbers::pi / 180.0), 0.0);
        EXPECT_NEAR(luminanceSeen(scene), 3.0 * cosine / std::numbers::pi, kExposureRounding) << degrees;
    }
    scene.materials[0].doubleSided = true;
    EXPECT_NEAR(luminanceSeen(scene), 1.5 / std::numbers::pi, kExposureRounding);
    scene.lights[0].enabled = false;
    EXPECT_EQ(luminanceSeen(scene), 0.0);
}

/// Eight candela 2 m above a small card: I / d^2, and at its corners some percent less.
TEST(Exposure, lampsFallOffWithTheSquareOfTheirDistanceWithinTheirRangeAndCone) {
    Scene scene = card();
    Light lamp;
    lamp.positionWS = {0.0, 0.0, 2.0};
    lamp.intensity = 8.0f;
    scene.lights = {lamp};
    const double above = 2.0 / std::numbers::pi;
    EXPECT_NEAR(luminanceSeen(scene), above, 0.08 * above);
    scene.lights[0].type = LightType::Spot;
    scene.lights[0].directionWS = {0.0, 0.0, 1.0};
    EXPECT_EQ(luminanceSeen(scene), 0.0) << "turned away";
    scene.lights[0] = lamp;
    scene.lights[0].rangeMetres = 1.5f;
    EXPECT_EQ(luminanceSeen(scene), 0.0) << "out of range";
}

TEST(Exposure, surfacesCountByTheirTexturesEmissionAndSizeInThePicture) {
    Scene scene = card();
    scene.lights = {sun(std::numbers::pi)};
    Image& image = scene.images.emplace_back();
    image.width = 128;
    image.height = 64;
    // Half black, half a grey of linear 0.5: sRGB code 188 of 255.
    for (int i = 0; i < image.width * image.height; ++i)
        for (int c = 0; c < 4; ++c) image.texels.push_back(std::byte(c == 3 || i % image.width < 64 ? 0 : 188));
    scene.materials[0].texture(TextureSlot::BaseColor).image = 0;
    EXPECT_NEAR(luminanceSeen(scene), 0.25, 0.01);
    scene.materials[0].emissive = glm::vec3(2.0f);
    EXPECT_NEAR(luminanceSeen(scene), 2.25, 0.01);
    scene.materials[0].model = MaterialModel::SingleColor;
    scene.lights.clear();
    EXPECT_NEAR(luminanceSeen(scene), 2.25, 0.01) << "its colour needs no light";
    scene.materials[0].texture(TextureSlot::BaseColor).image = kNone;
    // A black card of the same size, first beside the view, then in it.
    scene.materials.emplace_back().baseColor = glm::vec4(0.0f);
    Node& other = scene.nodes.emplace_back(scene.nodes[0]);
    other.instances[0].material = 1;
    other.parentFromNode[3].x = 5.0;
    EXPECT_NEAR(luminanceSeen(scene), 3.0, kExposureRounding) << "it is not in the picture";
    other.parentFromNode[3].x = 0.1;
    EXPECT_NEAR(luminanceSeen(scene), 3.0, kExposureRounding) << "half of the view";
    for (int i = 0; i < 9; ++i) scene.nodes.push_back(scene.nodes.back());
    EXPECT_EQ(luminanceSeen(scene), 0.0) << "a tenth";
    scene.nodes.resize(2);
    scene.nodes.pop_back();
    scene.nodes[0].parentFromNode[2].z = -1.0;
    scene.nodes[0].parentFromNode[0].x = -1.0;
    scene.nodes[0].parentFromNode[3].z = 9.0;
    EXPECT_FALSE(estimatedLuminance(scene, scene.cameras[0], 1.0)) << "behind the camera";
}

TEST(Exposure, aSheenAndAHighlightReflectToo) {
    Scene scene = card();
    scene.lights = {sun(std::numbers::pi)};
    scene.materials[0].baseColor = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    EXPECT_EQ(luminanceSeen(scene), 0.0) << "lambert";
    scene.materials[0].model = MaterialModel::MetallicRoughness;
    EXPECT_NEAR(luminanceSeen(scene), 0.04, kExposureRounding);
    scene.materials[0].sheenColor = glm::vec3(0.5f);
    EXPECT_NEAR(luminanceSeen(scene), 0.19, kExposureRounding);
}

TEST(Exposure, stopsBringToADisplaysBrightHalfWhatIsMoreThanTwoOfThemAway) {
    for (const double luminance :
         {0.1001, 0.4, 1.59, 0.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        EXPECT_EQ(fittingExposureEV(luminance), 0) << luminance;
    EXPECT_EQ(fittingExposureEV(0.09), 2);
    EXPECT_EQ(fittingExposureEV(0.018), 4);
    EXPECT_EQ(fittingExposureEV(0.4 * 1024.0), -10);
}

/// A triangle that faces a sun.
std::string litModel(const TempFolder& folder, double lux, double roughness = 1.0) {
    constexpr const char* kTriangle = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"; // (0 0 0), (1 0 0), (0 1 0)
    return folder.file("lit.gltf",
                       fmt::format(R"({{"asset": {{"version": "2.0"}}, "extensionsUsed": ["KHR_lights_punctual"],
                "extensions": {{"KHR_lights_punctual": {{"lights": [{{"type": "directional", "intensity": {}}}]}}}},
                "buffers": [{{"byteLength": 36, "uri": "data:application/octet-stream;base64,{}"}}],
                "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
                "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                                "min": [0, 0, 0], "max": [1, 1, 0]}}],
                "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}, "material": 0}}]}}],
                "materials": [{{"pbrMetallicRoughness": {{"roughnessFactor": {}}}}}],
                "nodes": [{{"mesh": 0}}, {{"extensions": {{"KHR_lights_punctual": {{"light": 0}}}}}}],
                "scene": 0, "scenes": [{{"nodes": [0, 1]}}]}})",
                                   lux, kTriangle, roughness));
}

TEST(DefaultExposure, isGivenToAModelWhoseOwnLightsAreFarFromADisplays) {
    const TempFolder folder;
    const auto write = [&](double lux) { return litModel(folder, lux); };
    const Scene bright = loadScene(write(1e5)); // sunlight: a white card has 1e5 / pi
    EXPECT_EQ(bright.options.requested.at("exposureEV"), OptionValue(-16.0));
    EXPECT_THAT(suppliedText(bright),
                HasSubstr("too bright for a display: exposed by -16 EV (--exposure chooses another)"));
    EXPECT_FALSE(loadScene(write(1.0)).options.requested.contains("exposureEV"));
    const Scene dim = loadScene(write(0.01));
    EXPECT_EQ(dim.options.requested.at("exposureEV"), OptionValue(7.0));
    EXPECT_THAT(suppliedText(dim), HasSubstr("too dim for a display: exposed by +7 EV (--exposure chooses another)"));
    EXPECT_THAT(suppliedText(dim, Advice::Panels), HasSubstr("(the panel View chooses another)"));
    const std::string own = folder.file("own.json", R"({"tessera": 1, "include": [{"file": "lit.gltf"}]})");
    EXPECT_FALSE(loadScene(own).options.requested.contains("exposureEV")) << "who writes a scene says how it is shown";
    LoadOptions options = loading(&LoadOptions::lights, 0);
    EXPECT_FALSE(loadScene(write(0.01), options).options.requested.contains("exposureEV"));
}

/// The intensity of the supplied environment, times the exposure.
double fillOf(const Scene& scene) {
    const auto requested = scene.options.requested.find("exposureEV");
    const double stops = requested == scene.options.requested.end() ? 0.0 : std::get<double>(requested->second);
    return scene.environment ? double(scene.environment->intensity) * std::exp2(stops) : 0.0;
}

TEST(FillLight, isAQuarterOfAModelsOwnLightOrWhatThatLacks) {
    const TempFolder folder;
    constexpr double kBrightLux = kBrightLuminance * std::numbers::pi;
    EXPECT_NEAR(fillOf(loadScene(litModel(folder, kBrightLux))), 0.25, 0.02);
    EXPECT_NEAR(fillOf(loadScene(litModel(folder, 1e5))), 0.25, 0.1) << "exposed";
    EXPECT_NEAR(fillOf(loadScene(litModel(folder, 0.5 * kBrightLux))), 0.5, 0.03);
    EXPECT_EQ(fillOf(loadScene(litModel(folder, 0.0))), 1.0);
    const Scene mirror = loadScene(litModel(folder, kBrightLux, 0.05));
    EXPECT_GT(fillOf(mirror), 0.9) << "smooth metal shows what is around it";
    EXPECT_THAT(suppliedText(mirror), HasSubstr("lit by the environment 'studio' at "));
    EXPECT_THAT(suppliedText(mirror), HasSubstr(" % beside its own lights"));
}

TEST(FillLight, isLeftOutWhereItWasNotRequested) {
    const TempFolder folder;
    const std::string model = litModel(folder, 1.0);
    EXPECT_FALSE(loadScene(model, loading(&LoadOptions::defaultLight, false)).environment);
    EXPECT_FALSE(loadScene(model, loading(&LoadOptions::lights, 1)).environment) << "its lights are what is measured";
    const std::string own = folder.file("own.json", R"({"tessera": 1, "include": [{"file": "lit.gltf"}]})");
    EXPECT_FALSE(loadScene(own).environment);
}

} // namespace
} // namespace tessera::scenes
