// Glass bodies whose rays leave at the back faces of the mesh: closed forms, and the reference.
#include "tests/image/GlassBehindTest.h"
#include "tests/image/GlassTest.h"

namespace tessera {
namespace {

using engine::Technique;
using frame::Refraction;
using scenes::Material;
using scenes::Scene;
using namespace test;

class GlassBackFaces : public GlassBehindTest {};
using GlassBackFacesSlow = GlassBackFaces;

/// The scene with a glass body, a closed mesh, in front of it.
Scene coveredByBody(Scene scene, const Material& glass, scenes::Mesh mesh, double tiltRadians = 0.0) {
    Scene covered = coveredByGlass(std::move(scene), glass, tiltRadians, 1.0);
    covered.nodes.back().instances[0].mesh = int(covered.meshes.size());
    covered.meshes.push_back(std::move(mesh));
    return covered;
}

/// The offset of two parallel sides at the distance of the drawn slab, whatever the material's thickness.
TEST_F(GlassBackFaces, throughTheBackOfASlabIsMovedAsideByTheClosedForm) {
    constexpr int kMoved = 3;
    const frame::FrameSettings settings = seeing(Refraction::BackFaces);
    const std::vector<float> plain = drawn(checkedWall(), settings);
    for (const auto& [ior, isMirrored] : {std::pair(1.0, false), {1.3, false}, {1.5, false}, {1.5, true}}) {
        const bool bends = ior > 1.0;
        const double thickness = bends ? kMoved * kBehindPixelMetres / asideMetres(1.0, ior, kBehindTiltRadians) : 0.5;
        scenes::Mesh slab;
        scenes::builtin::appendBox(slab, {-4.0, -4.0, -thickness}, {4.0, 4.0, 0.0});
        Scene covered = coveredByBody(checkedWall(), bareGlass(ior), slab, kBehindTiltRadians);
        if (isMirrored) covered.nodes.back().parentFromNode[0] *= -1.0; // the slab is symmetric
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

/// Where a ray along -z at `asideMetres` from the axis of a ball around the origin meets a plane behind it, as a
/// distance from that axis. The ray turns twice, each time by the angle to the normal outside minus that inside.
double behindBallMetres(double radiusMetres, double ior, double asideMetres, double planeMetres) {
    const double outside = std::asin(asideMetres / radiusMetres);
    const double inside = std::asin(asideMetres / (radiusMetres * ior)), turn = 2.0 * (outside - inside);
    const double leavesAt = 2.0 * inside - outside; // by the angle to -z
    return radiusMetres * std::sin(leavesAt) - std::tan(turn) * (planeMetres - radiusMetres * std::cos(leavesAt));
}

/// A ball swaps left and right, as in the reference through the mesh, and in the closed form.
TEST_F(GlassBackFaces, throughTheBackOfABallIsTurnedRound) {
    constexpr double kIor = 1.5, kRadiusMetres = 0.7;
    scenes::Mesh ball;
    scenes::builtin::appendSphere(ball, {}, kRadiusMetres, 96, 48);
    const Scene scene = coveredByBody(rampWall(), bareGlass(kIor), ball);
    const frame::FrameSettings settings = seeing(Refraction::BackFaces);
    const validation::ReferencePicture truth = strictReference(scene, settings);
    const std::vector<float> plain = drawn(rampWall(), settings), shown = drawn(scene, settings);
    double worst = 0.0;
    int turned = 0;
    for (int y = 0; y < kBehindPixels; ++y)
        for (int x = 0; x < kBehindPixels; ++x) {
            // Where rays meet the wall within the image.
            const double across = metresOf(x), up = metresOf(y);
            if (std::hypot(across, up) > 0.5) continue;
            for (int c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(at(shown, x, y)[c] - at(truth.picture.rgba, x, y)[c]));
            const double aside = std::hypot(across, up);
            const double place = behindBallMetres(kRadiusMetres, kIor, aside, kBehindWallMetres) * across / aside;
            // The mesh's triangles move rays by 2 mm on the wall, whose ramp spans 4 m.
            ASSERT_NEAR(at(truth.picture.rgba, x, y).r, evenlyAt(plain, place, y).r, 1e-3) << "at " << x << ", " << y;
            const bool isLeft = at(plain, x, y).r < 0.5, showsLeft = at(shown, x, y).r < 0.5;
            turned += isLeft != showsLeft ? 1 : -1;
        }
    fmt::print("ball: worst error {:.4f} of a ramp from 0 to 1 over 4 m\n", worst);
    EXPECT_LT(worst, 0.02);
    EXPECT_GT(turned, 300);
}

/// Rays through the front of a deep box meet its sides, which reflect them, or its back: all cross its depth. A
/// material thickness below the distance to the far side has no effect.
TEST_F(GlassBackFaces, absorbsAlongItsThicknessWhereTheBackReflects) {
    constexpr double kDeepMetres = 0.8, kHalfMetres = 0.3, kTiltRadians = 0.5, kIor = 1.5;
    Material tinted = bareGlass(kIor);
    tinted.thicknessMetres = float(kDeepMetres);
    tinted.attenuationDistanceMetres = 1.0f;
    tinted.attenuationColor = {0.25f, 0.5f, 1.0f};
    Scene scene = quadScene(tinted);
    scene.meshes[0] = {};
    scenes::builtin::appendBox(scene.meshes[0], {-kHalfMetres, -kHalfMetres, -kDeepMetres},
                               {kHalfMetres, kHalfMetres, 0.0});
    placeQuad(scene.nodes[0], 0.0, 1.0, kTiltRadians);
    makeOrthographic(scene.cameras[0], 1.0);
    scene.environment = evenEnvironment(1.0);
    const frame::FrameSettings settings = seeing(Refraction::BackFaces);
    const double wayMetres = kDeepMetres / std::cos(std::asin(std::sin(kTiltRadians) / kIor));
    for (const double thicknessMetres : {kDeepMetres, 0.01}) {
        scene.materials[0].thicknessMetres = float(thicknessMetres);
        const std::vector<float> shown = drawn(scene, settings);
        const std::vector<float> truth = strictRadiance(scene, settings);
        int judged = 0;
        for (int y = 0; y < kBehindPixels; ++y)
            for (int x = 0; x < kBehindPixels; ++x) {
                if (std::max(std::abs(metresOf(x)), std::abs(metresOf(y))) > 0.9 * kHalfMetres * std::cos(kTiltRadians))
                    continue;
                ++judged;
                for (int c = 0; c < 3; ++c) {
                    const double right = at(truth, x, y)[c];
                    ASSERT_NEAR(at(shown, x, y)[c], right, 3e-2 * right) << "at " << x << ", " << y;
                    if (thicknessMetres < kDeepMetres) continue;
                    const double wanted = std::pow(double(tinted.attenuationColor[c]), wayMetres);
                    ASSERT_NEAR(at(shown, x, y)[c], wanted, 3e-2 * wanted) << "at " << x << ", " << y;
                    ASSERT_NEAR(right, wanted, 1e-3 * wanted) << "reference, at " << x << ", " << y;
                }
            }
        EXPECT_GT(judged, 100);
    }
}
/// Light is absorbed along its way to the back, whatever the material's thickness: by the cosine inside a slab, by the
/// chord of a ball.
TEST_F(GlassBackFaces, absorbsAlongTheWayToTheBackThatItsRaysMeet) {
    constexpr double kDeepMetres = 0.4, kRadiusMetres = 0.7;
    Material tinted = bareGlass(2.0);
    tinted.thicknessMetres = 3.0f;
    tinted.attenuationDistanceMetres = 1.0f;
    tinted.attenuationColor = {0.25f, 0.5f, 1.0f};
    tinted.dispersion = 4.0f; // indices of 1.9, 2 and 2.1
    constexpr double kIors[] = {1.9, 2.0, 2.1};
    const frame::FrameSettings settings = seeing(Refraction::BackFaces);
    const auto expectLeft = [&](scenes::Mesh mesh, double tiltRadians, const auto& wayMetres, double tolerance,
                                double truthTolerance) {
        Scene scene = quadScene(tinted);
        scene.meshes[0] = std::move(mesh);
        placeQuad(scene.nodes[0], 0.0, 1.0, tiltRadians);
        makeOrthographic(scene.cameras[0], 1.0);
        scene.environment = evenEnvironment(1.0);
        const std::vector<float> shown = drawn(scene, settings);
        const std::vector<float> truth = strictRadiance(scene, settings);
        for (int y = 0; y < kBehindPixels; ++y)
            for (int x = 0; x < kBehindPixels; ++x) {
                // Further out rays leave the image inside the slab, and the ball transmits little.
                if (std::hypot(metresOf(x), metresOf(y)) > 0.6) continue;
                for (int c = 0; c < 3; ++c) {
                    const double way = wayMetres(std::hypot(metresOf(x), metresOf(y)), kIors[c]);
                    const double wanted = std::pow(double(tinted.attenuationColor[c]), way);
                    ASSERT_NEAR(at(shown, x, y)[c], wanted, tolerance * wanted)
                        << tiltRadians << " at " << x << ", " << y;
                    ASSERT_NEAR(at(truth, x, y)[c], wanted, truthTolerance * wanted)
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
    // The mesh's triangles lie up to 0.2 mm inside of the ball on either side, which is 5e-4 of the transmitted light;
    // the renderer's pixels treat them as planes.
    const auto chordMetres = [](double asideMetres, double ior) {
        return 2.0 * std::sqrt(kRadiusMetres * kRadiusMetres - asideMetres * asideMetres / (ior * ior));
    };
    expectLeft(ball, 0.0, chordMetres, 4e-3, 1e-3);
}

/// A wedge that stands on the wall has total reflection at its back, whose depth equals the wall's up to rounding: the
/// wall is invisible, and the reflected rays show the background.
TEST_F(GlassBackFaces, thatStandsOnASurfaceReflectsWhatDoesNotLeaveIt) {
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

/// By default rays leave closed meshes by their back faces. Open meshes have no far side, even with a closed body
/// behind them.
TEST_F(GlassBackFaces, countByDefaultOfClosedMeshes) {
    scenes::Mesh box;
    scenes::builtin::appendBox(box, {-0.3, -0.3, -0.9}, {0.3, 0.3, -0.4});
    Scene scene = coveredByBody(rampWall(), bareGlass(1.5), box, 0.4);
    const auto shownWith = [&](Refraction refraction) { return drawn(scene, seeing(refraction)); };
    EXPECT_EQ(frame::FrameSettings().refraction, Refraction::ClosedMeshes);
    EXPECT_EQ(shownWith(Refraction::ClosedMeshes), shownWith(Refraction::BackFaces));
    EXPECT_NE(shownWith(Refraction::ClosedMeshes), shownWith(Refraction::OneSide));
    scene.meshes.back().indices.resize(scene.meshes.back().indices.size() - 3); // open at one side
    EXPECT_NE(shownWith(Refraction::BackFaces), shownWith(Refraction::ClosedMeshes)) << "on request of any mesh";
    scene.meshes.back() = box;
    const Scene pane = coveredByGlass(rampWall(), bareGlass(1.3), -0.3);
    const std::vector<float> alone = drawn(pane, seeing(Refraction::OneSide));
    EXPECT_EQ(drawn(pane, seeing(Refraction::ClosedMeshes)), alone);
    scene = coveredByGlass(scene, bareGlass(1.3), -0.3);
    placeQuad(scene.nodes.back(), 1.0, 4.0, -0.3);
    Scene paneAlone = pane;
    placeQuad(paneAlone.nodes.back(), 1.0, 4.0, -0.3);
    EXPECT_EQ(shownWith(Refraction::ClosedMeshes), drawn(paneAlone, seeing(Refraction::OneSide)));
}

/// Where a body ends behind the wall it stands in, its rays meet the wall. Without refraction no bit differs.
TEST_F(GlassBackFaces, thatReachesIntoTheWallShowsTheWall) {
    scenes::Mesh box;
    scenes::builtin::appendBox(box, {-0.6, -0.6, -1.5 * kBehindWallMetres}, {0.6, 0.6, 0.0});
    const Scene covered = coveredByBody(checkedWall(), bareGlass(1.0), box);
    const frame::FrameSettings settings = seeing(Refraction::BackFaces);
    const std::vector<float> plain = drawn(checkedWall(), settings);
    EXPECT_EQ(drawn(covered, settings), plain);
    const std::vector<float> truth = strictRadiance(covered, settings);
    for (std::size_t i = 0; i < plain.size(); ++i) ASSERT_NEAR(truth[i], plain[i], 1e-5) << i;
}

/// The table, viewed at a grazing angle, changes its depth within a pixel by more than the height of the rays reflected
/// by the prism's base: they must not meet it. The base shows only the light box, which is uniform.
TEST_F(GlassBackFaces, thatStandsOnWhatIsSeenFlatReflectsWhatDoesNotLeaveIt) {
    const scenes::Scene scene = scenes::loadScene("glass");
    frame::FrameSettings settings = ofSize(480, 270);
    settings.refraction = frame::Refraction::BackFaces;
    settings.shadows.kind = scenes::ShadowRequest::Kind::None;
    const std::vector<float> shown = drawn(scene, settings, Technique::Forward);
    const auto redAt = [&](int x, int y) { return shown[4 * (std::size_t(y) * 480 + std::size_t(x))]; };
    for (int y = 170; y < 175; ++y) // within that base
        for (int x = 112; x < 120; ++x)
            EXPECT_NEAR(redAt(x, y), redAt(117, 172), 0.1f * redAt(117, 172)) << x << ", " << y;
}

/// The base of the prism on the table of the scene glass has total reflection, and the rays that leave it begin at the
/// table's depth. Compared with the depth elsewhere in the pixel, one of three pixels there showed the table.
TEST_F(GlassBackFacesSlow, severalSamplesShowTheSameWhereABodyStandsOnASurface) {
    const scenes::Scene scene = scenes::loadScene("glass");
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = ofSize(640, 360);
    settings.refraction = frame::Refraction::BackFaces;
    const std::vector<float> one = renderer.render(Technique::Forward, settings).radiance;
    settings.samples = 4;
    const std::vector<float> four = renderer.render(Technique::Forward, settings).radiance;
    std::size_t others = 0, all = 0;
    for (int y = 228; y < 234; ++y) // within that base
        for (int x = 147; x < 163; ++x) {
            const std::size_t red = 4 * (std::size_t(y) * 640 + std::size_t(x));
            others += std::abs(one[red] - four[red]) > 0.1f * one[red] ? 1 : 0;
            ++all;
        }
    EXPECT_EQ(others, 0u) << "of " << all;
}

/// The thickness stated by a material, against the actual thickness of a body.
class GlassThickness : public GlassTest {};

/// Back faces determine the path length in a body. Its absorption per metre stays the same down to a stated thickness
/// that absorbs less than a rounding of the light.
TEST_F(GlassThickness, countsForNothingWhereBackFacesGiveTheWay) {
    constexpr double kDeepMetres = 0.4;
    scenes::Material tinted = bareGlass(1.5);
    tinted.attenuationDistanceMetres = 1.0f;
    tinted.attenuationColor = {0.25f, 0.5f, 1.0f};
    frame::FrameSettings settings = ofSide(16);
    settings.refraction = frame::Refraction::BackFaces;
    for (const float thicknessMetres : {3.0f, 1e-3f, 1e-6f, 1e-9f}) {
        tinted.thicknessMetres = thicknessMetres;
        scenes::Scene scene = quadScene(tinted);
        scene.meshes[0] = {};
        scenes::builtin::appendBox(scene.meshes[0], {-4.0, -4.0, -kDeepMetres}, {4.0, 4.0, 0.0});
        scene.nodes[0].parentFromNode = glm::dmat4(1.0);
        makeOrthographic(scene.cameras[0], 1.0);
        scene.environment = evenEnvironment(1.0);
        const std::vector<float> shown = drawn(scene, settings);
        for (std::size_t pixel = 0; pixel < shown.size(); pixel += 4)
            for (std::size_t c = 0; c < 3; ++c) {
                const double wanted = std::pow(double(tinted.attenuationColor[glm::length_t(c)]), kDeepMetres);
                // As for the slab of GlassBehind: rounding of the far side's depth and of the filtered map.
                ASSERT_NEAR(shown[pixel + c], wanted, 1e-4 * wanted) << thicknessMetres << " m, channel " << c;
            }
    }
}

} // namespace
} // namespace tessera
