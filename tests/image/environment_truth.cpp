// Environment light against the reference and published tables.
#include <iterator>
#include <numbers>

#include "tests/image/AreaLightTest.h"
#include "tests/image/EnvironmentTest.h"
#include "tests/image/FlatTest.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::EnvironmentLight;
using namespace test;

// Errors under uniform light, relative to the reflected light; measured 0.006, 0.005 and 0.1.
constexpr double kEvenError = 0.01;            ///< noise of samples and of the reference, interpolation of tables
constexpr double kInnerReflectionError = 0.02; ///< tables at the onset of total reflection
constexpr double kTwoAlphasError = 0.12;       ///< the table has one alpha, the mean of two
constexpr double kFacetsError = 0.025;         ///< of 24 microfacets for a lobe of two alphas
constexpr double kLeastError = 1e-5;           ///< absolute, where reflection is nearly zero

struct EvenCase {
    std::string name;
    scenes::Material material;
    double splitSumError = kEvenError, sampledError = kEvenError;
};

class EnvironmentTruth : public EnvironmentTest {
protected:
    void expectEven(const std::vector<EvenCase>& cases, bool compensates);
};

TEST_F(EnvironmentTruth, theBackdropIsThatOfTheReferenceInEveryPixel) {
    scenes::Scene scene = quadScene(unlit());
    scene.nodes[0].parentFromNode[3] = glm::dvec4(0.0, 0.0, 100.0, 1.0); // behind the camera
    scene.cameras[0].projection = scenes::Projection::Perspective;
    scene.cameras[0].fovYRadians = 1.8; // far from the axis
    scene.environment =
        environmentOf(64, 32, [](int x, int y) { return glm::dvec3(1 + x % 5, 1 + y % 7, 1.0 + 0.01 * x * y); });
    scene.environment->rotationDegrees = 40.0f;
    frame::FrameSettings settings = exactOfSize(48, 27);
    const validation::ReferencePicture truth = strictReference(scene, settings);
    const std::vector<float> seen = drawn(scene, settings);
    for (std::size_t i = 0; i < seen.size(); i += 4)
        for (std::size_t c = i; c < i + 3; ++c)
            ASSERT_NEAR(seen[c], truth.picture.rgba[c], 1e-3) << i / 4; // steps of a texel, and fp32 angles
}

/// E(mu, alpha) of a height-correlated GGX lobe with F = 1, shading.md section 6, to 2e-4; with compensation 1.
TEST_F(EnvironmentTruth, aWhiteFurnaceLosesWhatThePublishedTableSays) {
    constexpr double kCosines[] = {0.1, 0.25, 0.5, 0.75, 1.0};
    constexpr double kAlphas[] = {0.05, 0.1, 0.25, 0.5, 0.75, 1.0};
    constexpr double kReflected[6][5] = {{.9113, .9745, .9927, .9961, .9973}, {.8834, .9216, .9692, .9831, .9882},
                                         {.8916, .8401, .8572, .8915, .9158}, {.8601, .7652, .6982, .6821, .6879},
                                         {.8107, .6802, .5646, .5014, .4639}, {.7602, .5976, .4507, .3645, .3069}};
    scenes::Scene scene = quadScene(twoSided({}));
    scene.environment = evenEnvironment(1.0);
    for (const auto& [light, compensates] : {std::pair(EnvironmentLight::SplitSum, false),
                                             {EnvironmentLight::Sampled, false},
                                             {EnvironmentLight::SplitSum, true},
                                             {EnvironmentLight::Sampled, true}}) {
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = ofSize(16, 16);
        settings.environment.light = light;
        settings.environment.samples = 1024;
        settings.environment.compensates = compensates;
        for (int a = 0; a < 6; ++a) {
            scene.materials[0].perceptualRoughness = float(std::sqrt(kAlphas[a]));
            renderer.materialsChanged();
            for (int m = 0; m < 5; ++m) {
                lookAtCosine(scene.cameras[0], kCosines[m], 0.05);
                const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
                double mean = 0.0;
                for (std::size_t i = 0; i < seen.size(); i += 4) mean += double(seen[i]) * 4.0 / double(seen.size());
                // 256 pixels of 1024 samples of the lobe, whose weights vary by less than 1, leave 2e-3 / 3.
                EXPECT_NEAR(mean, compensates ? 1.0 : kReflected[a][m],
                            light == EnvironmentLight::SplitSum ? 1e-3 : 2e-3)
                    << infoOf(light).name << ", cosine " << kCosines[m] << ", alpha " << kAlphas[a]
                    << (compensates ? ", compensated" : "");
            }
        }
    }
}

