// Spread light against closed forms, the reference and faults.
#include <cmath>
#include <map>
#include <numbers>
#include <span>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "renderer/gpu/Timer.h"
#include "tests/image/DiffusionTest.h"
#include "tests/support/ShaderMutant.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::SubsurfaceMethod;
using namespace test;
namespace builtin = scenes::builtin;

class DiffusionTruth : public DiffusionTest {};
using DiffusionTruthSlow = DiffusionTruth;

// ---- On a plane ----------------------------------------------------------------------------------------------------

/// Errors at some sides of the atlas; each must be at most 0.7 of the one before.
void expectConvergence(std::span<const int> sides, const std::function<TruthError(int)>& step,
                       const std::function<TruthError(int)>& dot) {
    double before = 0.0;
    for (const int side : sides) {
        const TruthError ofStep = step(side), ofDot = dot(side);
        fmt::print("{} texels: step {:.2e}, dot {:.2e} with {:.5f} of its light\n", side, ofStep.l2, ofDot.l2,
                   ofDot.energy);
        EXPECT_LE(ofStep.l2, 0.01) << side;
        EXPECT_LE(ofStep.l2, before > 0.0 ? 0.7 * before : 1.0) << side;
        // The dot is as round as texels make it.
        EXPECT_LE(ofDot.l2, side >= 2048 ? 0.01 : 0.2) << side;
        EXPECT_NEAR(ofDot.energy, 1.0, side >= 2048 ? 0.01 : 0.06) << side;
        before = ofStep.l2;
    }
}

TEST_F(DiffusionTruth, aStepAndADotSpreadAsTheClosedFormsSay) {
    expectConvergence(
        std::array{256, 512}, [&](int side) { return stepError(side); }, [&](int side) { return dotError(side); });
}

TEST_F(DiffusionTruthSlow, aStepAndADotSpreadAsTheClosedFormsSay) {
    expectConvergence(
        std::array{512, 1024, 2048}, [&](int side) { return stepError(side); },
        [&](int side) { return dotError(side); });
    const double c = 0.6 * std::cos(0.3), s = 0.6 * std::sin(0.3);
    const double turned = stepError(2048, [&](scenes::Scene& scene) { mapTexture(scene, {{c, s}, {-s, c}}); }).l2;
    fmt::print("2048 texels, turned: {:.2e}\n", turned);
    EXPECT_LE(turned, 0.01);
}

// After a narrow Gaussian a wide one, neighbours, and those between which taps grow apart.
TEST_F(DiffusionTruth, anyTwoWidthsSpreadAStepAsTheClosedFormSays) {
    for (const auto& [narrow, wide] : {std::pair(0.71, 17.9), {0.3, 30.0}, {1.5, 4.5}, {2.6, 5.0}, {5.0, 9.0}}) {
        const double error = stepErrorOf(narrow, wide);
        fmt::print("{} and {} texels: {:.2e}\n", narrow, wide, error);
        // Twice the worst that was measured.
        EXPECT_LE(error, 2e-3) << narrow << " and " << wide;
    }
}

TEST_F(DiffusionTruth, fewerGaussiansAndHalfTheResolutionAreNearTheClosedForms) {
    scenes::Scene scene = scenes::loadScene("diffusion_truth");
    scene.cameras = {above({builtin::kTruthEdgeX, 0.0, 0.0}, 2.0 / 1024.0)};
    engine::Renderer renderer(context(), scene);
    const auto error = [&](int gaussians, bool half, int side = 256) {
        frame::FrameSettings settings;
        settings.sizePixels = {896, 8};
        settings.diffusion = {side, gaussians, half};
        return errorOf(pictureOf(renderer, settings), scene.cameras[0],
                       [](const glm::dvec3& placeWS) { return builtin::spreadStep(placeWS.x - builtin::kTruthEdgeX); })
            .l2;
    };
    const double all = error(8, false), halved = error(8, true), smaller = error(8, false, 128);
    double before = all;
    for (const int gaussians : {4, 2, 1}) {
        const double own = error(gaussians, false);
        fmt::print("{} Gaussians: {:.2e}\n", gaussians, own);
        EXPECT_GT(own, before);
        EXPECT_LT(own, 0.1);
        before = own;
    }
    fmt::print("all: {:.2e}, at half the resolution {:.2e}, {:.2e} of as many texels\n", all, halved, smaller);
    // Four texels of light are the mean of one that is spread, which widens it by a sixteenth of its area.
    EXPECT_LT(halved, 1.3 * smaller);
}

