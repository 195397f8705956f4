#pragma once
#include "scenes/Scene.h"

/// Camera placement that fits everything drawn into the image.
namespace tessera::scenes {

/// World bounds of everything drawn, sampled over the length of the active clips. Leaves the scene posed at time 0.
/// Invalid poses are skipped.
Box3 boundsOverClips(Scene& scene);

/// An eye, and a target in the middle of its view.
struct Framing {
    glm::dvec3 eyeWS{0.0}, targetWS{0.0};
    double radiusMetres = 1.0; ///< half the diagonal of the bounds
};

/// Finds the nearest eye that sees every vertex drawn, for a vertical field of view and an aspect (width over height),
/// with a margin of 5 %, over the length of the active clips. It looks along -(1, 0.7, 1), +Y up; at shallow scenes
/// from the front, and at scenes flat along an axis along that axis, from the side that most of the surface faces. An
/// empty scene counts as one of radius 1 m about the origin, a point as one about it. Leaves the scene posed at time 0.
/// Throws InputError when the bounds are too large to be numbers.
Framing framingOf(Scene& scene, double fovYRadians, double aspect);

} // namespace tessera::scenes
