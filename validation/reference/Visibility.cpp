#include "validation/reference/Visibility.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "validation/reference/MaterialAt.h"
#include "validation/reference/Trees.h"

namespace tessera::reference {

namespace {

/// A place along the ray in front of all visible points.
double startOf(const Ray& ray, const Anchor& anchor) {
    if (anchor.radiusMetres == 0.0) return 0.0;
    const double length = glm::length(ray.direction);
    const double nearest = glm::dot(anchor.centreRWS - ray.originRWS, ray.direction) / (length * length);
    return std::max(0.0, nearest - 1.01 * anchor.radiusMetres / length);
}

/// The conditions for a hit to count, and the hits found along a ray.
struct Query : RTCIntersectContext {
    const Ray* ray = nullptr;
    const Textures* textures = nullptr;
    double nearMetres = 0.0, farMetres = 0.0;
    std::optional<Hit> nearest;
    std::vector<Hit>* all = nullptr; ///< collects every hit, not only the nearest
    bool masksHaveHoles = true;
    const Object* backsOf = nullptr; ///< only back faces of this object count
};

std::optional<Hit> keptHit(const Object& object, std::uint32_t triangle, const Query& query) {
    std::optional<Hit> hit = hitOf(object, triangle, *query.ray);
    if (!hit || hit->depthMetres < query.nearMetres || hit->depthMetres > query.farMetres) return {};
    if (query.backsOf != nullptr ? hit->frontFacing || &object != query.backsOf
                                 : !hit->frontFacing && !object.material->doubleSided)
        return {};
    if (query.masksHaveHoles && object.material->alphaMode == scenes::AlphaMode::Mask &&
        opacityAt(*hit, *query.textures) < double(object.material->alphaCutoff))
        return {};
    hit->toViewer = -glm::normalize(query.ray->direction);
    return hit;
}

/// Called by Embree with every candidate; a rejected one does not end the ray.
void judgeCandidate(const RTCFilterFunctionNArguments* arguments) {
    auto& query = *static_cast<Query*>(arguments->context);
    const auto& object = *static_cast<const Object*>(arguments->geometryUserPtr);
    const std::optional<Hit> hit = keptHit(object, RTCHitN_primID(arguments->hit, arguments->N, 0), query);
    if (!hit || query.all) arguments->valid[0] = 0;
    if (!hit) return;
    if (query.all)
        query.all->push_back(*hit);
    else if (!query.nearest || hit->depthMetres < query.nearest->depthMetres)
        query.nearest = hit;
}

/// Relative depth error of Embree's single precision, besides the rounding of positions. The hit in double precision
/// decides.
constexpr double kDepthSlack = 1e-4;

void trace(RTCScene tree, const Objects& objects, Query& query) {
    const Anchor& anchor = objects.anchor();
    const double start = startOf(*query.ray, anchor);
    RTCRayHit rayHit = rayFrom(glm::vec3(query.ray->at(start) - anchor.centreRWS), glm::vec3(query.ray->direction));
    rayHit.ray.tnear = float(std::max(0.0, query.nearMetres * (1.0 - kDepthSlack) - objects.roundingMetres() - start));
    rayHit.ray.tfar = float(query.farMetres * (1.0 + kDepthSlack) + objects.roundingMetres() - start);
    rtcIntersect1(tree, &query, &rayHit);
}

bool isSame(const Hit& a, const Hit& b) {
    return a.object == b.object && a.triangle == b.triangle;
}

} // namespace

struct Visibility::Trees {
    const Objects& objects;
    const CameraRays& rays;
    const Textures& textures;
    Device device;
    Tree opaque, transparent;