/// Against an independent integration: means agree within three standard errors. The second of two maps also tests
/// compensation, which in a short sweep only the white furnace above covers.
TEST_SWEEP(EnvironmentTruth, samplesAgreeWithTheReferenceWithinThreeStandardErrors) {
    scenes::Scene scene = scenes::loadScene("models");
    scene.lights.clear();
    scene.environment = builtinEnvironment("studio");
    frame::FrameSettings settings = exactOfSize(64, 36);
    settings.environment.light = EnvironmentLight::Sampled;
    settings.environment.samples = 256;
    engine::Renderer renderer(context(), scene);
    for (const char* name : everyNth(std::vector{"studio", "sky"}, 2)) {
        scene.environment = builtinEnvironment(name);
        renderer.environmentChanged();
        settings.environment.compensates = name == std::string_view("sky");
        const validation::ReferencePicture truth = strictReference(scene, settings);
        const std::vector<float> seen = renderer.render(Technique::Forward, settings).radiance;
        double sum = 0.0, squares = 0.0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < truth.picture.pixelCount(); ++i) {
            if (truth.surroundings[i].light == glm::dvec3(0.0)) continue;
            double own = 0.0, other = 0.0;
            for (std::size_t c = 0; c < 3; ++c) {
                own += double(seen[4 * i + c]);
                other += double(truth.picture.rgba[4 * i + c]);
            }
            // Relative to the light of the pixel, so that no bright one dominates.
            const double error = (own - other) / (own + other + 1e-3);
            sum += error;
            squares += error * error;
            ++count;
        }
        ASSERT_GT(count, 500u);
        const double mean = sum / double(count);
        const double standardError = std::sqrt(squares / double(count) - mean * mean) / std::sqrt(double(count));
        EXPECT_LE(std::abs(mean), 3.0 * standardError) << name << ": " << mean << " of " << standardError;
        EXPECT_LE(standardError, 2e-3) << name;
    }
}

/// A map of few texels with high contrast: a direction's weight depends on the texel that it lies in.
TEST_F(EnvironmentTruth, samplesOfCoarseMapsAreWeighedByTheTexelThatTheyLieIn) {
    scenes::Scene scene = quadScene({});
    makeOrthographic(scene.cameras[0], 0.5);
    scene.environment = environmentOf(
        16, 8, [](int x, int y) { return glm::dvec3((y % 3 == 0 ? 40.0 : 0.1) + (x % 5 == 2 ? 20.0 : 0.0)); });
    scene.environment->rotationDegrees = 180.0f; // so that the quad faces the map's middle
    frame::FrameSettings settings = ofSize(16, 16);
    settings.environment.light = EnvironmentLight::Sampled;
    settings.environment.samples = 1024;
    for (const float roughness : {0.4f, 1.0f})
        for (const float metallic : {0.0f, 1.0f}) {
            scene.materials[0].metallic = metallic;
            scene.materials[0].perceptualRoughness = roughness;
            const validation::ReferencePicture truth = strictReference(scene, settings);
            const std::vector<float> seen = drawn(scene, settings);
            double own = 0.0, wanted = 0.0;
            for (std::size_t i = 0; i < seen.size(); i += 4) {
                own += double(seen[i]);
                wanted += double(truth.picture.rgba[i]);
            }
            // 256 pixels of 3 x 1024 samples each, and as many in the reference.
            EXPECT_NEAR(own / wanted, 1.0, 3e-3) << "roughness " << roughness << ", metallic " << metallic;
        }
}

