#pragma once
#include <optional>

#include "validation/reference/CameraRays.h"
#include "validation/reference/Objects.h"
#include "validation/reference/Visibility.h"

namespace tessera::viewer {

/// Distances from positions in a scene to opaque surfaces that face them. Throws std::runtime_error when memory runs
/// out.
class Clearance {
public:
    explicit Clearance(const scenes::Scene& scene);

    /// Along a direction of length 1; none beyond `mostMetres`. Surfaces closer than `leastMetres`, by default 1e-4 of
    /// `mostMetres`, are skipped: single precision blurs a surface that contains the position.
    std::optional<double> metresAlong(const glm::dvec3& placeWS, const glm::dvec3& directionWS, double mostMetres,
                                      double leastMetres = 0.0) const;
    /// To the nearest surface in 26 directions.
    std::optional<double> metresAround(const glm::dvec3& placeWS, double mostMetres) const;

private:
    // The eye of the rays is the centre of the bounds.
    reference::CameraRays rays_;
    reference::Objects objects_;
    reference::Textures textures_;
    reference::Visibility visibility_;
};

} // namespace tessera::viewer
