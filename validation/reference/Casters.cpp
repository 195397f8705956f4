#include "validation/reference/Casters.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "validation/reference/MaterialAt.h"
#include "validation/reference/Slots.h"

namespace tessera::reference {

namespace {

/// The conditions for a candidate to count, and what the segment has met.
struct ShadowQuery : RTCIntersectContext {
    Segment segment;
    glm::dvec3 centreRWS{0.0};
    const Object* ownObject = nullptr; ///< the surface at the segment's start, with its triangle
    std::uint32_t ownTriangle = 0;
    const Textures* textures = nullptr;
    const scenes::Material* passed = nullptr; ///< as in Casters::meet()
    Casters::Met met;
};

/// Where a segment crosses a triangle.
struct Crossing {
    Hit hit;
    double share = 0.0;  ///< fraction of the segment up to there
    bool goesIn = false; ///< through the side whose corners run counter-clockwise
};

/// Intersects a triangle between the segment's ends, by the signed volumes of the tetrahedra over the triangle's edges.
std::optional<Crossing> crossingOf(const Object& object, std::uint32_t triangle, const ShadowQuery& query) {
    const auto& [from, along] = query.segment;
    glm::dvec3 corners[3];
    for (int i = 0; i < 3; ++i) corners[i] = object.cornerRWS(triangle, i) - query.centreRWS - from;
    const double volumes[3] = {glm::dot(along, glm::cross(corners[2], corners[1])),
                               glm::dot(along, glm::cross(corners[0], corners[2])),
                               glm::dot(along, glm::cross(corners[1], corners[0]))};
    const bool isInside = (volumes[0] >= 0.0 && volumes[1] >= 0.0 && volumes[2] >= 0.0) ||
                          (volumes[0] <= 0.0 && volumes[1] <= 0.0 && volumes[2] <= 0.0);
    const double sum = volumes[0] + volumes[1] + volumes[2];
    if (!isInside || sum == 0.0) return {};
    Crossing crossing;
    Hit& hit = crossing.hit;
    hit.object = &object;
    hit.triangle = triangle;
    for (int i = 0; i < 3; ++i) hit.weights[i] = volumes[i] / sum;
    const glm::dvec3 place = hit.weights.x * corners[0] + hit.weights.y * corners[1] + hit.weights.z * corners[2];
    crossing.share = glm::dot(place, along) / glm::dot(along, along);
    if (!(crossing.share > 0.0 && crossing.share < 1.0)) return {};
    const glm::dvec3 front = object.handedness * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    crossing.goesIn = glm::dot(front, along) < 0.0;
    return crossing;
}

void judgeCrossing(const RTCFilterFunctionNArguments* arguments) {
    auto& query = *static_cast<ShadowQuery*>(arguments->context);
    const auto& object = *static_cast<const Object*>(arguments->geometryUserPtr);
    const std::uint32_t triangle = RTCHitN_primID(arguments->hit, arguments->N, 0);
    arguments->valid[0] = 0; // the ray continues until the answer is known
    if (query.met.isHidden || (&object == query.ownObject && triangle == query.ownTriangle)) return;
    const std::optional<Crossing> crossing = crossingOf(object, triangle, query);
    if (!crossing) return;
    if (object.material->alphaMode == scenes::AlphaMode::Mask) {
        if (reference::isUndecided(crossing->hit, *query.textures)) query.met.isUndecided = true;
        const double cutoff = double(object.material->alphaCutoff);
        const double opacity = opacityAt(crossing->hit, *query.textures);
        // Three weights, two blends and a product, each rounded to 2^-24 of at most 1.
        if (std::abs(opacity - cutoff) < 16.0 * 0x1p-24 * std::max(1.0, cutoff)) query.met.isUndecided = true;
        if (opacity < cutoff) return;
    }
    if (object.material == query.passed) {
        query.met.crossings.push_back(crossing->goesIn ? -crossing->share : crossing->share);
        return;
    }
    query.met.isHidden = true;
    arguments->valid[0] = -1;
}

} // namespace

Casters::Casters(const scenes::Scene& scene, const Objects& objects)
    : textures_(scene, Filtering::Exact), anchor_(objects.anchor()), device_(makeDevice()) {
    std::vector<const Object*> casting;
    std::vector<double> places[3]; // casters' corners, from the anchor
    for (const Object& object : objects.opaque()) {
        if (!object.castsShadow) continue;
        casting.push_back(&object);
        for (std::uint32_t triangle = 0; triangle < object.mesh->indices.size() / 3; ++triangle)
            for (int corner = 0; corner < 3; ++corner) {
                const glm::dvec3 place = object.cornerRWS(triangle, corner) - anchor_.centreRWS;
                radiusMetres_ = std::max(radiusMetres_, glm::length(place));
                for (int axis = 0; axis < 3; ++axis) places[axis].push_back(place[axis]);
            }
    }
    if (casting.empty()) return;
    glm::dvec3 origin;
    for (int axis = 0; axis < 3; ++axis) {
        const auto middle = places[axis].begin() + std::ptrdiff_t(places[axis].size() / 2);
        std::nth_element(places[axis].begin(), middle, places[axis].end());
        origin[axis] = *middle;
    }
    originMetres_ = glm::length(origin);
    roundingMetres_ = objects.roundingBeyondMetres(anchor_.centreRWS + origin);
    tree_ = makeTree(device_.get(), casting, anchor_.centreRWS, judgeCrossing);
}

Casters::Met Casters::meet(const Segment& segment, const Hit* own, const scenes::Material* passed) const {
    ShadowQuery query{};
    rtcInitIntersectContext(&query);
    query.segment = segment;
    query.centreRWS = anchor_.centreRWS;
    query.ownObject = own ? own->object : nullptr;
    query.ownTriangle = own ? own->triangle : 0;
    query.textures = &textures_;
    query.passed = passed;
    RTCRay ray = rayFrom(glm::vec3(segment.from), glm::vec3(segment.along)).ray;
    ray.tfar = 1.00001f; // judgeCrossing() tests the end in double
    rtcOccluded1(tree_.get(), &query, &ray);
    return std::move(query.met);
}

double Casters::toleranceMetres(const glm::dvec3& placeRWS) const {
    const double common = kPositionRounding * (originMetres_ + anchor_.otherOriginMetres) + roundingMetres_;
    const double reach = glm::length(placeRWS - anchor_.centreRWS) + anchor_.otherOriginMetres;
    return 4.0 * (common + 2.0 * kPositionRounding * reach);
}

} // namespace tessera::reference
