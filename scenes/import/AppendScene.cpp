#include "scenes/import/AppendScene.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/AreaLight.h"
#include "scenes/Direction.h"

namespace tessera::scenes {
namespace {

template <typename Element>
void moveAll(std::vector<Element>& from, std::vector<Element>& to) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

void shift(int& index, std::size_t offset) {
    if (index != kNone) index += static_cast<int>(offset);
}

glm::dvec3 movedPoint(const glm::dmat4& worldFromPart, const glm::dvec3& point) {
    return glm::dvec3(worldFromPart * glm::dvec4(point, 1.0));
}

/// det(M) M^-T without a division, up to a positive factor: what normals and axes of rotation are moved by.
glm::dmat3 cofactorOf(glm::dmat3 matrix) {
    // Products of its entries neither overflow nor vanish.
    double largest = 0.0;
    for (glm::length_t i = 0; i < 9; ++i) largest = std::max(largest, std::abs(matrix[i / 3][i % 3]));
    if (largest > 0.0) matrix /= largest;
    return {glm::cross(matrix[1], matrix[2]), glm::cross(matrix[2], matrix[0]), glm::cross(matrix[0], matrix[1])};
}

/// `what` names whose direction it is.
glm::dvec3 movedDirection(const glm::dvec3& vector, const char* what, const std::string& name) {
    const std::optional<glm::dvec3> direction = directionOf(vector);
    if (!direction)
        throw InputError(fmt::format("its transform leaves the {} '{}' no direction; give scales that are not 0 and "
                                     "finite",
                                     what, name));
    return *direction;
}

void moveLight(Light& light, const glm::dmat4& worldFromPart) {
    const glm::dmat3 linear(worldFromPart);
    light.positionWS = movedPoint(worldFromPart, light.positionWS);
    light.directionWS = movedDirection(linear * light.directionWS, "light", light.name);
    if (infoOf(light.type).isTurned())
        light.alongWS = acrossFrom(light.directionWS, movedDirection(linear * light.alongWS, "light", light.name))
                            .value_or(usualAlong(light.directionWS));
    // Mirrored, what was across is on the other side.
    if (infoOf(light.type).hasCorners() && glm::determinant(linear) < 0.0)
        for (std::size_t i = 0; i < light.corners.count; ++i) light.corners.metres[i].y *= -1.0f;
    if (!light.animation) return;
    LightAnimation& animation = *light.animation;
    animation.centerWS = movedPoint(worldFromPart, animation.centerWS);
    animation.axisWS = movedDirection(cofactorOf(linear) * animation.axisWS, "light",
                                      light.name); // mirrored, an orbit runs the other way
    animation.amplitudeMetres = linear * animation.amplitudeMetres;
    for (glm::dvec3& pointWS : animation.pointsWS) pointWS = movedPoint(worldFromPart, pointWS);
}

/// View direction and position go along exactly; up follows as far as a rotation allows.
void moveCamera(Camera& camera, const glm::dmat4& worldFromPart) {
    const glm::dmat4 moved = worldFromPart * camera.worldFromCamera;
    const glm::dvec3 back = movedDirection(glm::dvec3(moved[2]), "camera", camera.name);
    const glm::dvec3 right = movedDirection(glm::cross(glm::dvec3(moved[1]), back), "camera", camera.name);
    camera.worldFromCamera = {glm::dvec4(right, 0.0), glm::dvec4(glm::cross(back, right), 0.0), glm::dvec4(back, 0.0),
                              moved[3]};
}

} // namespace

void appendScene(Scene& whole, Scene part, const std::string& name, const glm::dmat4& worldFromPart) {
    Node root;
    root.name = name;
    root.parentFromNode = worldFromPart;
    const int rootIndex = static_cast<int>(whole.nodes.size());
    whole.nodes.push_back(std::move(root));

    for (Material& material : part.materials)
        for (TextureUse& use : material.textures) shift(use.image, whole.images.size());
    for (Node& node : part.nodes) {
        if (node.parent == kNone)
            node.parent = rootIndex;
        else
            shift(node.parent, static_cast<std::size_t>(rootIndex) + 1);
        for (MeshInstance& instance : node.instances) {
            shift(instance.mesh, whole.meshes.size());
            shift(instance.material, whole.materials.size());
        }
    }
    for (Light& light : part.lights) moveLight(light, worldFromPart);
    for (Camera& camera : part.cameras) moveCamera(camera, worldFromPart);

    moveAll(part.images, whole.images);
    moveAll(part.materials, whole.materials);
    moveAll(part.meshes, whole.meshes);
    moveAll(part.nodes, whole.nodes);
    moveAll(part.lights, whole.lights);
    moveAll(part.cameras, whole.cameras);
    moveAll(part.warnings, whole.warnings);
}

} // namespace tessera::scenes
