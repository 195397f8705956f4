// What bodies of glass show of what stands behind them: against closed forms, between techniques, and against the
// reference.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/Median.h"
#include "tests/image/FlatTest.h"
#include "tests/image/GlassTest.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::EnvironmentLight;
using frame::Refraction;
using scenes::Material;
using scenes::Scene;
using namespace test;

constexpr int kBehindPixels = 48;                          ///< side of a picture, which spans 2 m
constexpr double kBehindPixelMetres = 2.0 / kBehindPixels; ///< orthographic
constexpr double kBehindWallMetres = 2.0;                  ///< behind z = 0
constexpr double kGlassTiltRadians = 0.5;                  ///< of the glass, about y: its left edge comes nearer

/// Of the metres to either side of x = 0 that two texels are apart, so that what lies between is a ramp of 0 to 1.
scenes::Image rampImage() {
    const glm::vec4 texels[] = {{0.0f, 0.25f, 1.0f, 1.0f}, {1.0f, 0.75f, 0.0f, 1.0f}};
    scenes::Image image;
    image.name = "ramp";
    image.width = 2;
    image.height = 1;
    image.format = scenes::TexelFormat::Rgba32Float;
    const auto* const bytes = reinterpret_cast<const std::byte*>(texels);
    image.texels.assign(bytes, bytes + sizeof(texels));
    return image;
}

scenes::Image checkerImage() {
    return image8([](int x, int y) { return std::array<int, 4>{30 * x + 20, 30 * y + 20, (x + y) % 2 * 200, 255}; });
}

void placeQuad(scenes::Node& node, double z, double halfMetres, double tiltRadians = 0.0) {
    const double cosine = std::cos(tiltRadians), sine = std::sin(tiltRadians);
    glm::dmat4& placed = node.parentFromNode;
    placed = glm::dmat4(1.0);
    placed[0] = glm::dvec4(cosine, 0.0, -sine, 0.0) * halfMetres;
    placed[1] = glm::dvec4(0.0, 1.0, 0.0, 0.0) * halfMetres;
    placed[2] = {sine, 0.0, cosine, 0.0};
    placed[3] = {0.0, 0.0, z, 1.0};
}

/// A wall that shines by itself, and fills the picture.
Scene wallScene(scenes::Image image, double halfMetres) {
    Scene scene = quadScene(unlit());
    scene.images = {std::move(image)};
    scene.materials[0].texture(scenes::TextureSlot::BaseColor) = nearest();
    scene.cameras[0].projection = scenes::Projection::Orthographic;
    scene.cameras[0].halfHeightMetres = 1.0;
    scene.background = {0.125f, 0.375f, 0.625f};
    placeQuad(scene.nodes[0], -kBehindWallMetres, halfMetres);
    return scene;
}

Scene checkedWall() {
    return wallScene(checkerImage(), 1.5);
}

/// Its colours change evenly along x.
Scene rampWall() {
    Scene scene = wallScene(rampImage(), 4.0);
    scenes::Sampler& sampler = scene.materials[0].texture(scenes::TextureSlot::BaseColor).sampler;
    sampler.magnification = sampler.minification = scenes::Filter::Linear;
    return scene;
}

/// The scene with a quad of glass before it, wider than the picture.
Scene coveredByGlass(Scene scene, const Material& glass, double tiltRadians = 0.0, double halfMetres = 4.0) {
    scene.materials.push_back(glass);
    scenes::Node& node = scene.nodes.emplace_back(scene.nodes[0]);
    node.instances[0].material = int(scene.materials.size()) - 1;
    placeQuad(node, 0.0, halfMetres, tiltRadians);
    return scene;
}

/// With a near and a far side along each other: the way that light is moved aside, by Snell's law.
double asideMetres(double thicknessMetres, double ior, double radians) {
    const double inside = std::asin(std::sin(radians) / ior);
    return thicknessMetres * std::sin(radians) * (1.0 - std::cos(radians) / (ior * std::cos(inside)));
}

class GlassBehind : public GlassTest {
protected:
    static frame::FrameSettings seeing(Refraction refraction, int samples = 1) {
        frame::FrameSettings settings = ofSide(kBehindPixels);
        settings.refraction = refraction;
        settings.samples = samples;
        settings.filter = frame::TextureFilter::Exact;
        return settings;
    }
    static glm::dvec3 at(const std::vector<float>& picture, int x, int y) {
        const float* const pixel = &picture[std::size_t(4 * (y * kBehindPixels + x))];
        return {pixel[0], pixel[1], pixel[2]};
    }
    static double metresOf(int pixel) { return (pixel + 0.5) * kBehindPixelMetres - 1.0; }
    /// Of a picture whose colours change evenly along x.
    static glm::dvec3 evenlyAt(const std::vector<float>& picture, double metres, int y) {
        const glm::dvec3 left = at(picture, 0, y), right = at(picture, kBehindPixels - 1, y);
        const double share = (metres - metresOf(0)) / (metresOf(kBehindPixels - 1) - metresOf(0));
        return left + share * (right - left);
    }
    void expectAllTechniquesAlike();
};

