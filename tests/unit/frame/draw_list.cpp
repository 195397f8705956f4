#include "renderer/frame/DrawList.h"

#include <algorithm>
#include <tuple>

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>

#include "tests/support/Random.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::frame {
namespace {

using testing::ElementsAre;

CameraView viewOf(const scenes::Camera& camera, LightingSpace space = LightingSpace::World,
                  std::span<const SurfaceBounds> bounds = {}) {
    return makeCameraView(camera, {64, 64}, space, glm::vec3(0.0f), bounds);
}

CameraView defaultView(LightingSpace space = LightingSpace::World) {
    scenes::Camera camera;
    camera.worldFromCamera =
        glm::translate(glm::dmat4(1.0), {1.0, 2.0, 3.0}) * glm::rotate(glm::dmat4(1.0), 0.4, {0.6, 0.8, 0.0});
    return viewOf(camera, space);
}

/// Opaque, masked and blended materials on nodes, some of them mirrored, and a mesh without triangles.
scenes::Scene mixedScene() {
    scenes::Scene scene = scenes::tinyScene();
    scene.materials.resize(4);
    scene.materials[1].alphaMode = scenes::AlphaMode::Mask;
    scene.materials[2].alphaMode = scenes::AlphaMode::Blend;
    scene.meshes.push_back(scene.meshes[0]);
    scene.meshes.emplace_back(); // nothing to draw
    scene.nodes.clear();
    for (int i = 0; i < 12; ++i) {
        scenes::Node& node = scene.nodes.emplace_back();
        const double mirror = i % 3 == 0 ? -1.0 : 1.0;
        node.parentFromNode =
            glm::translate(glm::dmat4(1.0), {0.0, 0.0, -double(i)}) * glm::scale(glm::dmat4(1.0), {mirror, 1.0, 1.0});
        node.instances = {{i % 2, (3 * i) % 4}, {2, 0}, {0, 2}};
    }
    return scene;
}

TEST(DrawList, depthIsAlwaysDrawnInOrderAndSplitOnlyWhereHolesOrThePipelineStateNeedIt) {
    scenes::Scene scene = mixedScene(); // material 1 is masked
    scene.materials[3].doubleSided = true;
    const std::vector<Batch> batches{{0, 2, 0, false}, {2, 3, 2, false}, {5, 1, 2, true},  {6, 2, 1, true},
                                     {8, 1, 1, false}, {9, 1, 3, false}, {11, 1, 3, false}};
    std::vector<std::tuple<int, int, bool, bool, int>> drawn;
    for (const DepthBatch& batch : depthBatches(scene, batches))
        drawn.emplace_back(batch.first, batch.count, batch.mirrored, batch.doubleSided, batch.maskedBy.value_or(-1));
    using Drawn = std::tuple<int, int, bool, bool, int>;
    EXPECT_THAT(drawn,
                ElementsAre(Drawn(0, 5, false, false, -1), Drawn(5, 1, true, false, -1), Drawn(6, 2, true, false, 1),
                            Drawn(8, 1, false, false, 1), Drawn(9, 1, false, true, -1), Drawn(11, 1, false, true, -1)));
}

TEST(DrawList, batchesCoverEveryDrawExactlyOnce) {
    const scenes::Scene scene = mixedScene();
    const DrawList list = makeDrawList(scene);
    EXPECT_EQ(list.draws.size(), 24u); // 12 nodes x 2 meshes that have triangles
    for (std::size_t i = 0; i < list.draws.size(); ++i)
        EXPECT_EQ(list.draws[i].material == 2, int(i) >= list.firstTransparent) << "blended ones are last: " << i;
    const ViewDraws view = makeViewDraws(list, defaultView(), false);
    EXPECT_EQ(view.seen.size(), list.draws.size());
    std::vector<int> drawn(list.draws.size(), 0);
    std::vector<Batch> batches = view.opaque;
    for (const Batch& batch : view.transparent) batches.push_back(batch);
    for (const Batch& batch : batches) {
        for (int i = batch.first; i < batch.first + batch.count; ++i) {
            ++drawn.at(std::size_t(i));
            EXPECT_EQ(list.draws[std::size_t(i)].material, batch.material);
            EXPECT_EQ(list.draws[std::size_t(i)].mirrored, batch.mirrored);
        }
    }
    EXPECT_THAT(drawn, testing::Each(1));
    std::vector<std::tuple<int, int, int>> expected, found;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node)
        for (const scenes::MeshInstance& instance : scene.nodes[node].instances)
            if (instance.mesh != 2) expected.emplace_back(int(node), instance.mesh, instance.material);
    for (const Draw& draw : list.draws) found.emplace_back(draw.node, draw.mesh, draw.material);
    EXPECT_THAT(found, testing::UnorderedElementsAreArray(expected));
}

