// Shadow rays of smooth-shaded triangles start above them (docs/shadows.md, "Smooth-shaded meshes").
#include "tests/image/ShadowTest.h"
#include "validation/reference/CameraRays.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::ShadowFilter, frame::ShadowTerminator;

using namespace test;

class ShadowTerminators : public ShadowTest {
protected:
    /// A ball of 16 slices on a floor.
    static scenes::Scene coarseBall() {
        scenes::Scene scene = ballUnderSun();
        scene.meshes[0] = {};
        scenes::builtin::appendSphere(scene.meshes[0], glm::dvec3(0.0, 0.6, 0.0), 0.6, 16, 8);
        scene.lights[0].directionWS = glm::normalize(glm::dvec3(-1.0, -0.5, -0.7));
        return scene;
    }
    static frame::FrameSettings settingsOf(ShadowFilter filter, ShadowTerminator terminator) {
        frame::FrameSettings settings = withShadows(ofSize(96, 54), filter);
        settings.shadowTerminator = terminator;
        return settings;
    }
    static std::vector<float> picture(engine::Renderer& renderer, const frame::FrameSettings& settings) {
        return renderer.render(Technique::Deferred, settings).radiance;
    }
    /// Expects points of a square of so many rows, whose normals lean outwards by `lean` radians, to be lifted as the
    /// closed form requires. Viewed by parallel rays at an angle to the vertical, with a floor twice `eyeMetres` below.
    void expectLifted(double lean, int rows, int samples, double eyeMetres, double eyeRadians);
    /// Expects that softened terminators change no bit of the image, and shadows do.
    void expectExactToTheLastBit(const scenes::Scene& scene) {
        engine::Renderer renderer(context(), scene);
        for (const ShadowFilter filter : {ShadowFilter::Traced, ShadowFilter::Pcf})
            for (const auto textures : {frame::TextureFilter::Hardware, frame::TextureFilter::Exact}) {
                frame::FrameSettings exact = settingsOf(filter, ShadowTerminator::Exact),
                                     softened = settingsOf(filter, ShadowTerminator::Softened), none = exact;
                exact.filter = softened.filter = none.filter = textures;
                none.shadows = {scenes::ShadowRequest::Kind::None};
                const std::vector<float> seen = picture(renderer, exact);
                EXPECT_EQ(picture(renderer, softened), seen) << infoOf(filter).name;
                EXPECT_NE(picture(renderer, none), seen) << "no shadow";
            }
    }
};

// A ball shadows none of its points whose normal faces the light.
TEST_F(ShadowTerminators, ofACoarseBallAreThoseOfTheRoundBallThatItApproximates) {
    scenes::Scene scene = coarseBall();
    scene.nodes[0].instances = {{0, 0}};
    struct Way {
        ShadowFilter filter;
        int texels = 1024;
    };
    for (const auto& [filter, texels] :
         {Way{ShadowFilter::Traced}, Way{ShadowFilter::Hard}, Way{ShadowFilter::Hard, 128},
          Way{ShadowFilter::Hard, 4096}, Way{ShadowFilter::Pcf}, Way{ShadowFilter::Pcf, 128},
          Way{ShadowFilter::Pcss}}) {
        std::size_t torn[2] = {0, 0}, lit = 0;
        for (const double turn : {0.3, 2.0, 4.0}) {
            scene.lights[0].directionWS = glm::normalize(glm::dvec3(std::cos(turn), -0.4, std::sin(turn)));
            scene.lights[0].angularRadiusRadians = filter == ShadowFilter::Pcss ? 0.02f : 0.0f;
            engine::Renderer renderer(context(), scene);
            frame::FrameSettings settings = settingsOf(filter, ShadowTerminator::Exact);
            settings.shadowMaps.resolutionTexels = texels;
            settings.shadows = {scenes::ShadowRequest::Kind::None};
            const std::vector<float> open = picture(renderer, settings);
            const float brightest = *std::ranges::max_element(open);
            settings.shadows = kAllLightsCast;
            for (const ShadowTerminator terminator : {ShadowTerminator::Exact, ShadowTerminator::Softened}) {
                settings.shadowTerminator = terminator;
                const std::vector<float> seen = picture(renderer, settings);
                for (std::size_t i = 0; i < seen.size(); i += 4)
                    torn[int(terminator)] += std::abs(seen[i] - open[i]) > 0.01f * brightest;
            }
            for (std::size_t i = 0; i < open.size(); i += 4) lit += open[i] > 0.01f * brightest;
        }
        fmt::print("{}, {} texels: of {} lit pixels {} torn, softened {}\n", infoOf(filter).name, texels, lit, torn[0],
                   torn[1]);
        EXPECT_GT(torn[0], lit / 50) << infoOf(filter).name << ", " << texels << " texels";
        EXPECT_EQ(torn[1], 0u) << infoOf(filter).name << ", " << texels << " texels";
    }
}