TEST_F(DiffusionTruth, stretchedAndSlantedTexturesChangeNothing) {
    const double plain = stepError(256).l2;
    for (const double stretch : {10.0, 100.0}) {
        // Squares so narrow that both directions have as many texels.
        const double own = stepError(256, [&](scenes::Scene& scene) {
                               for (glm::vec3& position : scene.meshes[0].positionsOS) position.z /= float(stretch);
                               mapTexture(scene, {{1.0, 0.0}, {0.0, stretch}});
                           }).l2;
        fmt::print("stretched {}:1: {:.2e}, else {:.2e}\n", stretch, own, plain);
        EXPECT_LE(own, 2.0 * plain + 1e-5) << stretch;
    }
    for (const double stretch : {2.0, 8.0}) {
        // Fewer texels along x.
        const double own = stepError(256, [&](scenes::Scene& scene) {
                               mapTexture(scene, {{1.0 / stretch, 0.0}, {0.0, 1.0}});
                           }).l2;
        const double coarse = stepError(int(256.0 / stretch)).l2;
        fmt::print("{} times fewer texels along x: {:.2e}, with as many both ways {:.2e}\n", stretch, own, coarse);
        EXPECT_LE(own, 1.5 * coarse + 1e-5) << stretch;
    }
    for (const double turn : {0.3, 0.7853981633974483}) {
        const double c = 0.6 * std::cos(turn), s = 0.6 * std::sin(turn);
        const double turned = stepError(256, [&](scenes::Scene& scene) { mapTexture(scene, {{c, s}, {-s, c}}); }).l2;
        const double slanted = stepError(256, [&](scenes::Scene& scene) {
                                   mapTexture(scene, {{0.6, 0.0}, {0.3, 0.6}});
                               }).l2;
        fmt::print("turned by {:.2f}: {:.2e}, slanted {:.2e}\n", turn, turned, slanted);
        // The edge of the shadow is as straight as texels make it.
        EXPECT_LE(turned, 0.05);
        EXPECT_LE(slanted, 0.05);
    }
}

// ---- Over seams ----------------------------------------------------------------------------------------------------

TEST_F(DiffusionTruth, lightThatIsTheSameEverywhereStaysSoOverSeams) {
    scenes::Scene scene = sphereScene(0.03, 16);
    scenes::Mesh& mesh = scene.meshes[0];
    for (glm::vec3& normal : mesh.normalsOS) normal = glm::vec3(0.0f, 1.0f, 0.0f);
    scene.lights[0].directionWS = {0.0, -1.0, 0.0};
    scene.lights[0].intensity = 1.0f;
    scene.background = glm::vec3(0.0f);
    frame::FrameSettings settings;
    settings.sizePixels = {400, 400};
    settings.shadows = {scenes::ShadowRequest::Kind::None};
    for (const int side : {128, 512}) {
        settings.diffusion.sideTexels = side;
        const engine::RenderedFrame frame = engine::Renderer(context(), scene).render(Technique::Deferred, settings);
        std::size_t covered = 0;
        double worst = 0.0;
        for (std::size_t i = 0; i < frame.radiance.size(); i += 4) {
            if (frame.radiance[i + 3] == 0.0f) continue;
            ++covered;
            for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(double(frame.radiance[i + c]) - 1.0));
        }
        fmt::print("{} texels: off by {:.2e} at most, in {} pixels\n", side, worst, covered);
        EXPECT_GT(covered, 100000u);
        EXPECT_LE(worst, 1e-3) << side;
    }
}

