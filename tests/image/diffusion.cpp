#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <span>
#include <tuple>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/Error.h"
#include "engine/PrepareView.h"
#include "engine/Rendering.h"
#include "renderer/gpu/Timer.h"
#include "scenes/Load.h"
#include "scenes/LookAt.h"
#include "scenes/builtin/DiffusionTruth.h"
#include "scenes/builtin/Shapes.h"
#include "tests/image/ShadowTest.h"
#include "tests/support/ShaderMutant.h"
#include "tests/support/TestScenes.h"
#include "validation/figures/PixelErrors.h"

namespace tessera {
namespace {

using engine::Technique;
using scenes::SubsurfaceMethod;
using testing::HasSubstr;
namespace builtin = scenes::builtin;

/// Seen from above by parallel rays: x to the right, -z up.
scenes::Camera above(const glm::dvec3& middleWS, double halfHeightMetres) {
    scenes::Camera camera;
    camera.name = "above";
    camera.projection = scenes::Projection::Orthographic;
    camera.worldFromCamera = glm::dmat4({1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, -1.0, 0.0}, {0.0, 1.0, 0.0, 0.0},
                                        glm::dvec4(middleWS + glm::dvec3(0.0, 1.0, 0.0), 1.0));
    camera.halfHeightMetres = halfHeightMetres;
    camera.nearMetres = 0.01;
    camera.farMetres = 3.0;
    return camera;
}

struct TruthError {
    double l2 = 0.0;     ///< of all channels, relative to the truth's own
    double energy = 0.0; ///< sum of what is found over that of the truth
};

/// Compares a picture of `above(middle, halfHeight)` with what leaves at each pixel.
template <typename Truth>
TruthError errorOf(const Picture& picture, const scenes::Camera& camera, Truth truth) {
    double wrong = 0.0, whole = 0.0, found = 0.0, wanted = 0.0;
    const double metres = 2.0 * camera.halfHeightMetres / picture.height;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const glm::dvec2 place = metres * (glm::dvec2(x, picture.height - 1 - y) + 0.5 -
                                               0.5 * glm::dvec2(picture.width, picture.height));
            const glm::dvec3 right = truth(glm::dvec3(camera.worldFromCamera[3]) + glm::dvec3(place.x, -1.0, -place.y));
            for (int c = 0; c < 3; ++c) {
                const double own = picture.pixel(std::size_t(y) * std::size_t(picture.width) + std::size_t(x))[c];
                wrong += (own - right[c]) * (own - right[c]);
                whole += right[c] * right[c];
                found += own;
                wanted += right[c];
            }
        }
    }
    return {std::sqrt(wrong / whole), found / wanted};
}

class Diffusion : public test::ShadowTest {
protected:
    static Picture pictureOf(engine::Renderer& renderer, const frame::FrameSettings& settings) {
        return engine::toPicture(renderer.render(Technique::Deferred, settings));
    }
    Picture pictureOf(const scenes::Scene& scene, const frame::FrameSettings& settings,
                      shader::SourceTree shaders = shader::SourceTree()) {
        engine::Renderer renderer(context(), scene, std::move(shaders));
        return pictureOf(renderer, settings);
    }

    /// Of the step, with another mapping of the square's texture.
    TruthError stepError(int side, const std::function<void(scenes::Scene&)>& change = {},
                         shader::SourceTree shaders = shader::SourceTree()) {
        scenes::Scene scene = scenes::loadScene("diffusion_truth");
        if (change) change(scene);
        scene.cameras = {above({builtin::kTruthEdgeX, 0.0, 0.0}, 2.0 / 1024.0)};
        frame::FrameSettings settings;
        settings.sizePixels = {896, 8};
        settings.diffusion.sideTexels = side;
        return errorOf(pictureOf(scene, settings, std::move(shaders)), scene.cameras[0], [](const glm::dvec3& placeWS) {
            return builtin::diffusedStep(placeWS.x - builtin::kTruthEdgeX);
        });
    }
    TruthError dotError(int side, shader::SourceTree shaders = shader::SourceTree()) {
        scenes::Scene scene = scenes::loadScene("diffusion_truth");
        scene.cameras = {above(builtin::kTruthDotWS, 0.25)};
        frame::FrameSettings settings;
        settings.sizePixels = {128, 128};
        settings.diffusion.sideTexels = side;
        return errorOf(pictureOf(scene, settings, std::move(shaders)), scene.cameras[0], [](const glm::dvec3& placeWS) {
            return builtin::diffusedDot(glm::distance(placeWS, builtin::kTruthDotWS));
        });
    }
};