/// Materials of every model, with black below lobes to isolate them.
std::vector<EvenCase> evenCases() {
    using scenes::MaterialModel;
    std::vector<EvenCase> cases;
    const auto add = [&](std::string name, MaterialModel model, float color) -> EvenCase& {
        EvenCase& added = cases.emplace_back(EvenCase{std::move(name), {}});
        added.material.model = model;
        added.material.baseColor = glm::vec4(glm::vec3(color), 1.0f);
        return added;
    };
    add("lambert", MaterialModel::Lambert, 0.7f);
    scenes::Material& wrapped = add("wrapped lambert", MaterialModel::Lambert, 0.7f).material;
    wrapped.subsurface.method = scenes::SubsurfaceMethod::Wrap;
    wrapped.subsurface.bodyRadiusMetres = 1.0f;
    for (const float exponent : {1.0f, 10.0f, 100.0f, 1e4f})
        add(fmt::format("blinn_phong, p {}", exponent), MaterialModel::BlinnPhong, 0.0f).material.exponent = exponent;
    for (const auto& [alpha, ior] : {std::pair(0.05f, 1.5f),
                                     {0.05f, 0.75f},
                                     {0.05f, 1.005f},
                                     {0.3f, 0.4f},
                                     {0.3f, 0.7f},
                                     {0.3f, 0.9f},
                                     {1.0f, 0.7f},
                                     {0.3f, 1.0f},
                                     {0.3f, 1.33f},
                                     {0.3f, 1.5f},
                                     {0.3f, 2.5f},
                                     {1.0f, 1.33f},
                                     {1.0f, 2.5f}}) {
        EvenCase& glossy =
            add(fmt::format("microfacet, alpha {}, ior {}", alpha, ior), MaterialModel::Microfacet, 0.0f);
        glossy.material.alpha = alpha;
        glossy.material.ior = ior;
        if (ior < 1.0f) glossy.splitSumError = kInnerReflectionError;
    }
    EvenCase& brushed = add("microfacet_anisotropic, alpha 0.1 and 0.4", MaterialModel::MicrofacetAnisotropic, 0.0f);
    brushed.material.alpha = 0.1f;
    brushed.material.alphaY = 0.4f;
    brushed.splitSumError = kTwoAlphasError;
    for (const float metallic : {0.0f, 1.0f})
        for (const float roughness : {0.2f, 0.5f, 1.0f}) {
            const char* const kind = metallic > 0.0f ? "metal" : "dielectric";
            scenes::Material& material =
                add(fmt::format("{}, roughness {}", kind, roughness), MaterialModel::MetallicRoughness, 0.2f).material;
            material.metallic = metallic;
            material.perceptualRoughness = roughness;
        }
    for (const float roughness : {0.3f, 0.8f}) {
        scenes::Material& cloth =
            add(fmt::format("sheen, roughness {}", roughness), MaterialModel::MetallicRoughness, 0.2f).material;
        cloth.metallic = 0.0f;
        cloth.sheenColor = glm::vec3(0.8f);
        cloth.sheenPerceptualRoughness = roughness;
    }
    scenes::Material& satin = add("sheen over a mirror", MaterialModel::MetallicRoughness, 1.0f).material;
    satin.perceptualRoughness = 0.0f;
    satin.sheenColor = glm::vec3(0.8f);
    satin.sheenPerceptualRoughness = 0.5f;
    scenes::Material& lacquer = add("clearcoat", MaterialModel::MetallicRoughness, 0.2f).material;
    lacquer.perceptualRoughness = 0.6f;
    lacquer.clearcoat = 0.9f;
    lacquer.clearcoatPerceptualRoughness = 0.2f;
    EvenCase& steel = add("anisotropic metal", MaterialModel::MetallicRoughness, 0.8f);
    steel.material.perceptualRoughness = 0.5f;
    steel.material.anisotropyStrength = 0.7f;
    steel.splitSumError = kFacetsError;
    for (int degrees = 0; degrees <= 90; degrees += 15) {
        EvenCase& brass = add(fmt::format("brushed by {} degrees", degrees), MaterialModel::MetallicRoughness, 1.0f);
        brass.material.perceptualRoughness = 0.3f;
        brass.material.anisotropyStrength = 0.42f; // alphas of 0.09 and 0.25
        brass.material.anisotropyRotationRadians = glm::radians(float(degrees));
        brass.splitSumError = kFacetsError;
    }
    // Measured 1 %; with another start of the 24 microfacets' azimuths 3 to 5 %.
    EvenCase& fluted = add("brushed to the utmost", MaterialModel::MetallicRoughness, 1.0f);
    fluted.material.perceptualRoughness = 0.5f;
    fluted.material.anisotropyStrength = 1.0f;
    fluted.material.anisotropyRotationRadians = glm::radians(90.0f);
    fluted.splitSumError = kFacetsError;
    return cases;
}

