// Detection of closed meshes, which decides how rays leave bodies of glass.
#include "scenes/ClosedBodies.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "scenes/builtin/Shapes.h"

namespace tessera::scenes {
namespace {

Mesh box() {
    Mesh mesh;
    builtin::appendBox(mesh, {-1.0, -2.0, -3.0}, {1.0, 2.0, 3.0}); // each face has vertices of its own
    return mesh;
}

TEST(ClosedBodies, meshesAreClosedWhoseEdgesAllHaveTwoSides) {
    EXPECT_TRUE(isClosed(box()));
    Mesh ball;
    builtin::appendSphere(ball, {5.0, 0.0, 0.0}, 0.5, 16, 8); // triangles without area at its poles, and a seam
    EXPECT_TRUE(isClosed(ball));
    EXPECT_FALSE(isClosed(Mesh()));

    Mesh open = box();
    open.indices.resize(open.indices.size() - 3);
    EXPECT_FALSE(isClosed(open)) << "a triangle is missing";
    Mesh turned = box();
    std::swap(turned.indices[0], turned.indices[1]);
    EXPECT_FALSE(isClosed(turned)) << "a triangle faces inwards";
    Mesh inwards = box();
    for (std::size_t i = 0; i < inwards.indices.size(); i += 3) std::swap(inwards.indices[i], inwards.indices[i + 1]);
    EXPECT_FALSE(isClosed(inwards)) << "all do";
    Mesh twice = box();
    twice.indices.insert(twice.indices.end(), twice.indices.begin(), twice.indices.begin() + 3);
    EXPECT_FALSE(isClosed(twice)) << "edges of three triangles";
    Mesh moved = box();
    moved.positionsOS[0].x += 1e-3f;
    EXPECT_FALSE(isClosed(moved)) << "a gap";

    Mesh pane;
    builtin::appendBox(pane, {-4.0, -4.0, 0.0}, {4.0, 4.0, 0.01});
    EXPECT_TRUE(isClosed(pane));

    Mesh sheet;
    sheet.positionsOS = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.3f}};
    sheet.indices = {0, 1, 2, 2, 1, 0};
    EXPECT_FALSE(isClosed(sheet)) << "nothing inside";
}

TEST(ClosedBodies, aBodyIsClosedWhereAllMeshesThatShowItAre) {
    Scene scene;
    scene.meshes = {box(), box()};
    scene.meshes[1].indices.resize(3);
    Material body;
    body.transmission = 1.0f;
    body.thicknessMetres = 0.1f;
    Material sheet = body;
    sheet.thicknessMetres = 0.0f;
    scene.materials = {body, body, body, sheet};
    Node& node = scene.nodes.emplace_back();
    node.instances = {{0, 0}, {0, 1}, {1, 1}, {0, 3}};
    ClosedMeshes meshes;
    EXPECT_EQ(closedBodies(scene, meshes), (std::vector<bool>{true, false, false, false}));
    EXPECT_TRUE(hasClosedBodies(scene, meshes));
    // Moving a vertex opens a mesh, and moving it back closes the mesh, once verticesMoved() is called.
    const float rest = scene.meshes[0].positionsOS[0].x;
    for (const bool isMoved : {true, false}) {
        scene.meshes[0].positionsOS[0].x = isMoved ? rest + 1e-3f : rest;
        EXPECT_EQ(hasClosedBodies(scene, meshes), isMoved);
        meshes.verticesMoved();
        EXPECT_EQ(hasClosedBodies(scene, meshes), !isMoved);
    }
    node.instances = {{0, 1}, {1, 1}};
    EXPECT_FALSE(hasClosedBodies(scene, meshes));
}

} // namespace
} // namespace tessera::scenes
