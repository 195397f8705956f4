// Pixels with other triangles than the reference: excluded if rounding explains them, else lost geometry by name.

#include <gmock/gmock.h>

#include "scenes/builtin/Author.h"
#include "tests/image/ImageTest.h"
#include "tests/support/Random.h"
#include "tests/support/ShaderMutant.h"
#include "validation/compare/ShownTriangles.h"
#include "validation/compare/TechniqueCompare.h"
#include "validation/stress/StressScene.h"

namespace tessera {
namespace {

using validation::LostGeometry;
using validation::LostKind;
using validation::ShownTriangles;
using namespace test;

/// Shaders that move one mesh instance out of the image, counted from 0.
class Without : public ShaderMutant {
public:
    explicit Without(std::uint32_t instance) {
        replace("passes/geometry.vert", "gl_Position = clip;",
                fmt::format("gl_Position = drawNormal2.w == {}.0 ? vec4(2.0, 2.0, 2.0, 1.0) : clip;", instance + 1));
    }
};

class LostGeometryTest : public ImageTest {
protected:
    ShownTriangles shown(const scenes::Scene& scene, const frame::FrameSettings& settings,
                         const std::vector<reference::Ids>& ids, const shader::SourceTree& shaders = {}) {
        engine::Renderer renderer(context(), scene, shaders);
        return validation::shownTriangles(renderer, settings, ids);
    }

