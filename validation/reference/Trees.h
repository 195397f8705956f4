#pragma once
#include <memory>
#include <vector>

#include <embree3/rtcore.h>

#include "validation/reference/Objects.h"

/// Embree trees of the reference's triangles, in single precision. They find candidates; callers test these in double
/// precision.
namespace tessera::reference {

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseTree {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using Tree = std::unique_ptr<RTCSceneTy, ReleaseTree>;

/// Throws std::runtime_error when Embree does not start.
Device makeDevice();

/// Builds a tree of the objects' triangles, relative to `centreRWS`. Calls `judge` with each candidate, with its object
/// as the geometry's user pointer. Throws std::runtime_error when Embree fails, as for lack of memory.
Tree makeTree(RTCDevice device, const std::vector<const Object*>& objects, const glm::dvec3& centreRWS,
              RTCFilterFunctionN judge);

/// An unbounded ray without a hit.
RTCRayHit rayFrom(const glm::vec3& origin, const glm::vec3& direction);

} // namespace tessera::reference
