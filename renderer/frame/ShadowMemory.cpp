#include "renderer/frame/ShadowMemory.h"

#include <algorithm>
#include <cmath>

namespace tessera::frame {

namespace {

bool haveOnePlace(const ShadowFace& a, const ShadowFace& b) {
    return a.cornerTexels == b.cornerTexels && a.sideTexels == b.sideTexels;
}

/// Whether all of a draw lies farther along a face's camera than its light reaches.
bool isBeyond(const Draw& draw, const ShadowFace& face) {
    if (std::isinf(face.reachMetres) || draw.boxWS.empty()) return false;
    const glm::dmat4& world = face.camera.worldFromCamera;
    const glm::dvec3 forwardWS = -glm::dvec3(world[2]), eyeWS = glm::dvec3(world[3]);
    const glm::dvec3 low = draw.boxWS.min - eyeWS, high = draw.boxWS.max - eyeWS;
    const double nearest = glm::dot(glm::min(low * forwardWS, high * forwardWS), glm::dvec3(1.0));
    // Far more than rounding moves vertices, as where draws are culled by planes.
    const double errorMetres = 1e-5 * (glm::length(glm::max(glm::abs(low), glm::abs(high))) + 2.0 * draw.reachMetres);
    return nearest > 1.001 * face.reachMetres + errorMetres;
}

} // namespace

bool ShadowMemory::begin(const ShadowMaps& maps, const SceneGpu& scene, bool holdsAtlas, bool culls) {
    const std::uint64_t casters = scene.casterRevision();
    // Where one face has moved, others may lie over it.
    const bool keeps =
        holdsAtlas && casters == held_.casters && std::ranges::equal(maps.faces, held_.faces, haveOnePlace);
    if (!keeps) held_ = {};
    draws_ = {};
    drawnFaces_ = 0;
    for (std::size_t i = 0; i < maps.faces.size(); ++i) {
        const ShadowFace& face = maps.faces[i];
        if (keeps && face == held_.faces[i]) continue;
        const CameraView view = faceView(face);
        const ViewDraws drawn = makeViewDraws(scene.drawList(), view, culls, [&](const Draw& draw) {
            return scene.isCaster(draw) && !(culls && isBeyond(draw, face));
        });
        ShadowDraws::Face& added =
            draws_.faces.emplace_back(face.cornerTexels, face.sideTexels, view.constants, drawn.opaque);
        const int first = int(draws_.rows.size());
        for (Batch& batch : added.batches) batch.first += first;
        for (gpu::DrawIndexedCommand command : scene.commandsOf(drawn)) {
            command.baseInstance += std::uint32_t(first);
            draws_.commands.push_back(command);
        }
        draws_.rows.insert(draws_.rows.end(), drawn.rows.begin(), drawn.rows.end());
    }
    begun_ = {casters, maps.faces};
    return !draws_.faces.empty() || !holdsAtlas;
}

ShadowMemory& ShadowMemories::of(std::size_t view, const FrameSettings& settings) {
    for (Way& way : ways_) {
        if (way.view != view || way.filter != settings.shadowFilter || way.maps != settings.shadowMaps) continue;
        way.idleFrames = 0;
        return *way.memory;
    }
    const auto isTaken = [&](std::size_t number) {
        return std::ranges::any_of(ways_, [&](const Way& way) { return way.memory->number_ == number; });
    };
    auto memory = std::make_unique<ShadowMemory>();
    while (isTaken(memory->number_)) ++memory->number_;
    return *ways_.emplace_back(view, settings.shadowFilter, settings.shadowMaps, std::move(memory)).memory;
}

void ShadowMemories::forget() {
    for (Way& way : ways_) way.memory->held_ = {};
}

void ShadowMemories::beginFrame() {
    std::erase_if(ways_, [](Way& way) { return ++way.idleFrames > kMostIdleFrames; });
}

} // namespace tessera::frame