/// Both methods of environment light against the reference, under uniform radiance.
void EnvironmentTruth::expectEven(const std::vector<EvenCase>& cases, bool compensates) {
    constexpr int kCellPixels = 4;
    constexpr double kCosines[] = {0.9, 0.5, 0.15};
    constexpr int kRows = int(std::size(kCosines));
    const int columns = int(cases.size());
    // A square per cell of a metre, viewed along -z; each tilts about x and is stretched to fill its cell.
    scenes::Scene scene = quadScene({});
    scene.materials.clear();
    scene.nodes.clear();
    scene.environment = evenEnvironment(1.0);
    scenes::Camera& camera = scene.cameras[0];
    camera.projection = scenes::Projection::Orthographic;
    camera.worldFromCamera[3] = {0.0, 0.0, 10.0, 1.0};
    camera.halfHeightMetres = 0.5 * kRows;
    camera.nearMetres = 1.0;
    camera.farMetres = 20.0;
    for (int column = 0; column < columns; ++column) {
        scene.materials.push_back(cases[std::size_t(column)].material);
        for (int row = 0; row < kRows; ++row) {
            const double cosine = kCosines[row], sine = std::sqrt(1.0 - cosine * cosine);
            scenes::Node& node = scene.nodes.emplace_back();
            node.parentFromNode[0] = {0.5, 0.0, 0.0, 0.0};
            node.parentFromNode[1] = glm::dvec4(0.0, cosine, sine, 0.0) * (0.5 / cosine);
            node.parentFromNode[2] = {0.0, -sine, cosine, 0.0};
            node.parentFromNode[3] = {column - 0.5 * (columns - 1), 0.5 * (kRows - 1) - row, 0.0, 1.0};
            node.instances = {{0, column}};
        }
    }
    frame::FrameSettings settings = ofSize(columns * kCellPixels, kRows * kCellPixels);
    settings.environment.samples = 4096;
    settings.environment.compensates = compensates;
    const validation::ReferencePicture truth = strictReference(scene, settings);
    engine::Renderer renderer(context(), scene);
    for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
        settings.environment.light = light;
        const std::vector<float> seen = renderer.render(Technique::Forward, settings).radiance;
        const auto meanOf = [&](const std::vector<float>& rgba, int column, int row) {
            double sum = 0.0;
            for (int y = row * kCellPixels; y < (row + 1) * kCellPixels; ++y)
                for (int x = column * kCellPixels; x < (column + 1) * kCellPixels; ++x)
                    for (int c = 0; c < 3; ++c)
                        sum += double(rgba[std::size_t(4 * (y * settings.sizePixels.x + x) + c)]);
            return sum / (3.0 * kCellPixels * kCellPixels);
        };
        for (int column = 0; column < columns; ++column)
            for (int row = 0; row < kRows; ++row) {
                const EvenCase& one = cases[std::size_t(column)];
                const double reflected = meanOf(truth.picture.rgba, column, row);
                const double error = light == EnvironmentLight::SplitSum ? one.splitSumError : one.sampledError;
                EXPECT_NEAR(meanOf(seen, column, row), reflected, error * reflected + kLeastError)
                    << infoOf(light).name << ", " << one.name << ", cosine " << kCosines[row];
            }
    }
}

/// Under uniform radiance both methods are exact except for tables and noise, so that the reflection of any lobe is one
/// known number.
TEST_F(EnvironmentTruth, everyModelReflectsEvenLightAsTheReferenceDoes) {
    expectEven(evenCases(), false);
}

