#include "validation/reference/Objects.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "validation/reference/TangentFrame.h"
#include "validation/reference/Tangents.h"

namespace tessera::reference {

namespace {

/// cof M = det(M) M^-T, which transforms normals even where M is singular. Its elements are the minors of M with
/// alternating signs.
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

scenes::Box3 boxOf(const scenes::Mesh& mesh) {
    scenes::Box3 boxOS;
    for (const glm::vec3& position : mesh.positionsOS) boxOS.extend(glm::dvec3(position));
    return boxOS;
}

double depthOfBoxCentre(const Object& object, const glm::dvec3& forward) {
    const scenes::Box3 boxOS = boxOf(*object.mesh);
    const glm::dvec3 centreOS = 0.5 * (boxOS.min + boxOS.max);
    return glm::dot(forward, glm::dvec3(object.rwsFromObject * glm::dvec4(centreOS, 1.0)));
}

/// Bounds of the vertices that an object's triangles use.
struct Bounds {
    scenes::Box3 boxRWS;
    double nodeMetres = 0.0; ///< from the node's origin to the box's farthest corner
};

Bounds boundsOf(const Object& object) {
    Bounds bounds;
    for (const std::uint32_t vertex : object.mesh->indices)
        bounds.boxRWS.extend(
            glm::dvec3(object.rwsFromObject * glm::dvec4(glm::dvec3(object.mesh->positionsOS[vertex]), 1.0)));
    const glm::dvec3 node(object.rwsFromObject[3]);
    bounds.nodeMetres = glm::length(glm::max(glm::abs(bounds.boxRWS.min - node), glm::abs(bounds.boxRWS.max - node)));
    return bounds;
}

struct Range {
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    void intersect(double a, double b) {
        least = std::max(least, std::min(a, b));
        most = std::min(most, std::max(a, b));
    }
};

/// Whether a ray can hit a mesh, by its slightly enlarged bounding box.
bool mayHit(const Ray& ray, const scenes::Mesh& mesh, const glm::dmat4& rwsFromObject) {
    const scenes::Box3 boxOS = boxOf(mesh);
    if (boxOS.empty()) return false;
    scenes::Box3 boxRWS;
    for (int corner = 0; corner < 8; ++corner) {
        const auto side = [&](int axis) { return (corner >> axis & 1) != 0 ? boxOS.max[axis] : boxOS.min[axis]; };
        boxRWS.extend(glm::dvec3(rwsFromObject * glm::dvec4(side(0), side(1), side(2), 1.0)));
    }
    const glm::dvec3 farthest = glm::max(glm::abs(boxRWS.min), glm::abs(boxRWS.max));
    const double room = 1e-9 * (glm::length(farthest) + glm::length(ray.originRWS));
    Range depths{0.0};
    for (int axis = 0; axis < 3; ++axis) {
        const double least = boxRWS.min[axis] - room - ray.originRWS[axis];
        const double most = boxRWS.max[axis] + room - ray.originRWS[axis];
        if (ray.direction[axis] != 0.0)
            depths.intersect(least / ray.direction[axis], most / ray.direction[axis]);
        else if (least > 0.0 || most < 0.0)
            return false;
    }
    return depths.least <= depths.most;
}

/// Depths at which a box can meet the image of parallel rays, within the camera's depths; empty if it cannot. Points of
/// the view are x right + y up + depth forward, so that the box's extent along each axis of the world bounds the depth
/// once x and y are limited to the image.
std::optional<Range> depthsInPicture(const scenes::Box3& boxRWS, const glm::dvec2& half, const CameraRays& rays) {
    const glm::dvec3 centre = 0.5 * (boxRWS.min + boxRWS.max), extent = 0.5 * (boxRWS.max - boxRWS.min);
    const auto along = [&](const glm::dvec3& axis) {
        const double middle = glm::dot(axis, centre), reach = glm::dot(glm::abs(axis), extent);
        return Range{middle - reach, middle + reach};
    };
    const Range x = along(rays.right()), y = along(rays.up());
    if (x.least > half.x || x.most < -half.x || y.least > half.y || y.most < -half.y) return {};
    Range depths = along(rays.forward());
    depths.intersect(rays.nearMetres(), rays.farMetres());
    for (int axis = 0; axis < 3; ++axis) {
        const double slope = rays.forward()[axis];
        const double aside = half.x * std::abs(rays.right()[axis]) + half.y * std::abs(rays.up()[axis]);
        if (slope != 0.0)
            depths.intersect((boxRWS.min[axis] - aside) / slope, (boxRWS.max[axis] + aside) / slope);
        else if (boxRWS.min[axis] > aside || boxRWS.max[axis] < -aside)
            return {};
    }
    if (!(depths.least <= depths.most)) return {};
    return depths;
}

/// An upper bound of the product's margin around the depths in view: an eighth and 1e-3 of their span, and the fp32
/// rounding (renderer/frame/DepthInterval.h).
double roomMetres(double spanMetres, double acrossMetres, double nodeMetres) {
    return 0.13 * spanMetres + 2e-3 * acrossMetres + 1e-6 * nodeMetres;
}

/// The product's origin lies in the middle of the depths in view, which are within these.
Anchor parallelAnchor(const std::vector<Bounds>& all, const CameraRays& rays) {
    Range seen{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    double nodeMetres = 0.0;
    glm::dvec2 largestHalf(0.0);
    for (const Bounds& bounds : all) {
        // Rounding may move points from just outside the image into it.
        const double farthest = glm::length(glm::max(glm::abs(bounds.boxRWS.min), glm::abs(bounds.boxRWS.max)));
        const glm::dvec2 half = 1.001 * rays.halfExtent() + 2e-6 * farthest;
        const std::optional<Range> depths = depthsInPicture(bounds.boxRWS, half, rays);
        if (!depths) continue;
        seen = {std::min(seen.least, depths->least), std::max(seen.most, depths->most)};
        nodeMetres = std::max(nodeMetres, bounds.nodeMetres);
        largestHalf = glm::max(largestHalf, half);
    }
    if (!(seen.least <= seen.most)) return {};
    const double span = seen.most - seen.least, across = glm::length(largestHalf);
    return {0.5 * (seen.least + seen.most) * rays.forward(), glm::length(glm::dvec2(0.5 * span, across)),
            0.5 * span + roomMetres(span, across, nodeMetres)};
}

/// The product moves its origin away from the eye where the farthest depth in view, with its margin, is at most twice
/// the nearest. Here the whole scene must satisfy that.
Anchor perspectiveAnchor(const std::vector<Bounds>& all, const CameraRays& rays) {
    scenes::Box3 boundsRWS;
    double nodeMetres = 0.0;
    for (const Bounds& bounds : all) {
        boundsRWS.extend(bounds.boxRWS.min);
        boundsRWS.extend(bounds.boxRWS.max);
        nodeMetres = std::max(nodeMetres, bounds.nodeMetres);
    }
    if (boundsRWS.empty()) return {};
    const glm::dvec3 centreRWS = 0.5 * (boundsRWS.min + boundsRWS.max);
    const double radius = 0.5 * glm::length(boundsRWS.max - boundsRWS.min);
    const double ahead = glm::dot(centreRWS, rays.forward());
    const double beside = glm::length(centreRWS - ahead * rays.forward());
    const double roomyRadius = radius + roomMetres(2.0 * radius, beside + radius, nodeMetres);
    if (!(ahead > 3.0 * roomyRadius)) return {};
    return {centreRWS, radius, beside + roomyRadius};
}

} // namespace

Objects::Objects(const scenes::Scene& scene, const CameraRays& rays, scenes::SubsurfaceRequest subsurface,
                 const std::vector<scenes::Box3>& besideRWS)
    : Objects(scene, rays, subsurface, besideRWS, nullptr) {}

Objects::Objects(const scenes::Scene& scene, const CameraRays& rays, const Ray& only)
    : Objects(scene, rays, {}, {}, &only) {}

Objects::Objects(const scenes::Scene& scene, const CameraRays& rays, scenes::SubsurfaceRequest subsurface,
                 const std::vector<scenes::Box3>& besideRWS, const Ray* only) {
    const std::vector<glm::dmat4> worldFromNode = scenes::worldFromNodes(scene);
    std::uint32_t number = 0;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        for (const scenes::MeshInstance& instance : scene.nodes[node].instances)
            add(scene, instance, worldFromNode[node], rays, subsurface, only, number++);
    }
    setBodyRadii();
    std::vector<std::pair<double, Object>> byDepth;
    for (const Object& object : transparent_) byDepth.emplace_back(depthOfBoxCentre(object, rays.forward()), object);
    std::stable_sort(byDepth.begin(), byDepth.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    std::transform(byDepth.begin(), byDepth.end(), transparent_.begin(),
                   [](const auto& entry) { return entry.second; });
    std::vector<Bounds> bounds;
    for (const std::vector<Object>* list : {&opaque_, &transparent_})
        for (const Object& object : *list) bounds.push_back(boundsOf(object));
    for (const scenes::Box3& box : besideRWS) bounds.push_back({box, 0.5 * glm::length(box.max - box.min)});
    anchor_ = rays.isPerspective() ? perspectiveAnchor(bounds, rays) : parallelAnchor(bounds, rays);
    for (std::vector<Object>* list : {&opaque_, &transparent_}) {
        for (Object& object : *list) {
            object.anchor = anchor_;
            for (std::uint32_t triangle = 0; triangle < object.mesh->indices.size() / 3; ++triangle) {
                for (int corner = 0; corner < 3; ++corner)
                    roundingMetres_ =
                        std::max(roundingMetres_, kPositionRounding * object.cornerReach(triangle, corner));
            }
        }
    }
}

double Objects::roundingBeyondMetres(const glm::dvec3& placeRWS) const {
    double metres = 0.0;
    const auto extend = [&](const Object& object) {
        for (std::uint32_t triangle = 0; triangle < object.mesh->indices.size() / 3; ++triangle) {
            double reach = 0.0, farthest = 0.0, longest = 0.0;
            for (int corner = 0; corner < 3; ++corner) {
                const glm::dvec3 cornerRWS = object.cornerRWS(triangle, corner);
                reach = std::max(reach, object.cornerReach(triangle, corner));
                farthest = std::max(farthest, glm::length(cornerRWS - placeRWS));
                longest = std::max(longest, glm::length(object.cornerRWS(triangle, (corner + 1) % 3) - cornerRWS));
            }
            // The whole triangle moves with its corners, and is at least this far away.
            metres = std::max(metres, kPositionRounding * (reach - std::max(farthest - longest, 0.0)));
        }
    };
    std::for_each(opaque_.begin(), opaque_.end(), extend);
    std::for_each(transparent_.begin(), transparent_.end(), extend);
    return metres;
}

void Objects::add(const scenes::Scene& scene, const scenes::MeshInstance& instance, const glm::dmat4& worldFromNode,
                  const CameraRays& rays, scenes::SubsurfaceRequest subsurface, const Ray* only, std::uint32_t number) {
    Object object;
    object.mesh = &scene.meshes[std::size_t(instance.mesh)];
    object.material = &scene.materials[std::size_t(instance.material)];
    if (object.mesh->indices.empty()) return;
    object.castsShadow = instance.castsShadow && object.material->castsShadow;
    object.subsurface = scenes::subsurfaceOf(*object.material, subsurface);
    object.number = number;
    object.rwsFromObject = worldFromNode;
    object.rwsFromObject[3] -= glm::dvec4(rays.eyeWS(), 0.0);
    if (only != nullptr && !mayHit(*only, *object.mesh, object.rwsFromObject)) return;
    object.handedness = glm::determinant(glm::dmat3(worldFromNode)) < 0.0 ? -1.0 : 1.0;
    object.normalFromObject = cofactorMatrix(glm::dmat3(worldFromNode)) * object.handedness;
    if (tangentSlot(*object.material)) object.tangentsOS = &tangentsOf(*object.mesh, *object.material);
    const bool isTransparent = scenes::isTransparent(*object.material);
    (isTransparent ? transparent_ : opaque_).push_back(object);
}

void Objects::setBodyRadii() {
    std::map<const scenes::Material*, scenes::Box3> boxes;
    for (const std::vector<Object>* list : {&opaque_, &transparent_})
        for (const Object& object : *list)
            for (std::uint32_t corner = 0; corner < object.mesh->indices.size(); ++corner)
                boxes[object.material].extend(object.cornerRWS(corner / 3, int(corner % 3)));
    for (std::vector<Object>* list : {&opaque_, &transparent_})
        for (Object& object : *list) {
            const double given = double(object.material->subsurface.bodyRadiusMetres);
            const glm::dvec3 half = 0.5 * (boxes[object.material].max - boxes[object.material].min);
            object.bodyRadiusMetres = given > 0.0 ? given : std::min({half.x, half.y, half.z});
        }
}

const std::vector<glm::dvec4>& Objects::tangentsOf(const scenes::Mesh& mesh, const scenes::Material& material) {
    std::unique_ptr<std::vector<glm::dvec4>>& known = tangents_[{&mesh, &material}];
    if (!known) known = std::make_unique<std::vector<glm::dvec4>>(reference::tangentsOS(mesh, material));
    return *known;
}

} // namespace tessera::reference