TEST(DrawList, batchesOfTheSameMaterialAndWindingAreNotApart) {
    const ViewDraws view = makeViewDraws(makeDrawList(mixedScene()), defaultView(), false);
    std::vector<std::pair<int, bool>> seen;
    for (const Batch& batch : view.opaque) seen.emplace_back(batch.material, batch.mirrored);
    EXPECT_TRUE(std::is_sorted(seen.begin(), seen.end()));
    EXPECT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end());
}

TEST(DrawList, transparentDrawsRunFarToNearWithTiesInDocumentOrder) {
    scenes::Scene scene = scenes::tinyScene();
    scene.materials[0].alphaMode = scenes::AlphaMode::Blend;
    scene.nodes.clear();
    for (const double z : {-5.0, -9.0, -5.0, -1.0, -9.0}) {
        scenes::Node& node = scene.nodes.emplace_back();
        node.parentFromNode = glm::translate(glm::dmat4(1.0), {0.0, 0.0, z});
        node.instances = {{0, 0}};
    }
    const CameraView view = viewOf({});
    const DrawList list = makeDrawList(scene);
    const ViewDraws draws = makeViewDraws(list, view, false);
    std::vector<int> nodes;
    for (const Batch& batch : draws.transparent) nodes.push_back(list.draws[std::size_t(batch.first)].node);
    EXPECT_THAT(nodes, ElementsAre(1, 4, 0, 2, 3));
    EXPECT_TRUE(draws.opaque.empty());
}

TEST(DrawList, anEmptySceneDrawsNothing) {
    scenes::Scene scene;
    const DrawList list = makeDrawList(scene);
    const ViewDraws view = makeViewDraws(list, defaultView(), true);
    EXPECT_TRUE(list.draws.empty() && view.seen.empty() && view.rows.empty());
    EXPECT_TRUE(view.opaque.empty() && view.transparent.empty());
}

/// Identifies each draw of the batches by its index and an entry of its rows.
std::vector<std::pair<int, float>> drawn(const ViewDraws& view, const std::vector<Batch>& batches) {
    std::vector<std::pair<int, float>> result;
    for (const Batch& batch : batches)
        for (int i = batch.first; i < batch.first + batch.count; ++i)
            result.emplace_back(view.seen.at(std::size_t(i)), view.rows.at(std::size_t(i)).normal[2].w);
    return result;
}

/// Returns whether any of a grid of points in the box is within the four sides of the view, in double precision.
bool someOfItIsInside(const scenes::Box3& box, const CameraView& view) {
    constexpr int kSteps = 8;
    for (int x = 0; x <= kSteps; ++x)
        for (int y = 0; y <= kSteps; ++y)
            for (int z = 0; z <= kSteps; ++z) {
                const glm::dvec3 point = glm::mix(box.min, box.max, glm::dvec3(x, y, z) / double(kSteps));
                const glm::dvec4 clip = view.clipFromLS * glm::dvec4(view.positionLS(point), 1.0);
                if (std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && clip.w > 0.0) return true;
            }
    return false;
}

TEST(ViewDraws, drawsThatRoundingMayMoveIntoTheViewAreKept) {
    // Vertices 1000 km from their object's origin, which single precision moves by centimetres. They are 2 cm and 200 m
    // outside the frustum of 45 degrees.
    scenes::Scene scene = scenes::tinyScene();
    for (glm::vec3& position : scene.meshes[0].positionsOS) position = glm::vec3(1e6f, 0.0f, 0.0f) + 0.01f * position;
    const CameraView view = viewOf({});
    for (const auto& [besideMetres, seen] : {std::pair(0.02, 1u), std::pair(200.0, 0u)}) {
        const double edgeMetres = 10.0 * std::tan(0.5 * scenes::Camera{}.fovYRadians);
        scene.nodes[0].parentFromNode = glm::translate(glm::dmat4(1.0), {edgeMetres + besideMetres - 1e6, 0.0, -10.0});
        EXPECT_EQ(makeViewDraws(makeDrawList(scene), view, true).seen.size(), seen) << besideMetres;
    }
}