/// An index of 1 bends nothing: not a bit differs, of parallel rays and of a lens, of one sample and of several.
TEST_F(GlassBehind, thatBendsNothingShowsExactlyWhatStandsThere) {
    struct Case {
        Refraction refraction;
        scenes::Projection projection;
        int samples;
    };
    using scenes::Projection;
    for (const Case& one :
         {Case{Refraction::OneSide, Projection::Orthographic, 1},
          Case{Refraction::TwoSides, Projection::Perspective, 1}, Case{Refraction::OneSide, Projection::Perspective, 4},
          Case{Refraction::TwoSides, Projection::Orthographic, 4}}) {
        SCOPED_TRACE(fmt::format("{}, {} samples", infoOf(one.refraction).name, one.samples));
        Scene wall = checkedWall();
        wall.cameras[0].projection = one.projection;
        const frame::FrameSettings settings = seeing(one.refraction, one.samples);
        const std::vector<float> plain = drawn(wall, settings, Technique::Forward);
        const std::vector<float> shown =
            drawn(coveredByGlass(wall, bareGlass(1.0), kGlassTiltRadians), settings, Technique::Forward);
        EXPECT_EQ(shown.size(), plain.size());
        // Of several samples each shows the mean of all: their sum may round once more.
        const float leeway = one.samples == 1 ? 0.0f : 1e-6f;
        for (std::size_t i = 0; i < plain.size(); ++i) ASSERT_NEAR(shown[i], plain[i], leeway) << i;
    }
}

/// Seen straight on, whatever its index: what it reflects is lost, and what its body absorbs.
TEST_F(GlassBehind, seenStraightOnShowsWhatItsClosedFormLeaves) {
    Material glass = clearGlass();
    glass.baseColor = {0.9f, 0.7f, 0.5f, 1.0f};
    glass.transmission = 0.75f;
    glass.thicknessMetres = 0.5f;
    glass.attenuationDistanceMetres = 0.25f;
    glass.attenuationColor = {0.5f, 0.8f, 1.0f};
    const std::vector<float> plain = drawn(checkedWall(), seeing(Refraction::OneSide));
    for (const Refraction refraction : {Refraction::OneSide, Refraction::TwoSides})
        for (const float ior : {1.5f, 2.0f}) {
            glass.ior = ior;
            const double contrast = (double(ior) - 1.0) / (double(ior) + 1.0);
            const std::vector<float> shown = drawn(coveredByGlass(checkedWall(), glass), seeing(refraction));
            for (int y = 0; y < kBehindPixels; ++y)
                for (int x = 0; x < kBehindPixels; ++x)
                    for (int c = 0; c < 3; ++c) {
                        const double left = std::pow(double(glass.attenuationColor[c]), 2.0);
                        const double wanted =
                            0.75 * double(glass.baseColor[c]) * left * (1.0 - contrast * contrast) * at(plain, x, y)[c];
                        ASSERT_NEAR(at(shown, x, y)[c], wanted, kGlassRounding * std::max(wanted, 1e-3))
                            << ior << " at " << x << ", " << y;
                    }
        }
}

/// By a whole number of pixels, so that no texel is interpolated. What is moved in from beyond the picture's edge is
/// not known: there the body shows the background.
TEST_F(GlassBehind, withAFarSideMovesThePictureAsideByTheClosedForm) {
    constexpr int kMoved = 3;
    const frame::FrameSettings settings = seeing(Refraction::TwoSides);
    const std::vector<float> plain = drawn(checkedWall(), settings);
    const double cosine = std::cos(kGlassTiltRadians);
    for (const double ior : {1.3, 1.5, 2.4}) {
        Material glass = clearGlass();
        glass.ior = float(ior);
        glass.thicknessMetres =
            float(kMoved * kBehindPixelMetres / asideMetres(1.0, double(glass.ior), kGlassTiltRadians));
        const double straight = std::pow((ior - 1.0) / (ior + 1.0), 2.0);
        const double share = 1.0 - (straight + (1.0 - straight) * std::pow(1.0 - cosine, 5.0));
        const std::vector<float> shown = drawn(coveredByGlass(checkedWall(), glass, kGlassTiltRadians), settings);
        for (int y = 0; y < kBehindPixels; ++y)
            for (int x = 0; x < kBehindPixels; ++x) {
                const glm::dvec3 behind = x < kMoved ? glm::dvec3(0.125, 0.375, 0.625) : at(plain, x - kMoved, y);
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(at(shown, x, y)[c], share * behind[c], 1e-5) << ior << " at " << x << ", " << y;
            }
    }
}

