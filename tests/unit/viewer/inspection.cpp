#include "viewer/session/Inspection.h"

#include <gmock/gmock.h>

#include "tests/support/TestScenes.h"
#include "tests/unit/viewer/CameraTest.h"

namespace tessera::viewer {
namespace {

using namespace test;
using tessera::test::quadScene;
using testing::ElementsAre;

TEST(Inspection, aPlaceIsThePixelThatCoversIt) {
    EXPECT_EQ(pixelAt({0.0f, 0.999f}, {10, 20}), glm::ivec2(0, 19));
    EXPECT_EQ(pixelAt({0.55f, 0.5f}, {10, 20}), glm::ivec2(5, 10));
    for (int x = 0; x < 983; ++x) EXPECT_EQ(pixelAt({float(x) / 983.0f, 0.5f}, {983, 20}).x, x);
    EXPECT_EQ(pixelAt({1.0f, -0.1f}, {10, 20}), glm::ivec2(9, 0)) << "the nearest one";
}

TEST(Inspection, itsLinesReportBothSidesAndTheirDifference) {
    Inspection inspection;
    inspection.pixel = {606, 303};
    inspection.sizePixels = {980, 778};
    inspection.sides[0] = {{0.5f, 0.25f, 2.0f, 1.0f}, {188, 137, 255, 255}};
    EXPECT_THAT(inspectionLines(inspection),
                ElementsAre("606, 303 of 980x778", "linear 0.5 0.25 2", "shown #bc89ff  188 137 255"));
    inspection.sides[1] = {{12.0f, 0.0f, 0.0f, 1.0f}, {188, 99, 255, 255}, frame::DebugView::Lights};
    EXPECT_THAT(inspectionLines(inspection),
                ElementsAre("606, 303 of 980x778", "Left", "linear 0.5 0.25 2", "shown #bc89ff  188 137 255", "Right",
                            "lights 12", "shown #bc63ff  188 99 255"))
        << "of two views there is no difference";
    inspection.sides[1] = {{0.5f, 0.125f, 3.0f, 1.0f}, {188, 99, 255, 255}};
    inspection.isSurfaceKnown = true;
    EXPECT_THAT(inspectionLines(inspection),
                ElementsAre("606, 303 of 980x778", "Left", "linear 0.5 0.25 2", "shown #bc89ff  188 137 255", "Right",
                            "linear 0.5 0.125 3", "shown #bc63ff  188 99 255", "difference 0 0.125 -1", "no surface"));
    inspection.sides[1].reset();
    inspection.surface = {"paint", 3.5, {0.6, -0.0, 0.8}, {0.0, 0.0, 1.0}, 1};
    EXPECT_THAT(inspectionLines(inspection),
                ElementsAre("606, 303 of 980x778", "linear 0.5 0.25 2", "shown #bc89ff  188 137 255", "material paint",
                            "depth 3.5 m", "shading normal 0.6 0 0.8", "face normal 0 0 1", "1 light reaches it"));
}

TEST(Inspection, itsLinesReportTheLightsThatEachSideVisitsAndOnceThoseThatReachThePlace) {
    Inspection inspection;
    inspection.sides[0].emplace().visitedLights = 38;
    inspection.isSurfaceKnown = true;
    inspection.surface.emplace().reachingLights = 12;
    EXPECT_EQ(inspectionLines(inspection).back(), "visits 38 lights, 12 reach it");
    inspection.sides[0]->visitedLights = 1;
    inspection.surface->reachingLights = 1;
    EXPECT_EQ(inspectionLines(inspection).back(), "visits 1 light, 1 reaches it");
    inspection.sides[1].emplace().visitedLights = 1024;
    const auto compared = [&] {
        std::vector<std::string> counts;
        for (const std::string& line : inspectionLines(inspection))
            if (line == "Left" || line == "Right" || line.find("light") != std::string::npos) counts.push_back(line);
        return counts;
    };
    EXPECT_THAT(compared(), ElementsAre("Left", "visits 1 light", "Right", "visits 1024 lights", "1 light reaches it"));
    inspection.sides[0]->visitedLights.reset();
    EXPECT_THAT(compared(), ElementsAre("Left", "Right", "visits 1024 lights", "1 light reaches it"))
        << "of one side it is not known";
}

TEST(Inspection, ofWhatTakesNoLightNoneAreVisitedAndOfWhatIsTransparentItIsNotKnown) {
    InspectedSurface surface;
    EXPECT_EQ(visitsOf(surface, 38), 38u);
    EXPECT_EQ(visitsOf(surface, std::nullopt), std::nullopt);
    surface.isLit = false;
    EXPECT_EQ(visitsOf(surface, 38), 0u);
    surface.isTransparent = true;
    EXPECT_EQ(visitsOf(surface, 38), std::nullopt);
}

TEST(Inspection, whereAHookMovesVerticesItIsNotKnownHowManyLightsAreVisited) {
    scenes::Scene scene = quadScene({});
    const auto visited = [&] {
        const scenes::Camera camera = perspective({0, 0, 5}, {0, 0, 0});
        return visitsOf(surfaceAt(scene, camera, {100, 100}, {50, 50}, 0.0).value(), 38);
    };
    EXPECT_EQ(visited(), 38u);
    scene.hook.emplace();
    EXPECT_EQ(visited(), 38u) << "a hook that changes surfaces alone leaves them where they are";
    scene.hook->movesVertices = true;
    EXPECT_EQ(visited(), std::nullopt) << "the ray finds the surface where the hook found it";
    scene.materials[0].model = scenes::MaterialModel::SingleColor;
    EXPECT_EQ(visited(), std::nullopt) << "the picture may show another one, which takes light";
}

TEST(Inspection, theSurfaceOfAPixelFacesTheViewerAndCountsTheLightsThatReachIt) {
    scenes::Material paint;
    paint.name = "paint";
    paint.doubleSided = true;
    scenes::Scene scene = quadScene(paint);
    scene.lights.resize(3);
    scene.lights[0].positionWS = scene.lights[1].positionWS = scene.lights[2].positionWS = {0.0, 0.0, 2.0};
    scene.lights[1].rangeMetres = 1.0f;
    scene.lights[2].enabled = false;
    const auto at = [&](const scenes::Camera& camera, glm::ivec2 pixel) {
        return surfaceAt(scene, camera, {100, 100}, pixel, 0.0);
    };
    for (const double side : {1.0, -1.0}) {
        const auto front = at(perspective({0, 0, 5.0 * side}, {0, 0, 0}), {50, 50});
        ASSERT_TRUE(front);
        const glm::dvec3 normalWS(0.0, 0.0, side);
        EXPECT_EQ(front->material, "paint");
        EXPECT_NEAR(front->depthMetres, 5.0, 1e-9);
        EXPECT_LT(glm::distance(front->faceNormalWS, normalWS), 1e-9);
        EXPECT_LT(glm::distance(front->shadingNormalWS, normalWS), 1e-9);
        EXPECT_TRUE(front->isLit);
        EXPECT_FALSE(front->isTransparent);
        EXPECT_EQ(front->reachingLights, 1u);
    }
    EXPECT_NEAR(at(orthographic({0, 0, 7}, {0, 0, 0}, 2.0), {70, 30}).value().depthMetres, 7.0, 1e-9);
    EXPECT_FALSE(at(perspective({0, 0, 5}, {0, 0, 0}), {1, 1}));
    scene.materials[0].model = scenes::MaterialModel::SingleColor;
    scene.materials[0].alphaMode = scenes::AlphaMode::Blend;
    const auto pane = at(perspective({0, 0, 5}, {0, 0, 0}), {50, 50});
    ASSERT_TRUE(pane);
    EXPECT_FALSE(pane->isLit);
    EXPECT_TRUE(pane->isTransparent);
}

TEST(Inspection, theShadingNormalLiesBetweenTheVerticesNormalsUnlessAMapReplacesIt) {
    scenes::Scene scene = quadScene({});
    scene.meshes[0].normalsOS = {{-0.6f, 0, 0.8f}, {0.6f, 0, 0.8f}, {0.6f, 0, 0.8f}, {-0.6f, 0, 0.8f}};
    const auto inspected = [&] {
        return surfaceAt(scene, orthographic({0, 0, 5}, {0, 0, 0}, 2.0), {100, 100}, {62, 30}, 0.0).value();
    };
    constexpr double kRounding = 1e-7;                // rounding of the vertices' normals to fp32
    const double across = (62.5 - 50.0) / 50.0 * 2.0; // offset of the pixel's centre, metres
    EXPECT_LT(glm::distance(inspected().shadingNormalWS, glm::normalize(glm::dvec3(0.6 * across, 0.0, 0.8))),
              kRounding);
    EXPECT_LT(glm::distance(inspected().faceNormalWS, glm::dvec3(0.0, 0.0, 1.0)), 1e-9);
    scenes::Image& map = scene.images.emplace_back();
    map.width = map.height = 1;
    map.texels = {std::byte{51}, std::byte{204}, std::byte{230}, std::byte{255}};
    scene.materials[0].texture(scenes::TextureSlot::Normal).image = 0;
    scene.materials[0].normalMapSpace = scenes::NormalMapSpace::Object;
    const glm::dvec3 texel = 2.0 * glm::dvec3(51.0, 204.0, 230.0) / 255.0 - 1.0;
    EXPECT_LT(glm::distance(inspected().shadingNormalWS, glm::normalize(texel)), kRounding);
    EXPECT_LT(glm::distance(inspected().faceNormalWS, glm::dvec3(0.0, 0.0, 1.0)), 1e-9);
}

TEST(Inspection, aPlaceHasOnePinWhichIsCompletedButKeepsItsValues) {
    std::vector<PinnedInspection> pins;
    const glm::vec2 place(0.5f), other(0.25f);
    const auto keep = [&](std::vector<std::string> lines, bool isRequested) {
        keepPin(pins, place, lines, isRequested);
    };
    keep({"linear 1"}, false);
    EXPECT_TRUE(pins.empty());
    keep({"linear 1"}, true);
    keep({"linear 1", "depth 2"}, false);
    EXPECT_EQ(pins.at(0).lines.size(), 2u) << "the surface was found";
    keep({"linear 3", "depth 2"}, false);
    EXPECT_EQ(pins.at(0).lines[0], "linear 1") << "an edit changes no pin";
    keep({"linear 3", "depth 2"}, true);
    keepPin(pins, other, {"linear 4"}, true);
    ASSERT_EQ(pins.size(), 2u);
    EXPECT_EQ(pins[0].lines[0], "linear 3");
}

} // namespace
} // namespace tessera::viewer
