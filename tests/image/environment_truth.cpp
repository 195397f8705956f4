// Light from everywhere against the reference and published tables.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "shaders/shared/environment.h"
#include "tests/image/EnvironmentTest.h"
#include "tests/image/FlatTest.h"
#include "tests/unit/docs/Tables.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::EnvironmentLight;
using namespace test;

class EnvironmentTruth : public EnvironmentTest {
protected:
    void expectSamplesAgree();
};
using EnvironmentTruthSlow = EnvironmentTruth;

// Of light that is the same everywhere, in parts of what is reflected of it; measured as 0.006, 0.005 and 0.1.
constexpr double kEvenError = 0.01;            ///< noise of samples and of the reference, tables between their places
constexpr double kInnerReflectionError = 0.02; ///< tables where total reflection begins
constexpr double kTwoAlphasError = 0.12;       ///< the table of one alpha, the mean of two
constexpr double kFacetsError = 0.025;         ///< of 24 for a lobe of two alphas
constexpr double kLeastError = 1e-5;           ///< absolute, where next to nothing is reflected

TEST_F(EnvironmentTruth, theBackdropIsThatOfTheReferenceInEveryPixel) {
    scenes::Scene scene = quadScene(unlit());
    scene.nodes[0].parentFromNode[3] = glm::dvec4(0.0, 0.0, 100.0, 1.0); // behind the camera
    scene.cameras[0].projection = scenes::Projection::Perspective;
    scene.cameras[0].fovYRadians = 1.8; // far from the axis
    scene.environment =
        environmentOf(64, 32, [](int x, int y) { return glm::dvec3(1 + x % 5, 1 + y % 7, 1.0 + 0.01 * x * y); });
    scene.environment->rotationDegrees = 40.0f;
    frame::FrameSettings settings;
    settings.sizePixels = {48, 27};
    settings.filter = frame::TextureFilter::Exact;
    const validation::ReferencePicture truth = validation::referencePicture(
        scene, settings, [] {}, validation::Leeway::None);
    engine::Renderer renderer(context(), scene);
    const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
    for (std::size_t i = 0; i < seen.size(); i += 4)
        for (std::size_t c = i; c < i + 3; ++c)
            ASSERT_NEAR(seen[c], truth.picture.rgba[c], 1e-3) << i / 4; // steps of a texel, and fp32 angles
}

/// E(mu, alpha) of a height-correlated GGX lobe with F = 1, shading.md section 6: good to 2e-4. Compensated, all of it.
TEST_F(EnvironmentTruth, aWhiteFurnaceLosesWhatThePublishedTableSays) {
    constexpr double kCosines[] = {0.1, 0.25, 0.5, 0.75, 1.0};
    constexpr double kAlphas[] = {0.05, 0.1, 0.25, 0.5, 0.75, 1.0};
    constexpr double kReflected[6][5] = {{.9113, .9745, .9927, .9961, .9973}, {.8834, .9216, .9692, .9831, .9882},
                                         {.8916, .8401, .8572, .8915, .9158}, {.8601, .7652, .6982, .6821, .6879},
                                         {.8107, .6802, .5646, .5014, .4639}, {.7602, .5976, .4507, .3645, .3069}};
    scenes::Material white;
    white.metallic = 1.0f;
    white.doubleSided = true;
    scenes::Scene scene = quadScene(white);
    scene.environment = evenEnvironment(1.0);
    scenes::Camera& camera = scene.cameras[0];
    camera.projection = scenes::Projection::Orthographic;
    camera.halfHeightMetres = 0.05;
    for (const auto& [light, compensates] : {std::pair(EnvironmentLight::SplitSum, false),
                                             {EnvironmentLight::Sampled, false},
                                             {EnvironmentLight::SplitSum, true},
                                             {EnvironmentLight::Sampled, true}}) {
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings;
        settings.sizePixels = {16, 16};
        settings.environment.light = light;
        settings.environment.samples = 1024;
        settings.environment.compensates = compensates;
        for (int a = 0; a < 6; ++a) {
            scene.materials[0].perceptualRoughness = float(std::sqrt(kAlphas[a]));
            renderer.materialsChanged();
            for (int m = 0; m < 5; ++m) {
                const double angle = std::acos(kCosines[m]);
                camera.worldFromCamera = glm::dmat4(1.0);
                camera.worldFromCamera[0] = {std::cos(angle), 0.0, -std::sin(angle), 0.0};
                camera.worldFromCamera[2] = {std::sin(angle), 0.0, std::cos(angle), 0.0};
                camera.worldFromCamera[3] = {2.0 * std::sin(angle), 0.0, 2.0 * std::cos(angle), 1.0};
                const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
                double mean = 0.0;
                for (std::size_t i = 0; i < seen.size(); i += 4) mean += double(seen[i]) * 4.0 / double(seen.size());
                // 256 pixels of 1024 samples of the lobe, whose worth spreads by less than 1, leave 2e-3 / 3.
                EXPECT_NEAR(mean, compensates ? 1.0 : kReflected[a][m],
                            light == EnvironmentLight::SplitSum ? 1e-3 : 2e-3)
                    << infoOf(light).name << ", cosine " << kCosines[m] << ", alpha " << kAlphas[a]
                    << (compensates ? ", compensated" : "");
            }
        }
    }
}

