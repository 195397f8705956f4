#include "validation/reference/Render.h"

#include <atomic>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "renderer/frame/CameraView.h"
#include "scenes/Load.h"
#include "scenes/LookAt.h"
#include "scenes/builtin/Room.h"
#include "tests/support/Random.h"
#include "tests/unit/scenes/TinyScene.h"
#include "validation/reference/CameraRays.h"

namespace tessera::reference {
namespace {

namespace room = scenes::builtin;

TEST(ReferenceRender, theRoomIsItsClosedForm) {
    const scenes::Scene scene = scenes::loadScene("room");
    for (const scenes::Camera& camera : scene.cameras) {
        Settings settings;
        settings.sizePixels = {97, 55};
        settings.camera = camera;
        std::atomic<int> rows = 0;
        const Rendered rendered = render(scene, settings, [&rows] { ++rows; });
        EXPECT_EQ(rows, 55);
        const CameraRays rays(camera, settings.sizePixels);
        int compared = 0;
        for (int row = 0; row < rendered.height; ++row) {
            for (int column = 0; column < rendered.width; ++column) {
                const Ray ray = rays.through(column, row);
                const auto seen = room::roomPointAlong(rays.eyeWS() + ray.originRWS, ray.direction);
                if (!seen) continue;
                const glm::dvec3 truth = room::roomRadiance(seen->positionWS, seen->normalWS, seen->material);
                const glm::dvec3& found = rendered.radiance[std::size_t(row * rendered.width + column)];
                // Positions and normals of the scene are fp32: 6e-8 of those of the rotated box, times its slope.
                for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c], truth[c], 1e-6 * truth[c]) << column << ',' << row;
                ++compared;
            }
        }
        EXPECT_GT(compared, rendered.width * rendered.height * 9 / 10);
    }
}

TEST(ReferenceRender, whereNothingIsDrawnThereIsExactlyTheBackground) {
    scenes::Scene scene;
    scene.background = {0.25f, 0.5f, 1.0f};
    Settings settings;
    settings.sizePixels = {3, 2};
    const Rendered rendered = render(scene, settings);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(rendered.radiance[i], glm::dvec3(0.25, 0.5, 1.0));
        EXPECT_EQ(rendered.covered[i], 0);
        EXPECT_EQ(rendered.ids[i], Ids{});
    }
}

/// A red triangle and a blue one behind it, viewed from the front.
Settings settingsOfTwoTriangles(scenes::Scene& scene, double eyeMetres, double gapMetres) {
    scene = scenes::tinyScene();
    scene.materials = {scene.materials.front(), scene.materials.front()};
    scene.materials[0].model = scene.materials[1].model = scenes::MaterialModel::SingleColor;
    scene.materials[0].baseColor = {1.0f, 0.0f, 0.0f, 1.0f};
    scene.materials[1].baseColor = {0.0f, 0.0f, 1.0f, 1.0f};
    scene.nodes = {scene.nodes.front(), scene.nodes.front()};
    scene.nodes[1].parentFromNode[3].z = -gapMetres;
    scene.nodes[0].instances.front().material = 0;
    scene.nodes[1].instances.front().material = 1;
    Settings settings;
    settings.sizePixels = {1, 1};
    settings.camera.worldFromCamera = scenes::worldFromLookAt({0.5, 1.0, eyeMetres}, {0.5, 1.0, 0.0});
    settings.camera.fovYRadians = 1.0 / eyeMetres;
    return settings;
}

TEST(ReferenceRender, trianglesACentimetreApartAreNotInOnePlaceHoweverFarTheEyeIs) {
    for (const auto projection : {scenes::Projection::Perspective, scenes::Projection::Orthographic}) {
        for (const double eyeMetres : {5.0, 1e3, 1e5}) {
            const auto seen = [&](double gapMetres) {
                scenes::Scene scene;
                Settings settings = settingsOfTwoTriangles(scene, eyeMetres, gapMetres);
                settings.camera.projection = projection;
                return Probe(scene, settings).at({0.5, 0.5});
            };
            EXPECT_TRUE(seen(0.01).others.empty()) << eyeMetres;
            const Layers together = seen(0.0);
            ASSERT_EQ(together.others.size(), 1u) << eyeMetres;
            EXPECT_TRUE(together.others.front().isCoincident);
        }
    }
}

