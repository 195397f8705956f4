#include "scenes/builtin/Room.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/Author.h"
#include "scenes/builtin/Builtin.h"
#include "scenes/builtin/Shapes.h"

namespace tessera::scenes::builtin {

const std::array<RoomFinish, kRoomMaterialCount> kRoomFinishes = {{
    {"floor", {0.5f, 0.4375f, 0.375f}, {0.0f, 0.0f, 0.0f}, false},
    {"ceiling", {0.875f, 0.875f, 0.875f}, {0.0f, 0.0f, 0.0f}, true},
    {"left wall", {0.625f, 0.125f, 0.09375f}, {0.0f, 0.0f, 0.0f}, false},
    {"right wall", {0.125f, 0.5f, 0.15625f}, {0.0f, 0.0f, 0.0f}, false},
    {"far wall", {0.75f, 0.75f, 0.8125f}, {0.0f, 0.0f, 0.0f}, true},
    {"near wall", {0.375f, 0.375f, 0.5f}, {0.0f, 0.0f, 0.0f}, false},
    {"sign", {0.25f, 0.5f, 0.75f}, {0.0f, 0.0f, 0.0f}, false},
    {"panel", {0.25f, 0.25f, 0.25f}, {0.5f, 0.375f, 0.125f}, false},
    {"lantern", {0.5f, 0.25f, 0.125f}, {0.0625f, 0.25f, 0.5f}, true},
    {"plinth", {0.375f, 0.375f, 0.3125f}, {0.0f, 0.0f, 0.0f}, false},
}};

namespace {

/// Distance of patches from their wall: far more than depth resolves, too small to be visible from the side.
constexpr double kPatchOffsetMetres = 0.01;
const glm::dvec3 kPlinthHalfMetres(0.4, 0.3, 0.25);

/// A rectangle by its middle and its half sides; its normal is normalize(cross(halfU, halfV)).
struct Rectangle {
    RoomMaterial material;
    glm::dvec3 centerWS;
    glm::dvec3 halfU;
    glm::dvec3 halfV;
};

constexpr std::array kRectangles = {
    Rectangle{RoomMaterial::Floor, {0.0, 0.0, 0.0}, {0.0, 0.0, 3.0}, {2.0, 0.0, 0.0}},
    Rectangle{RoomMaterial::Ceiling, {0.0, 3.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, 3.0}},
    Rectangle{RoomMaterial::LeftWall, {-2.0, 1.5, 0.0}, {0.0, 1.5, 0.0}, {0.0, 0.0, 3.0}},
    Rectangle{RoomMaterial::RightWall, {2.0, 1.5, 0.0}, {0.0, 0.0, 3.0}, {0.0, 1.5, 0.0}},
    Rectangle{RoomMaterial::FarWall, {0.0, 1.5, -3.0}, {2.0, 0.0, 0.0}, {0.0, 1.5, 0.0}},
    Rectangle{RoomMaterial::NearWall, {0.0, 1.5, 3.0}, {0.0, 1.5, 0.0}, {2.0, 0.0, 0.0}},
    Rectangle{RoomMaterial::Sign, {-0.5, 1.75, -3.0 + kPatchOffsetMetres}, {0.5, 0.0, 0.0}, {0.0, 0.375, 0.0}},
    Rectangle{RoomMaterial::Panel, {2.0 - kPatchOffsetMetres, 1.5, -1.25}, {0.0, 0.0, 0.5}, {0.0, 0.5, 0.0}},
    Rectangle{RoomMaterial::Lantern, {-2.0 + kPatchOffsetMetres, 2.0, -1.0}, {0.0, 0.25, 0.0}, {0.0, 0.0, 0.5}},
};

/// The plinth is a cube of half side 1, turned, moved and scaled unequally.
glm::dmat4 worldFromPlinth() {
    glm::dmat4 matrix = glm::translate(glm::dmat4(1.0), glm::dvec3(0.7, kPlinthHalfMetres.y, -1.1));
    matrix = glm::rotate(matrix, glm::radians(30.0), glm::dvec3(0.0, 1.0, 0.0));
    return glm::scale(matrix, kPlinthHalfMetres);
}

/// The ray parameter, in lengths of `directionWS`, at which the ray enters the plinth, and the normal there.
std::optional<std::pair<double, glm::dvec3>> hitPlinth(const glm::dvec3& originWS, const glm::dvec3& directionWS) {
    const glm::dmat4 plinthFromWorld = glm::inverse(worldFromPlinth());
    const glm::dvec3 origin(plinthFromWorld * glm::dvec4(originWS, 1.0));
    const glm::dvec3 direction(plinthFromWorld * glm::dvec4(directionWS, 0.0));
    double enter = 0.0;
    double leave = std::numeric_limits<double>::infinity();
    glm::dvec3 normal(0.0);
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0) {
            if (std::abs(origin[axis]) > 1.0) return std::nullopt;
            continue;
        }
        const double towards = direction[axis] > 0.0 ? 1.0 : -1.0;
        const double nearer = (-towards - origin[axis]) / direction[axis];
        if (nearer > enter) {
            enter = nearer;
            normal = glm::dvec3(0.0);
            normal[axis] = -towards;
        }
        leave = std::min(leave, (towards - origin[axis]) / direction[axis]);
    }
    if (enter >= leave || enter == 0.0) return std::nullopt;
    const glm::dmat3 worldFromNormal = glm::transpose(glm::dmat3(plinthFromWorld));
    return std::pair(enter, glm::normalize(worldFromNormal * normal));
}

