// Sampled light and sampled shadows of an area light are multiplied: the mean of the product is the product of the
// means only where both take random numbers of their own.
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "scenes/LookAt.h"
#include "tests/image/AreaLightTest.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/TestScenes.h"

namespace tessera {
namespace {

constexpr int kShadowPixels = 64;
constexpr int kFewSamples = 4; ///< of each kind, so that both have much noise

class AreaSampleShadows : public test::ShadowTest {
protected:
    /// Every pixel sees the same place of a floor, from below a plate that hides half of a light.
    static scenes::Scene placeUnderAPlate() {
        scenes::Material matte;
        matte.model = scenes::MaterialModel::Lambert;
        matte.doubleSided = true;
        scenes::Scene scene = test::quadScene(matte);
        scenes::Node& plate = scene.nodes.emplace_back();
        plate.parentFromNode[3] = glm::dvec4(1.0, 0.0, 0.5, 1.0);
        plate.instances = {{0, 0}};
        scenes::Light light = test::areaLight(scenes::LightType::Rectangle, {0.0, 0.0, 1.0}, {0.5, 0.3, -1.0}, 1.0f);
        light.widthMetres = light.heightMetres = 1.6f;
        light.castsShadow = true;
        light.isSeen = false;
        scene.lights = {light};
        scenes::Camera& camera = scene.cameras[0];
        camera.projection = scenes::Projection::Orthographic;
        camera.halfHeightMetres = 1e-5;
        camera.nearMetres = 0.0;
        camera.worldFromCamera = scenes::worldFromLookAt({0.0, 0.0, 0.3}, {0.0, 0.0, 0.0});
        return scene;
    }
    static std::vector<double> redOf(engine::Renderer& renderer, scenes::ShadowRequest shadows) {
        frame::FrameSettings settings;
        settings.sizePixels = {kShadowPixels, kShadowPixels};
        settings.area = {frame::AreaLights::Sampled, kFewSamples};
        settings.shadows = shadows;
        settings.shadowFilter = frame::ShadowFilter::Traced;
        settings.shadowSamples = kFewSamples;
        const std::vector<float> radiance = renderer.render(engine::Technique::Deferred, settings).radiance;
        std::vector<double> red;
        for (std::size_t i = 0; i < radiance.size(); i += 4) red.push_back(double(radiance[i]));
        return red;
    }
};

double meanOfProduct(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum / double(a.size());
}
double deviation(const std::vector<double>& values, double mean) {
    return std::sqrt(std::max(meanOfProduct(values, values) - mean * mean, 0.0));
}

TEST_F(AreaSampleShadows, takeRandomNumbersThatTheLightDoesNot) {
    const scenes::Scene scene = placeUnderAPlate();
    engine::Renderer renderer(context(), scene);
    const std::vector<double> light = redOf(renderer, {scenes::ShadowRequest::Kind::None});
    std::vector<double> visible = redOf(renderer, test::kAllLightsCast);
    const std::vector<double> ones(light.size(), 1.0);
    for (std::size_t i = 0; i < light.size(); ++i) visible[i] /= light[i];
    const double meanLight = meanOfProduct(light, ones), meanVisible = meanOfProduct(visible, ones);
    const double lightNoise = deviation(light, meanLight), shadowNoise = deviation(visible, meanVisible);
    const double correlation = (meanOfProduct(light, visible) - meanLight * meanVisible) / (lightNoise * shadowNoise);
    fmt::print("light {:.3f} +- {:.3f}, visible {:.3f} +- {:.3f}, correlation {:+.3f}\n", meanLight, lightNoise,
               meanVisible, shadowNoise, correlation);
    EXPECT_GT(lightNoise, 0.01 * meanLight);
    EXPECT_GT(shadowNoise, 0.05);
    EXPECT_LE(std::abs(correlation), 4.0 / kShadowPixels) << "four standard errors of independent pixels";
}

} // namespace
} // namespace tessera