/// Returns whether passes/geometry.vert, in single precision, puts a vertex inside the four sides of the view.
bool isShownInside(const DrawRows& rows, const glm::vec3& positionOS, const CameraView& view) {
    const glm::vec4 object(positionOS, 1.0f);
    const glm::vec3 positionRWS(glm::dot(rows.position[0], object), glm::dot(rows.position[1], object),
                                glm::dot(rows.position[2], object));
    const glm::vec4 clip = view.constants.clipFromRWS * glm::vec4(positionRWS, 1.0f);
    return clip.w > 0.0f && std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w;
}

glm::dmat4 randomPlace(test::Random& random, double farthestMetres) {
    return glm::translate(glm::dmat4(1.0), random.logarithmic(1.0, farthestMetres) * random.direction()) *
           glm::rotate(glm::dmat4(1.0), random.between(0.0, 6.0), random.direction());
}

/// Objects of one vertex each at view depths within these bounds, on the sides of the view or just beside them: by at
/// most 3e-7 of the distances summed on the way, about the error of single precision.
struct SideScene {
    scenes::Scene scene = scenes::tinyScene();
    SideScene(test::Random& random, const scenes::Camera& camera, const CameraView& view, double nearestMetres,
              double farthestMetres) {
        scene.nodes.clear();
        scene.meshes.resize(40, scene.meshes[0]);
        for (int i = 0; i < int(scene.meshes.size()); ++i) {
            const glm::vec3 positionOS(random.logarithmic(1e-2, 1e6) * random.direction());
            scene.meshes[std::size_t(i)].positionsOS.assign(3, positionOS);
            const double depthMetres = random.logarithmic(nearestMetres, farthestMetres);
            const double half = depthMetres * std::tan(0.5 * camera.fovYRadians);
            const int axis = random.index(2);
            glm::dvec3 placeVS(random.between(-0.9, 0.9) * half, random.between(-0.9, 0.9) * half, -depthMetres);
            placeVS[axis] = random.index(2) == 0 ? half : -half;
            const glm::dvec3 onSideWS(camera.worldFromCamera * glm::dvec4(placeVS, 1.0));
            const double summedMetres = double(glm::length(positionOS)) + glm::distance(onSideWS, view.originWS);
            placeVS[axis] *= 1.0 + random.between(-1e-7, 3e-7) * summedMetres / half;
            const glm::dvec3 placeWS(camera.worldFromCamera * glm::dvec4(placeVS, 1.0));
            const glm::dmat4 turn = glm::rotate(glm::dmat4(1.0), random.between(0.0, 6.0), random.direction());
            scenes::Node& node = scene.nodes.emplace_back();
            node.parentFromNode =
                glm::translate(glm::dmat4(1.0), placeWS - glm::dvec3(turn * glm::dvec4(positionOS, 1.0))) * turn;
            node.instances = {{i, 0}};
        }
    }
};

/// Expects draws whose vertex is inside the view to be kept. Returns how many are inside by rounding alone.
int expectShownDrawsKept(const scenes::Scene& scene, const CameraView& view) {
    const DrawList list = makeDrawList(scene);
    const ViewDraws whole = makeViewDraws(list, view, false), culled = makeViewDraws(list, view, true);
    int moved = 0;
    for (std::size_t i = 0; i < whole.seen.size(); ++i) {
        const Draw& draw = list.draws[std::size_t(whole.seen[i])];
        const glm::vec3& positionOS = scene.meshes[std::size_t(draw.mesh)].positionsOS[0];
        if (!isShownInside(whole.rows[i], positionOS, view)) continue;
        moved += !someOfItIsInside(draw.boxWS, view);
        EXPECT_TRUE(std::binary_search(culled.seen.begin(), culled.seen.end(), whole.seen[i])) << "draw " << i;
    }
    return moved;
}