/// Corners lie within a thousandth of a pixel of pixels' centres, so that edges pass many centres as closely.
TEST(ReferenceRender, trianglesCoverThePixelsWhoseCentresLieWithinTheirOutlines) {
    constexpr int kPixels = 16;
    constexpr double kEyeMetres = 3.0;
    test::Random random(71);
    int covered = 0, close = 0;
    for (int i = 0; i < 100; ++i) {
        const bool isLens = i % 2 == 0;
        scenes::Scene scene = scenes::tinyScene();
        scene.materials[0].doubleSided = true;
        glm::dvec2 outline[3]; // pixels
        for (int c = 0; c < 3; ++c) {
            const double ahead = random.between(2.0, 4.0), metres = 2.0 / kPixels * (isLens ? ahead / kEyeMetres : 1.0);
            outline[c] = glm::dvec2(random.index(kPixels), random.index(kPixels)) + 0.5 +
                         glm::dvec2(random.between(-1e-3, 1e-3), random.between(-1e-3, 1e-3));
            const glm::dvec2 placed = (outline[c] - 0.5 * kPixels) * glm::dvec2(metres, -metres);
            scene.meshes[0].positionsOS[std::size_t(c)] = glm::dvec3(placed, kEyeMetres - ahead);
        }
        Settings settings;
        settings.sizePixels = {kPixels, kPixels};
        settings.camera.projection = isLens ? scenes::Projection::Perspective : scenes::Projection::Orthographic;
        settings.camera.halfHeightMetres = 1.0;
        settings.camera.fovYRadians = 2.0 * std::atan(1.0 / kEyeMetres);
        settings.camera.worldFromCamera[3] = {0.0, 0.0, kEyeMetres, 1.0};
        const Rendered rendered = render(scene, settings);
        for (int y = 0; y < kPixels; ++y)
            for (int x = 0; x < kPixels; ++x) {
                double least = 1e9, most = -1e9; // pixels from the centre to the edges' lines, by their sides
                for (int c = 0; c < 3; ++c) {
                    const glm::dvec2 from = outline[c], edge = outline[(c + 1) % 3] - from;
                    const glm::dvec2 to = glm::dvec2(x + 0.5, y + 0.5) - from;
                    const double beside = (edge.x * to.y - edge.y * to.x) / std::max(glm::length(edge), 1e-9);
                    least = std::min(least, beside);
                    most = std::max(most, beside);
                }
                if (std::min(std::abs(least), std::abs(most)) < 1e-5) continue; // roundings of corners
                const bool isWithin = least > 0.0 || most < 0.0;
                ASSERT_EQ(rendered.covered[std::size_t(y * kPixels + x)] != 0, isWithin) << i << ": " << x << ", " << y;
                covered += isWithin;
                close += std::min(std::abs(least), std::abs(most)) < 1e-3;
            }
    }
    EXPECT_GT(covered, 1000);
    EXPECT_GT(close, 300);
}

TEST(ReferenceRender, geometryOutsideThePictureCostsParallelRaysNoDigits) {
    for (const double farMetres : {1e4, 1e6, 1e8}) {
        scenes::Scene scene;
        Settings settings = settingsOfTwoTriangles(scene, 5.0, 0.01);
        settings.camera.projection = scenes::Projection::Orthographic;
        settings.camera.halfHeightMetres = 0.5;
        settings.sizePixels = {20, 20};
        const Rendered alone = render(scene, settings);
        scene.nodes.push_back(scene.nodes.front());
        scene.nodes.back().parentFromNode[3] = glm::dvec4(farMetres, 0.3 * farMetres, -0.7 * farMetres, 1.0);
        const Rendered beside = render(scene, settings);
        EXPECT_EQ(beside.covered, alone.covered) << farMetres;
        EXPECT_EQ(beside.radiance, alone.radiance) << farMetres;
        EXPECT_TRUE(Probe(scene, settings).at({10.3, 10.3}).others.empty()) << farMetres;
    }
}

TEST(ReferenceRender, trianglesAreInOnePlaceWhereRoundingsOfTheirNodesMayExchangeThem) {
    scenes::Scene scene;
    const Settings settings = settingsOfTwoTriangles(scene, 5.0, 0.006);
    EXPECT_TRUE(Probe(scene, settings).at({0.5, 0.5}).others.empty());
    for (glm::vec3& positionOS : scene.meshes[0].positionsOS) positionOS.z += 131072.0f; // steps of 16 mm in fp32
    for (scenes::Node& node : scene.nodes) node.parentFromNode[3].z -= 131072.0;
    const Layers seen = Probe(scene, settings).at({0.5, 0.5});
    ASSERT_EQ(seen.others.size(), 1u);
    EXPECT_TRUE(seen.others.front().isCoincident);
}