// ---- On a plane ----------------------------------------------------------------------------------------------------

/// Stretches the first mesh's texture coordinates: u by `along` over x, v by 1 over z, askew by `shear`.
void mapTexture(scenes::Scene& scene, const glm::dmat2& fromXZ) {
    scenes::Mesh& mesh = scene.meshes[0];
    for (std::size_t i = 0; i < mesh.positionsOS.size(); ++i) {
        const glm::dvec2 place(double(mesh.positionsOS[i].x) - builtin::kTruthEdgeX, double(mesh.positionsOS[i].z));
        mesh.texCoords[0][i] = glm::vec2(fromXZ * place + 0.5);
    }
}

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

TEST_F(Diffusion, aStepAndADotSpreadAsTheClosedFormsSay) {
    expectConvergence(
        std::array{256, 512}, [&](int side) { return stepError(side); }, [&](int side) { return dotError(side); });
}

using DiffusionSlow = Diffusion;

TEST_F(DiffusionSlow, aStepAndADotSpreadAsTheClosedFormsSay) {
    expectConvergence(
        std::array{512, 1024, 2048}, [&](int side) { return stepError(side); },
        [&](int side) { return dotError(side); });
    const double c = 0.6 * std::cos(0.3), s = 0.6 * std::sin(0.3);
    const double turned = stepError(2048, [&](scenes::Scene& scene) { mapTexture(scene, {{c, s}, {-s, c}}); }).l2;
    fmt::print("2048 texels, turned: {:.2e}\n", turned);
    EXPECT_LE(turned, 0.01);
}

// Widths in texels: after a narrow Gaussian a wide one, neighbours, and those between which taps grow apart.
TEST_F(Diffusion, anyTwoWidthsSpreadAStepAsTheClosedFormSays) {
    for (const auto& [narrow, wide] : {std::pair(0.71, 17.9), {0.3, 30.0}, {1.5, 4.5}, {2.6, 5.0}, {5.0, 9.0}}) {
        scenes::Scene scene = scenes::loadScene("diffusion_truth");
        scene.cameras = {above({builtin::kTruthEdgeX, 0.0, 0.0}, 2.0 / 1024.0)};
        constexpr double kNarrowShare = 0.05;
        const auto metres = [](double texels) { return texels / 256.0; };
        for (scenes::Material& material : scene.materials) {
            const auto variance = [&](double texels) {
                return float(std::pow(1e3 * double(material.subsurface.scaleMetres) * metres(texels), 2));
            };
            material.subsurface.profile = {{variance(narrow), glm::vec3(float(kNarrowShare))},
                                           {variance(wide), glm::vec3(float(1.0 - kNarrowShare))}};
        }
        frame::FrameSettings settings;
        settings.sizePixels = {896, 8};
        settings.diffusion.sideTexels = 256;
        const auto truth = [&, ofNarrow = metres(narrow), ofWide = metres(wide)](const glm::dvec3& placeWS) {
            const auto step = [&](double sigma) {
                return 0.5 * std::erfc(-(placeWS.x - builtin::kTruthEdgeX) / (std::numbers::sqrt2 * sigma));
            };
            return glm::dvec3(kNarrowShare * step(ofNarrow) + (1.0 - kNarrowShare) * step(ofWide));
        };
        const double error = errorOf(pictureOf(scene, settings), scene.cameras[0], truth).l2;
        fmt::print("{} and {} texels: {:.2e}\n", narrow, wide, error);
        EXPECT_LE(error, 0.01) << narrow << " and " << wide;
    }
}

