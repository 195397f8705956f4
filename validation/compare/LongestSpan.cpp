#include "validation/compare/LongestSpan.h"

#include <algorithm>

#include <fmt/format.h>

#include "scenes/Shadows.h"

namespace tessera::validation {

namespace {

struct Longest {
    double metres = -1.0;
    std::string name;

    template <typename Name>
    void take(double otherMetres, Name&& nameOf) {
        if (!(otherMetres > metres)) return;
        metres = otherMetres;
        name = nameOf();
    }
};

void takeCasters(const scenes::Scene& scene, Longest& longest) {
    const std::vector<glm::dmat4> worldFromNode = scenes::worldFromNodes(scene);
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        for (const scenes::MeshInstance& instance : scene.nodes[n].instances) {
            if (!scenes::isCaster(scene, instance)) continue;
            const scenes::Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
                const glm::dvec3 position(mesh.positionsOS[mesh.indices[i]]);
                longest.take(glm::length(glm::dvec3(worldFromNode[n] * glm::dvec4(position, 1.0))), [&] {
                    return fmt::format("triangle {} of mesh '{}' at node '{}'", i / 3, mesh.name, scene.nodes[n].name);
                });
            }
        }
    }
}

void takeLights(const scenes::Scene& scene, Longest& longest) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const scenes::Light& light = scene.lights[i];
        if (!light.enabled || !scenes::infoOf(light.type).hasPosition()) continue;
        longest.take(glm::length(light.positionWS) + scenes::shadowRadiusMetres(light),
                     [&] { return fmt::format("light {} '{}'", i, light.name); });
    }
}

} // namespace

std::string longestSpan(const scenes::Scene& scene) {
    Longest longest;
    takeCasters(scene, longest);
    takeLights(scene, longest);
    if (longest.name.empty()) return {};
    return fmt::format("{}, which reaches {:.3g} m from the origin", longest.name, longest.metres);
}

} // namespace tessera::validation
