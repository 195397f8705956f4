#pragma once
#include <array>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "scenes/Scene.h"

namespace tessera::test {

/// A mesh without tangents, and MikkTSpace's tangents of its corners, one per index.
struct MikkTSpaceTruth {
    std::string name;
    scenes::Mesh mesh;
    std::vector<glm::vec4> tangentsOS;
};

/// The meshes of mikktspace.json, from Blender 3.4.1: smooth and mirrored, sheared, flat, and with two triangles of
/// constant texture coordinates, whose tangent sign is -1. Vertices that differ only in their tangents are merged if
/// `isIndexed`; else every corner has a separate vertex.
inline std::vector<MikkTSpaceTruth> mikkTSpaceTruth(bool isIndexed) {
    std::ifstream file(TESSERA_SOURCE_DIR "/tests/support/mikktspace.json");
    const nlohmann::json meshes = nlohmann::json::parse(file).at("meshes");
    std::vector<MikkTSpaceTruth> all;
    for (const auto& [name, json] : meshes.items()) {
        MikkTSpaceTruth truth{name, {}, {}};
        std::map<std::array<float, 8>, std::uint32_t> known;
        for (const std::size_t index : json.at("indices").get<std::vector<std::size_t>>()) {
            const auto v = json.at("vertices")[index].get<std::array<float, 12>>();
            truth.tangentsOS.emplace_back(v[8], v[9], v[10], v[11]);
            scenes::Mesh& mesh = truth.mesh;
            const std::array<float, 8> same = {v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]};
            const auto next = std::uint32_t(mesh.positionsOS.size());
            const std::uint32_t vertex = isIndexed ? known.emplace(same, next).first->second : next;
            mesh.indices.push_back(vertex);
            if (vertex != next) continue;
            mesh.positionsOS.emplace_back(v[0], v[1], v[2]);
            mesh.normalsOS.push_back(glm::normalize(glm::vec3(v[3], v[4], v[5])));
            mesh.texCoords[0].emplace_back(v[6], 1.0f - v[7]);
        }
        all.push_back(truth);
    }
    return all;
}

} // namespace tessera::test