/// Half of twice the thickness is the thickness; where none is left nothing is moved.
TEST_F(GlassBehind, withAFarSideIsAsThickAsItsTextureSays) {
    const frame::FrameSettings settings = seeing(Refraction::TwoSides);
    const auto shownOf = [&](float thickness, std::optional<float> texel) {
        Material glass = bareGlass(1.5);
        glass.thicknessMetres = thickness;
        Scene scene = coveredByGlass(checkedWall(), glass, kGlassTiltRadians);
        if (texel) {
            scene.images.push_back(floatImage({0.7f, *texel, 0.3f, 0.1f}));
            scene.materials.back().texture(scenes::TextureSlot::Thickness).image = int(scene.images.size()) - 1;
        }
        return drawn(scene, settings);
    };
    const auto expectAlike = [](const std::vector<float>& own, const std::vector<float>& wanted) {
        for (std::size_t i = 0; i < own.size(); ++i) ASSERT_NEAR(own[i], wanted[i], 1e-5f) << i;
    };
    const std::vector<float> plain = drawn(checkedWall(), settings), moved = shownOf(0.5f, std::nullopt);
    EXPECT_NE(moved, plain);
    expectAlike(shownOf(1.0f, 0.5f), moved);
    expectAlike(shownOf(0.5f, 0.0f), plain);
}

/// The scene with a body whose mesh is closed before it.
Scene coveredByBody(Scene scene, const Material& glass, scenes::Mesh mesh, double tiltRadians = 0.0) {
    Scene covered = coveredByGlass(std::move(scene), glass, tiltRadians, 1.0);
    covered.nodes.back().instances[0].mesh = int(covered.meshes.size());
    covered.meshes.push_back(std::move(mesh));
    return covered;
}

/// The same of a slab that has a back: where it ends is drawn, and not what the thickness says.
TEST_F(GlassBehind, throughTheBackOfASlabIsMovedAsideByTheClosedForm) {
    constexpr int kMoved = 3;
    const frame::FrameSettings settings = seeing(Refraction::BackFaces);
    const std::vector<float> plain = drawn(checkedWall(), settings);
    for (const auto& [ior, isMirrored] : {std::pair(1.0, false), {1.3, false}, {1.5, false}, {1.5, true}}) {
        const bool bends = ior > 1.0;
        const double thickness = bends ? kMoved * kBehindPixelMetres / asideMetres(1.0, ior, kGlassTiltRadians) : 0.5;
        scenes::Mesh slab;
        scenes::builtin::appendBox(slab, {-4.0, -4.0, -thickness}, {4.0, 4.0, 0.0});
        Scene covered = coveredByBody(checkedWall(), bareGlass(ior), slab, kGlassTiltRadians);
        if (isMirrored) covered.nodes.back().parentFromNode[0] *= -1.0; // left and right are alike
        const std::vector<float> shown = drawn(covered, settings);
        if (!bends) {
            EXPECT_EQ(shown, plain);
            continue;
        }
        for (int y = 0; y < kBehindPixels; ++y)
            for (int x = 0; x < kBehindPixels; ++x) {
                const glm::dvec3 behind = x < kMoved ? glm::dvec3(0.125, 0.375, 0.625) : at(plain, x - kMoved, y);
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(at(shown, x, y)[c], behind[c], 1e-5)
                        << ior << (isMirrored ? ", mirrored" : "") << " at " << x << ", " << y;
            }
    }
}

/// Where a ray along -z that meets a ball around the origin so far from its axis meets a plane behind it, from that
/// axis too. The ray turns by the angle to the normal less that inside, twice.
double behindBallMetres(double radiusMetres, double ior, double asideMetres, double planeMetres) {
    const double outside = std::asin(asideMetres / radiusMetres);
    const double inside = std::asin(asideMetres / (radiusMetres * ior)), turn = 2.0 * (outside - inside);
    const double leavesAt = 2.0 * inside - outside; // by the angle to -z
    return radiusMetres * std::sin(leavesAt) - std::tan(turn) * (planeMetres - radiusMetres * std::cos(leavesAt));
}

/// A ball turns left and right round, as the reference finds through the mesh itself, and the closed form says.
TEST_F(GlassBehind, throughTheBackOfABallIsTurnedRound) {
    constexpr double kIor = 1.5, kRadiusMetres = 0.7;
    scenes::Mesh ball;
    scenes::builtin::appendSphere(ball, {}, kRadiusMetres, 96, 48);
    const Scene scene = coveredByBody(rampWall(), bareGlass(kIor), ball);
    const frame::FrameSettings settings = seeing(Refraction::BackFaces);
    const validation::ReferencePicture truth = validation::referencePicture(
        scene, settings, [] {}, validation::Leeway::None);
    const std::vector<float> plain = drawn(rampWall(), settings), shown = drawn(scene, settings);
    double worst = 0.0;
    int turned = 0;
    for (int y = 0; y < kBehindPixels; ++y)
        for (int x = 0; x < kBehindPixels; ++x) {
            // Where rays meet the wall within the picture.
            const double across = metresOf(x), up = metresOf(y);
            if (std::hypot(across, up) > 0.5) continue;
            for (int c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(at(shown, x, y)[c] - at(truth.picture.rgba, x, y)[c]));
            const double aside = std::hypot(across, up);
            const double place = behindBallMetres(kRadiusMetres, kIor, aside, kBehindWallMetres) * across / aside;
            // The mesh has facets: 2 mm on the wall, of 4 m.
            ASSERT_NEAR(at(truth.picture.rgba, x, y).r, evenlyAt(plain, place, y).r, 1e-3) << "at " << x << ", " << y;
            const bool isLeft = at(plain, x, y).r < 0.5, showsLeft = at(shown, x, y).r < 0.5;
            turned += isLeft != showsLeft ? 1 : -1;
        }
    fmt::print("ball: worst error {:.4f} of a ramp from 0 to 1 over 4 m\n", worst);
    EXPECT_LT(worst, 0.02);
    EXPECT_GT(turned, 300);
}