TEST(ViewDraws, aVertexThatRoundingShowsInTheViewIsNeverCulled) {
    test::Random random(7);
    int moved = 0;
    for (int round = 0; round < 100; ++round) {
        scenes::Camera camera;
        camera.worldFromCamera = randomPlace(random, 1e6);
        camera.fovYRadians = random.logarithmic(0.01, 2.0);
        const CameraView view = viewOf(camera, round % 2 == 0 ? LightingSpace::World : LightingSpace::View);
        EXPECT_EQ(view.originWS, view.eyeWS);
        moved += expectShownDrawsKept(SideScene(random, camera, view, 1.0, 1e6).scene, view);
    }
    EXPECT_GT(moved, 100) << "otherwise nothing is tested";
}

TEST(ViewDraws, aVertexThatRoundingShowsInAViewFromAfarIsNeverCulled) {
    test::Random random(8);
    int moved = 0;
    for (int round = 0; round < 100; ++round) {
        scenes::Camera camera;
        camera.worldFromCamera = randomPlace(random, 1e6);
        camera.fovYRadians = random.logarithmic(1e-4, 0.1);
        const double distanceMetres = random.logarithmic(1e2, 1e6), radiusMetres = 0.1 * distanceMetres;
        const glm::dvec3 middleWS(camera.worldFromCamera * glm::dvec4(0.0, 0.0, -distanceMetres, 1.0));
        const SurfaceBounds bounds{{middleWS - radiusMetres, middleWS + radiusMetres}, radiusMetres};
        const LightingSpace space = round % 2 == 0 ? LightingSpace::World : LightingSpace::View;
        const CameraView view = viewOf(camera, space, std::span(&bounds, 1));
        EXPECT_GT(glm::distance(view.originWS, view.eyeWS), 0.5 * distanceMetres) << "lighting space is at the eye";
        const SideScene sides(random, camera, view, distanceMetres - radiusMetres, distanceMetres + radiusMetres);
        moved += expectShownDrawsKept(sides.scene, view);
        // A vertex twice as far from the axis is outside by more than any rounding.
        scenes::Scene outside = scenes::tinyScene();
        outside.nodes[0].parentFromNode = glm::translate(
            glm::dmat4(1.0), glm::dvec3(camera.worldFromCamera *
                                        glm::dvec4(2.0 * distanceMetres * std::tan(0.5 * camera.fovYRadians) + 10.0,
                                                   0.0, -distanceMetres, 1.0)));
        EXPECT_TRUE(makeViewDraws(makeDrawList(outside), view, true).seen.empty());
    }
    EXPECT_GT(moved, 100) << "otherwise nothing is tested";
}

TEST(ViewDraws, visibleDrawsKeepOrderAndRowsAndTheRestIsCulled) {
    test::Random random(5);
    std::size_t left = 0, all = 0;
    for (int round = 0; round < 200; ++round) {
        scenes::Scene scene = mixedScene();
        for (scenes::Node& node : scene.nodes)
            node.parentFromNode = glm::translate(glm::dmat4(1.0), 20.0 * random.direction()) * node.parentFromNode;
        const DrawList list = makeDrawList(scene);
        const CameraView view = defaultView(round % 2 == 0 ? LightingSpace::World : LightingSpace::View);
        const ViewDraws whole = makeViewDraws(list, view, false), culled = makeViewDraws(list, view, true);
        const auto isLeft = [&](const std::pair<int, float>& draw) {
            return std::find(culled.seen.begin(), culled.seen.end(), draw.first) == culled.seen.end();
        };
        for (const auto member : {&ViewDraws::opaque, &ViewDraws::transparent}) {
            std::vector<std::pair<int, float>> expected = drawn(whole, whole.*member);
            std::erase_if(expected, isLeft);
            EXPECT_EQ(drawn(culled, culled.*member), expected);
        }
        for (std::size_t i = 0; i < list.draws.size(); ++i) {
            if (!isLeft({int(i), 0.0f})) continue;
            ++left;
            EXPECT_FALSE(someOfItIsInside(list.draws[i].boxWS, view)) << "round " << round << ", draw " << i;
        }
        all += list.draws.size();
    }
    EXPECT_GT(double(left), 0.5 * double(all)) << "most of a sphere of 20 m around lies outside a view of 45 degrees";
}

