#include "validation/reference/HookAt.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace tessera::reference {
namespace {

bool isMetallic(const SurfacePoint& point) {
    return scenes::infoOf(point.model).microsurface == scenes::Microsurface::MetallicRoughness;
}
bool hasAlpha(const SurfacePoint& point) {
    return isMetallic(point) || scenes::infoOf(point.model).isMicrofacet();
}

/// The hook's input: parameters that the model lacks are neutral, and an unlit colour counts as emission.
scenes::HookPoint pointOf(const Hit& hit, const SurfacePoint& point) {
    const scenes::Mesh& mesh = *hit.object->mesh;
    const bool isLit = scenes::infoOf(point.model).isLit;
    scenes::HookPoint result;
    result.surface.color = glm::vec3(point.color);
    result.surface.emission = glm::vec3(isLit ? point.emission : point.emission + point.color);
    if (hasAlpha(point)) result.surface.alpha = float(point.alpha);
    if (isMetallic(point)) result.surface.metallic = float(point.metallic);
    if (!mesh.texCoords[0].empty()) result.uv = glm::vec2(hit.at<glm::dvec2>(mesh.texCoords[0]));
    result.positionOS = glm::vec3(hit.at<glm::dvec3>(mesh.positionsOS));
    result.instance = int(hit.object->number);
    return result;
}

/// Applies a number that the hook changed, clamped to `least` and `most`, or to its old value if that lies outside. NaN
/// becomes the least. Unchanged numbers keep all digits.
void take(float before, float after, double least, double most, double& number) {
    if (after == before) return;
    const double low = std::min(number, least), high = std::max(number, most);
    number = double(after) >= low ? std::min(double(after), high) : low;
}

void takeAll(const scenes::HookedSurface& before, const scenes::HookedSurface& after, SurfacePoint& point) {
    if (!scenes::infoOf(point.model).isLit) {
        for (int c = 0; c < 3; ++c) {
            if (after.emission[c] == before.emission[c]) continue;
            point.emission[c] += std::exchange(point.color[c], 0.0);
            take(before.emission[c], after.emission[c], 0.0, scenes::kMostEmission, point.emission[c]);
        }
        return;
    }
    point.passingColor = point.color;
    point.passingMetallic = point.metallic;
    for (int c = 0; c < 3; ++c) {
        take(before.color[c], after.color[c], 0.0, 1.0, point.color[c]);
        take(before.emission[c], after.emission[c], 0.0, scenes::kMostEmission, point.emission[c]);
    }
    if (hasAlpha(point)) take(before.alpha, after.alpha, kSmallestAlpha, 1.0, point.alpha);
    if (isMetallic(point)) take(before.metallic, after.metallic, 0.0, 1.0, point.metallic);
}

} // namespace

void HookPoints::change(const Hit& hit, SurfacePoint& point) {
    const scenes::HookPoint own = pointOf(hit, point);
    const auto begin = requested_.begin(), next = begin + std::ptrdiff_t(next_), end = requested_.end();
    auto found = std::find(next, end, own);
    if (found == end) {
        found = std::find(begin, next, own);
        if (found == next) found = end;
    }
    if (!areKnown_) {
        if (found == end) requested_.push_back(own);
        return;
    }
    if (found == end) throw std::logic_error("a pixel lights a point that it did not pass to its hook");
    next_ = std::size_t(found - begin);
    takeAll(own.surface, known_[next_], point);
}

} // namespace tessera::reference
