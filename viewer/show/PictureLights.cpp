#include "viewer/show/PictureLights.h"

#include <cassert>

#include "validation/culling/VisitedLights.h"

namespace tessera::viewer {

bool PictureLights::areCounted(const engine::ViewRequest& view) {
    return frame::sumsOverLights(view.settings.view) && !infoOf(view.technique).addsByBlending &&
           view.settings.samples == 1;
}

std::optional<std::size_t> PictureLights::visitedAt(glm::ivec2 pixel) const {
    const glm::ivec2 size(lists_.view.sizePixels);
    assert(pixel.x >= 0 && pixel.y >= 0 && pixel.x < size.x && pixel.y < size.y);
    const int row = size.y - 1 - pixel.y;
    const float depth = depth_.at(std::size_t(row) * std::size_t(size.x) + std::size_t(pixel.x));
    if (!(depth > 0.0f)) return std::nullopt;
    const validation::VisitedLights visited(lists_);
    std::vector<int> sceneLights;
    visited.at(visited.cellAt(pixel.x, row, depth), sceneLights);
    return sceneLights.size();
}

} // namespace tessera::viewer