/// The pixel bounds of boxes of half a metre at these view-space positions.
PixelArea pixelsOfBoxes(const std::vector<glm::dvec3>& placesVS, const scenes::Camera& camera, const CameraView& view) {
    scenes::Scene scene = scenes::tinyScene();
    scene.meshes[0].positionsOS = {glm::vec3(-0.25f), glm::vec3(0.25f), glm::vec3(-0.25f, 0.25f, -0.25f)};
    scene.nodes.clear();
    for (const glm::dvec3& place : placesVS) {
        scenes::Node& node = scene.nodes.emplace_back();
        node.parentFromNode = camera.worldFromCamera * glm::translate(glm::dmat4(1.0), place);
        node.instances = {{0, 0}};
    }
    return makeViewDraws(makeDrawList(scene), view, true).opaquePixels;
}

TEST(ViewDraws, opaquePixelsEncloseTheDrawsThatAreSeenClosely) {
    scenes::Camera camera; // of 45 degrees, so 100 pixels are 2 tan 22.5 degrees at a metre
    const CameraView view = makeCameraView(camera, {200, 100}, LightingSpace::World, glm::vec3(0.0f));
    const double pixelsAMetre = 50.0 / std::tan(0.5 * camera.fovYRadians);
    test::Random random(11);
    for (int i = 0; i < 1000; ++i) {
        const double ahead = random.between(2.0, 50.0);
        const glm::dvec3 place(random.between(-1.0, 1.0) * ahead, random.between(-0.5, 0.5) * ahead, -ahead);
        const PixelArea area = pixelsOfBoxes({place}, camera, view);
        // The box extends 0.25 m before and behind its centre.
        for (const int axis : {0, 1}) {
            const double middle = axis == 0 ? 100.0 : 50.0;
            double low = 1e9, high = -1e9;
            for (const double side : {-0.25, 0.25})
                for (const double depth : {ahead - 0.25, ahead + 0.25}) {
                    low = std::min(low, middle + pixelsAMetre * (place[axis] + side) / depth);
                    high = std::max(high, middle + pixelsAMetre * (place[axis] + side) / depth);
                }
            if (area.empty()) continue;
            EXPECT_LE(area.low[axis], std::max(0.0, std::floor(low)));
            EXPECT_GE(area.high[axis], std::min(2.0 * middle, std::ceil(high)));
            EXPECT_GE(area.low[axis], std::clamp(low - 3.0, 0.0, 2.0 * middle));
            EXPECT_LE(area.high[axis], std::clamp(high + 3.0, 0.0, 2.0 * middle));
        }
    }
    const PixelArea left = pixelsOfBoxes({{-5.0, 0.0, -10.0}}, camera, view),
                    right = pixelsOfBoxes({{5.0, 2.0, -10.0}}, camera, view);
    const PixelArea both = pixelsOfBoxes({{-5.0, 0.0, -10.0}, {5.0, 2.0, -10.0}}, camera, view);
    EXPECT_LT(left.high.x, 100);
    EXPECT_GT(right.low.x, 100);
    EXPECT_EQ(both, (PixelArea{glm::min(left.low, right.low), glm::max(left.high, right.high)}));
}

TEST(ViewDraws, opaquePixelsAreAllWhereABoxReachesBehindTheEyeAndNoneWhereNothingIsDrawn) {
    const scenes::Camera camera;
    const CameraView view = makeCameraView(camera, {200, 100}, LightingSpace::World, glm::vec3(0.0f));
    const PixelArea whole{{0, 0}, {200, 100}};
    EXPECT_EQ(pixelsOfBoxes({{0.1, 0.0, -0.2}}, camera, view), whole);
    EXPECT_EQ(pixelsOfBoxes({{0.0, 0.0, -10.0}, {0.1, 0.0, -0.2}, {1.0, 0.0, -10.0}}, camera, view), whole);
    EXPECT_TRUE(pixelsOfBoxes({}, camera, view).empty());
    EXPECT_TRUE(pixelsOfBoxes({{0.0, 0.0, 10.0}}, camera, view).empty()) << "behind the eye";
}