TEST_F(Diffusion, fewerGaussiansAndHalfTheResolutionAreNearTheClosedForms) {
    scenes::Scene scene = scenes::loadScene("diffusion_truth");
    scene.cameras = {above({builtin::kTruthEdgeX, 0.0, 0.0}, 2.0 / 1024.0)};
    engine::Renderer renderer(context(), scene);
    const auto error = [&](int gaussians, bool half, int side = 256) {
        frame::FrameSettings settings;
        settings.sizePixels = {896, 8};
        settings.diffusion = {side, gaussians, half};
        return errorOf(
                   pictureOf(renderer, settings), scene.cameras[0],
                   [](const glm::dvec3& placeWS) { return builtin::diffusedStep(placeWS.x - builtin::kTruthEdgeX); })
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

TEST_F(Diffusion, stretchedAndSlantedTexturesChangeNothing) {
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

/// A sphere of six charts, each a side of a cube blown up; they lie apart in the texture.
scenes::Mesh sixCharts(double radiusMetres, int steps) {
    scenes::Mesh mesh;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const double sign = side % 2 == 0 ? 1.0 : -1.0;
        const auto first = std::uint32_t(mesh.positionsOS.size());
        for (int j = 0; j <= steps; ++j) {
            for (int i = 0; i <= steps; ++i) {
                const double a = std::tan((2.0 * i / steps - 1.0) * std::numbers::pi / 4.0);
                const double b = std::tan((2.0 * j / steps - 1.0) * std::numbers::pi / 4.0);
                glm::dvec3 place;
                place[axis] = sign;
                place[(axis + 1) % 3] = sign * a;
                place[(axis + 2) % 3] = b;
                // The same to the last bit from both sides of an edge.
                const glm::dvec3 point = radiusMetres * place / std::sqrt(1.0 + (a * a + b * b));
                mesh.positionsOS.emplace_back(glm::vec3(point * 1048576.0 + 0.0) / 1048576.0f);
                mesh.normalsOS.emplace_back(glm::normalize(point));
                const glm::dvec2 corner(double(side % 3) / 3.0, double(side / 3) / 2.0);
                mesh.texCoords[0].emplace_back(corner + glm::dvec2(0.03 + 0.27 * i / steps, 0.04 + 0.4 * j / steps));
            }
        }
        for (int j = 0; j < steps; ++j) {
            for (int i = 0; i < steps; ++i) {
                const std::uint32_t a = first + std::uint32_t(j * (steps + 1) + i), b = a + 1;
                const std::uint32_t c = a + std::uint32_t(steps + 1), d = c + 1;
                mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
            }
        }
    }
    // Vertices of edges are computed on two sides: one place each.
    for (std::size_t i = 0; i < mesh.positionsOS.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (glm::distance(mesh.positionsOS[i], mesh.positionsOS[j]) < 1e-4f * float(radiusMetres))
                mesh.positionsOS[i] = mesh.positionsOS[j];
    return mesh;
}

/// The sphere under one sun, seen from +z.
scenes::Scene sphereScene(double radiusMetres, int steps) {
    scenes::Scene scene = test::ballUnderSun();
    scene.meshes = {sixCharts(radiusMetres, steps)};
    scene.nodes.resize(1);
    scene.nodes[0].parentFromNode = glm::dmat4(1.0);
    scene.nodes[0].instances = {{0, 0}};
    scenes::Material skin;
    skin.model = scenes::MaterialModel::Lambert;
    skin.baseColor = glm::vec4(1.0f);
    skin.subsurface.method = SubsurfaceMethod::TextureSpaceDiffusion;
    scene.materials = {skin};
    scenes::Camera& camera = scene.cameras[0];
    camera.worldFromCamera = scenes::worldFromLookAt(glm::dvec3(0.9, 0.7, 1.0) * (4.0 * radiusMetres), glm::dvec3(0.0));
    camera.projection = scenes::Projection::Orthographic;
    camera.halfHeightMetres = 1.05 * radiusMetres;
    camera.nearMetres = 0.01 * radiusMetres;
    camera.farMetres = 20.0 * radiusMetres;
    return scene;
}

TEST_F(Diffusion, lightThatIsTheSameEverywhereStaysSoOverSeams) {
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

TEST_F(Diffusion, seamsAreNoWorseThanWhatLiesBetweenThem) {
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

TEST_F(DiffusionSlow, spreadSkinIsNearerTheReferenceThanTheOtherMethods) {
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

class DiffusionFaults : public Diffusion {
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
        {"one Gaussian's weight", "passes/diffusion_blur.frag", "sum = vec4(constants.weight.rgb * result, 1.0);",
         "sum = vec4(constants.weight.rgb * result * (constants.blur.z == 1.0 ? 0.8 : 1.0), 1.0);",
         &DiffusionFaults::step},
        {"millimetres taken for metres", "passes/diffusion_blur.frag", "float variance = constants.blur.x;",
         "float variance = constants.blur.x * 1e6;", &DiffusionFaults::step},
        {"stretch ignored", "passes/diffusion_blur.frag", "constants.blur.y == 0.0 ? own.x : own.y", "own.y",
         &DiffusionFaults::stepOfFewerTexelsAlongX},
        {"dilation off", "passes/diffusion_fill.frag", "if (chart == 0.0) return;", "if (chart <= 0.0) return;",
         &DiffusionFaults::evenLight},
        {"the albedo taken twice", "lib/raster/diffused.glsl", "float power = 1.0 - material.dielectric.z;",
         "float power = 1.0;", &DiffusionFaults::evenLight},
        {"back faces lit", "passes/diffusion_light.frag", "    entering = vec4(light, 1.0);",
         "    surface.normalLS = -surface.normalLS;\n"
         "    light += shadeSurface(surface, viewpoint, gl_FragCoord.xy);\n"
         "    entering = vec4(light, 1.0);",
         &DiffusionFaults::night},
        {"channels of the profile swapped", "passes/diffusion_blur.frag", "constants.weight.rgb * result",
         "constants.weight.bgr * result", &DiffusionFaults::step},
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

// ---- In frames -----------------------------------------------------------------------------------------------------

TEST_F(Diffusion, everyTechniqueGivesTheSamePictureToTheLastBit) {
    scenes::Scene head = scenes::loadScene("head");
    head.materials[0].subsurface.method = SubsurfaceMethod::TextureSpaceDiffusion;
    scenes::Scene gold = head;
    gold.materials[0].model = scenes::MaterialModel::MetallicRoughness;
    gold.materials[0].metallic = 0.4f;
    gold.materials[0].clearcoat = 0.5f;
    gold.materials[0].sheenColor = glm::vec3(0.3f, 0.2f, 0.1f);
    scenes::Scene glass = head;
    glass.materials[0].alphaMode = scenes::AlphaMode::Blend;
    glass.materials[0].baseColor.a = 0.6f;
    const std::tuple<const scenes::Scene*, frame::ShadowFilter, frame::TextureFilter, int> cases[] = {
        {&head, frame::ShadowFilter::Traced, frame::TextureFilter::Exact, 1},
        {&gold, frame::ShadowFilter::Pcf, frame::TextureFilter::Hardware, 1},
        {&glass, frame::ShadowFilter::Traced, frame::TextureFilter::Hardware, 4},
    };
    for (const auto& [scene, shadows, texture, samples] : cases) {
        engine::Renderer renderer(context(), *scene);
        frame::FrameSettings settings;
        settings.sizePixels = {96, 54};
        settings.diffusion.sideTexels = 64;
        settings.shadowFilter = shadows;
        settings.filter = texture;
        settings.samples = samples;
        expectParity(renderer, settings);
    }
}

TEST_F(Diffusion, leavingOutWhatTheSceneDoesNotNeedChangesNoBit) {
    scenes::Scene ball = sphereScene(0.03, 12);
    for (scenes::Light& light : ball.lights) light.castsShadow = true;
    frame::FrameSettings settings;
    settings.sizePixels = {160, 90};
    settings.diffusion.sideTexels = 128;
    engine::Renderer renderer(context(), ball);
    const std::vector<float> pruned = renderer.render(Technique::Deferred, settings).radiance;
    settings.prune = false;
    EXPECT_EQ(renderer.render(Technique::Deferred, settings).radiance, pruned);
}

TEST_F(DiffusionSlow, whatSpreadingCosts) {
    scenes::Scene scene = scenes::loadScene("head_skin");
    engine::Renderer renderer(context(), scene);
    renderer.backend().setProfiling(true);
    frame::FrameSettings settings;
    // The second frame lights all that it sees anew, the third what a camera nearer by sees besides, the last nothing.
    double lit = 0.0;
    for (int frame = 0; frame < 4; ++frame) {
        if (frame == 1) scene.lights[0].intensity *= 1.1f;
        if (frame == 2) settings.camera = 1;
        renderer.render(Technique::Deferred, settings);
        double spreading = 0.0, all = 0.0;
        for (const gpu::PassTiming& timing : renderer.backend().passTimings()) {
            const double ms = timing.gpuMs.value_or(timing.cpuMs);
            if (timing.name.starts_with("diffusion")) {
                fmt::print("{}: {:.1f} ms\n", timing.name, ms);
                spreading += ms;
            }
            all += ms;
        }
        fmt::print("frame {}: spreading {:.1f} of {:.1f} ms\n", frame, spreading, all);
        if (frame == 1) lit = spreading;
        if (frame == 2) {
            EXPECT_LE(spreading, 0.1 * lit);
        }
        if (frame == 3) {
            EXPECT_EQ(spreading, 0.0);
        }
    }
}

/// Names of the passes of the latest frame that spread light.
std::vector<std::string> passesThatSpread(engine::Renderer& renderer) {
    std::vector<std::string> names;
    for (const gpu::PassTiming& timing : renderer.backend().passTimings())
        if (timing.name.starts_with("diffusion")) names.push_back(timing.name);
    return names;
}

TEST_F(Diffusion, spreadLightIsKeptWhileOnlyTheCameraMoves) {
    for (const frame::ShadowFilter filter : {frame::ShadowFilter::Traced, frame::ShadowFilter::Hard}) {
        scenes::Scene ball = sphereScene(0.03, 12);
        for (scenes::Light& light : ball.lights) light.castsShadow = true;
        frame::FrameSettings settings;
        settings.sizePixels = {160, 90};
        settings.diffusion.sideTexels = 128;
        settings.shadowFilter = filter;
        engine::Renderer renderer(context(), ball);
        renderer.render(Technique::Deferred, settings);
        EXPECT_FALSE(passesThatSpread(renderer).empty());
        int step = 0;
        const auto moved = [&](auto change, bool keeps) {
            change();
            const std::vector<float> seen = renderer.render(Technique::Deferred, settings).radiance;
            EXPECT_EQ(passesThatSpread(renderer).empty(), keeps);
            const std::vector<float> fresh =
                engine::Renderer(context(), ball).render(Technique::Deferred, settings).radiance;
            double most = 0.0;
            for (std::size_t i = 0; i < seen.size(); ++i)
                most = std::max(most, std::abs(double(seen[i]) - double(fresh[i])));
            EXPECT_EQ(most, 0.0) << infoOf(filter).name << ", " << ++step;
        };
        moved([&] { settings.eyeOffsetWS = {0.01, 0.0, 0.002}; }, true);
        moved([&] { ball.lights[0].intensity *= 2.0f; }, false);
        moved([&] { ball.lights[0].directionWS = glm::dvec3(0.0, -1.0, 0.0); }, false);
        moved([&] { settings.diffusion.gaussians = 2; }, false);
        moved([&] { settings.eyeOffsetWS = {0.0, 0.01, 0.0}; }, true);
        ball.materials[0].subsurface.preScatterShare = 1.0f;
        renderer.materialsChanged();
        moved([] {}, false);
    }
}

TEST_F(Diffusion, lightingOnlyWhatIsSeenChangesNoBit) {
    scenes::Scene ball = sphereScene(0.03, 24);
    ball.cameras[0].projection = scenes::Projection::Perspective;
    ball.cameras[0].fovYRadians = 0.7;
    ball.cameras[0].nearMetres = 1e-3;
    for (const bool half : {false, true}) {
        for (const std::optional<int> gaussians : {std::optional<int>(), std::optional<int>(1)}) {
            frame::FrameSettings settings;
            settings.sizePixels = {200, 150};
            settings.diffusion.sideTexels = 512;
            settings.diffusion.half = half;
            if (gaussians) settings.diffusion.gaussians = *gaussians;
            scenes::Scene seen = ball;
            engine::Renderer renderer(context(), seen), all(context(), ball);
            settings.prune = true;
            for (int step = 0; step < 7; ++step) {
                // Around the ball, then so near that most of it lies outside of the picture.
                const double angle = 0.9 * step, metres = step < 5 ? 0.12 : 0.045;
                const glm::dvec3 eyeWS(metres * std::sin(angle), 0.02 - 0.01 * step, metres * std::cos(angle));
                ball.cameras[0].worldFromCamera = scenes::worldFromLookAt(eyeWS, glm::dvec3(0.0));
                seen.cameras[0] = ball.cameras[0];
                settings.prune = true;
                const std::vector<float> pruned = renderer.render(Technique::Deferred, settings).radiance;
                settings.prune = false;
                EXPECT_EQ(all.render(Technique::Deferred, settings).radiance, pruned)
                    << "half " << half << ", step " << step;
            }
        }
    }
}

TEST_F(Diffusion, mapsHideLightFromTexelsAsRaysDo) {
    scenes::Scene scene = scenes::loadScene("diffusion_truth");
    scene.cameras = {above({builtin::kTruthEdgeX, 0.0, 0.0}, 2.0 / 1024.0)};
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.sizePixels = {896, 8};
    settings.diffusion.sideTexels = 256;
    settings.shadowMaps.resolutionTexels = 2048;
    const auto truth = [](const glm::dvec3& placeWS) {
        return builtin::diffusedStep(placeWS.x - builtin::kTruthEdgeX);
    };
    for (const frame::ShadowFilter filter : test::mapFilters()) {
        settings.shadowFilter = filter;
        const double error = errorOf(pictureOf(renderer, settings), scene.cameras[0], truth).l2;
        fmt::print("{}: {:.2e}\n", infoOf(filter).name, error);
        EXPECT_LE(error, 0.03) << infoOf(filter).name;
    }
}

// The lit object itself has no holes.
TEST_F(Diffusion, holesOfCastersLetLightThrough) {
    for (const frame::ShadowFilter filter : {frame::ShadowFilter::Traced, frame::ShadowFilter::Hard}) {
        scenes::Scene ball = sphereScene(0.03, 12);
        for (scenes::Light& light : ball.lights) light.castsShadow = true;
        scenes::Mesh plate = test::quad();
        for (glm::vec3& position : plate.positionsOS) position = 0.05f * position;
        ball.meshes.push_back(plate);
        scenes::Material opaque;
        opaque.doubleSided = true;
        opaque.baseColor.a = 0.25f;
        ball.materials.push_back(opaque);
        scenes::Node& node = ball.nodes.emplace_back();
        node.parentFromNode[3] = glm::dvec4(0.08 * glm::normalize(-ball.lights[0].directionWS), 1.0);
        node.instances = {{1, 1}};
        frame::FrameSettings settings;
        settings.sizePixels = {160, 90};
        settings.diffusion.sideTexels = 128;
        settings.shadowFilter = filter;
        engine::Renderer renderer(context(), ball);
        const std::vector<float> hidden = renderer.render(Technique::Deferred, settings).radiance;
        // All of it is a hole now, which is the first one of the scene.
        ball.materials[1].alphaMode = scenes::AlphaMode::Mask;
        ball.materials[1].alphaCutoff = 0.5f;
        renderer.materialsChanged();
        const std::vector<float> lit = renderer.render(Technique::Deferred, settings).radiance;
        EXPECT_NE(lit, hidden) << infoOf(filter).name;
        EXPECT_EQ(lit, engine::Renderer(context(), ball).render(Technique::Deferred, settings).radiance);
        ball.nodes.pop_back();
        const std::vector<float> without =
            engine::Renderer(context(), ball).render(Technique::Deferred, settings).radiance;
        const auto sumOf = [](const std::vector<float>& radiance) {
            return std::accumulate(radiance.begin(), radiance.end(), 0.0);
        };
        EXPECT_NEAR(sumOf(lit), sumOf(without), 0.01 * sumOf(without)) << infoOf(filter).name;
        EXPECT_LT(sumOf(hidden), 0.9 * sumOf(lit)) << infoOf(filter).name;
    }
}

TEST_F(Diffusion, objectsThatCannotBeUnwrappedAreRefusedByName) {
    scenes::Scene scene = test::ballUnderSun();
    scene.materials[std::size_t(scene.nodes[0].instances[0].material)].subsurface.method =
        SubsurfaceMethod::TextureSpaceDiffusion;
    scenes::Mesh& mesh = scene.meshes[std::size_t(scene.nodes[0].instances[0].mesh)];
    mesh.name = "ball";
    for (glm::vec2& texCoord : mesh.texCoords[0]) texCoord.x = std::abs(texCoord.x - 0.5f);
    engine::Renderer renderer(context(), scene);
    try {
        renderer.draw(Technique::Deferred, {});
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), HasSubstr("mesh 'ball'"));
        EXPECT_THAT(error.what(), HasSubstr("unwrap it so that none overlap"));
    }
}

} // namespace
} // namespace tessera
