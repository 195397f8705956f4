
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "scenes/Direction.h"
#include "scenes/import/GltfSteps.h"

namespace tessera::scenes::gltf {
namespace {

/// Corners of triangles, counter-clockwise seen from outside.
using SolidTriangles = std::array<std::array<std::uint8_t, 3>, kCornersOfSolid / 3>;

/// Corners 0 to 2 lie around a segment's start, counter-clockwise against its direction, and 3 to 5 around its end.
constexpr SolidTriangles kPrismTriangles{
    {{0, 2, 1}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}, {3, 4, 5}}};
/// The corners are +X, -X, +Y, -Y, +Z, -Z.
constexpr SolidTriangles kOctahedronTriangles{
    {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};

constexpr std::uint8_t cornerOf(const SolidTriangles& triangles, std::size_t i) {
    return triangles[i / 3][i % 3];
}
constexpr bool isAtEnd(std::uint8_t prismCorner) {
    return prismCorner >= 3;
}

/// Minimum half width of a solid relative to the largest coordinate: at least 8 float steps there.
constexpr double kLeastShareOfCoordinate = 0x1p-20;

/// Clamps positions to single precision; scene checks refuse clamped ones as too far away.
glm::vec3 roundedPlace(const glm::dvec3& place) {
    constexpr double kMost = std::numeric_limits<float>::max();
    return glm::vec3(glm::clamp(place, -kMost, kMost));
}

/// Offsets from the centre to the corners of an octahedron with `width` between opposite corners.
std::array<glm::dvec3, 6> octahedron(double width) {
    std::array<glm::dvec3, 6> corners{};
    for (std::size_t i = 0; i < corners.size(); ++i)
        corners[i][glm::length_t(i / 2)] = i % 2 == 0 ? 0.5 * width : -0.5 * width;
    return corners;
}

/// Offsets from a segment's ends to the corners of its prism, whose sides are `width` wide.
std::array<glm::dvec3, 6> prism(const glm::dvec3& along, double width) {
    const glm::dvec3 direction = directionOf(along).value_or(glm::dvec3(0.0, 0.0, 1.0)), size = glm::abs(direction);
    const bool isLeastX = size.x <= size.y && size.x <= size.z;
    const glm::dvec3 axis(isLeastX ? 1.0 : 0.0, !isLeastX && size.y <= size.z ? 1.0 : 0.0,
                          !isLeastX && size.y > size.z ? 1.0 : 0.0);
    const glm::dvec3 across = glm::normalize(glm::cross(axis, direction)), up = glm::cross(direction, across);
    std::array<glm::dvec3, 6> corners{};
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double angle = 2.0 * std::numbers::pi / 3.0 * double(i % 3);
        corners[i] = width / std::numbers::sqrt3 * (std::cos(angle) * across + std::sin(angle) * up);
    }
    return corners;
}

/// Moves the unshared vertices of a mesh of cornersOfSolids() to the corners of the solids, and sets each triangle's
/// normal. The width of the solids must be positive.
void inflate(Mesh& mesh, int mode, double widthOS) {
    const bool isPoints = mode == kPoints;
    const SolidTriangles& triangles = isPoints ? kOctahedronTriangles : kPrismTriangles;
    double largest = 0.0;
    Box3 box;
    for (const glm::vec3& place : mesh.positionsOS) {
        box.extend(place);
        for (glm::length_t axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(double(place[axis])));
    }
    const glm::dvec3 sides = box.empty() ? glm::dvec3(0.0) : box.max - box.min;
    const double longest = std::max({sides.x, sides.y, sides.z});
    const double width =
        std::max(longest > 0.0 ? std::min(widthOS, longest) : widthOS, 2.0 * kLeastShareOfCoordinate * largest);
    for (std::size_t first = 0; first + kCornersOfSolid <= mesh.positionsOS.size(); first += kCornersOfSolid) {
        const std::span<glm::vec3> placesOS = std::span(mesh.positionsOS).subspan(first, kCornersOfSolid);
        // The first triangle of a prism lies around its start, the last around its end.
        const glm::dvec3 start(placesOS.front()), end(placesOS.back());
        const std::array<glm::dvec3, 6> offsets = isPoints ? octahedron(width) : prism(end - start, width);
        std::array<glm::dvec3, kCornersOfSolid> solid{};
        for (std::size_t i = 0; i < kCornersOfSolid; ++i) {
            solid[i] = glm::dvec3(placesOS[i]) + offsets[cornerOf(triangles, i)];
            placesOS[i] = roundedPlace(solid[i]);
        }
        for (std::size_t i = 0; i < kCornersOfSolid; i += 3)
            std::fill_n(mesh.normalsOS.begin() + std::ptrdiff_t(first + i), 3,
                        glm::vec3(normalOfTriangle(solid[i], solid[i + 1], solid[i + 2])));
    }
}

double largestScale(const glm::dmat4& matrix) {
    double largest = 0.0;
    for (glm::length_t axis = 0; axis < 3; ++axis) largest = std::max(largest, glm::length(glm::dvec3(matrix[axis])));
    return largest;
}

/// The bounds of a scene by the boxes of its meshes, and the largest scale of each mesh.
struct Sizes {
    Box3 boundsWS;
    std::map<int, double> scales; ///< by mesh
};

Sizes sizesOf(const Scene& scene) {
    const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
    std::map<int, glm::dmat4> skinned; // world-from-mesh of skinned meshes, by their first joint
    for (const Deformed& deformed : scene.rig.deformed) {
        if (deformed.skin == kNone) continue;
        const Skin& skin = scene.rig.skins[std::size_t(deformed.skin)];
        if (!skin.joints.empty())
            skinned[deformed.mesh] = worldFromNode[std::size_t(skin.joints.front())] * skin.jointFromBind.front();
    }
    std::vector<std::optional<Box3>> boxesOS(scene.meshes.size()); // computed once per mesh, however many nodes show it
    const auto boxOf = [&](int mesh) -> const Box3& {
        std::optional<Box3>& box = boxesOS[std::size_t(mesh)];
        if (box) return *box;
        box.emplace();
        const Mesh& shown = scene.meshes[std::size_t(mesh)];
        for (const std::uint32_t index : shown.indices) box->extend(glm::dvec3(shown.positionsOS[index]));
        return *box;
    };
    Sizes sizes;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        for (const MeshInstance& instance : scene.nodes[n].instances) {
            const auto found = skinned.find(instance.mesh);
            const glm::dmat4& worldFromMesh = found == skinned.end() ? worldFromNode[n] : found->second;
            double& scale = sizes.scales[instance.mesh];
            scale = std::max(scale, largestScale(worldFromMesh));
            const Box3& boxOS = boxOf(instance.mesh);
            for (int corner = 0; corner < 8 && !boxOS.empty(); ++corner) {
                const glm::bvec3 isMost((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
                sizes.boundsWS.extend(
                    glm::dvec3(worldFromMesh * glm::dvec4(glm::mix(boxOS.min, boxOS.max, isMost), 1.0)));
            }
        }
    return sizes;
}

glm::vec3 faceNormalOS(const Mesh& mesh, std::size_t firstCorner) {
    const auto corner = [&](std::size_t i) { return glm::dvec3(mesh.positionsOS[mesh.indices[firstCorner + i]]); };
    return glm::vec3(normalOfTriangle(corner(0), corner(1), corner(2)));
}

template <typename T>
void unshare(std::vector<T>& values, const std::vector<std::uint32_t>& indices, std::size_t each = 1) {
    if (values.empty()) return;
    std::vector<T> own;
    own.reserve(indices.size() * each);
    for (const std::uint32_t index : indices)
        for (std::size_t i = 0; i < each; ++i) own.push_back(values[index * each + i]);
    values = std::move(own);
}

/// Gives every triangle three unshared vertices and its geometric normal; drops tangents, which belonged to other
/// normals. A triangle without area gets an arbitrary unit normal.
void makeFlat(Shape& shape) {
    Mesh& mesh = shape.rest;
    shape.isFlat = true;
    for (MorphTarget& target : shape.targets) {
        unshare(target.positionsOS, mesh.indices);
        for (auto& set : target.texCoords) unshare(set, mesh.indices);
        unshare(target.colors, mesh.indices);
        target.normalsOS.clear();
        target.tangentsOS.clear();
    }
    unshare(shape.joints, mesh.indices, shape.influences);
    unshare(shape.weights, mesh.indices, shape.influences);
    std::vector<glm::vec3> normalsOS;
    normalsOS.reserve(mesh.indices.size());
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        normalsOS.insert(normalsOS.end(), 3, faceNormalOS(mesh, i));
    unshare(mesh.positionsOS, mesh.indices);
    for (auto& set : mesh.texCoords) unshare(set, mesh.indices);
    unshare(mesh.colors, mesh.indices);
    mesh.normalsOS = std::move(normalsOS);
    mesh.tangentsOS.clear();
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = std::uint32_t(i);
}

/// Normalises normals. Invalid ones (zero, not finite) become the normal of a triangle at the vertex. Returns the
/// number of invalid ones.
std::size_t repairNormals(Mesh& mesh) {
    std::vector<bool> isBroken(mesh.normalsOS.size(), false);
    std::size_t brokenCount = 0;
    for (std::size_t i = 0; i < mesh.normalsOS.size(); ++i) {
        const std::optional<glm::dvec3> normalOS = directionOf(mesh.normalsOS[i]);
        mesh.normalsOS[i] = normalOS.value_or(glm::dvec3(0.0, 0.0, 1.0));
        isBroken[i] = !normalOS;
        brokenCount += normalOS ? 0 : 1;
    }
    for (std::size_t corner = 0; brokenCount > 0 && corner < mesh.indices.size(); ++corner) {
        const std::uint32_t vertex = mesh.indices[corner];
        if (isBroken[vertex]) mesh.normalsOS[vertex] = faceNormalOS(mesh, corner / 3 * 3);
    }
    return brokenCount;
}

/// Normalises tangents and makes their w +1 or -1. Returns false if one has no direction or no sign.
bool normalizeTangents(Mesh& mesh) {
    for (glm::vec4& tangentOS : mesh.tangentsOS) {
        const std::optional<glm::dvec3> direction = directionOf(glm::vec3(tangentOS));
        if (!direction || !(std::abs(tangentOS.w) > 0.0f)) return false;
        tangentOS = glm::vec4(glm::vec3(*direction), tangentOS.w > 0.0f ? 1.0f : -1.0f);
    }
    return true;
}

} // namespace

std::vector<std::uint32_t> thinElements(int mode, std::vector<std::uint32_t> corners,
                                        const std::vector<glm::vec3>& positionsOS, bool endsMayMove) {
    if (mode == kPoints) return corners;
    std::vector<std::uint32_t> ends;
    const auto add = [&](std::uint32_t start, std::uint32_t end) {
        if (endsMayMove || positionsOS[start] != positionsOS[end]) ends.insert(ends.end(), {start, end});
    };
    const std::size_t step = mode == kLines ? 2 : 1;
    ends.reserve(2 * (corners.size() / step + 1));
    for (std::size_t i = 0; i + 1 < corners.size(); i += step) add(corners[i], corners[i + 1]);
    if (mode == kLineLoop && corners.size() > 2) add(corners.back(), corners.front());
    return ends;
}

std::vector<std::uint32_t> cornersOfSolids(int mode, const std::vector<std::uint32_t>& elements) {
    const std::size_t each = mode == kPoints ? 1 : 2;
    std::vector<std::uint32_t> corners;
    corners.reserve(elements.size() / each * kCornersOfSolid);
    for (std::size_t element = 0; element + each <= elements.size(); element += each)
        for (std::size_t i = 0; i < kCornersOfSolid; ++i) {
            const bool isEnd = mode != kPoints && isAtEnd(cornerOf(kPrismTriangles, i));
            corners.push_back(elements[element + (isEnd ? 1 : 0)]);
        }
    return corners;
}

double pointLineWidths(std::size_t points) {
    constexpr double kFewest = 2.0, kMost = 8.0;
    return std::clamp(1.0 / (3.0 * std::sqrt(double(points)) * kLineWidthShare), kFewest, kMost);
}

void sizeThinSolids(Scene& scene, const std::map<int, int>& thinModes) {
    if (thinModes.empty()) return;
    const Sizes sizes = sizesOf(scene);
    const glm::dvec3 sidesWS = sizes.boundsWS.empty() ? glm::dvec3(0.0) : sizes.boundsWS.max - sizes.boundsWS.min;
    const double longestWS = std::max({sidesWS.x, sidesWS.y, sidesWS.z});
    // A single point has no extent: it is as large as in a model of 1 m.
    const double lineWidthWS = kLineWidthShare * (longestWS > 0.0 ? longestWS : 1.0);
    std::size_t points = 0;
    for (const auto& [mesh, mode] : thinModes)
        if (mode == kPoints) points += scene.meshes[std::size_t(mesh)].positionsOS.size() / kCornersOfSolid;
    const double pointWidths = pointLineWidths(points);
    const auto scaleOf = [&](int mesh) {
        const auto scale = sizes.scales.find(mesh);
        return scale == sizes.scales.end() ? 0.0 : scale->second;
    };
    std::map<int, double> shapeScales; // largest by shape, over all its deformed meshes
    for (const Deformed& deformed : scene.rig.deformed) {
        double& scale = shapeScales[deformed.shape];
        scale = std::max(scale, scaleOf(deformed.mesh));
    }
    const auto inflateAt = [&](Mesh& mesh, int mode, double scale) {
        const double widthOS = (mode == kPoints ? pointWidths : 1.0) * lineWidthWS / (scale > 0.0 ? scale : 1.0);
        if (std::isfinite(widthOS) && widthOS > 0.0) inflate(mesh, mode, widthOS);
    };
    std::map<int, int> shapes; // by mesh
    for (const Deformed& deformed : scene.rig.deformed) shapes[deformed.mesh] = deformed.shape;
    std::set<int> inflated; // shapes
    for (const auto& [mesh, mode] : thinModes) {
        Mesh& drawn = scene.meshes[std::size_t(mesh)];
        const auto shape = shapes.find(mesh);
        if (shape == shapes.end()) {
            inflateAt(drawn, mode, scaleOf(mesh));
            continue;
        }
        Mesh& rest = scene.rig.shapes[std::size_t(shape->second)].rest;
        if (inflated.insert(shape->second).second) inflateAt(rest, mode, shapeScales[shape->second]);
        std::ranges::copy(rest.positionsOS, drawn.positionsOS.begin());
        std::ranges::copy(rest.normalsOS, drawn.normalsOS.begin());
    }
    for (const bool arePoints : {false, true})
        if (std::ranges::any_of(thinModes, [&](const auto& entry) { return (entry.second == kPoints) == arePoints; }))
            scene.notes.push_back(
                fmt::format("its {} are drawn as thin solids, {:.2g} % of the model's longest side wide",
                            arePoints ? "points" : "lines", 100.0 * kLineWidthShare * (arePoints ? pointWidths : 1.0)));
}

std::vector<std::uint32_t> trianglesOf(int mode, std::vector<std::uint32_t> corners) {
    if (mode != kStrip && mode != kFan) {
        corners.resize(corners.size() / 3 * 3);
        return corners;
    }
    std::vector<std::uint32_t> triangles;
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        const bool isOdd = i % 2 == 1;
        const std::uint32_t a = mode == kFan ? corners[i + 1] : corners[i];
        const std::uint32_t b = mode == kFan ? corners[i + 2] : corners[i + (isOdd ? 2 : 1)];
        const std::uint32_t c = mode == kFan ? corners[0] : corners[i + (isOdd ? 1 : 2)];
        if (a != b && b != c && c != a) triangles.insert(triangles.end(), {a, b, c});
    }
    return triangles;
}

void finishNormals(Context& context, const std::string& place, Shape& shape) {
    Mesh& mesh = shape.rest;
    // Drops morphed attributes that the mesh lacks.
    for (MorphTarget& target : shape.targets) {
        if (mesh.colors.empty()) target.colors.clear();
        for (std::size_t set = 0; set < mesh.texCoords.size(); ++set)
            if (mesh.texCoords[set].empty()) target.texCoords[set].clear();
    }
    if (mesh.normalsOS.empty()) {
        constexpr std::size_t kMostVertexBytes = 2 * sizeof(glm::vec3) + 2 * sizeof(glm::vec2) + sizeof(glm::vec4);
        const std::size_t mostBytes =
            (1 + shape.targets.size()) * kMostVertexBytes + shape.influences * (sizeof(std::uint32_t) + sizeof(float));
        context.document.charge(mesh.indices.size() * mostBytes, place);
        return makeFlat(shape);
    }
    if (const std::size_t broken = repairNormals(mesh); broken > 0)
        context.warn("{}/attributes/NORMAL: {} normals have no direction; their triangles' are used", place, broken);
    if (!normalizeTangents(mesh)) {
        mesh.tangentsOS.clear();
        context.warn("{}/attributes/TANGENT: holds tangents without a direction; tangents are derived instead", place);
    }
    if (mesh.tangentsOS.empty())
        for (MorphTarget& target : shape.targets) target.tangentsOS.clear();
}

} // namespace tessera::scenes::gltf