/// The rows of the only draw, for a node with this transform.
DrawRows rowsOf(const glm::dmat4& worldFromObject, const CameraView& view) {
    scenes::Scene scene = scenes::tinyScene();
    scene.nodes[0].parentFromNode = worldFromObject;
    return makeViewDraws(makeDrawList(scene), view, false).rows.at(0);
}

glm::dvec3 apply(const glm::vec4 rows[3], const glm::dvec4& v) {
    return {glm::dot(glm::dvec4(rows[0]), v), glm::dot(glm::dvec4(rows[1]), v), glm::dot(glm::dvec4(rows[2]), v)};
}

TEST(DrawList, positionRowsTakeObjectSpaceToWorldAxesAtTheEyeInBothLightingSpaces) {
    test::Random random(1);
    for (const LightingSpace space : {LightingSpace::World, LightingSpace::View}) {
        const CameraView view = defaultView(space);
        const glm::dmat4 worldFromObject = glm::translate(glm::dmat4(1.0), {1.5, 2.5, 3.5}) *
                                           glm::rotate(glm::dmat4(1.0), 1.0, {0, 1, 0}) *
                                           glm::scale(glm::dmat4(1.0), {2.0, -3.0, 0.5});
        const DrawRows rows = rowsOf(worldFromObject, view);
        for (int i = 0; i < 100; ++i) {
            const glm::dvec4 pointOS(random.direction(), 1.0);
            const glm::dvec3 expected = glm::dvec3(worldFromObject * pointOS) - view.eyeWS;
            EXPECT_LE(glm::distance(apply(rows.position, pointOS), expected), 1e-6); // fp32 rows of order one
        }
    }
}

TEST(DrawList, normalRowsAgreeWithTheInverseTransposeUpToLength) {
    test::Random random(2);
    for (const glm::dvec3& scale : {glm::dvec3(1.0), glm::dvec3(2, 0.1, 5), glm::dvec3(-1, 1, 1),
                                    glm::dvec3(-2, -3, -0.5), glm::dvec3(1e-20), glm::dvec3(1e15, 1e15, -1e14)}) {
        for (int i = 0; i < 50; ++i) {
            const glm::dmat4 worldFromObject =
                glm::rotate(glm::dmat4(1.0), random.between(0.0, 6.0), random.direction()) *
                glm::scale(glm::dmat4(1.0), scale) *
                glm::rotate(glm::dmat4(1.0), random.between(0.0, 6.0), random.direction());
            const CameraView view = defaultView(i % 2 == 0 ? LightingSpace::World : LightingSpace::View);
            const DrawRows rows = rowsOf(worldFromObject, view);
            const glm::dvec3 normalOS = random.direction();
            const glm::dvec3 expected = glm::normalize(
                view.lsFromWorld * (glm::transpose(glm::inverse(glm::dmat3(worldFromObject))) * normalOS));
            const glm::dvec3 found = glm::normalize(apply(rows.normal, glm::dvec4(normalOS, 0.0)));
            // fp32 entries of order one; a stretch of 50:1 may amplify their rounding by cancellation.
            ASSERT_LE(glm::distance(found, expected), 50 * 2e-7)
                << "scale " << scale.x << " " << scale.y << " " << scale.z;
            ASSERT_EQ(rows.normal[0].w, scale.x * scale.y * scale.z < 0.0 ? -1.0f : 1.0f);
        }
    }
}

TEST(DrawList, aSingularTransformKeepsTheNormalOfItsPlane) {
    const CameraView view = viewOf({});
    const DrawRows flat = rowsOf(glm::scale(glm::dmat4(1.0), {2.0, 3.0, 0.0}), view); // squashed into z = 0
    EXPECT_EQ(apply(flat.normal, {0, 0, 1, 0}), glm::dvec3(0, 0, 1));
    const DrawRows line =
        rowsOf(glm::scale(glm::dmat4(1.0), {2.0, 0.0, 0.0}), view); // no plane left: no normal, no NaN
    EXPECT_EQ(apply(line.normal, {0, 0, 1, 0}), glm::dvec3(0.0));
}

} // namespace
} // namespace tessera::frame
