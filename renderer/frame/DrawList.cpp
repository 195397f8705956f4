#include "renderer/frame/DrawList.h"

#include <algorithm>

#include "scenes/InUse.h"

namespace tessera::frame {

namespace {

bool isTransparent(const scenes::Scene& scene, const Draw& draw) {
    return scene.materials[std::size_t(draw.material)].alphaMode == scenes::AlphaMode::Blend;
}

glm::dvec3 boxCenter(const scenes::Mesh& mesh) {
    scenes::Box3 box;
    for (const glm::vec3& position : mesh.positionsOS) box.extend(glm::dvec3(position));
    return box.empty() ? glm::dvec3(0.0) : 0.5 * (box.min + box.max);
}

/// Draw::largestColor of a mesh.
float largestColor(const scenes::Mesh& mesh) {
    float largest = mesh.colors.empty() ? 0.0f : 1.0f;
    for (const glm::vec4& color : mesh.colors) largest = std::max({largest, color.r, color.g, color.b, color.a});
    return largest;
}

/// cof M: the matrix of 2x2 minors with their signs; its columns are cross products of M's columns.
glm::dmat3 cofactor(const glm::dmat3& m) {
    return {glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1])};
}

} // namespace

DrawList makeDrawList(const scenes::Scene& scene) {
    DrawList list;
    list.worldFromObject = worldFromNodes(scene);
    std::vector<glm::dvec3> centersOS(scene.meshes.size());
    std::transform(scene.meshes.begin(), scene.meshes.end(), centersOS.begin(), boxCenter);
    std::vector<float> largestColors(scene.meshes.size());
    std::transform(scene.meshes.begin(), scene.meshes.end(), largestColors.begin(), largestColor);
    int number = 0;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        const glm::dmat4& worldFromObject = list.worldFromObject[node];
        const bool mirrored = glm::determinant(glm::dmat3(worldFromObject)) < 0.0;
        for (const scenes::MeshInstance& instance : scene.nodes[node].instances) {
            const int own = number++;
            if (!scenes::isDrawn(scene, instance)) continue;
            const glm::dvec3 centerWS(worldFromObject * glm::dvec4(centersOS[std::size_t(instance.mesh)], 1.0));
            list.draws.push_back({instance.mesh, instance.material, int(node), own, mirrored,
                                  largestColors[std::size_t(instance.mesh)], centerWS});
        }
    }
    const auto transparent = std::stable_partition(list.draws.begin(), list.draws.end(),
                                                   [&](const Draw& draw) { return !isTransparent(scene, draw); });
    std::stable_sort(list.draws.begin(), transparent, [](const Draw& a, const Draw& b) {
        return a.material != b.material ? a.material < b.material : a.mirrored < b.mirrored;
    });
    list.firstTransparent = int(transparent - list.draws.begin());
    for (int i = 0; i < list.firstTransparent; ++i) {
        const Draw& draw = list.draws[std::size_t(i)];
        if (list.opaque.empty() || list.opaque.back().material != draw.material ||
            list.opaque.back().mirrored != draw.mirrored) {
            list.opaque.push_back({i, 0, draw.material, draw.mirrored});
        }
        ++list.opaque.back().count;
    }
    return list;
}

std::vector<Batch> sortedTransparent(const DrawList& list, const CameraView& view) {
    std::vector<Batch> batches;
    std::vector<double> depth(list.draws.size(), 0.0);
    for (int i = list.firstTransparent; i < int(list.draws.size()); ++i) {
        const Draw& draw = list.draws[std::size_t(i)];
        depth[std::size_t(i)] = glm::dot(view.forwardLS, view.lsFromWorld * (draw.centerWS - view.eyeWS));
        batches.push_back({i, 1, draw.material, draw.mirrored});
    }
    std::stable_sort(batches.begin(), batches.end(), [&](const Batch& a, const Batch& b) {
        return depth[std::size_t(a.first)] > depth[std::size_t(b.first)];
    });
    return batches;
}

std::vector<DrawRows> makeDrawRows(const DrawList& list, const CameraView& view) {
    std::vector<DrawRows> rows(list.draws.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const glm::dmat4& worldFromObject = list.worldFromObject[std::size_t(list.draws[i].node)];
        const glm::dmat3 linear(worldFromObject);
        const glm::dvec3 originRS = glm::dvec3(worldFromObject[3]) - view.originWS;
        const double sign = list.draws[i].mirrored ? -1.0 : 1.0;
        glm::dmat3 normal = cofactor(view.lsFromWorld * linear) * sign;
        // Scaled to order one: the cofactors of a node scaled by 1e-20 would leave fp32's range.
        double largest = 0.0;
        for (int c = 0; c < 3; ++c)
            largest = std::max({largest, std::abs(normal[c].x), std::abs(normal[c].y), std::abs(normal[c].z)});
        if (largest > 0.0) normal /= largest;
        const double extra[3] = {sign, double(list.draws[i].largestColor), 1.0 + list.draws[i].instance};
        for (int r = 0; r < 3; ++r) {
            rows[i].position[r] = glm::vec4(linear[0][r], linear[1][r], linear[2][r], originRS[r]);
            rows[i].normal[r] = glm::vec4(normal[0][r], normal[1][r], normal[2][r], extra[r]);
        }
    }
    return rows;
}

} // namespace tessera::frame