TEST_F(DiffusionTruth, seamsAreNoWorseThanWhatLiesBetweenThem) {
    scenes::Scene scene = sphereScene(0.03, 48);
    scene.lights[0].directionWS = glm::normalize(glm::dvec3(-1.0, -0.5, -0.2));
    frame::FrameSettings settings;
    settings.sizePixels = {64, 64};
    settings.diffusion.sideTexels = 512;
    settings.shadows = {scenes::ShadowRequest::Kind::None};
    const reference::Settings wanted = [&] {
        reference::Settings result = validation::referenceSettings(scene, settings);
        result.diffusionPoints = 1024;
        result.leeway = false;
        return result;
    }();
    const reference::Rendered truth = reference::render(scene, wanted);
    const Picture picture = pictureOf(scene, settings);
    double at[2] = {}, count[2] = {};
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 64; ++x) {
            const std::size_t i = std::size_t(y * 64 + x);
            const glm::dvec2 place = (glm::dvec2(x, 63 - y) + 0.5 - 32.0) * (1.05 / 32.0);
            const double length2 = glm::dot(place, place);
            if (length2 > 0.9) continue; // the rim
            const glm::dmat4& m = scene.cameras[0].worldFromCamera;
            glm::dvec3 point = glm::abs(glm::dmat3(m) * glm::dvec3(place.x, place.y, std::sqrt(1.0 - length2)));
            double sizes[] = {point.x, point.y, point.z};
            std::ranges::sort(sizes);
            const bool isSeam = sizes[2] - sizes[1] < 0.09; // two pixels
            const double wrong = glm::distance(
                truth.radiance[i], glm::dvec3(picture.pixel(i)[0], picture.pixel(i)[1], picture.pixel(i)[2]));
            at[isSeam] += wrong * wrong;
            count[isSeam] += 1.0;
        }
    }
    const double inside = std::sqrt(at[0] / count[0]), seams = std::sqrt(at[1] / count[1]);
    fmt::print("off by {:.2e} inside, {:.2e} at seams\n", inside, seams);
    EXPECT_GT(count[1], 100.0);
    EXPECT_LE(seams, 2.0 * inside);
}

// ---- Against the reference -----------------------------------------------------------------------------------------

/// Relative mean square error of a picture where both it and its neighbours show the reference's first object.
struct HeadError {
    double relMse = 0.0, p99 = 0.0, bias = 0.0;
    std::size_t pixels = 0;
};
HeadError headError(const Picture& picture, const reference::Rendered& truth, std::uint32_t object) {
    std::vector<std::size_t> inside;
    double mean = 0.0;
    for (int y = 1; y + 1 < truth.height; ++y) {
        for (int x = 1; x + 1 < truth.width; ++x) {
            bool isInside = true;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    isInside = isInside && truth.ids[std::size_t((y + dy) * truth.width + x + dx)].object == object;
            if (!isInside) continue;
            inside.push_back(std::size_t(y * truth.width + x));
            for (int c = 0; c < 3; ++c) mean += truth.radiance[inside.back()][c];
        }
    }
    mean /= 3.0 * double(inside.size());
    HeadError error;
    error.pixels = inside.size();
    std::vector<double> relative;
    double wrong = 0.0, difference = 0.0;
    for (const std::size_t i : inside) {
        for (int c = 0; c < 3; ++c) {
            const double right = truth.radiance[i][c], own = picture.pixel(i)[c];
            const double square = (own - right) * (own - right) / (right * right + 1e-2 * mean * mean);
            wrong += square;
            difference += own - right;
            relative.push_back(std::sqrt(square));
        }
    }
    const double count = 3.0 * double(inside.size());
    std::ranges::nth_element(relative, relative.begin() + std::ptrdiff_t(0.99 * count));
    error.relMse = wrong / count;
    error.p99 = relative[std::size_t(0.99 * count)];
    error.bias = difference / count / mean;
    return error;
}