TEST_F(ShadowTerminators, ofRealFacetsAreExactToTheLastBit) {
    scenes::Scene scene = coarseBall();
    scenes::Mesh facets;
    const scenes::Mesh& ball = scene.meshes[0];
    for (std::size_t first = 0; first < ball.indices.size(); first += 3) {
        const auto corner = [&](std::size_t i) { return ball.positionsOS[ball.indices[first + i]]; };
        const glm::vec3 normal = glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
        for (std::size_t i = 0; i < 3; ++i) {
            facets.indices.push_back(std::uint32_t(facets.positionsOS.size()));
            facets.positionsOS.push_back(corner(i));
            facets.normalsOS.push_back(normal);
            facets.texCoords[0].emplace_back(0.0f);
        }
    }
    scene.meshes[0] = facets;
    expectExactToTheLastBit(scene);
}

// The corners of a box with averaged normals are 54.7 degrees off its sides, those of a beam without ends 45. Points in
// the middle of a side would be lifted past objects on it: here a plate 0.1 m above the upper one.
TEST_F(ShadowTerminators, ofBoxesWithAveragedNormalsAreExactToTheLastBit) {
    scenes::Scene scene = coarseBall();
    scenes::builtin::appendFloor(scene.meshes.emplace_back(), {0.0, 1.1, 0.0}, {0.4, 0.3}, {1, 1});
    scene.nodes[0].instances.push_back({2, 0});
    for (const bool isBeam : {false, true}) {
        scenes::Mesh& box = scene.meshes[0] = {};
        const glm::vec3 middle(0.0f, 0.6f, 0.0f), half(0.5f, 0.4f, 0.3f);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 side((corner & 1) != 0 ? 1.0f : -1.0f, (corner & 2) != 0 ? 1.0f : -1.0f,
                                 (corner & 4) != 0 ? 1.0f : -1.0f);
            box.positionsOS.push_back(middle + half * side);
            box.normalsOS.push_back(glm::normalize(isBeam ? glm::vec3(0.0f, side.y, side.z) : side));
            box.texCoords[0].emplace_back(0.0f);
        }
        box.indices = {0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5, 0, 1, 4, 1, 5, 4,
                       2, 6, 3, 3, 6, 7, 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6};
        expectExactToTheLastBit(scene);
    }
}