    /// Drops every instance of a scene in turn, or every third. An instance visible to the reference must be reported
    /// first, as missing from about as many pixels; a hidden one loses nothing.
    void expectEveryInstanceNamed(const scenes::Scene& scene, const frame::FrameSettings& settings) {
        const std::vector<reference::Ids> ids = validation::referencePicture(scene, settings).ids;
        std::uint32_t count = 0;
        for (const scenes::Node& node : scene.nodes) count += std::uint32_t(node.instances.size());
        std::size_t seen = 0, tried = 0;
        for (std::uint32_t instance = 0; instance < count; instance += isWholeSweep() ? 1 : 3) {
            ++tried;
            SCOPED_TRACE(fmt::format("{} without instance {}", scene.name, instance));
            const auto opaque = std::count_if(ids.begin(), ids.end(),
                                              [&](const reference::Ids& own) { return own.object == instance + 1; });
            const ShownTriangles found = shown(scene, settings, ids, Without(instance).tree());
            // Hidden, or so few pixels that all may lie within 1/128 of one from its edge.
            if (opaque <= 2 && found.lost.empty()) continue;
            ASSERT_FALSE(found.lost.empty()) << opaque << " pixels show it";
            EXPECT_EQ(found.lost.front().kind, LostKind::Missing);
            EXPECT_EQ(found.lost.front().instance, instance) << validation::lostText(found.lost.front());
            // All but its edge: 1 in 30 centres may lie within 1/128 of a pixel of it.
            EXPECT_GE(double(found.lost.front().pixels), 0.9 * double(opaque) - 1.0);
            ++seen;
        }
        fmt::print("{}: {} of {} instances are seen, and named where they are dropped\n", scene.name, seen, tried);
        EXPECT_GT(seen, tried / 2);
    }
};

TEST_SWEEP_AS(LostGeometryTest, everyInstanceOfModelsThatIsDroppedIsNamed, LostGeometrySlow,
              everyInstanceOfModelsThatIsDroppedIsNamed) {
    expectEveryInstanceNamed(scenes::loadScene("models"), exactOfSize(160, 90));
}

/// With glass, masks, mirrored nodes.
TEST_SWEEP_AS(LostGeometryTest, everyInstanceOfTheSceneOfEveryFeatureThatIsDroppedIsNamed, LostGeometrySlow,
              everyInstanceOfTheSceneOfEveryFeatureThatIsDroppedIsNamed) {
    expectEveryInstanceNamed(everythingScene(), exactOfSize(96, 54));
}

TEST_F(LostGeometryTest, compareNeverHoldsWhereAnInstanceOfTheHallIsDropped) {
    const scenes::Scene scene = scenes::loadScene("hall");
    const frame::FrameSettings settings = exactOfSize(160, 90);
    const std::vector<reference::Ids> ids = validation::referencePicture(scene, settings).ids;
    std::size_t seen = 0;
    for (const std::uint32_t instance : {4u, 5u, 11u, 12u, 29u, 30u}) {
        if (std::none_of(ids.begin(), ids.end(), [&](const reference::Ids& own) { return own.object == instance + 1; }))
            continue; // hidden
        ++seen;
        const ShownTriangles found = shown(scene, settings, ids, Without(instance).tree());
        ASSERT_FALSE(found.lost.empty()) << instance;
        EXPECT_EQ(found.lost.front().instance, instance);
        fmt::print("{}\n", validation::lostText(found.lost.front()));
        validation::Verdict verdict{true, {}};
        validation::missLostGeometry(verdict, found.lost);
        EXPECT_FALSE(verdict.ok);
        EXPECT_THAT(verdict.missed, testing::ElementsAre(testing::HasSubstr(fmt::format("instance {} ", instance))));
    }
    EXPECT_GE(seen, 3u);
}

/// The stress floor viewed straight from above, with a mesh 10 cm above it. Metres are pixels / (height / 2).
scenes::Scene floorWith(scenes::Mesh above) {
    namespace builtin = scenes::builtin;
    scenes::Scene scene = validation::stressFloor();
    scene.lights = {validation::stressLight({0.3, 1.0, 0.2}, 1.0f)};
    scene.materials.push_back(builtin::lambert("dark", glm::vec3(0.2f)));
    scene.materials.back().doubleSided = true;
    builtin::addNode(scene, "speck", glm::dmat4(1.0), {{builtin::addMesh(scene, "square", std::move(above)), 1}});
    return scene;
}

TEST_F(LostGeometryTest, anInstanceOfOnePixelThatIsDroppedIsNamed) {
    scenes::Mesh square;
    scenes::builtin::appendFloor(square, {0.0, 0.1, 0.0}, glm::dvec2(2.0 / 33.0), {1, 1}); // the pixel 16,16 of 33
    const scenes::Scene scene = floorWith(std::move(square));
    const frame::FrameSettings settings = exactOfSize(33, 33);
    const std::vector<reference::Ids> ids = validation::referencePicture(scene, settings).ids;
    EXPECT_TRUE(shown(scene, settings, ids).lost.empty());
    const ShownTriangles found = shown(scene, settings, ids, Without(1).tree());
    ASSERT_EQ(found.lost.size(), 1u);
    EXPECT_EQ(validation::lostText(found.lost.front()),
              "instance 1 (node 'speck', mesh 'square') is missing from 1 pixel, such as 16,16");
    // The inverse: it grows over eight pixels that show the floor.
    ShaderMutant larger;
    larger.replace("passes/geometry.vert", "gl_Position = clip;",
                   "gl_Position = drawNormal2.w == 2.0 ? clip * vec4(3.0, 3.0, 1.0, 1.0) : clip;");
    const ShownTriangles grown = shown(scene, settings, ids, larger.tree());
    ASSERT_EQ(grown.lost.size(), 1u);
    EXPECT_EQ(grown.lost.front().instance, 0u);
    EXPECT_EQ(grown.lost.front().pixels, 8u);
}

TEST_F(LostGeometryTest, geometryThatCoversOnlyBackgroundIsReportedAsExtra) {
    scenes::Mesh square;
    scenes::builtin::appendFloor(square, {0.0, 0.1, 0.0}, glm::dvec2(2.0 / 33.0), {1, 1});
    scenes::Scene scene = floorWith(std::move(square));
    scene.nodes.erase(scene.nodes.begin());
    const frame::FrameSettings settings = exactOfSize(33, 33);
    const std::vector<reference::Ids> ids = validation::referencePicture(scene, settings).ids;
    ShaderMutant larger;
    larger.replace("passes/geometry.vert", "gl_Position = clip;", "gl_Position = clip * vec4(3.0, 3.0, 1.0, 1.0);");
    const ShownTriangles grown = shown(scene, settings, ids, larger.tree());
    ASSERT_EQ(grown.lost.size(), 1u);
    EXPECT_EQ(grown.lost.front().kind, LostKind::Extra);
    EXPECT_EQ(grown.lost.front().instance, 0u);
    EXPECT_EQ(grown.lost.front().pixels, 8u);
}

TEST_F(LostGeometryTest, aMeshThatFillsThePictureAndIsDroppedIsNamed) {
    scenes::Mesh square;
    scenes::builtin::appendFloor(square, {0.013, 0.1, 0.0}, {2.2, 2.2}, {1, 1});
    const scenes::Scene scene = floorWith(std::move(square));
    const frame::FrameSettings settings = exactOfSize(64, 64);
    const std::vector<reference::Ids> ids = validation::referencePicture(scene, settings).ids;
    const ShownTriangles found = shown(scene, settings, ids, Without(1).tree());
    ASSERT_FALSE(found.lost.empty());
    EXPECT_EQ(found.lost.front().instance, 1u);
    EXPECT_EQ(found.lost.front().pixels, 64u * 64u);
    EXPECT_EQ(std::count(found.excluded.begin(), found.excluded.end(), 1), 0);
}

/// Wires as wide as a pixel down to 1/500 of one: a wire in only one of the two images is rounding, on any background.
TEST_F(LostGeometryTest, sliversThatOnlyOneOfTheTwoShowsNeverCountAsLost) {
    constexpr int kSide = 256;
    constexpr double kPixel = 2.0 / kSide;
    Random random(7);
    std::size_t differing = 0;
    for (int picture = 0; picture < 8; ++picture) {
        scenes::Mesh wires;
        for (std::uint32_t i = 0; i < 60; ++i) {
            const double angle = random.between(0.0, pi), width = random.logarithmic(kPixel / 500.0, kPixel);
            const glm::dvec3 along(std::cos(angle), 0.0, std::sin(angle)), across(-along.z, 0.0, along.x);
            const glm::dvec3 begin(random.between(-0.9, 0.9), 0.1 + 1e-3 * i, random.between(-0.9, 0.9));
            const glm::dvec3 end = begin + random.between(0.1, 0.8) * along;
            for (const glm::dvec3& corner : {begin, begin + width * across, end}) {
                wires.positionsOS.emplace_back(corner);
                wires.normalsOS.emplace_back(0.0f, 1.0f, 0.0f);
                wires.indices.push_back(std::uint32_t(wires.indices.size()));
            }
        }
        const scenes::Scene scene = floorWith(std::move(wires));
        const frame::FrameSettings settings = exactOfSize(kSide, kSide);
        const ShownTriangles found = shown(scene, settings, validation::referencePicture(scene, settings).ids);
        for (const LostGeometry& lost : found.lost) ADD_FAILURE() << validation::lostText(lost);
        differing += std::size_t(std::count(found.excluded.begin(), found.excluded.end(), 1));
    }
    fmt::print("{} pixels of wires differ, all explained\n", differing);
    EXPECT_GT(differing, 20u);
}

TEST_F(LostGeometryTest, holesOfMasksThatHardwareFiltersNeverCountAsLost) {
    const scenes::Scene scene = everythingScene();
    frame::FrameSettings settings = exactOfSize(96, 54);
    settings.filter = frame::TextureFilter::Hardware;
    EXPECT_TRUE(shown(scene, settings, validation::referencePicture(scene, settings).ids).lost.empty());
}

/// Drivers may move the border of a hole, but not drop the mask.
TEST_F(LostGeometryTest, aMaskThatHardwareFiltersIsNamedWhereItIsDropped) {
    frame::FrameSettings settings = exactOfSize(96, 54);
    settings.filter = frame::TextureFilter::Hardware;
    expectEveryInstanceNamed(everythingScene(), settings);
}

/// The drawing order decides which of two coplanar triangles is visible.
TEST_F(LostGeometryTest, trianglesInOnePlaceAreComparedWithTheOneThatIsShown) {
    for (const bool swapped : {false, true}) {
        scenes::Mesh square;
        scenes::builtin::appendFloor(square, {0.013, 0.1, 0.0}, {2.2, 2.2}, {1, 1});
        scenes::Scene scene = floorWith(std::move(square));
        scenes::Node twin = scene.nodes.back();
        twin.instances[0].material = 0;
        scene.nodes.push_back(twin);
        if (swapped) std::swap(scene.nodes[1], scene.nodes[2]);
        frame::FrameSettings settings = exactOfSize(64, 64);
        engine::Renderer renderer(context(), scene);
        for (const frame::TextureFilter filter : {frame::TextureFilter::Exact, frame::TextureFilter::Hardware}) {
            settings.filter = filter;
            validation::CompareRequest request;
            request.techniques = {engine::Technique::Deferred};
            request.against = validation::Reference{};
            request.settings = settings;
            const validation::CompareRecord record =
                validation::compareTechniques(renderer, context().capabilities(), request).record;
            EXPECT_TRUE(record.ok()) << validation::compareTable(record);
            EXPECT_EQ(record.pairs[0].figures.excluded, 0.0);
        }
        const ShownTriangles found =
            shown(scene, settings, validation::referencePicture(scene, settings).ids, Without(1).tree());
        EXPECT_TRUE(found.lost.empty()) << "the other of the two fills its place";
    }
}

} // namespace
} // namespace tessera