/// Rounding of the product's positions grows with their distance from an origin that the product chooses. The reference
/// tolerates the distance between that origin and its own.
TEST(ReferenceRender, fromAFarEyeTheProductsOriginIsNotFartherFromTheReferencesThanIsGranted) {
    test::Random random(21);
    int far = 0;
    for (int i = 0; i < 2000; ++i) {
        scenes::Scene scene = scenes::tinyScene();      // 2 m by 4 m
        scene.meshes[0].positionsOS.emplace_back(1e6f); // no triangle uses it
        scene.meshes[0].normalsOS.emplace_back(0.0f, 0.0f, 1.0f);
        Settings settings;
        settings.sizePixels = {64, 64};
        scenes::Camera& camera = settings.camera;
        const bool isParallel = i % 4 == 0;
        camera.projection = isParallel ? scenes::Projection::Orthographic : scenes::Projection::Perspective;
        const double eyeMetres = random.logarithmic(1.0, 1e6);
        camera.fovYRadians = 1.5;
        camera.halfHeightMetres = 2.0 * eyeMetres;
        camera.nearMetres = i % 3 == 0 ? 1e-3 : 0.5 * eyeMetres;
        if (i % 5 == 0) camera.farMetres = 1.5 * eyeMetres;
        // The triangle lies up to 35 degrees beside the view axis.
        const glm::dvec3 beside(random.between(-0.5, 0.5) * eyeMetres, random.between(-0.5, 0.5) * eyeMetres, 0.0);
        camera.worldFromCamera = scenes::worldFromLookAt({0.7, 1.3, eyeMetres}, glm::dvec3(0.7, 1.3, 0.0) + beside);
        const bool isCut = isParallel && i % 5 == 0;
        if (isParallel) { // one more beside the image
            scene.nodes.push_back(scene.nodes.front());
            scene.nodes.back().parentFromNode[3] =
                glm::dvec4(5.0 * camera.halfHeightMetres * glm::dvec3(camera.worldFromCamera[0]), 1.0);
        }
        if (isCut) { // one more that lies along the view axis and ends far beyond the far plane
            scene.nodes.push_back(scene.nodes.front());
            glm::dmat4& placed = scene.nodes.back().parentFromNode;
            placed[1] = -100.0 * eyeMetres * camera.worldFromCamera[2];
            placed[2] = camera.worldFromCamera[1];
        }
        const CameraRays rays(camera, settings.sizePixels);
        const Anchor anchor = Objects(scene, rays).anchor();
        if (anchor.radiusMetres == 0.0) continue;
        const double mostMetres = isParallel && !isCut ? 5.0 + 0.01 * camera.halfHeightMetres : scenes::kInfinity;
        ASSERT_LE(anchor.otherOriginMetres, mostMetres) << eyeMetres;
        ++far;
        const frame::CameraView view = frame::makeCameraView(camera, settings.sizePixels, frame::LightingSpace::World,
                                                             glm::vec3(0.0f), frame::surfaceBounds(scene));
        ASSERT_TRUE(view.depths.isEven) << "the product stays at the eye, " << eyeMetres << " m away";
        ASSERT_LE(glm::distance(view.originWS - view.eyeWS, anchor.centreRWS), anchor.otherOriginMetres) << eyeMetres;
    }
    EXPECT_GT(far, 1000);
}

TEST(ReferenceRender, ofTrianglesInOnePlaceEitherIsAllowedAndNoMixOfThem) {
    scenes::Scene scene;
    Settings settings = settingsOfTwoTriangles(scene, 5.0, 0.0);
    for (const Filtering filtering : {Filtering::Exact, Filtering::Hardware}) {
        settings.filtering = filtering;
        const Rendered rendered = render(scene, settings);
        ASSERT_EQ(rendered.alternatives[0].size(), 1u);
        const Span& other = rendered.alternatives[0].front();
        EXPECT_EQ(other.least, other.most);
        EXPECT_EQ(rendered.radiance[0] + other.least, glm::dvec3(1.0, 0.0, 1.0));
        EXPECT_EQ(rendered.radiance[0] * other.least, glm::dvec3(0.0));
    }
    settings.findsAlternatives = false;
    EXPECT_TRUE(render(scene, settings).alternatives[0].empty());
}