// A square of 2 m whose normals lean by a to both sides of the middle, as on a roll of paper: at x the planes through
// its left and right corners lie (1 + x) sin a and (1 - x) sin a above it. With corner weights (1 - x) / 2 and (1 + x)
// / 2 the blend is (1 - x^2) sin a, over the length of the blended normal. That shortens the shadow of a plate's edge 1
// m above. Normals that lean towards the middle, as in a gutter, lift points as high.
TEST_F(ShadowTerminators, pointsAreLiftedToTheBlendOfTheirCornersTangentPlanes) {
    expectLifted(0.15, 1, 1, 5.0, 0.0);
    expectLifted(-0.15, 1, 1, 5.0, 0.0);
}
// Fragments that cover a part of their pixel are lifted where they are shaded. The origin of lighting space is far
// aside here, so that from there to the pixel's centre the planes through corners rise by centimetres.
TEST_F(ShadowTerminators, pointsOfPartsOfPixelsAreLiftedToThatBlendToo) {
    expectLifted(0.15, 50, 4, 200.0, 0.7);
}
void ShadowTerminators::expectLifted(double lean, int rows, int samples, double eyeMetres, double eyeRadians) {
    constexpr double kPlateMetres = 1.0, kPlateEdge = -1.6, kSlope = 0.6; // of the sun
    scenes::Scene scene = coarseBall();
    scenes::Mesh& square = scene.meshes[0] = {};
    for (int row = 0; row <= rows; ++row) {
        for (const float x : {-1.0f, 1.0f}) {
            square.positionsOS.emplace_back(x, 0.0f, 2.0f * float(row) / float(rows) - 1.0f);
            square.normalsOS.emplace_back(x * std::sin(lean), std::cos(lean), 0.0);
            square.texCoords[0].emplace_back(x, float(row));
        }
        const auto first = std::uint32_t(2 * row);
        if (row < rows)
            for (const std::uint32_t corner : {0u, 2u, 1u, 1u, 2u, 3u}) square.indices.push_back(first + corner);
    }
    scene.meshes[1] = {};
    scenes::builtin::appendFloor(scene.meshes[1], {0.0, kPlateMetres, kPlateEdge - 2.0}, {8.0, 4.0}, {1, 1});
    const glm::dvec3 toEye(std::sin(eyeRadians), std::cos(eyeRadians), 0.0);
    // Below everything, so that the origin of lighting space, in the middle of the visible geometry, lies far from the
    // square.
    scenes::builtin::appendFloor(scene.meshes[1], -2.0 * eyeMetres * toEye, {8.0, 8.0}, {1, 1});
    scene.lights[0].directionWS = glm::normalize(glm::dvec3(0.0, -kSlope, 1.0));
    scenes::Camera& camera = scene.cameras[0];
    makeOrthographic(camera, 1.0);
    camera.nearMetres = 0.1;
    camera.farMetres = 4.0 * eyeMetres;
    camera.worldFromCamera = {
        {toEye.y, -toEye.x, 0, 0}, {0, 0, -1, 0}, glm::dvec4(toEye, 0.0), glm::dvec4(eyeMetres * toEye, 1.0)};
    engine::Renderer renderer(context(), scene);
    for (const ShadowTerminator terminator : {ShadowTerminator::Exact, ShadowTerminator::Softened}) {
        frame::FrameSettings settings = settingsOf(ShadowFilter::Traced, terminator);
        settings.sizePixels = {128, 128};
        settings.samples = samples;
        settings.view = frame::DebugView::Shadow;
        const std::vector<float> seen = renderer.render(Technique::Forward, settings).radiance;
        const reference::CameraRays rays(camera, settings.sizePixels);
        int dark = 0, wrong = 0, straightIsWrong = 0;
        for (int y = 0; y < 128; ++y)
            for (int x = 0; x < 128; ++x) {
                const glm::dvec3 originWS = rays.eyeWS() + rays.through(x, y).originRWS;
                const glm::dvec3 placeWS = originWS - originWS.y / toEye.y * toEye;
                const double across = placeWS.x;
                if (std::abs(across) > (samples > 1 ? 0.97 : 1.0)) continue; // uncovered pixels, and the rim
                const double blend = std::hypot(std::cos(lean), across * std::sin(lean));
                const bool isLifted = terminator == ShadowTerminator::Softened;
                const double lift = isLifted ? (1.0 - across * across) * std::abs(std::sin(lean)) / blend : 0.0;
                const double behindEdge = kPlateEdge + (kPlateMetres - lift) / kSlope - placeWS.z;
                const double behindStraight = kPlateEdge + kPlateMetres / kSlope - placeWS.z;
                // Heights are stored in steps of a twelfth at most; rounding loses up to half a step.
                double tolerance = 1e-3 + 0.045 * lift / kSlope;
                // A fragment is shaded up to 3/8 of a pixel from its pixel's centre.
                if (samples > 1)
                    tolerance += 0.375 * (2.0 / 128.0) * (1.0 + 2.0 * std::abs(std::sin(lean)) / kSlope / toEye.y);
                const float shown = seen[4 * std::size_t(128 * y + x)];
                const bool isDark = shown == 0.0f;
                dark += isDark;
                wrong += std::abs(behindEdge) > tolerance && shown != (behindEdge > 0.0 ? 0.0f : 1.0f);
                straightIsWrong += isDark != (behindStraight > 0.0);
            }
        fmt::print("{}: {} pixels dark, {} wrong, {} by the triangles themselves\n", int(terminator), dark, wrong,
                   straightIsWrong);
        EXPECT_EQ(wrong, 0);
        EXPECT_GT(dark, 1000);
        if (terminator == ShadowTerminator::Softened) {
            EXPECT_GT(straightIsWrong, 500);
        }
    }
}

