// Scenes that a supplied camera views from inside.
#include "scenes/Enclosure.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "scenes/Defaults.h"
#include "tests/unit/scenes/TinyScene.h"

namespace tessera::scenes {
namespace {

enum class Facing : std::uint8_t { Inwards, Outwards };

/// Adds a box whose faces all face inwards or outwards, with the centre of its floor at `atWS`; `walls` are some of its
/// faces +x, -x, +y, -y, +z and -z.
void addBox(Scene& scene, const glm::dvec3& sides, Facing facing, std::initializer_list<int> walls,
            const glm::dvec3& atWS = {}) {
    Mesh& mesh = scene.meshes[0];
    for (const int wall : walls) {
        const int axis = wall / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const float side = wall % 2 == 0 ? 1.0f : -1.0f;
        const auto first = std::uint32_t(mesh.positionsOS.size());
        for (const auto& [du, dv] : {std::pair(-1.0f, -1.0f), {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}) {
            glm::vec3 corner(0.0f);
            corner[axis] = side;
            corner[u] = du;
            corner[v] = dv;
            mesh.positionsOS.push_back(glm::vec3(atWS + 0.5 * sides * (glm::dvec3(corner) + glm::dvec3(0, 1, 0))));
        }
        const bool isCounted = (side > 0.0f) == (facing == Facing::Outwards);
        for (const std::uint32_t index : {0, 1, 2, 0, 2, 3})
            mesh.indices.push_back(first + (isCounted ? index : 3 - index));
    }
    mesh.normalsOS.assign(mesh.positionsOS.size(), {0.0f, 1.0f, 0.0f});
}

Scene nothing() {
    Scene scene = tinyScene();
    scene.meshes[0] = Mesh();
    return scene;
}
Scene box(const glm::dvec3& sides, Facing facing, std::initializer_list<int> walls = {0, 1, 2, 3, 4, 5}) {
    Scene scene = nothing();
    addBox(scene, sides, facing, walls);
    return scene;
}

TEST(Enclosure, whatANodeMirrorsHasItsFrontsWhereItShowsThem) {
    for (const Facing facing : {Facing::Inwards, Facing::Outwards}) {
        Scene mirrored = box({10.0, 6.0, 4.0}, facing);
        mirrored.nodes[0].parentFromNode[0][0] = -1.0;
        EXPECT_EQ(framingInside(mirrored).has_value(), facing == Facing::Inwards);
    }
}

TEST(Enclosure, aRoomIsSeenFromOneEndAtTheHeightOfAPersonAlongItsLongestWay) {
    const Scene room = box({10.0, 6.0, 4.0}, Facing::Inwards);
    const std::optional<Framing> inside = framingInside(room);
    ASSERT_TRUE(inside.has_value());
    EXPECT_NEAR(inside->eyeWS.y, 1.7, 0.1);
    EXPECT_LT(std::abs(inside->eyeWS.z), 2.0);
    EXPECT_GT(std::abs(inside->eyeWS.x), 3.5);
    EXPECT_LT(std::abs(inside->eyeWS.x), 5.0);
    EXPECT_LT(glm::dot(inside->targetWS - inside->eyeWS, inside->eyeWS), 0.0) << "it looks at the wall behind it";
}

TEST(Enclosure, aCourtWithoutARoofAndAHouseWithWallsOfTwoSidesAreRoomsToo) {
    EXPECT_TRUE(framingInside(box({12.0, 6.0, 16.0}, Facing::Inwards, {0, 1, 3, 4, 5})).has_value());
    Scene house = box({10.0, 6.0, 8.0}, Facing::Inwards);
    addBox(house, {10.5, 6.2, 8.5}, Facing::Outwards, {0, 1, 2, 3, 4, 5}, {0.0, -0.1, 0.0});
    EXPECT_TRUE(framingInside(house).has_value());
}

TEST(Enclosure, thingsAreSeenFromOutside) {
    EXPECT_FALSE(framingInside(box({10.0, 6.0, 8.0}, Facing::Outwards)).has_value()) << "a closed body";
    EXPECT_FALSE(framingInside(box({0.4, 0.3, 0.3}, Facing::Inwards)).has_value()) << "the inside of a vessel";
    EXPECT_FALSE(framingInside(box({10.0, 6.0, 8.0}, Facing::Inwards, {0, 3, 5})).has_value()) << "a corner of a room";
    EXPECT_FALSE(framingInside(box({10.0, 6.0, 8.0}, Facing::Inwards, {0, 1, 2, 4, 5})).has_value()) << "no floor";
    EXPECT_FALSE(framingInside(tinyScene()).has_value());
    EXPECT_FALSE(framingInside(nothing()).has_value());
    Scene table = nothing(); // objects on a board
    addBox(table, {20.0, 0.1, 20.0}, Facing::Outwards, {0, 1, 2, 3, 4, 5});
    for (const double x : {-6.0, 6.0})
        for (const double z : {-6.0, 6.0})
            addBox(table, {2.0, 5.0, 2.0}, Facing::Outwards, {0, 1, 2, 3, 4, 5}, {x, 0.1, z});
    EXPECT_FALSE(framingInside(table).has_value());
}

TEST(Enclosure, theSuppliedCameraStandsInARoomAndSaysSo) {
    Scene room = box({10.0, 6.0, 4.0}, Facing::Inwards), body = box({10.0, 6.0, 4.0}, Facing::Outwards);
    addDefaultCamera(room);
    addDefaultCamera(body);
    EXPECT_EQ(suppliedText(room), "no camera in it: seen from inside by the supplied camera 'default'");
    EXPECT_EQ(suppliedText(body), "no camera in it: seen whole by the supplied camera 'default'");
    const glm::dvec3 eyeWS(room.cameras.at(0).worldFromCamera[3]);
    EXPECT_TRUE(worldBounds(room).min.x < eyeWS.x && eyeWS.x < worldBounds(room).max.x);
    EXPECT_LT(room.cameras.at(0).nearMetres, 0.1) << "the walls must not be cut away";
}

} // namespace
} // namespace tessera::scenes
