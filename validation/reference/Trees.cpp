#include "validation/reference/Trees.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace tessera::reference {

namespace {

void throwIfFailed(RTCDevice device, const char* what) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    throw std::runtime_error(error == RTC_ERROR_OUT_OF_MEMORY
                                 ? fmt::format("the reference renderer is out of memory while {}", what)
                                 : fmt::format("Embree failed while {} (error {})", what, int(error)));
}

} // namespace

Device makeDevice() {
    Device device(rtcNewDevice(nullptr));
    if (!device) throw std::runtime_error("Embree, which traces the reference renderer's rays, does not start");
    return device;
}

Tree makeTree(RTCDevice device, const std::vector<const Object*>& objects, const glm::dvec3& centreRWS,
              RTCFilterFunctionN judge) {
    Tree tree(rtcNewScene(device));
    throwIfFailed(device, "it makes a scene");
    rtcSetSceneFlags(tree.get(), RTC_SCENE_FLAG_ROBUST); // rays along shared edges slip through neither triangle
    for (const Object* object : objects) {
        const std::size_t vertices = object->mesh->positionsOS.size(), triangles = object->mesh->indices.size() / 3;
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* position = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                                     RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices));
        auto* index = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles));
        if (!position || !index) {
            rtcReleaseGeometry(geometry);
            throwIfFailed(device, "it takes in a mesh");
        }
        for (const glm::vec3& vertexOS : object->mesh->positionsOS) {
            const glm::dvec4 positionRWS = object->rwsFromObject * glm::dvec4(glm::dvec3(vertexOS), 1.0);
            for (int axis = 0; axis < 3; ++axis) *position++ = float(positionRWS[axis] - centreRWS[axis]);
        }
        std::copy(object->mesh->indices.begin(), object->mesh->indices.end(), index);
        rtcSetGeometryUserData(geometry, const_cast<Object*>(object));
        rtcSetGeometryIntersectFilterFunction(geometry, judge);
        rtcSetGeometryOccludedFilterFunction(geometry, judge);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(tree.get(), geometry);
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(tree.get());
    throwIfFailed(device, "it sorts the scene's triangles");
    return tree;
}

RTCRayHit rayFrom(const glm::vec3& origin, const glm::vec3& direction) {
    RTCRayHit rayHit{};
    rayHit.ray.org_x = origin.x;
    rayHit.ray.org_y = origin.y;
    rayHit.ray.org_z = origin.z;
    rayHit.ray.dir_x = direction.x;
    rayHit.ray.dir_y = direction.y;
    rayHit.ray.dir_z = direction.z;
    rayHit.ray.tfar = std::numeric_limits<float>::infinity();
    rayHit.ray.mask = ~0u;
    rayHit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rayHit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    return rayHit;
}

} // namespace tessera::reference