TEST_F(DiffusionTruthSlow, spreadSkinIsNearerTheReferenceThanTheOtherMethods) {
    const scenes::Scene scene = scenes::loadScene("head_skin");
    frame::FrameSettings settings;
    settings.sizePixels = {320, 180};
    settings.filter = frame::TextureFilter::Exact;
    reference::Settings wanted = validation::referenceSettings(scene, settings);
    wanted.leeway = false;
    wanted.diffusionPoints = 1024;
    const reference::Rendered half = reference::render(scene, wanted);
    wanted.diffusionPoints = 2048;
    const reference::Rendered truth = reference::render(scene, wanted);
    Picture before;
    before.width = half.width;
    before.height = half.height;
    for (const glm::dvec3& radiance : half.radiance)
        before.rgba.insert(before.rgba.end(), {float(radiance.x), float(radiance.y), float(radiance.z), 1.0f});
    double whole = 0.0, apart = 0.0, count = 0.0;
    for (const reference::Diffusion::Answer& spread : truth.spread) {
        if (spread.whole == glm::dvec3(0.0)) continue;
        whole += spread.whole.x;
        apart += spread.apart;
        count += 1.0;
    }
    const HeadError doubling = headError(before, truth, 1);
    fmt::print("reference: doubling its points {:.2e}; undivided {:.4f} (red), {:.4f} of it faces away\n",
               doubling.relMse, whole / count, apart / count);
    engine::Renderer renderer(context(), scene);
    std::map<std::string, double> relMse;
    for (const scenes::SubsurfaceMethodInfo& method : scenes::subsurfaceMethods()) {
        settings.subsurface = method.method;
        renderer.keepSpreadLight(false);
        pictureOf(renderer, settings); // compiles
        const gpu::CpuTimer clock;
        const Picture picture = pictureOf(renderer, settings);
        const double ms = clock.elapsedMs();
        renderer.keepSpreadLight(true);
        const HeadError error = headError(picture, truth, 1);
        relMse[std::string(method.name)] = error.relMse;
        fmt::print("{}: relMse {:.2e}, p99 {:.2e}, bias {:+.2e} of {} pixels, {:.0f} ms\n", method.name, error.relMse,
                   error.p99, error.bias, error.pixels, ms);
    }
    const double own = relMse.at("texture_space_diffusion");
    EXPECT_LE(doubling.relMse, 0.1 * own);
    EXPECT_GE(relMse.at("wrap"), 5.0 * own);
    EXPECT_GE(relMse.at("none"), 5.0 * own);
}

// ---- Faults --------------------------------------------------------------------------------------------------------

/// What is measured with the shaders under test, and the most that it may be.
struct Measured {
    double found, most;
};

class DiffusionFaults : public DiffusionTest {
public:
    struct Fault {
        const char* what;
        const char* file;
        const char* from;
        const char* to;
        Measured (DiffusionFaults::*seenBy)(const shader::SourceTree&);
    };

    Measured step(const shader::SourceTree& shaders) { return {stepError(256, {}, shaders).l2, 0.01}; }
    Measured coarseStep(const shader::SourceTree& shaders) { return {stepError(128, {}, shaders).l2, 0.02}; }
    Measured twoWidths(const shader::SourceTree& shaders) {
        return {std::max(stepErrorOf(0.71, 17.9, shaders), stepErrorOf(2.6, 5.0, shaders)), 2e-3};
    }
    Measured slantedStep(const shader::SourceTree& shaders) {
        return {stepErrorOf(5.0, 9.0, shaders, {{0.6, 0.0}, {0.3, 0.6}}), 3e-3};
    }
    Measured stepOfFewerTexelsAlongX(const shader::SourceTree& shaders) {
        const auto stretch = [](scenes::Scene& scene) { mapTexture(scene, {{0.5, 0.0}, {0.0, 1.0}}); };
        return {stepError(512, stretch, shaders).l2, 0.01};
    }
    /// Even light on a sphere of six charts: how far pixels are off, where the surface keeps half of the light.
    Measured evenLight(const shader::SourceTree& shaders) {
        scenes::Scene scene = sphereScene(0.03, 16);
        for (glm::vec3& normal : scene.meshes[0].normalsOS) normal = glm::vec3(0.0f, 1.0f, 0.0f);
        scene.materials[0].baseColor = glm::vec4(0.5f, 0.5f, 0.5f, 1.0f);
        scene.lights[0].directionWS = {0.0, -1.0, 0.0};
        scene.lights[0].intensity = 1.0f;
        const engine::RenderedFrame frame = drawn(scene, shaders);
        double worst = 0.0;
        for (std::size_t i = 0; i < frame.radiance.size(); i += 4)
            if (frame.radiance[i + 3] != 0.0f) worst = std::max(worst, std::abs(double(frame.radiance[i]) - 0.5));
        return {worst, 1e-3};
    }
    /// The night of a sphere far larger than light spreads.
    Measured night(const shader::SourceTree& shaders) {
        scenes::Scene scene = sphereScene(0.1, 16);
        scene.lights[0].directionWS = glm::normalize(glm::dvec3(0.9, 0.7, 1.0)); // as the camera looks from
        const engine::RenderedFrame frame = drawn(scene, shaders);
        const std::size_t middle = 4 * (100 * 200 + 100);
        return {double(frame.radiance[middle]), 1e-6};
    }

private:
    engine::RenderedFrame drawn(scenes::Scene& scene, const shader::SourceTree& shaders) {
        scene.background = glm::vec3(0.0f);
        frame::FrameSettings settings;
        settings.sizePixels = {200, 200};
        settings.shadows = {scenes::ShadowRequest::Kind::None};
        settings.diffusion.sideTexels = 128;
        return engine::Renderer(context(), scene, shaders).render(Technique::Deferred, settings);
    }
};

