#include "renderer/frame/DrawList.h"

#include <algorithm>

#include "scenes/InUse.h"

namespace tessera::frame {

namespace {

bool isTransparent(const scenes::Scene& scene, const Draw& draw) {
    return scenes::isTransparent(scene.materials[std::size_t(draw.material)]);
}

scenes::Box3 boxOf(const scenes::Mesh& mesh) {
    scenes::Box3 box;
    for (const glm::vec3& position : mesh.positionsOS) box.extend(glm::dvec3(position));
    return box;
}

/// Bounding box of a transformed box.
scenes::Box3 transformed(const scenes::Box3& box, const glm::dmat4& transform) {
    scenes::Box3 result;
    if (box.empty()) return result;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                               corner & 4 ? box.max.z : box.min.z);
        result.extend(glm::dvec3(transform * glm::dvec4(point, 1.0)));
    }
    return result;
}

/// Draw::reachMetres of a mesh with this box.
double reachOf(const scenes::Box3& boxOS, const glm::dmat4& worldFromObject) {
    if (boxOS.empty()) return 0.0;
    const glm::dvec3 farthestOS = glm::max(glm::abs(boxOS.min), glm::abs(boxOS.max));
    double metres = 0.0;
    for (int axis = 0; axis < 3; ++axis) metres += glm::length(glm::dvec3(worldFromObject[axis])) * farthestOS[axis];
    return metres;
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
    std::vector<scenes::Box3> boxesOS(scene.meshes.size());
    std::transform(scene.meshes.begin(), scene.meshes.end(), boxesOS.begin(), boxOf);
    std::vector<float> largestColors(scene.meshes.size());
    std::transform(scene.meshes.begin(), scene.meshes.end(), largestColors.begin(), largestColor);
    int number = 0;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        const glm::dmat4& worldFromObject = list.worldFromObject[node];
        const bool mirrored = glm::determinant(glm::dmat3(worldFromObject)) < 0.0;
        for (const scenes::MeshInstance& instance : scene.nodes[node].instances) {
            const int own = number++;
            if (!scenes::isDrawn(scene, instance)) continue;
            const scenes::Box3& boxOS = boxesOS[std::size_t(instance.mesh)];
            const glm::dvec3 centerOS = boxOS.empty() ? glm::dvec3(0.0) : 0.5 * (boxOS.min + boxOS.max);
            list.draws.push_back({instance.mesh, instance.material, int(node), own, mirrored, instance.castsShadow, 0,
                                  largestColors[std::size_t(instance.mesh)], transformed(boxOS, worldFromObject),
                                  reachOf(boxOS, worldFromObject),
                                  glm::dvec3(worldFromObject * glm::dvec4(centerOS, 1.0))});
        }
    }
    const auto transparent = std::stable_partition(list.draws.begin(), list.draws.end(),
                                                   [&](const Draw& draw) { return !isTransparent(scene, draw); });
    std::stable_sort(list.draws.begin(), transparent, [](const Draw& a, const Draw& b) {
        return a.material != b.material ? a.material < b.material : a.mirrored < b.mirrored;
    });
    list.firstTransparent = int(transparent - list.draws.begin());
    return list;
}

namespace {

/// Extends `area` by the pixels that a draw's box may cover.
void extend(PixelArea& area, const Draw& draw, const glm::dvec3& objectWS, const CameraView& view) {
    const scenes::Box3& boxWS = draw.boxWS;
    const glm::ivec2 size(view.constants.sizePixels);
    const PixelArea whole{{0, 0}, size};
    if (boxWS.empty() || area == whole) return;
    const glm::dvec3 margin(roundingMetres(draw, objectWS, view));
    const glm::dvec3 low = boxWS.min - margin, high = boxWS.max + margin;
    glm::dvec2 lowest(1.0), highest(-1.0); // in normalised device coordinates
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 positionWS(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                                    corner & 4 ? high.z : low.z);
        const glm::dvec4 clip = view.clipFromLS * glm::dvec4(view.positionLS(positionWS), 1.0);
        if (!(clip.w > 0.0)) { // behind the eye: the box may cover any pixel
            area = whole;
            return;
        }
        lowest = glm::min(lowest, glm::dvec2(clip) / clip.w);
        highest = glm::max(highest, glm::dvec2(clip) / clip.w);
    }
    const auto pixel = [&](const glm::dvec2& place, double more) {
        return glm::ivec2(glm::clamp((place * 0.5 + 0.5) * glm::dvec2(size) + more, glm::dvec2(0.0), glm::dvec2(size)));
    };
    // One pixel of margin each way, since rasterisers snap vertices to subpixels; `high` is exclusive.
    const PixelArea own{pixel(lowest, -1.0), pixel(highest, 2.0)};
    if (own.empty()) return;
    area = area.empty() ? own : PixelArea{glm::min(area.low, own.low), glm::max(area.high, own.high)};
}