/// Where a body's back is met light is absorbed on its way there, whatever thickness the material has: by the cosine
/// inside of a slab, as long as the chord of a ball.
TEST_F(GlassBehind, absorbsAlongTheWayToTheBackThatItsRaysMeet) {
    constexpr double kDeepMetres = 0.4, kRadiusMetres = 0.7;
    Material tinted = bareGlass(2.0);
    tinted.thicknessMetres = 3.0f;
    tinted.attenuationDistanceMetres = 1.0f;
    tinted.attenuationColor = {0.25f, 0.5f, 1.0f};
    tinted.dispersion = 4.0f; // indices of 1.9, 2 and 2.1
    constexpr double kIors[] = {1.9, 2.0, 2.1};
    const frame::FrameSettings settings = seeing(Refraction::BackFaces);
    const auto expectLeft = [&](scenes::Mesh mesh, double tiltRadians, const auto& wayMetres, double leeway,
                                double truthLeeway) {
        Scene scene = quadScene(tinted);
        scene.meshes[0] = std::move(mesh);
        placeQuad(scene.nodes[0], 0.0, 1.0, tiltRadians);
        scene.cameras[0].projection = scenes::Projection::Orthographic;
        scene.cameras[0].halfHeightMetres = 1.0;
        scene.environment = evenEnvironment(1.0);
        const std::vector<float> shown = drawn(scene, settings);
        const std::vector<float> truth = validation::referencePicture(
                                             scene, settings, [] {}, validation::Leeway::None)
                                             .picture.rgba;
        for (int y = 0; y < kBehindPixels; ++y)
            for (int x = 0; x < kBehindPixels; ++x) {
                // Farther out rays leave the picture inside the slab, and the ball lets few through.
                if (std::hypot(metresOf(x), metresOf(y)) > 0.6) continue;
                for (int c = 0; c < 3; ++c) {
                    const double way = wayMetres(std::hypot(metresOf(x), metresOf(y)), kIors[c]);
                    const double wanted = std::pow(double(tinted.attenuationColor[c]), way);
                    ASSERT_NEAR(at(shown, x, y)[c], wanted, leeway * wanted) << tiltRadians << " at " << x << ", " << y;
                    ASSERT_NEAR(at(truth, x, y)[c], wanted, truthLeeway * wanted)
                        << "reference, " << tiltRadians << " at " << x << ", " << y;
                }
            }
    };
    scenes::Mesh slab, ball;
    scenes::builtin::appendBox(slab, {-4.0, -4.0, -kDeepMetres}, {4.0, 4.0, 0.0});
    scenes::builtin::appendSphere(ball, {}, kRadiusMetres, 192, 96);
    for (const double tiltRadians : {0.0, 0.3, 0.6, 0.9}) {
        const auto wayMetres = [&](double, double ior) {
            return kDeepMetres / std::cos(std::asin(std::sin(tiltRadians) / ior));
        };
        expectLeft(slab, tiltRadians, wayMetres, 1e-4, 1e-5);
    }
    // The mesh has facets, which are 0.8 mm off at most, and the renderer's pixels see them as planes.
    const auto chordMetres = [](double asideMetres, double ior) {
        return 2.0 * std::sqrt(kRadiusMetres * kRadiusMetres - asideMetres * asideMetres / (ior * ior));
    };
    expectLeft(ball, 0.0, chordMetres, 4e-3, 2e-3);
}

/// A wedge that stands on the wall reflects all light in its back, where its own depth and the wall's are the same up
/// to rounding: nothing of the wall shows, only the background that the reflected rays go to.
TEST_F(GlassBehind, thatStandsOnASurfaceReflectsWhatDoesNotLeaveIt) {
    constexpr double kIor = 2.4, kTiltRadians = 1.05, kHalfMetres = 0.4, kEdgeMetres = 0.1;
    scenes::Mesh wedge;
    scenes::builtin::appendBox(wedge, {-kHalfMetres, -0.8, -kBehindWallMetres}, {kHalfMetres, 0.8, 0.0});
    const auto aboveWall = [&](double x) { return kEdgeMetres + (kHalfMetres - x) * std::tan(kTiltRadians); };
    for (std::size_t i = 0; i < wedge.positionsOS.size(); ++i) {
        glm::vec3 &positionOS = wedge.positionsOS[i], &normalOS = wedge.normalsOS[i];
        if (positionOS.z < 0.0f) continue;
        positionOS.z = float(aboveWall(double(positionOS.x)) - kBehindWallMetres);
        if (normalOS.z > 0.5f) normalOS = {float(std::sin(kTiltRadians)), 0.0f, float(std::cos(kTiltRadians))};
    }
    const std::vector<float> shown =
        drawn(coveredByBody(rampWall(), bareGlass(kIor), wedge), seeing(Refraction::BackFaces));
    const double inside = kTiltRadians - std::asin(std::sin(kTiltRadians) / kIor);
    ASSERT_GT(std::sin(inside), 1.0 / kIor);
    int reflected = 0;
    for (int y = 0; y < kBehindPixels; ++y)
        for (int x = 0; x < kBehindPixels; ++x) {
            const double begin = metresOf(x), end = begin - aboveWall(begin) * std::tan(inside);
            if (begin > kHalfMetres - kBehindPixelMetres || end < -kHalfMetres + kBehindPixelMetres) continue;
            if (std::abs(metresOf(y)) > 0.7) continue;
            ++reflected;
            EXPECT_EQ(at(shown, x, y), glm::dvec3(0.125, 0.375, 0.625)) << "at " << x << ", " << y;
        }
    EXPECT_GT(reflected, kBehindPixels);
}

