#pragma once
#include "scenes/Scene.h"

/// Where a camera must stand to have all that is drawn in its picture.
namespace tessera::scenes {

/// World bounds of everything drawn, over the length of the clips that play where they move it, looked at in steps. The
/// scene comes back as it is at time 0. Poses that the scene cannot have are left out.
Box3 boundsOverClips(Scene& scene);

/// An eye, and a point in the middle of what it sees.
struct Framing {
    glm::dvec3 eyeWS{0.0}, targetWS{0.0};
    double radiusMetres = 1.0; ///< half the diagonal of the bounds
};

/// The eye nearest to the scene that has every vertex drawn in a picture of a vertical field of view and an aspect
/// (width over height), with a margin of 5 %, over the length of the clips that play. It looks along -(1, 0.7, 1), +Y
/// upright; at a scene that is flat along an axis it looks along that axis, from the side that more of its surface is
/// turned to. An empty scene is seen as one of radius 1 m about the origin, a point as one about it. The scene comes
/// back as it is at time 0. Throws InputError when the bounds are too large to be numbers.
Framing framingOf(Scene& scene, double fovYRadians, double aspect);

} // namespace tessera::scenes
