#pragma once
#include <optional>

#include "validation/reference/CameraRays.h"
#include "validation/reference/Objects.h"
#include "validation/reference/Visibility.h"

namespace tessera::viewer {

/// How far it is from places in a scene to its opaque surfaces, as far as these face the place. Throws
/// std::runtime_error when memory runs out.
class Clearance {
public:
    explicit Clearance(const scenes::Scene& scene);

    /// Along a direction of length 1; none where nothing is that near. What is nearer than `leastMetres`, else than
    /// 1e-4 of the most, is passed: single precision blurs a surface that the place lies on.
    std::optional<double> metresAlong(const glm::dvec3& placeWS, const glm::dvec3& directionWS, double mostMetres,
                                      double leastMetres = 0.0) const;
    /// To the nearest of all sides.
    std::optional<double> metresAround(const glm::dvec3& placeWS, double mostMetres) const;

private:
    // The eye of the rays is the middle of the bounds.
    reference::CameraRays rays_;
    reference::Objects objects_;
    reference::Textures textures_;
    reference::Visibility visibility_;
};

} // namespace tessera::viewer