/// Rays that bend once meet a wall, upright or leaning, where a plane and a line meet.
TEST_F(GlassBehind, bentOnceShowsWhereTheRayMeetsTheWall) {
    constexpr double kIor = 1.5;
    const double bend = std::tan(kGlassTiltRadians - std::asin(std::sin(kGlassTiltRadians) / kIor));
    for (const double leanRadians : {0.0, -0.6, 0.6}) {
        Scene wall = rampWall();
        placeQuad(wall.nodes[0], -kBehindWallMetres, 4.0, leanRadians);
        const frame::FrameSettings settings = seeing(Refraction::OneSide);
        const std::vector<float> plain = drawn(wall, settings);
        const std::vector<float> shown = drawn(coveredByGlass(wall, bareGlass(kIor), kGlassTiltRadians), settings);
        const double slope = -std::tan(leanRadians); // of the wall's z by x
        int met = 0;
        for (int y = 0; y < kBehindPixels; ++y)
            for (int x = 0; x < kBehindPixels; ++x) {
                // The ray begins on the glass, at z = -x tan(tilt), and goes to the left as it goes back.
                const double begin = metresOf(x), above = -begin * std::tan(kGlassTiltRadians) + kBehindWallMetres;
                const double place = (begin - above * bend) / (1.0 - slope * bend);
                if (place < -1.0 + kBehindPixelMetres) continue;
                ++met;
                const glm::dvec3 wanted = evenlyAt(plain, place, y);
                const glm::dvec3 step = glm::abs(at(plain, 1, y) - at(plain, 0, y));
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(at(shown, x, y)[c], wanted[c], 0.05 * step[c] + 1e-5)
                        << leanRadians << " at " << x << ", " << y;
            }
        EXPECT_GT(met, kBehindPixels * kBehindPixels / 3);
    }
}

/// A body that is thicker than the room before the wall: rays meet the wall inside, and not where they would leave the
/// body behind it.
TEST_F(GlassBehind, withAFarSideBehindTheWallShowsWhereTheRayMeetsTheWallInside) {
    constexpr double kIor = 1.5;
    const double bend = std::tan(kGlassTiltRadians - std::asin(std::sin(kGlassTiltRadians) / kIor));
    Material deep = bareGlass(kIor);
    deep.thicknessMetres = 8.0f;
    const frame::FrameSettings settings = seeing(Refraction::TwoSides);
    const Scene covered = coveredByGlass(rampWall(), deep, kGlassTiltRadians);
    const std::vector<float> plain = drawn(rampWall(), settings), shown = drawn(covered, settings);
    const std::vector<float> truth = validation::referencePicture(
                                         covered, settings, [] {}, validation::Leeway::None)
                                         .picture.rgba;
    int met = 0;
    for (int y = 0; y < kBehindPixels; ++y)
        for (int x = 0; x < kBehindPixels; ++x) {
            const double begin = metresOf(x), above = -begin * std::tan(kGlassTiltRadians) + kBehindWallMetres;
            const double place = begin - above * bend;
            if (place < -1.0 + kBehindPixelMetres) continue;
            ++met;
            const glm::dvec3 wanted = evenlyAt(plain, place, y);
            const glm::dvec3 step = glm::abs(at(plain, 1, y) - at(plain, 0, y));
            for (int c = 0; c < 3; ++c) {
                ASSERT_NEAR(at(shown, x, y)[c], wanted[c], 0.05 * step[c] + 1e-5) << "at " << x << ", " << y;
                ASSERT_NEAR(at(truth, x, y)[c], wanted[c], 1e-4) << "reference, at " << x << ", " << y;
            }
        }
    EXPECT_GT(met, kBehindPixels * kBehindPixels / 3);
}