DrawRows rowsOf(const Draw& draw, const glm::dmat4& worldFromObject, const CameraView& view) {
    const glm::dmat3 linear(worldFromObject);
    const glm::dvec3 originRWS = glm::dvec3(worldFromObject[3]) - view.originWS;
    const double sign = draw.mirrored ? -1.0 : 1.0;
    glm::dmat3 normal = cofactor(view.lsFromWorld * linear) * sign;
    // Scaled to order one: the cofactors of a node scaled by 1e-20 would leave fp32's range.
    double largest = 0.0;
    for (int c = 0; c < 3; ++c)
        largest = std::max({largest, std::abs(normal[c].x), std::abs(normal[c].y), std::abs(normal[c].z)});
    if (largest > 0.0) normal /= largest;
    const double extra[3] = {sign * (1.0 + draw.diffusionNumber), double(draw.largestColor), 1.0 + draw.instance};
    DrawRows rows;
    for (int r = 0; r < 3; ++r) {
        rows.position[r] = glm::vec4(linear[0][r], linear[1][r], linear[2][r], originRWS[r]);
        rows.normal[r] = glm::vec4(normal[0][r], normal[1][r], normal[2][r], extra[r]);
    }
    return rows;
}

} // namespace

double roundingMetres(const Draw& draw, const glm::dvec3& objectWS, const CameraView& view) {
    constexpr double kSingleShare = 1e-5, kDoubleShare = 0x1p-50;
    const glm::dvec3 fromOrigin =
        glm::max(glm::abs(draw.boxWS.min - view.originWS), glm::abs(draw.boxWS.max - view.originWS));
    const glm::dvec3 fromWorld = glm::max(glm::abs(draw.boxWS.min), glm::abs(draw.boxWS.max));
    return kSingleShare * (draw.reachMetres + glm::distance(objectWS, view.originWS) + glm::length(fromOrigin)) +
           kDoubleShare * (glm::length(fromWorld) + glm::length(objectWS) + draw.reachMetres);
}

std::vector<DepthBatch> depthBatches(const scenes::Scene& scene, std::span<const Batch> batches) {
    std::vector<DepthBatch> result;
    for (const Batch& batch : batches) {
        const scenes::Material& material = scene.materials[std::size_t(batch.material)];
        const bool isMasked = material.alphaMode == scenes::AlphaMode::Mask;
        const DepthBatch own{batch.first, batch.count, batch.mirrored, material.doubleSided,
                             isMasked ? std::optional<int>(batch.material) : std::nullopt};
        const bool goesOn = !result.empty() && !isMasked && !result.back().maskedBy &&
                            result.back().first + result.back().count == own.first &&
                            result.back().mirrored == own.mirrored && result.back().doubleSided == own.doubleSided;
        if (goesOn)
            result.back().count += own.count;
        else
            result.push_back(own);
    }
    return result;
}

ViewDraws makeViewDraws(const DrawList& list, const CameraView& view, bool culls,
                        const std::function<bool(const Draw&)>& isWanted) {
    ViewDraws result;
    std::vector<double> depths; ///< parallel to seen
    for (int i = 0; i < int(list.draws.size()); ++i) {
        const Draw& draw = list.draws[std::size_t(i)];
        const glm::dmat4& worldFromObject = list.worldFromObject[std::size_t(draw.node)];
        if (isWanted && !isWanted(draw)) continue;
        if (culls && isOutside(draw.boxWS, roundingMetres(draw, glm::dvec3(worldFromObject[3]), view), view)) continue;
        const int place = int(result.seen.size());
        result.seen.push_back(i);
        result.rows.push_back(rowsOf(draw, worldFromObject, view));
        depths.push_back(glm::dot(view.forwardLS, view.lsFromWorld * (draw.centerWS - view.eyeWS)));
        if (i >= list.firstTransparent) {
            result.transparent.push_back({place, 1, draw.material, draw.mirrored});
            continue;
        }
        extend(result.opaquePixels, draw, glm::dvec3(worldFromObject[3]), view);
        if (result.opaque.empty() || result.opaque.back().material != draw.material ||
            result.opaque.back().mirrored != draw.mirrored)
            result.opaque.push_back({place, 0, draw.material, draw.mirrored});
        ++result.opaque.back().count;
    }
    std::stable_sort(result.transparent.begin(), result.transparent.end(), [&](const Batch& a, const Batch& b) {
        return depths[std::size_t(a.first)] > depths[std::size_t(b.first)];
    });
    return result;
}

} // namespace tessera::frame
