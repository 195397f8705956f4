// Shaders of environments with one fault each: techniques share them and agree, the reference shares nothing and does
// not.
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/image/EnvironmentTest.h"
#include "tests/support/ShaderMutant.h"

namespace tessera {
namespace {

using frame::EnvironmentLight;
using namespace test;

struct EnvironmentFault {
    const char* fault;
    EnvironmentLight light;
    float roughness;  ///< of a metal; below 0: matte
    const char* file; ///< below shaders/
    const char* from;
    const char* to;
};

constexpr float kMatteBall = -1.0f;
constexpr EnvironmentFault kEnvironmentFaults[] = {
    {"rotated the wrong way", EnvironmentLight::SplitSum, kMatteBall, "lib/environment/environment_constants.glsl",
     "mat3(environment.mapFromLS) * directionLS", "directionLS * mat3(environment.mapFromLS)"},
    {"samples rotated the wrong way", EnvironmentLight::Sampled, kMatteBall,
     "lib/environment/environment_constants.glsl", "direction * mat3(environment.mapFromLS)",
     "mat3(environment.mapFromLS) * direction"},
    {"the wrong level", EnvironmentLight::SplitSum, 1.0f, "shared/environment.h", "* levelsADoubling;",
     "* 0.5 * levelsADoubling;"},
    {"a lobe without its table", EnvironmentLight::SplitSum, 1.0f, "lib/reflectance/even_light.glsl",
     "seen.f0 * lobe.x + seen.fresnelRise * lobe.y", "seen.f0 + seen.fresnelRise * lobe.y"},
    {"a density without its cosine", EnvironmentLight::Sampled, kMatteBall, "lib/reflectance/lobe_samples.glsl",
     "density = max(dot(seen.surface.normalLS, toLight), 0.0) * kInversePi", "density = kInversePi"},
    {"the density of the map left out", EnvironmentLight::Sampled, kMatteBall,
     "lib/environment/environment_samples.glsl", "mapDensity + surfaceDensity(seen, toLight)",
     "surfaceDensity(seen, toLight)"},
    {"the density of the lobe left out", EnvironmentLight::Sampled, 0.5f, "lib/reflectance/lobe_samples.glsl",
     "density += visibleDensity(lobeDistribution(seen, h), seen.nv, seen.viewerLength)", "density += 0.0"},
};

class EnvironmentFaults : public EnvironmentTest {
protected:
    /// Each of them, or each second one.
    void expectSeen();
    /// relMSE of a ball under a lamp of 25 texels, turned aside, against the reference.
    double errorOf(const EnvironmentFault& fault, const shader::SourceTree& shaders) {
        scenes::Material material;
        if (fault.roughness < 0.0f) {
            material.model = scenes::MaterialModel::Lambert;
        } else {
            material.metallic = 1.0f;
            material.perceptualRoughness = fault.roughness;
        }
        scenes::Scene scene = ballUnderSky(material);
        scene.environment = environmentOf(64, 32, [](int x, int y) {
            return glm::dvec3(std::abs(x - 30) <= 2 && std::abs(y - 12) <= 2 ? 40.0 : 0.2);
        });
        scene.environment->rotationDegrees = 50.0f;
        frame::FrameSettings settings;
        settings.sizePixels = {24, 24};
        settings.environment.light = fault.light;
        settings.environment.samples = 256;
        const validation::ReferencePicture truth = validation::referencePicture(
            scene, settings, [] {}, validation::Leeway::None);
        engine::Renderer renderer(context(), scene, shaders);
        const std::vector<float> seen = renderer.render(engine::Technique::Deferred, settings).radiance;
        double squares = 0.0, count = 0.0;
        for (std::size_t i = 0; i < truth.picture.pixelCount(); ++i) {
            if (truth.picture.covered[i] == 0) continue;
            const double own = double(seen[4 * i]), other = double(truth.picture.rgba[4 * i]);
            squares += (own - other) * (own - other) / ((other + 0.01) * (other + 0.01));
            count += 1.0;
        }
        return squares / count;
    }
};

using EnvironmentFaultsSlow = EnvironmentFaults;

void EnvironmentFaults::expectSeen() {
    for (const EnvironmentFault& fault :
         everyNth(std::vector(std::begin(kEnvironmentFaults), std::end(kEnvironmentFaults)), 2)) {
        SCOPED_TRACE(fault.fault);
        const ShaderMutant shaders;
        const double plain = errorOf(fault, shaders.tree());
        shaders.replace(fault.file, fault.from, fault.to);
        const double faulty = errorOf(fault, shaders.tree());
        fmt::print("{:34} relMSE {:.1e}, without it {:.1e}\n", fault.fault, faulty, plain);
        EXPECT_LE(plain, 0.15); // the shapes of the split sum's lobes
        // NaN counts as seen.
        EXPECT_FALSE(faulty <= 2.0 * plain + 1e-2);
    }
}
TEST_F(EnvironmentFaults, areSeenByTheReference) {
    expectSeen();
}
TEST_F(EnvironmentFaultsSlow, areSeenByTheReference) {
    expectSeen();
}

} // namespace
} // namespace tessera