/// Bent once, or moved aside by a far side, seen through a lens, with a far plane and without.
TEST_F(GlassBehind, throughALensShowsWhereTheRayMeetsTheWall) {
    constexpr double kIor = 1.5, kThicknessMetres = 0.4, kEyeMetres = 3.0, kFovYRadians = 0.5;
    const double half = std::tan(0.5 * kFovYRadians), wallHalf = half * (kEyeMetres + kBehindWallMetres);
    for (const double farMetres : {std::numeric_limits<double>::infinity(), 20.0})
        for (const Refraction refraction : {Refraction::OneSide, Refraction::TwoSides})
            for (const double tiltRadians : {0.0, kGlassTiltRadians}) {
                Scene wall = rampWall();
                wall.cameras[0].projection = scenes::Projection::Perspective;
                wall.cameras[0].fovYRadians = kFovYRadians;
                wall.cameras[0].farMetres = farMetres;
                Material glass = bareGlass(kIor);
                glass.thicknessMetres = float(kThicknessMetres);
                const frame::FrameSettings settings = seeing(refraction);
                const std::vector<float> plain = drawn(wall, settings);
                const std::vector<float> shown = drawn(coveredByGlass(wall, glass, tiltRadians), settings);
                const glm::dvec3 normal(std::sin(tiltRadians), 0.0, std::cos(tiltRadians));
                const glm::dvec3 eye(0.0, 0.0, kEyeMetres);
                int met = 0;
                for (int y = 0; y < kBehindPixels; ++y)
                    for (int x = 0; x < kBehindPixels; ++x) {
                        const glm::dvec3 ray =
                            glm::normalize(glm::dvec3(half * metresOf(x), -half * metresOf(y), -1.0));
                        glm::dvec3 from = eye - glm::dot(eye, normal) / glm::dot(ray, normal) * ray;
                        glm::dvec3 along = *bentDirection(-ray, kIor, normal);
                        if (refraction == Refraction::TwoSides) {
                            from -= kThicknessMetres / glm::dot(along, normal) * along;
                            along = ray;
                        }
                        const glm::dvec3 place = from - (from.z + kBehindWallMetres) / along.z * along;
                        const glm::dvec2 seen = glm::dvec2(place) / wallHalf;
                        if (std::max(std::abs(seen.x), std::abs(seen.y)) > 1.0 - kBehindPixelMetres) continue;
                        ++met;
                        const glm::dvec3 wanted = evenlyAt(plain, seen.x, y);
                        const glm::dvec3 step = glm::abs(at(plain, 1, y) - at(plain, 0, y));
                        for (int c = 0; c < 3; ++c)
                            ASSERT_NEAR(at(shown, x, y)[c], wanted[c], 0.05 * step[c] + 1e-5)
                                << infoOf(refraction).name << ", tilt " << tiltRadians << ", to " << farMetres
                                << " m, at " << x << ", " << y;
                    }
                EXPECT_GT(met, kBehindPixels * kBehindPixels / 2);
            }
}

/// A bar before the glass is no obstacle to what goes on behind it.
TEST_F(GlassBehind, raysPassBehindWhatStandsBeforeIt) {
    constexpr double kIor = 1.5, kBarMetres = 0.05; // half its width
    const double bend = std::tan(kGlassTiltRadians - std::asin(std::sin(kGlassTiltRadians) / kIor));
    const Scene wall = rampWall();
    Scene covered = coveredByGlass(wall, bareGlass(kIor), kGlassTiltRadians);
    covered.materials.push_back(unlit());
    scenes::Node& bar = covered.nodes.emplace_back(covered.nodes[0]);
    bar.instances[0].material = 2;
    placeQuad(bar, 1.5, 4.0);
    bar.parentFromNode[0] *= kBarMetres / 4.0;
    const frame::FrameSettings settings = seeing(Refraction::OneSide);
    const std::vector<float> plain = drawn(wall, settings), shown = drawn(covered, settings);
    int crossing = 0;
    for (int y = 0; y < kBehindPixels; ++y)
        for (int x = 0; x < kBehindPixels; ++x) {
            const double begin = metresOf(x);
            const double place = begin - (kBehindWallMetres - begin * std::tan(kGlassTiltRadians)) * bend;
            const auto isClear = [&](double metres) {
                return std::abs(metres) > kBarMetres + 1.5 * kBehindPixelMetres;
            };
            if (place < -1.0 + kBehindPixelMetres || !isClear(begin) || !isClear(place)) continue;
            crossing += begin > 0.0 && place < 0.0 ? 1 : 0;
            const glm::dvec3 wanted = evenlyAt(plain, place, y);
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(at(shown, x, y)[c], wanted[c], 2e-3) << "at " << x << ", " << y;
        }
    EXPECT_GT(crossing, kBehindPixels);
}

/// To the last bit: what is not met changes nothing. With a far side the ray of the viewer goes on.
TEST_F(GlassBehind, raysThatMeetNothingShowTheEnvironment) {
    for (const EnvironmentLight light : {EnvironmentLight::SplitSum, EnvironmentLight::Sampled})
        for (const Refraction refraction : {Refraction::OneSide, Refraction::TwoSides}) {
            frame::FrameSettings settings = ofSide(kBentPixels, light);
            settings.refraction = refraction;
            const Scene alone = bentPlane(bareGlass(1.5, 0.3));
            Scene with = alone;
            with.materials.push_back(unlit());
            scenes::Node& beside = with.nodes.emplace_back(with.nodes[0]);
            beside.instances[0].material = 1;
            placeQuad(beside, 50.0, 1.0); // behind the camera
            const std::vector<float> shown = drawn(with, settings);
            EXPECT_EQ(shown, drawn(alone, settings)) << infoOf(light).name << ", " << infoOf(refraction).name;
            if (refraction == Refraction::TwoSides) continue;
            settings.refraction = Refraction::Environment;
            EXPECT_EQ(shown, drawn(with, settings)) << infoOf(light).name;
        }
}

