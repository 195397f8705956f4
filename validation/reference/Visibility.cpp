#include "validation/reference/Visibility.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <tuple>

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include "validation/reference/MaterialAt.h"

namespace tessera::reference {

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using Tree = std::unique_ptr<RTCSceneTy, ReleaseScene>;

namespace {

void throwIfFailed(RTCDevice device, const char* what) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    throw std::runtime_error(error == RTC_ERROR_OUT_OF_MEMORY
                                 ? fmt::format("the reference renderer is out of memory while {}", what)
                                 : fmt::format("Embree failed while {} (error {})", what, int(error)));
}

/// Where along the ray everything still lies ahead.
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
    std::vector<Hit>* all = nullptr; ///< where every hit is wanted, not the nearest
    bool masksHaveHoles = true;
};

std::optional<Hit> keptHit(const Object& object, std::uint32_t triangle, const Query& query) {
    std::optional<Hit> hit = hitOf(object, triangle, *query.ray);
    if (!hit || hit->depthMetres < query.nearMetres || hit->depthMetres > query.farMetres) return {};
    if (!hit->frontFacing && !object.material->doubleSided) return {};
    if (query.masksHaveHoles && object.material->alphaMode == scenes::AlphaMode::Mask &&
        opacityAt(*hit, *query.textures) < double(object.material->alphaCutoff))
        return {};
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

/// Positions in single precision are relative to the anchor.
Tree makeTree(RTCDevice device, const std::vector<Object>& objects, const Anchor& anchor) {
    Tree tree(rtcNewScene(device));
    throwIfFailed(device, "it makes a scene");
    rtcSetSceneFlags(tree.get(), RTC_SCENE_FLAG_ROBUST); // rays along shared edges slip through neither triangle
    for (const Object& object : objects) {
        const std::size_t vertices = object.mesh->positionsOS.size(), triangles = object.mesh->indices.size() / 3;
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* position = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                                     RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices));
        auto* index = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles));
        if (!position || !index) {
            rtcReleaseGeometry(geometry);
            throwIfFailed(device, "it takes in a mesh");
        }
        for (const glm::vec3& vertexOS : object.mesh->positionsOS) {
            const glm::dvec4 positionRWS = object.rwsFromObject * glm::dvec4(glm::dvec3(vertexOS), 1.0);
            for (int axis = 0; axis < 3; ++axis) *position++ = float(positionRWS[axis] - anchor.centreRWS[axis]);
        }
        std::copy(object.mesh->indices.begin(), object.mesh->indices.end(), index);
        rtcSetGeometryUserData(geometry, const_cast<Object*>(&object));
        rtcSetGeometryIntersectFilterFunction(geometry, judgeCandidate);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(tree.get(), geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(tree.get());
    throwIfFailed(device, "it sorts the scene's triangles");
    return tree;
}

/// Relative error in depth of a hit by Embree's single precision, besides the rounding of positions; the
/// double one decides.
constexpr double kDepthSlack = 1e-4;

void trace(RTCScene tree, const Objects& objects, Query& query) {
    const Anchor& anchor = objects.anchor();
    RTCRayHit rayHit{};
    const double start = startOf(*query.ray, anchor);
    const glm::vec3 origin(query.ray->at(start) - anchor.centreRWS), direction(query.ray->direction);
    rayHit.ray.org_x = origin.x;
    rayHit.ray.org_y = origin.y;
    rayHit.ray.org_z = origin.z;
    rayHit.ray.dir_x = direction.x;
    rayHit.ray.dir_y = direction.y;
    rayHit.ray.dir_z = direction.z;
    rayHit.ray.tnear = float(std::max(0.0, query.nearMetres * (1.0 - kDepthSlack) - objects.roundingMetres() - start));
    rayHit.ray.tfar = float(query.farMetres * (1.0 + kDepthSlack) + objects.roundingMetres() - start);
    rayHit.ray.mask = ~0u;
    rayHit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rayHit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
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
    : trees_(new Trees{objects, rays, textures, Device(rtcNewDevice(nullptr)), {}, {}}) {
    if (!trees_->device) throw std::runtime_error("Embree, which traces the reference renderer's rays, does not start");
    trees_->opaque = makeTree(trees_->device.get(), objects.opaque(), trees_->objects.anchor());
    if (!objects.transparent().empty())
        trees_->transparent = makeTree(trees_->device.get(), objects.transparent(), trees_->objects.anchor());
}

Visibility::~Visibility() = default;

std::optional<Hit> Visibility::nearestOpaque(const Ray& ray) const {
    Query query = trees_->queryOf(ray, trees_->rays.farMetres());
    trace(trees_->opaque.get(), trees_->objects, query);
    return query.nearest;
}

std::vector<Hit> Visibility::transparentBefore(const Ray& ray, double depthMetres) const {
    std::vector<Hit> hits;
    if (!trees_->transparent) return hits;
    Query query = trees_->queryOf(ray, depthMetres);
    query.all = &hits;
    trace(trees_->transparent.get(), trees_->objects, query);
    // Objects lie in their order of drawing, so their addresses tell it; Embree may offer a candidate twice.
    const auto drawnBefore = [](const Hit& a, const Hit& b) {
        return std::pair(a.object, a.triangle) < std::pair(b.object, b.triangle);
    };
    std::sort(hits.begin(), hits.end(), drawnBefore);
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
