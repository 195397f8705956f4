#include "viewer/edit/LightHandle.h"

#include <cmath>

#include <fmt/format.h>

namespace tessera::viewer {

std::optional<std::size_t> handleAt(std::span<const LightHandle> handles, const glm::dvec2& place, double reach) {
    std::optional<std::size_t> nearest;
    for (std::size_t i = 0; i < handles.size(); ++i) {
        const double distance = glm::distance(handles[i].place, place);
        if (distance > reach) continue;
        reach = distance;
        nearest = i;
    }
    return nearest;
}

std::string hintOf(const LightHandle& handle) {
    return handle.moves() ? fmt::format("Drag to move along {}", handle.axisName()) : std::string();
}

PointerShape pointerShapeOf(const LightHandle& handle) {
    if (handle.isDraggedAnywhere()) return PointerShape::AnyWay;
    constexpr double kSteep = 2.414213562373095; // tan of 67.5 degrees, halfway to the next shape
    const glm::dvec2& way = handle.way;
    if (std::abs(way.x) > kSteep * std::abs(way.y)) return PointerShape::LeftRight;
    if (std::abs(way.y) > kSteep * std::abs(way.x)) return PointerShape::UpDown;
    return way.x * way.y > 0.0 ? PointerShape::Falling : PointerShape::Rising; // y counts downwards
}

} // namespace tessera::viewer