    /// For the nearest hit of a ray, within the camera's depths and not behind `depthMetres`.
    Query queryOf(const Ray& ray, double depthMetres) const {
        Query query{};
        rtcInitIntersectContext(&query);
        query.ray = &ray;
        query.textures = &textures;
        query.nearMetres = rays.nearMetres();
        query.farMetres = std::min(depthMetres, rays.farMetres());
        return query;
    }
};

Visibility::Visibility(const Objects& objects, const CameraRays& rays, const Textures& textures)
    : trees_(new Trees{objects, rays, textures, makeDevice(), {}, {}}) {
    const auto treeOf = [&](const std::vector<Object>& list) {
        std::vector<const Object*> pointers;
        for (const Object& object : list) pointers.push_back(&object);
        return makeTree(trees_->device.get(), pointers, objects.anchor().centreRWS, judgeCandidate);
    };
    trees_->opaque = treeOf(objects.opaque());
    if (!objects.transparent().empty()) trees_->transparent = treeOf(objects.transparent());
}

Visibility::~Visibility() = default;

std::optional<Hit> Visibility::nearestOpaque(const Ray& ray) const {
    Query query = trees_->queryOf(ray, trees_->rays.farMetres());
    trace(trees_->opaque.get(), trees_->objects, query);
    return query.nearest;
}

std::optional<Hit> Visibility::nearestOpaqueAhead(const Ray& ray) const {
    Query query = trees_->queryOf(ray, trees_->rays.farMetres());
    query.nearMetres = 0.0;
    query.farMetres = std::numeric_limits<double>::infinity();
    trace(trees_->opaque.get(), trees_->objects, query);
    return query.nearest;
}

std::optional<Hit> Visibility::farSideAhead(const Ray& ray, const Object& object) const {
    if (!trees_->transparent) return {};
    Query query = trees_->queryOf(ray, trees_->rays.farMetres());
    query.nearMetres = 0.0;
    query.farMetres = std::numeric_limits<double>::infinity();
    query.backsOf = &object;
    trace(trees_->transparent.get(), trees_->objects, query);
    return query.nearest;
}

std::vector<Hit> Visibility::transparentBefore(const Ray& ray, double depthMetres) const {
    std::vector<Hit> hits;
    if (!trees_->transparent) return hits;
    Query query = trees_->queryOf(ray, depthMetres);
    query.all = &hits;
    trace(trees_->transparent.get(), trees_->objects, query);
    // Objects are stored in drawing order, so addresses compare by it. The back faces of an object come before its
    // front faces. Embree may offer a candidate twice.
    const auto drawnBefore = [](const Hit& a, const Hit& b) {
        return std::tuple(a.object, a.frontFacing, a.triangle) < std::tuple(b.object, b.frontFacing, b.triangle);
    };
    std::sort(hits.begin(), hits.end(), drawnBefore);
    hits.erase(std::unique(hits.begin(), hits.end(), isSame), hits.end());
    return hits;
}

std::vector<Hit> Visibility::transparentAhead(const Ray& ray, double fromMetres, double depthMetres) const {
    std::vector<Hit> hits;
    if (!trees_->transparent) return hits;
    Query query = trees_->queryOf(ray, depthMetres);
    query.nearMetres = fromMetres;
    query.farMetres = depthMetres;
    query.all = &hits;
    trace(trees_->transparent.get(), trees_->objects, query);
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
        return std::tuple(-a.depthMetres, a.object, a.triangle) < std::tuple(-b.depthMetres, b.object, b.triangle);
    });
    hits.erase(std::unique(hits.begin(), hits.end(), isSame), hits.end());
    return hits;
}

std::vector<Hit> Visibility::opaqueBefore(const Ray& ray, double depthMetres) const {
    std::vector<Hit> hits;
    Query query = trees_->queryOf(ray, depthMetres);
    query.all = &hits;
    query.masksHaveHoles = false;
    trace(trees_->opaque.get(), trees_->objects, query);
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) {
        return std::tuple(a.depthMetres, a.object, a.triangle) < std::tuple(b.depthMetres, b.object, b.triangle);
    });
    hits.erase(std::unique(hits.begin(), hits.end(), isSame), hits.end());
    return hits;
}

} // namespace tessera::reference
