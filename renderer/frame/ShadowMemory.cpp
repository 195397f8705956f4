#include "renderer/frame/ShadowMemory.h"

#include <algorithm>
#include <cmath>

namespace tessera::frame {

namespace {

bool haveOnePlace(const ShadowFace& a, const ShadowFace& b) {
    return a.cornerTexels == b.cornerTexels && a.sideTexels == b.sideTexels;
}

/// Whether a draw lies entirely beyond the light's range along a face's camera.
bool isBeyond(const Draw& draw, const glm::dvec3& objectWS, const ShadowFace& face, const CameraView& view) {
    if (std::isinf(face.reachMetres) || draw.boxWS.empty()) return false;
    constexpr double kRangeRounding = 1e-5; // of the range in fp32; shaders read its inverse square
    const glm::dvec3 forwardWS = view.forwardLS * view.lsFromWorld;
    const glm::dvec3 low = draw.boxWS.min - view.eyeWS, high = draw.boxWS.max - view.eyeWS;
    const double nearest = glm::dot(glm::min(low * forwardWS, high * forwardWS), glm::dvec3(1.0));
    return nearest > (1.0 + kRangeRounding) * face.reachMetres + roundingMetres(draw, objectWS, view);
}

} // namespace

bool ShadowMemory::begin(const ShadowMaps& maps, const SceneGpu& scene, bool holdsAtlas, bool culls) {
    const std::uint64_t casters = scene.casterRevision();
    // If one face has moved, another one may overwrite it.
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
            const glm::dvec3 objectWS(scene.drawList().worldFromObject[std::size_t(draw.node)][3]);
            return scene.isCaster(draw) && !(culls && isBeyond(draw, objectWS, face, view));
        });
        ShadowDraws::Face& added = draws_.faces.emplace_back(
            ShadowDraws::Face{face.cornerTexels, face.sideTexels, view.constants, drawn.opaque});
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
    return *ways_.emplace_back(Way{view, settings.shadowFilter, settings.shadowMaps, std::move(memory)}).memory;
}

void ShadowMemories::beginFrame() {
    std::erase_if(ways_, [](Way& way) { return ++way.idleFrames > kMostIdleFrames; });
}

void ShadowMemories::forget() {
    for (Way& way : ways_) way.memory->held_ = {};
}

} // namespace tessera::frame