/// A rough body before an even wall shows just that, before an edge a wider one, as the reference does.
TEST_F(GlassBehind, thatIsRoughBlursWhatStandsThere) {
    Scene even = wallScene(uniformImage({200, 100, 50, 255}), 4.0);
    const frame::FrameSettings settings = seeing(Refraction::OneSide);
    const std::vector<float> plain = drawn(even, settings);
    const std::vector<float> shown = drawn(coveredByGlass(even, bareGlass(1.5, 0.3)), settings);
    for (std::size_t i = 0; i < plain.size(); ++i) ASSERT_NEAR(shown[i], plain[i], 2e-5f * plain[i]) << i;

    // Black to the left, white to the right.
    const Scene edge = wallScene(image8([](int x, int) {
                                     const int value = x < kSide / 2 ? 0 : 255;
                                     return std::array<int, 4>{value, value, value, 255};
                                 }),
                                 4.0);
    const Scene rough = coveredByGlass(edge, bareGlass(1.5, 0.3));
    const validation::ReferencePicture truth = validation::referencePicture(
        rough, settings, [] {}, validation::Leeway::None);
    const auto errorOf = [&](const Scene& scene) {
        const std::vector<float> own = drawn(scene, settings);
        double sum = 0.0;
        for (std::size_t i = 0; i < own.size(); i += 4) sum += std::abs(double(own[i]) - double(truth.picture.rgba[i]));
        return sum / double(truth.picture.pixelCount());
    };
    const double blurred = errorOf(rough), sharp = errorOf(coveredByGlass(edge, bareGlass(1.5)));
    fmt::print("behind rough glass: mean error {:.3f}, {:.3f} if it were smooth\n", blurred, sharp);
    EXPECT_LT(blurred, 0.5 * sharp);

    // Of a GGX lobe (1 + s / sqrt(s^2 + alpha^2)) / 2 lies below a slope s of its half vectors along one direction, and
    // they turn light by twice their angle: from a quarter to three quarters of the light it is so far.
    constexpr double kAlpha = 0.3 * 0.3;
    const double wanted = 2.0 * kBehindWallMetres * std::tan(2.0 * std::atan(kAlpha / std::sqrt(3.0)));
    const auto widthOf = [&](const std::vector<float>& picture) {
        std::vector<double> columns(kBehindPixels);
        for (int y = 0; y < kBehindPixels; ++y)
            for (int x = 0; x < kBehindPixels; ++x)
                columns[std::size_t(x)] += at(picture, x, y).r / double(kBehindPixels);
        const auto placeOf = [&](double share) {
            const auto next = std::ranges::find_if(columns, [&](double below) { return below > share; });
            if (next == columns.begin() || next == columns.end()) return std::numeric_limits<double>::quiet_NaN();
            const double rise = (share - *(next - 1)) / (*next - *(next - 1));
            return metresOf(int(next - columns.begin()) - 1) + rise * kBehindPixelMetres;
        };
        return placeOf(0.75) - placeOf(0.25);
    };
    // The means of columns, of 48 x 32 samples, place each quarter to 2.6 % of the width; the lobe's cosine takes 2 %
    // of it.
    EXPECT_NEAR(widthOf(truth.picture.rgba), wanted, 0.13 * wanted);
    EXPECT_NEAR(widthOf(drawn(rough, settings)), wanted, 0.25 * wanted) << "squares between two levels";
}

using GlassBehindSlow = GlassBehind;

/// Along rays bent once and moved aside, with levels and without, of one sample and of several. Or of several and not
/// pruned along one of them each.
void GlassBehind::expectAllTechniquesAlike() {
    for (const Refraction refraction : {Refraction::OneSide, Refraction::TwoSides, Refraction::BackFaces}) {
        SCOPED_TRACE(infoOf(refraction).name);
        Scene scene = fewWithGlass();
        scene.materials[1].thicknessMetres = 0.4f;
        scenes::builtin::appendSphere(scene.meshes.emplace_back(), {}, 1.0, 48, 24);
        scene.nodes[1].instances[0].mesh = 1;
        frame::FrameSettings settings;
        settings.sizePixels = {96, 54};
        settings.refraction = refraction;
        {
            engine::Renderer renderer(context(), scene);
            expectParity(renderer, settings, techniquesInTurn(std::size_t(refraction)));
            settings.samples = 4;
            if (isWholeSweep() || refraction == Refraction::TwoSides)
                expectParity(renderer, settings, {Technique::ForwardPrepass, Technique::ClusteredForward});
            settings.samples = 1;
        }
        if (!isWholeSweep() && refraction != Refraction::BackFaces) continue;
        scene.materials[1].perceptualRoughness = 0.0f; // so that there are no levels
        engine::Renderer renderer(context(), scene);
        const std::vector<float> pruned = renderer.render(Technique::Deferred, settings).radiance;
        settings.prune = false;
        EXPECT_EQ(renderer.render(Technique::Deferred, settings).radiance, pruned);
    }
}
TEST_F(GlassBehind, everyTechniqueShowsTheSameAndPruningChangesNoBit) {
    expectAllTechniquesAlike();
}
TEST_F(GlassBehindSlow, everyTechniqueShowsTheSameAndPruningChangesNoBit) {
    expectAllTechniquesAlike();
}