/// Against another integration of the same light: means agree within three of their standard errors. With the second of
/// two maps lobes are compensated, which by default the white furnace above shows alone.
void EnvironmentTruth::expectSamplesAgree() {
    scenes::Scene scene = scenes::loadScene("models");
    scene.lights.clear();
    scene.environment = builtinEnvironment("studio");
    frame::FrameSettings settings;
    settings.sizePixels = {64, 36};
    settings.filter = frame::TextureFilter::Exact;
    settings.environment.light = EnvironmentLight::Sampled;
    settings.environment.samples = 256;
    engine::Renderer renderer(context(), scene);
    for (const char* name : test::everyNth(std::vector{"studio", "sky"}, 2)) {
        scene.environment = builtinEnvironment(name);
        renderer.environmentChanged();
        settings.environment.compensates = name == std::string_view("sky");
        const validation::ReferencePicture truth = validation::referencePicture(
            scene, settings, [] {}, validation::Leeway::None);
        const std::vector<float> seen = renderer.render(Technique::Forward, settings).radiance;
        double sum = 0.0, squares = 0.0, light = 0.0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < truth.picture.pixelCount(); ++i) {
            if (truth.surroundings[i].light == glm::dvec3(0.0)) continue;
            double own = 0.0, other = 0.0;
            for (std::size_t c = 0; c < 3; ++c) {
                own += double(seen[4 * i + c]);
                other += double(truth.picture.rgba[4 * i + c]);
            }
            // By the light of the pixel, so that no bright one decides alone.
            const double error = (own - other) / (own + other + 1e-3);
            sum += error;
            squares += error * error;
            light += other;
            ++count;
        }
        ASSERT_GT(count, 500u);
        const double mean = sum / double(count);
        const double standardError = std::sqrt(squares / double(count) - mean * mean) / std::sqrt(double(count));
        EXPECT_LE(std::abs(mean), 3.0 * standardError) << name << ": " << mean << " of " << standardError;
        EXPECT_LE(standardError, 2e-3) << name;
    }
}
TEST_F(EnvironmentTruth, samplesAgreeWithTheReferenceWithinThreeStandardErrors) {
    expectSamplesAgree();
}
TEST_F(EnvironmentTruthSlow, samplesAgreeWithTheReferenceWithinThreeStandardErrors) {
    expectSamplesAgree();
}

struct EvenCase {
    std::string name;
    scenes::Material material;
    double splitSumError = kEvenError;
};

/// Materials of every model, with black below lobes that are to be seen alone.
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
                                     {0.05f, 1.02f},
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
    return cases;
}

