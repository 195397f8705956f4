#include "renderer/frame/VertexStreams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "base/Error.h"
#include "renderer/frame/Tangents.h"
#include "scenes/InUse.h"
#include "scenes/Shadows.h"
#include "shaders/shared/facet.h"

namespace tessera::frame {

namespace {

/// Appends a mesh's attribute, or `count` neutral values where the mesh has none; then those of the copied vertices.
template <typename T>
void append(std::vector<T>& stream, const std::vector<T>& values, std::size_t count,
            const std::vector<std::uint32_t>& copiedOf, const T& neutral) {
    if (values.empty()) {
        stream.resize(stream.size() + count + copiedOf.size(), neutral);
    } else {
        stream.insert(stream.end(), values.begin(), values.end());
        for (const std::uint32_t vertex : copiedOf) stream.push_back(values[vertex]);
    }
}

/// Whether softened terminators lift points of a triangle with this normal: its corners have different normals, all
/// within kMostLiftedDegrees of it.
bool isLifted(const glm::dvec3& facetNormal, const std::array<glm::dvec3, 3>& cornerNormals) {
    if (cornerNormals[0] == cornerNormals[1] && cornerNormals[1] == cornerNormals[2]) return false;
    static const double kLeastCosine = std::cos(glm::radians(scenes::kMostLiftedDegrees));
    return std::ranges::all_of(cornerNormals, [&](const glm::dvec3& normal) {
        return glm::dot(normal, facetNormal) >= kLeastCosine * glm::length(normal);
    });
}

/// By vertex, the normal of the triangles whose last corner it is, of length LIFTED_FACET if their points are lifted,
/// else unit. If the normals of two triangles differ, the second gets a copy of the vertex. Triangles without area are
/// invisible and share any vertex.
std::vector<glm::vec3> splitByFacets(const scenes::Mesh& mesh, TangentMesh& split) {
    const std::size_t own = mesh.positionsOS.size();
    const auto ownVertex = [&](std::uint32_t vertex) { return vertex < own ? vertex : split.copiedOf[vertex - own]; };
    std::vector<glm::vec3> normalsOS(own + split.copiedOf.size(), glm::vec3(0.0f));
    for (std::size_t first = 0; first + 2 < split.indices.size(); first += 3) {
        const auto corner = [&](std::size_t c) {
            return glm::dvec3(mesh.positionsOS[ownVertex(split.indices[first + c])]);
        };
        const glm::dvec3 normal = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
        const double length = glm::length(normal);
        if (!(length > 0.0)) continue;
        const auto cornerNormal = [&](std::size_t c) {
            return glm::dvec3(mesh.normalsOS[ownVertex(split.indices[first + c])]);
        };
        const bool lifts =
            !mesh.normalsOS.empty() && isLifted(normal / length, {cornerNormal(0), cornerNormal(1), cornerNormal(2)});
        const glm::vec3 normalOS(normal / length * (lifts ? double(LIFTED_FACET) : 1.0));
        const std::uint32_t last = split.indices[first + 2];
        if (normalsOS[last] == glm::vec3(0.0f)) {
            normalsOS[last] = normalOS;
        } else if (normalsOS[last] != normalOS) {
            split.indices[first + 2] = std::uint32_t(normalsOS.size());
            split.copiedOf.push_back(ownVertex(last));
            if (!split.tangentsOS.empty()) split.tangentsOS.push_back(glm::vec4(split.tangentsOS[last]));
            normalsOS.push_back(normalOS);
        }
    }
    return normalsOS;
}

VertexStreams::Range appendMesh(VertexStreams& streams, const scenes::Mesh& mesh, const FeatureSet& features,
                                const std::optional<TangentBasis>& basis) {
    TangentMesh split{mesh.indices, {}, mesh.tangentsOS};
    if (features.tangents() && basis) split = meshWithTangents(mesh, *basis);
    std::vector<glm::vec3> facetNormalsOS;
    if (features[Feature::Shadows]) facetNormalsOS = splitByFacets(mesh, split);
    const VertexStreams::Range range{std::uint32_t(streams.indices.size()), std::uint32_t(split.indices.size()),
                                     std::int32_t(streams.positionsOS.size())};
    streams.indices.insert(streams.indices.end(), split.indices.begin(), split.indices.end());
    const auto copy = [&](auto& stream, const auto& values, const auto& neutral) {
        append(stream, values, mesh.positionsOS.size(), split.copiedOf, neutral);
    };
    copy(streams.positionsOS, mesh.positionsOS, glm::vec3(0.0f));
    copy(streams.normalsOS, mesh.normalsOS, glm::vec3(0.0f));
    if (features.tangents())
        append(streams.tangentsOS, split.tangentsOS, mesh.positionsOS.size() + split.copiedOf.size(), {},
               glm::vec4(1.0f, 0.0f, 0.0f, 1.0f));
    if (features.texCoords()) copy(streams.texCoords[0], mesh.texCoords[0], glm::vec2(0.0f));
    if (features[Feature::TexCoord1]) copy(streams.texCoords[1], mesh.texCoords[1], glm::vec2(0.0f));
    if (features[Feature::VertexColor]) copy(streams.colors, mesh.colors, glm::vec4(1.0f));
    streams.facetNormalsOS.insert(streams.facetNormalsOS.end(), facetNormalsOS.begin(), facetNormalsOS.end());
    return range;
}

/// A mesh with the tangents that some of its materials need.
struct Version {
    std::optional<TangentBasis> basis;
    std::set<int> materials;
};

/// The versions of each drawn mesh, in document order. Materials without tangents share any version.
std::vector<std::vector<Version>> versionsOf(const scenes::Scene& scene) {
    std::vector<std::vector<Version>> meshes(scene.meshes.size());
    for (const scenes::Node& node : scene.nodes) {
        for (const scenes::MeshInstance& instance : node.instances) {
            if (!scenes::isDrawn(scene, instance)) continue;
            const std::optional<TangentBasis> basis = tangentBasis(scene.materials[std::size_t(instance.material)]);
            std::vector<Version>& versions = meshes[std::size_t(instance.mesh)];
            auto fitting = std::find_if(versions.begin(), versions.end(), [&](const Version& version) {
                return !basis || !version.basis || version.basis == basis;
            });
            if (fitting == versions.end()) fitting = versions.insert(fitting, Version{});
            if (basis) fitting->basis = basis;
            fitting->materials.insert(instance.material);
        }
    }
    return meshes;
}

/// Most vertices copied for materials that need different tangents: about 2 GiB.
constexpr std::size_t kMostCopiedVertices = std::size_t(1) << 25;

/// Upper bound: MikkTSpace may give each corner of a triangle its own vertex, shadows the last corner.
std::size_t mostVertices(const scenes::Mesh& mesh, const Version& version, const FeatureSet& features) {
    const bool splits =
        mesh.tangentsOS.empty() && version.basis && version.basis->method == scenes::TangentMethod::MikkTSpace;
    if (splits) return std::max(mesh.positionsOS.size(), mesh.indices.size());
    return mesh.positionsOS.size() + (features[Feature::Shadows] ? mesh.indices.size() / 3 : 0);
}

void requireFewCopies(const scenes::Scene& scene, const std::vector<std::vector<Version>>& versions,
                      const FeatureSet& features) {
    std::size_t copied = 0;
    for (std::size_t mesh = 0; mesh < versions.size(); ++mesh) {
        for (std::size_t further = 1; further < versions[mesh].size(); ++further)
            copied += mostVertices(scene.meshes[mesh], versions[mesh][further], features);
        if (copied > kMostCopiedVertices)
            throw InputError(
                fmt::format("materials need different tangents of their meshes, which takes copies of more than {} "
                            "vertices ('{}' has {} such materials); give the textures that tangents follow one "
                            "transform, one set of coordinates and one method",
                            kMostCopiedVertices, scene.meshes[mesh].name, versions[mesh].size()));
    }
}

} // namespace

std::vector<std::string> streamNames(const FeatureSet& features) {
    std::vector<std::string> names{"positions", "normals"};
    if (features.tangents()) names.emplace_back("tangents");
    if (features.texCoords()) names.emplace_back("texture_coordinates_0");
    if (features[Feature::TexCoord1]) names.emplace_back("texture_coordinates_1");
    if (features[Feature::VertexColor]) names.emplace_back("vertex_colors");
    return names;
}

VertexStreams makeVertexStreams(const scenes::Scene& scene, const FeatureSet& features) {
    VertexStreams streams;
    const std::vector<std::vector<Version>> versions = versionsOf(scene);
    if (features.tangents()) requireFewCopies(scene, versions, features);
    for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh) {
        for (const Version& version : versions[mesh]) {
            const VertexStreams::Range range = appendMesh(streams, scene.meshes[mesh], features, version.basis);
            for (const int material : version.materials) streams.ranges[{int(mesh), material}] = range;
        }
    }
    return streams;
}

} // namespace tessera::frame
