#pragma once
#include <optional>

#include "scenes/Scene.h"

namespace tessera::scenes {

/// What of a camera is said anew, in the terms of the command line.
struct CameraChange {
    std::optional<glm::dvec3> eyeWS;
    std::optional<glm::dvec3> targetWS;
    std::optional<glm::dvec3> upWS;         ///< of any length; Y where only eye and target are given
    std::optional<double> fovYDegrees;      ///< Perspective
    std::optional<double> halfHeightMetres; ///< Orthographic
    std::optional<double> nearMetres, farMetres;
    bool operator==(const CameraChange&) const = default;
};

/// The camera with the change: an eye alone moves it, a target alone turns it, and absent values stay. One change
/// of one camera is the same to the last bit wherever it is made. Throws InputError, naming the camera and the number,
/// for values that no camera can have.
Camera changedCamera(Camera camera, const CameraChange& change);

} // namespace tessera::scenes