/// In the light of a map that is the same everywhere both ways to find it are exact but for their tables and their
/// noise, so that what a surface reflects is known to one number, whatever its lobe.
TEST_F(EnvironmentTruth, everyModelReflectsEvenLightAsTheReferenceDoes) {
    constexpr int kCellPixels = 4;
    constexpr double kCosines[] = {0.9, 0.5, 0.15};
    constexpr int kRows = int(std::size(kCosines));
    const std::vector<EvenCase> cases = evenCases();
    const int columns = int(cases.size());
    // A square a cell of a metre, seen along -z; each tilts about x and is as long as it then looks short.
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
    frame::FrameSettings settings;
    settings.sizePixels = {columns * kCellPixels, kRows * kCellPixels};
    settings.environment.samples = 4096;
    const validation::ReferencePicture truth = validation::referencePicture(
        scene, settings, [] {}, validation::Leeway::None);
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
                const double error = light == EnvironmentLight::SplitSum ? one.splitSumError : kEvenError;
                EXPECT_NEAR(meanOf(seen, column, row), reflected, error * reflected + kLeastError)
                    << infoOf(light).name << ", " << one.name << ", cosine " << kCosines[row];
            }
    }
}

class EnvironmentSlow : public EnvironmentTest {};

/// Of one channel of a picture of ballUnderSky().
struct BallFigures {
    double relMse, noise; ///< noise of the reference, as relMse
    double meanError;     ///< the mean over pixels whose mean square relMse is
    double brightest;     ///< over the reference, in 999 of 1000 pixels at most
    double pixels;
};
BallFigures ballFigures(const std::vector<float>& seen, const validation::ReferencePicture& truth) {
    double errors = 0.0, squares = 0.0, noise = 0.0;
    std::vector<double> over;
    for (std::size_t i = 0; i < truth.picture.pixelCount(); ++i) {
        if (truth.picture.covered[i] == 0) continue;
        const double own = double(seen[4 * i]), other = double(truth.picture.rgba[4 * i]);
        const double relative = (own - other) / (other + 0.01);
        errors += relative;
        squares += relative * relative;
        noise += truth.surroundings[i].variance.x / ((other + 0.01) * (other + 0.01));
        over.push_back(own / std::max(other, 1e-3));
    }
    const double count = double(over.size());
    std::ranges::sort(over);
    return {squares / count, noise / count, errors / count, over[over.size() * 999 / 1000], count};
}

/// By how much more light a ball shows than the reference, on a picture of its own: a highlight of roughness 0.125 is
/// a hundredth of the ball wide. Where that is half a pixel the sum hangs on where pixels happen to lie, by 20 % and
/// more; with 200 of them across it is within 0.2 % of that of any finer picture.
double biasOfBall(engine::Renderer& renderer, const scenes::Scene& scene, frame::FrameSettings settings) {
    settings.sizePixels = {200, 200};
    reference::Settings wanted = validation::referenceSettings(scene, settings);
    wanted.leeway = false;
    wanted.environmentPaths = 64; // of 31,000 pixels together: noise of 2e-4
    const reference::Rendered truth = reference::render(scene, wanted);
    const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
    double shown = 0.0, light = 0.0;
    for (std::size_t i = 0; i < truth.radiance.size(); ++i) {
        if (truth.covered[i] == 0) continue;
        shown += double(seen[4 * i]);
        light += truth.radiance[i].x;
    }
    return shown / light - 1.0;
}

struct StatedError {
    double bias, relMse;
};
/// Of the table of docs/environment.md: a row's errors, environment by environment. Empty for a row that it lacks.
std::vector<StatedError> statedErrors(const std::string& row) {
    const std::string document = textOf(kRepository / "docs/environment.md"), start = "\n| " + row + " |";
    std::vector<StatedError> errors;
    const std::size_t at = document.find(start);
    if (at == std::string::npos) return errors;
    const std::size_t first = at + start.size();
    std::istringstream cells(document.substr(first, document.find('\n', first) - first));
    for (std::string cell; std::getline(cells, cell, '|');) {
        StatedError& error = errors.emplace_back();
        EXPECT_EQ(std::sscanf(cell.c_str(), " %lf %%, %lf", &error.bias, &error.relMse), 2) << row << ": " << cell;
        error.bias *= 0.01;
    }
    return errors;
}