Material roomMaterial(RoomMaterial which) {
    const RoomFinish& finish = kRoomFinishes[static_cast<std::size_t>(which)];
    Material material = lambert(finish.name, finish.color);
    if (which == RoomMaterial::Sign) material.model = MaterialModel::SingleColor;
    if (finish.perSteradian) {
        material = metallicRoughness(finish.name, finish.color, 0.0f, 0.5f);
        material.specularFactor = 0.0f;
    }
    material.emissive = finish.emissive;
    return material;
}

} // namespace

glm::dvec3 roomRadiance(const glm::dvec3& positionWS, const glm::dvec3& normalWS, RoomMaterial material) {
    const RoomFinish& finish = kRoomFinishes[static_cast<std::size_t>(material)];
    const glm::dvec3 color(finish.color);
    if (material == RoomMaterial::Sign) return color;
    const glm::dvec3 toLampWS = kRoomLampWS - positionWS;
    const double distanceSquared = glm::dot(toLampWS, toLampWS);
    const double cosine = std::max(0.0, glm::dot(normalWS, toLampWS)) / std::sqrt(distanceSquared);
    const double share = finish.perSteradian ? 1.0 / std::numbers::pi : 1.0;
    return glm::dvec3(finish.emissive) + color * (share * kRoomLampCandela * cosine / distanceSquared);
}

std::optional<RoomPoint> roomPointAlong(const glm::dvec3& originWS, const glm::dvec3& directionWS) {
    std::optional<RoomPoint> seen;
    double nearest = std::numeric_limits<double>::infinity();
    for (const Rectangle& rectangle : kRectangles) {
        const glm::dvec3 normalWS = glm::normalize(glm::cross(rectangle.halfU, rectangle.halfV));
        const double approach = glm::dot(directionWS, normalWS);
        if (approach >= 0.0) continue; // seen from behind
        const double along = glm::dot(rectangle.centerWS - originWS, normalWS) / approach;
        const glm::dvec3 offset = originWS + along * directionWS - rectangle.centerWS;
        const double u = glm::dot(offset, rectangle.halfU) / glm::dot(rectangle.halfU, rectangle.halfU);
        const double v = glm::dot(offset, rectangle.halfV) / glm::dot(rectangle.halfV, rectangle.halfV);
        // The walls' edges belong to both neighbours; a rounding error must not open a gap between them.
        constexpr double kEdge = 1.0 + 1e-12;
        if (along <= 0.0 || along >= nearest || std::abs(u) > kEdge || std::abs(v) > kEdge) continue;
        nearest = along;
        seen = RoomPoint{originWS + along * directionWS, normalWS, rectangle.material};
    }
    const auto plinth = hitPlinth(originWS, directionWS);
    if (plinth && plinth->first < nearest) {
        seen = RoomPoint{originWS + plinth->first * directionWS, plinth->second, RoomMaterial::Plinth};
    }
    return seen;
}

Scene makeRoom(const LoadOptions& options, LoadLedger&) {
    Scene scene;
    scene.name = "room";
    for (std::size_t i = 0; i < kRoomMaterialCount; ++i) addMaterial(scene, roomMaterial(static_cast<RoomMaterial>(i)));
    for (const Rectangle& r : kRectangles) {
        Mesh mesh;
        appendQuad(mesh, r.centerWS - r.halfU - r.halfV, r.centerWS + r.halfU - r.halfV, r.centerWS + r.halfU + r.halfV,
                   r.centerWS - r.halfU + r.halfV);
        const std::string name = kRoomFinishes[static_cast<std::size_t>(r.material)].name;
        addNode(scene, name, glm::dmat4(1.0), {{addMesh(scene, name, std::move(mesh)), static_cast<int>(r.material)}});
    }
    Mesh cube;
    appendBox(cube, glm::dvec3(-1.0), glm::dvec3(1.0));
    addNode(scene, "plinth", worldFromPlinth(),
            {{addMesh(scene, "cube", std::move(cube)), static_cast<int>(RoomMaterial::Plinth)}});

    const int lights = options.lights.value_or(1);
    for (int i = 0; i < lights; ++i) {
        Light lamp;
        lamp.name = "lamp " + std::to_string(i);
        lamp.positionWS = kRoomLampWS;
        lamp.intensity = static_cast<float>(kRoomLampCandela / lights);
        scene.lights.push_back(lamp);
    }
    addCamera(scene, "corner", {-1.5, 1.75, 2.75}, {0.45, 1.15, -1.5}, 62.0);
    addCamera(scene, "back", {1.5, 2.25, -2.5}, {-0.5, 1.0, 1.5}, 70.0);
    return scene;
}

} // namespace tessera::scenes::builtin
