#pragma once
#include "viewer/camera/CameraPose.h"

namespace tessera::viewer {

/// The pose from which all of a box is in view, looking the way `pose` does: the box's centre in the middle of the
/// picture and the focus there, its corners within the picture with a small margin and between the near and the far
/// plane. `aspect` is width over height. An empty box is taken as one about the origin, a point as one about it, of
/// radius 1 m.
CameraPose frameBounds(const scenes::Box3& boundsWS, const CameraPose& pose, const scenes::Camera& lens, double aspect);

} // namespace tessera::viewer