// Triangles smaller than a pixel, whose normals would be extrapolated far outside of them to the pixel's centre.
TEST_F(ShadowTerminators, ofAFineBallHaveNoDotsWhereAPixelHasSeveralSamples) {
    scenes::Scene scene = coarseBall();
    scene.nodes[0].instances = {{0, 0}};
    scene.meshes[0] = {};
    scenes::builtin::appendSphere(scene.meshes[0], glm::dvec3(0.0, 0.6, 0.0), 0.6, 300, 150);
    engine::Renderer renderer(context(), scene);
    for (const ShadowTerminator terminator : {ShadowTerminator::Exact, ShadowTerminator::Softened}) {
        frame::FrameSettings settings = settingsOf(ShadowFilter::Traced, terminator);
        settings.samples = 4;
        const std::vector<float> seen = renderer.render(Technique::Forward, settings).radiance;
        settings.shadows = {scenes::ShadowRequest::Kind::None};
        const std::vector<float> open = renderer.render(Technique::Forward, settings).radiance;
        const float brightest = *std::ranges::max_element(open);
        std::size_t dots = 0, lit = 0;
        for (std::size_t i = 0; i < seen.size(); i += 4) {
            dots += open[i] - seen[i] > 0.002f * brightest;
            lit += open[i] > 0.0f;
        }
        fmt::print("{}: {} dots among {} pixels\n", int(terminator), dots, lit);
        EXPECT_GT(lit, 100u);
        EXPECT_EQ(dots, 0u);
    }
}

TEST_F(ShadowTerminators, areThoseOfTheReferenceAndOfEveryTechnique) {
    scenes::Scene scene = coarseBall();
    std::size_t turn = 0;
    for (const bool hasSize : {false, true}) {
        if (hasSize) {
            scenes::Light lamp = pointLight({1.2, 1.4, 1.0}, 3.0f);
            lamp.radiusMetres = 0.2f;
            scene.lights = {lamp};
        }
        engine::Renderer renderer(context(), scene);
        frame::FrameSettings settings = settingsOf(ShadowFilter::Traced, ShadowTerminator::Exact);
        const WrongPixels exact = wrongPixels(renderer, settings);
        settings.shadowTerminator = ShadowTerminator::Softened;
        const WrongPixels count = wrongPixels(renderer, settings);
        fmt::print("{} pixels wrong, {} undecided (exact {}), {} changed by shadows of {}\n", count.wrong,
                   count.undecided, exact.undecided, count.hidden, count.covered);
        EXPECT_EQ(count.wrong, 0u);
        // In penumbrae the noise of rays leaves pixels undecided.
        EXPECT_LE(count.undecided, exact.undecided + count.covered / 500);
        EXPECT_GT(count.hidden, count.covered / 25);
        expectParity(renderer, settings, techniquesInTurn(turn++));
        settings.samples = 4;
        expectParity(renderer, settings, techniquesInTurn(turn++, 4));
        settings.samples = 1;
        settings.shadowFilter = ShadowFilter::Pcf;
        expectParity(renderer, settings, techniquesInTurn(turn++));
        expectPruningIsUnseen(renderer, settings);
    }
}

/// Softened terminators with wrapped light.
class WrappedTerminators : public ShadowTerminators {};

// A plate's edge shadows the ball: shadow rays of wrapped light start above the surface already.
TEST_F(WrappedTerminators, aSurfaceThatWrapsLightIsNotLiftedOffItsTriangles) {
    scenes::Scene scene = coarseBall();
    scene.materials[0] = lambert();
    scene.materials[0].subsurface.method = scenes::SubsurfaceMethod::Wrap;
    scene.materials[0].subsurface.bodyRadiusMetres = 0.6f;
    scene.meshes[1] = {};
    scenes::builtin::appendFloor(scene.meshes[1], {-2.0, 1.5, 0.0}, {4.0, 4.0}, {1, 1});
    scene.lights[0].directionWS = glm::normalize(glm::dvec3(0.5, -1.0, -0.6));
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = settingsOf(ShadowFilter::Traced, ShadowTerminator::Softened);
    settings.sizePixels = {192, 108};
    const WrongPixels count = wrongPixels(renderer, settings);
    fmt::print("{}\n", count.text());
    EXPECT_EQ(count.wrong, 0u);
    EXPECT_GT(count.hidden, count.covered / 25);
}

} // namespace
} // namespace tessera
