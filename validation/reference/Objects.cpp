#include "validation/reference/Objects.h"

#include <algorithm>

#include "validation/reference/TangentFrame.h"
#include "validation/reference/Tangents.h"

namespace tessera::reference {

namespace {

/// cof M = det(M) M^-T, which carries normals through singular transforms too: rows i, j of M^-T's adjugate are the
/// minors of M with alternating signs.
glm::dmat3 cofactorMatrix(const glm::dmat3& m) {
    glm::dmat3 cofactor;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            const int c1 = (column + 1) % 3, c2 = (column + 2) % 3, r1 = (row + 1) % 3, r2 = (row + 2) % 3;
            cofactor[column][row] = m[c1][r1] * m[c2][r2] - m[c1][r2] * m[c2][r1];
        }
    }
    return cofactor;
}

double depthOfBoxCentre(const Object& object, const glm::dvec3& forward) {
    scenes::Box3 boxOS;
    for (const glm::vec3& position : object.mesh->positionsOS) boxOS.extend(glm::dvec3(position));
    const glm::dvec3 centreOS = 0.5 * (boxOS.min + boxOS.max);
    return glm::dot(forward, glm::dvec3(object.relFromObject * glm::dvec4(centreOS, 1.0)));
}

/// With perspective the product leaves the eye where the farthest depth of what it sees, with room for roundings, is at
/// most twice the nearest; here all of the scene must be so.
Anchor anchorOf(const scenes::Box3& boundsRel, const CameraRays& rays) {
    if (boundsRel.empty()) return {};
    const glm::dvec3 centreRel = 0.5 * (boundsRel.min + boundsRel.max);
    const double radius = 0.5 * glm::length(boundsRel.max - boundsRel.min);
    const double ahead = glm::dot(centreRel, rays.forward());
    const double beside = glm::length(centreRel - ahead * rays.forward());
    const double roomyRadius = 1.3 * radius + 2e-3 * beside;
    if (rays.isPerspective() && !(ahead > 3.0 * roomyRadius)) return {};
    return {centreRel, radius, beside + roomyRadius};
}

} // namespace

Objects::Objects(const scenes::Scene& scene, const CameraRays& rays) {
    const std::vector<glm::dmat4> worldFromNode = scenes::worldFromNodes(scene);
    std::uint32_t number = 0;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        for (const scenes::MeshInstance& instance : scene.nodes[node].instances)
            add(scene, instance, worldFromNode[node], rays, number++);
    }
    std::vector<std::pair<double, Object>> byDepth;
    for (const Object& object : transparent_) byDepth.emplace_back(depthOfBoxCentre(object, rays.forward()), object);
    std::stable_sort(byDepth.begin(), byDepth.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::transform(byDepth.begin(), byDepth.end(), transparent_.begin(),
                   [](const auto& entry) { return entry.second; });
    scenes::Box3 boundsRel;
    for (const std::vector<Object>* list : {&opaque_, &transparent_}) {
        for (const Object& object : *list) {
            for (const std::uint32_t vertex : object.mesh->indices) {
                const glm::dvec3 vertexOS(object.mesh->positionsOS[vertex]);
                boundsRel.extend(glm::dvec3(object.relFromObject * glm::dvec4(vertexOS, 1.0)));
            }
        }
    }
    anchor_ = anchorOf(boundsRel, rays);
    for (std::vector<Object>* list : {&opaque_, &transparent_})
        for (Object& object : *list) object.anchor = anchor_;
}

void Objects::add(const scenes::Scene& scene, const scenes::MeshInstance& instance, const glm::dmat4& worldFromNode,
                  const CameraRays& rays, std::uint32_t number) {
    Object object;
    object.mesh = &scene.meshes[std::size_t(instance.mesh)];
    object.material = &scene.materials[std::size_t(instance.material)];
    if (object.mesh->indices.empty()) return;
    object.number = number;
    object.relFromObject = worldFromNode;
    object.relFromObject[3] -= glm::dvec4(rays.eyeWS(), 0.0);
    object.handedness = glm::determinant(glm::dmat3(worldFromNode)) < 0.0 ? -1.0 : 1.0;
    object.normalFromObject = cofactorMatrix(glm::dmat3(worldFromNode)) * object.handedness;
    if (tangentSlot(*object.material)) object.tangentsOS = &tangentsOf(*object.mesh, *object.material);
    const bool isTransparent = object.material->alphaMode == scenes::AlphaMode::Blend;
    (isTransparent ? transparent_ : opaque_).push_back(object);
}

const std::vector<glm::dvec4>& Objects::tangentsOf(const scenes::Mesh& mesh, const scenes::Material& material) {
    std::unique_ptr<std::vector<glm::dvec4>>& known = tangents_[{&mesh, &material}];
    if (!known) known = std::make_unique<std::vector<glm::dvec4>>(reference::tangentsOS(mesh, material));
    return *known;
}

} // namespace tessera::reference