/// Wrapped light in front of a matte surface adds its wrap to the light of even skies, and half of it where the sky
/// behind is black: as if both sides had the mean of their irradiances.
TEST_F(EnvironmentTruth, wrappedLightIsThatOfTheMeanOfFrontAndBack) {
    constexpr float kWrap = 0.8f;
    scenes::Material skin = lambert();
    skin.subsurface.method = scenes::SubsurfaceMethod::Wrap;
    skin.subsurface.wrap = kWrap;
    skin.subsurface.wrapTint = {1.0f, 0.5f, 0.0f};
    skin.subsurface.bodyRadiusMetres = 1.0f;
    scenes::Scene scene = quadScene(skin);
    makeOrthographic(scene.cameras[0], 0.5);
    for (const bool isEven : {true, false}) {
        scene.environment = environmentOf(64, 32, [&](int x, int y) {
            const bool isFront = scenes::directionInMap({(x + 0.5) / 64.0, (y + 0.5) / 32.0}).z > 0.0;
            return glm::dvec3(isEven || isFront ? 1.0 : 0.0);
        });
        const std::vector<float> seen = drawn(scene, ofSize(4, 4));
        for (std::size_t c = 0; c < 3; ++c) {
            const double wrap = double(kWrap) * double(skin.subsurface.wrapTint[int(c)]);
            const double wanted = std::numbers::pi * (1.0 + (isEven ? wrap : 0.5 * wrap)); // without 1/pi
            EXPECT_NEAR(seen[c], wanted, 5e-4 * wanted) << isEven << ", " << c;
        }
    }
}

/// Light scattered between microfacets leaves through the layers above them: without these, a coat is off by 21 % with
/// samples, and coat and sheen together by 76 % with the split sum.
TEST_F(EnvironmentTruth, layersLieOverWhatCompensationAdds) {
    std::vector<EvenCase> cases;
    for (const bool isCoated : {false, true})
        for (const float sheen : {0.0f, 0.8f}) {
            EvenCase& one = cases.emplace_back(EvenCase{fmt::format("coat {}, sheen {}", isCoated, sheen), {}});
            one.material.metallic = 1.0f;
            one.material.perceptualRoughness = 1.0f;
            one.material.clearcoat = isCoated ? 1.0f : 0.0f;
            one.material.clearcoatPerceptualRoughness = 0.2f;
            one.material.sheenColor = glm::vec3(sheen);
            one.material.sheenPerceptualRoughness = 0.5f;
            // Each layer attenuates by its mean over all light; the reference attenuates light by light.
            if (isCoated || sheen > 0.0f) one.splitSumError = one.sampledError = 0.05;
        }
    expectEven(cases, true);
}

/// A coat has its own normal, here tilted by 37 degrees towards +x: it mirrors what lies at 74 degrees from the
/// surface's normal, on one side.
TEST_F(EnvironmentTruth, aCoatSeesWhatItsOwnNormalMirrors) {
    scenes::Material coat = blackDielectric(); // isolates the coat
    coat.specularFactor = 0.0f;
    coat.clearcoat = 1.0f;
    coat.texture(scenes::TextureSlot::ClearcoatNormal).image = 0;
    scenes::Scene scene = quadScene(coat);
    scene.images = {uniformImage({204, 128, 230, 255})}; // 0.6, 0, 0.8
    makeOrthographic(scene.cameras[0], 0.5);
    frame::FrameSettings settings = exactOfSize(8, 8);
    settings.environment.samples = 1024;
    const auto expectAsReference = [&](double error, const std::string& what) {
        const validation::ReferencePicture truth = strictReference(scene, settings);
        const float seen = drawn(scene, settings)[4 * (4 * 8 + 4)];
        const float wanted = truth.picture.rgba[4 * (4 * 8 + 4)];
        EXPECT_GT(wanted, 0.01f) << what;
        EXPECT_NEAR(seen, wanted, error * double(wanted)) << what;
    };
    // Radiance grows along +x: straight ahead it is half as bright as in the coat's mirror direction.
    for (const float roughness : {0.0f, 0.3f}) {
        scene.materials[0].clearcoatPerceptualRoughness = roughness;
        scene.environment = environmentOf(64, 32, [](int x, int y) {
            return glm::dvec3(1.0 + 0.95 * scenes::directionInMap({(x + 0.5) / 64.0, (y + 0.5) / 32.0}).x);
        });
        for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled}) {
            settings.environment.light = light;
            // The lobe leans towards the normal, and the radiance changes steeply.
            expectAsReference(roughness > 0.0f && light == EnvironmentLight::SplitSum ? 0.05 : 0.01,
                              fmt::format("{}, roughness {}", infoOf(light).name, roughness));
        }
    }
    scene.environment.reset();
    scene.lights = {areaLight(scenes::LightType::Sphere, {2.0 * 0.96, 0.0, 2.0 * 0.28}, {0.0, 0.0, -1.0}, 3.0f)};
    scene.lights[0].isSeen = false;
    expectAsReference(0.1, "a sphere");
}

} // namespace
} // namespace tessera
