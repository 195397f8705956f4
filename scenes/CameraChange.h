#pragma once
#include <optional>

#include "scenes/Scene.h"

namespace tessera::scenes {

/// New values for a camera, in the terms of the command line.
struct CameraChange {
    std::optional<glm::dvec3> eyeWS;
    std::optional<glm::dvec3> targetWS;
    std::optional<glm::dvec3> upWS;         ///< of any length; default with a target: +Y
    std::optional<double> fovYDegrees;      ///< Perspective
    std::optional<double> halfHeightMetres; ///< Orthographic
    std::optional<double> nearMetres, farMetres;
    bool operator==(const CameraChange&) const = default;
};

/// Applies a change to a camera: an eye alone moves it, a target alone turns it, and absent values stay. The result is
/// bit-identical wherever it is computed. Throws InputError, naming the camera and the number, for values that no
/// camera can have.
Camera changedCamera(Camera camera, const CameraChange& change);

} // namespace tessera::scenes