/// The errors that docs/environment.md tells, by which the split sum is judged, and its other bars: a bias of a
/// hundredth on matte surfaces, and no fireflies. Samples err by their noise alone.
TEST_F(EnvironmentSlow, theErrorOfTheSplitSumByRoughnessAndEnvironment) {
    const std::pair<const char*, scenes::Environment> environments[] = {
        {"studio", builtinEnvironment("studio")},
        {"sky", builtinEnvironment("sky")},
        {"sun", environmentOf(512, 256, [](int x, int y) { return glm::dvec3(x == 60 && y == 70 ? 1e5 : 0.1); })},
        {"squares",
         environmentOf(512, 256, [](int x, int y) { return glm::dvec3((x / 32 + y / 32) % 2 == 0 ? 1.0 : 0.05); })},
        {"even", evenEnvironment(1.0)}};
    struct Row {
        std::string name;
        scenes::Material material;
    };
    std::vector<Row> rows(1);
    rows[0].name = "matte";
    rows[0].material.model = scenes::MaterialModel::Lambert;
    for (const double roughness : {0.0, 0.125, 0.25, 0.5, 0.75, 1.0}) {
        Row& row = rows.emplace_back();
        row.name = fmt::format("metal, roughness {}", roughness);
        row.material.metallic = 1.0f;
        row.material.perceptualRoughness = float(roughness);
    }
    // The page rounds errors to a digit, which may be half as much less than what it stands for.
    constexpr double kRounded = 1.5;
    // Half of the last digit of a bias, and three standard errors of the reference: 1e-2 a pixel of 1200.
    constexpr double kLeastBias = 1.5e-3;
    constexpr double kRoundingError = 1e-5; // of sums in single precision, where light is even
    for (std::size_t column = 0; column < std::size(environments); ++column) {
        const auto& [name, environment] = environments[column];
        for (const Row& row : rows) {
            SCOPED_TRACE(fmt::format("{}, {}", name, row.name));
            scenes::Scene scene = ballUnderSky(row.material);
            scene.environment = environment;
            frame::FrameSettings settings;
            settings.sizePixels = {40, 40};
            settings.environment.backdrop = frame::Backdrop::Off;
            const validation::ReferencePicture truth = validation::referencePicture(
                scene, settings, [] {}, validation::Leeway::None);
            engine::Renderer renderer(context(), scene);
            const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
            const BallFigures ball = ballFigures(seen, truth);
            const double bias = biasOfBall(renderer, scene, settings);
            std::printf("%-8s %-22s bias %+.2e relMSE %.2e (noise of the reference %.1e) brightest %.2f\n", name,
                        row.name.c_str(), bias, ball.relMse, ball.noise, ball.brightest);
            // A lobe of the wrong shape is up to 5.4 times too bright at an edge; a firefly of that sun would be 1e2
            // and more.
            EXPECT_LE(ball.brightest, 8.0);
            // The reference is close enough to tell by how much the split sum errs where that is much.
            EXPECT_LE(ball.noise, std::max(0.1 * ball.relMse, 4e-4));
            if (row.material.model == scenes::MaterialModel::Lambert) {
                EXPECT_LE(std::abs(bias), 0.01);
                EXPECT_LE(ball.relMse, 3e-3); // most of it where the sun stands at the horizon
            }
            if (row.material.perceptualRoughness == 0.0f) continue; // a mirror: EnvironmentMirrors
            const std::vector<StatedError> stated = statedErrors(row.name);
            ASSERT_EQ(stated.size(), std::size(environments));
            EXPECT_LE(std::abs(bias), kRounded * std::abs(stated[column].bias) + kLeastBias);
            EXPECT_LE(ball.relMse, kRounded * stated[column].relMse);
            settings.environment.light = EnvironmentLight::Sampled;
            settings.environment.samples = 256;
            const BallFigures sampled = ballFigures(renderer.render(Technique::Deferred, settings).radiance, truth);
            // Pixels that take the same run of the map's samples err alike.
            const double alone =
                std::min(sampled.pixels, double(1 << ENVIRONMENT_SAMPLES_LOG2) / settings.environment.samples);
            const double standardError = std::sqrt((sampled.relMse - sampled.meanError * sampled.meanError) / alone);
            std::printf("%-8s %-22s sampled %+.2e, standard error %.1e\n", name, row.name.c_str(), sampled.meanError,
                        standardError);
            EXPECT_LE(std::abs(sampled.meanError), 3.0 * standardError + kRoundingError);
            EXPECT_LE(standardError, 5e-3); // so small that 2 % too much or too little would show
        }
    }
}

} // namespace
} // namespace tessera