// ---- Area lights ---------------------------------------------------------------------------------------------------

/// A white triangle of Lambert's model under a sphere of 0.2 m, 2 m above (0.5, 1, 0). The only pixel views that point
/// from the side.
Settings settingsUnderASphere(scenes::Scene& scene) {
    scene = scenes::tinyScene();
    scene.materials.front().model = scenes::MaterialModel::Lambert;
    scenes::Light& light = scene.lights.emplace_back();
    light.type = scenes::LightType::Sphere;
    light.radiusMetres = 0.2f;
    light.positionWS = {0.5, 1.0, 2.0};
    light.castsShadow = true;
    Settings settings;
    settings.sizePixels = {1, 1};
    settings.camera.worldFromCamera = scenes::worldFromLookAt({-3.0, 1.0, 3.0}, {0.5, 1.0, 0.0});
    return settings;
}

TEST(ReferenceRender, aSurfaceShowsAnAreaLightAndTheErrorOfItsIntegralIsReported) {
    scenes::Scene scene;
    const Settings settings = settingsUnderASphere(scene);
    const Rendered rendered = render(scene, settings);
    constexpr double kWanted = 0.01 * std::numbers::pi; // (r / d)^2
    // The radius is rounded to fp32.
    EXPECT_NEAR(rendered.radiance[0].g, kWanted, 1e-6 * kWanted);
    EXPECT_EQ(rendered.areaLights[0].light, rendered.radiance[0]);
    EXPECT_LE(std::sqrt(rendered.areaLights[0].variance.g), 2e-5 * kWanted);
    EXPECT_TRUE(rendered.alternatives[0].empty());
}

TEST(ReferenceRender, ofAFlatLightTheShareOfItsSurfaceThatIsInSightReachesAPoint) {
    scenes::Scene scene;
    const Settings settings = settingsUnderASphere(scene);
    scenes::Light& light = scene.lights.front();
    light.widthMetres = 0.4f;
    light.heightMetres = 0.1f;
    light.radiusMetres = 0.1f;
    for (glm::vec2& corner : light.corners.metres) corner *= glm::vec2(0.4f, 0.1f);
    // A triangle halfway to the light hides the part beyond a straight edge, which in the light's plane is 4 cm from
    // its centre.
    scenes::Mesh& mesh = scene.meshes.emplace_back(scene.meshes.front());
    const double t = 0.4;
    const double ofDisk = (std::acos(t) - t * std::sqrt(1.0 - t * t)) / std::numbers::pi, ofRectangle = 0.16 / 0.4;
    for (const auto& [type, hidden] : {std::pair{scenes::LightType::Rectangle, ofRectangle},
                                       {scenes::LightType::Polygon, ofRectangle},
                                       {scenes::LightType::Disk, ofDisk},
                                       {scenes::LightType::Sphere, ofDisk}}) {
        SCOPED_TRACE(scenes::infoOf(type).name);
        light.type = type;
        scene.nodes.front().instances.resize(1);
        const double whole = render(scene, settings).radiance[0].g;
        ASSERT_GT(whole, 0.0);
        mesh.positionsOS = {{0.52f, -50.0f, 1.0f}, {50.0f, 1.0f, 1.0f}, {0.52f, 50.0f, 1.0f}};
        scene.nodes.front().instances.push_back({1, 0});
        const Rendered part = render(scene, settings);
        // Rays of 64 rings, a hundredth of the surface apart along the edge.
        EXPECT_NEAR(part.radiance[0].g, (1.0 - hidden) * whole, 2e-3 * whole);
        EXPECT_EQ(part.areaLights[0].light, part.radiance[0]);
        mesh.positionsOS[0].x = mesh.positionsOS[2].x = 0.39f;
        EXPECT_EQ(render(scene, settings).radiance[0], glm::dvec3(0.0));
    }
}

TEST(ReferenceRender, idsOfTransparentTrianglesStayBelowTheirBound) {
    for (std::uint32_t object = 0; object < 300; ++object)
        for (const std::uint32_t triangle : {0u, 1u, 77u, 4000000000u})
            EXPECT_LT(transparentId(object, triangle), 0x10000u);
    EXPECT_NE(transparentId(1, 2), transparentId(2, 1));
}

} // namespace
} // namespace tessera::reference