TEST_F(GlassBehind, hasNoTraceWhereThereIsNothingToShow) {
    const auto planOf = [](const Scene& scene, Refraction refraction = Refraction::OneSide) {
        frame::FrameSettings settings;
        settings.refraction = refraction;
        return planText(engine::planFrame(scene, Technique::Deferred, settings));
    };
    const auto hasDefine = [](const Scene& scene, const std::string& wanted) {
        for (const shader::ProgramDesc& program : engine::framePrograms(scene, Technique::Deferred, {}))
            for (const auto& [name, value] : program.defines)
                if (name == wanted && value != "0") return true;
        return false;
    };
    using ::testing::HasSubstr, ::testing::Not;
    const Scene covered = coveredByGlass(checkedWall(), bareGlass(1.5));
    EXPECT_THAT(planOf(covered), HasSubstr("behind_glass"));
    EXPECT_THAT(planOf(covered), Not(HasSubstr("behind_glass_levels"))) << "smooth";
    EXPECT_TRUE(hasDefine(covered, "HAS_SCENE_BEHIND"));
    EXPECT_FALSE(hasDefine(covered, "HAS_BLURRED_SCENE_BEHIND"));
    EXPECT_THAT(planOf(coveredByGlass(checkedWall(), bareGlass(1.5, 0.3))), HasSubstr("behind_glass_levels"));
    EXPECT_THAT(planOf(covered, Refraction::Environment), Not(HasSubstr("behind_glass")));
    EXPECT_THAT(planOf(covered), Not(HasSubstr("far_sides")));
    EXPECT_THAT(planOf(covered, Refraction::BackFaces), HasSubstr("far_sides"));
    EXPECT_THAT(planOf(checkedWall(), Refraction::BackFaces), Not(HasSubstr("far_sides")));

    Scene onlyGlass = quadScene(bareGlass(1.5));
    for (const Scene& scene : {checkedWall(), coveredByGlass(checkedWall(), clearGlass()), onlyGlass}) {
        EXPECT_THAT(planOf(scene), Not(HasSubstr("behind_glass")));
        EXPECT_THAT(planOf(scene), HasSubstr("surfaces behind glass")) << "told as left out";
        EXPECT_FALSE(hasDefine(scene, "HAS_SCENE_BEHIND"));
    }
}

/// Where its bodies stand on a table before a lamp's foot and a pane's holder.
TEST_F(GlassBehindSlow, mostOfTheSceneGlassIsNearerToTheReferenceWithWhatStandsBehind) {
    const Scene scene = scenes::loadScene("glass");
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings;
    settings.sizePixels = {96, 54};
    settings.shadows = {scenes::ShadowRequest::Kind::None};
    settings.environment.light = EnvironmentLight::Sampled;
    const Picture truth = validation::referencePicture(
                              scene, settings, [] {}, validation::Leeway::None)
                              .picture;
    const auto drawnWith = [&](Refraction refraction) {
        settings.refraction = refraction;
        return renderer.render(Technique::Deferred, settings).radiance;
    };
    const std::vector<float> alone = drawnWith(Refraction::Environment), behind = drawnWith(Refraction::OneSide);
    // Of each pixel that the two show differently: bodies, and nothing else.
    std::vector<double> errorsAlone, errorsBehind;
    double squaresAlone = 0.0, squaresBehind = 0.0;
    const auto errorAt = [&](const std::vector<float>& shown, std::size_t pixel, double& squares) {
        double error = 0.0, light = 0.0;
        for (std::size_t i = 4 * pixel; i < 4 * pixel + 3; ++i) {
            const double own = double(shown[i]), other = double(truth.rgba[i]);
            error += std::abs(own - other);
            light += other + 0.01;
            squares += (own - other) * (own - other) / ((other + 0.01) * (other + 0.01)) / 3.0;
        }
        return error / light;
    };
    for (std::size_t pixel = 0; pixel < truth.pixelCount(); ++pixel) {
        if (std::equal(&alone[4 * pixel], &alone[4 * pixel + 3], &behind[4 * pixel])) continue;
        errorsAlone.push_back(errorAt(alone, pixel, squaresAlone));
        errorsBehind.push_back(errorAt(behind, pixel, squaresBehind));
    }
    const double count = double(errorsAlone.size()), medianAlone = medianOf(errorsAlone),
                 medianBehind = medianOf(errorsBehind);
    fmt::print("glass: {} pixels of bodies; median error {:.3f} with the environment alone, {:.3f} with what stands "
               "behind; relMSE {:.2f} and {:.2f}\n",
               errorsAlone.size(), medianAlone, medianBehind, squaresAlone / count, squaresBehind / count);
    EXPECT_GT(count, 100.0);
    EXPECT_LT(medianBehind, 0.7 * medianAlone);
}

} // namespace
} // namespace tessera