TEST_F(DiffusionFaults, everyFaultIsSeenByAClosedForm) {
    const Fault faults[] = {
        {"one Gaussian's weight", "passes/diffusion_spread.frag", "sum = vec4(constants.weight.rgb * result, 1.0);",
         "sum = vec4(constants.weight.rgb * result * (abs(constants.weight.r - 0.078) < 0.01 ? 0.8 : 1.0), 1.0);",
         &DiffusionFaults::step},
        {"millimetres taken for metres", "passes/diffusion_spread.frag", "    precise float narrow = variance",
         "    variance *= 1e6;\n    precise float narrow = variance", &DiffusionFaults::step},
        {"stretch ignored", "passes/diffusion_spread.frag", "constants.gaussian.y == 0.0 ? own.x : own.y", "own.y",
         &DiffusionFaults::stepOfFewerTexelsAlongX},
        {"dilation off", "passes/filled_light.glsl", "if (chart == 0.0) return filled;",
         "if (chart <= 0.0) return filled;", &DiffusionFaults::evenLight},
        {"the albedo taken twice", "lib/raster/spread_light.glsl", "powerOf(surface.albedo, 1.0 - material.mixed.z)",
         "powerOf(surface.albedo, 1.0)", &DiffusionFaults::evenLight},
        {"back faces lit", "passes/diffusion_light.frag", "    entering = vec4(light, 1.0);",
         "    surface.normalLS = -surface.normalLS;\n"
         "    light += shadeSurface(surface, viewpoint, gl_FragCoord.xy);\n"
         "    entering = vec4(light, 1.0);",
         &DiffusionFaults::night},
        {"channels of the profile swapped", "passes/diffusion_spread.frag", "constants.weight.rgb * result",
         "constants.weight.bgr * result", &DiffusionFaults::step},
        {"taps that end early", "passes/diffusion_spread.frag", "ceil(DIFFUSION_REACH * perStep / float(apart))",
         "ceil(2.0 * perStep / float(apart))", &DiffusionFaults::twoWidths},
        {"taps far apart where light is not smooth", "passes/diffusion_spread.frag", "bool isFine = !isSmooth",
         "bool isFine = false", &DiffusionFaults::twoWidths},
        {"a slanted texture taken for a straight one", "passes/diffusion_spread.frag",
         "precise float aside = shear * float(offset);", "precise float aside = 0.0;", &DiffusionFaults::slantedStep},
        {"light that texels hold already spread counted as none", "passes/diffusion_light.frag",
         "constants.inTexels.rgb * light", "0.0 * light", &DiffusionFaults::coarseStep},
    };
    for (const Fault& fault : faults) {
        SCOPED_TRACE(fault.what);
        const auto measure = [&](const test::ShaderMutant& shaders) { return (this->*fault.seenBy)(shaders.tree()); };
        const test::ShaderMutant sound, broken;
        broken.replace(fault.file, fault.from, fault.to);
        const Measured before = measure(sound), after = measure(broken);
        fmt::print("{:<55} {:.1e}, without it {:.1e}, at most {:.0e}\n", fault.what, after.found, before.found,
                   before.most);
        EXPECT_LE(before.found, before.most);
        EXPECT_GT(after.found, after.most);
    }
}

} // namespace
} // namespace tessera
