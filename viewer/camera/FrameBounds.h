#pragma once
#include "viewer/camera/CameraPose.h"

namespace tessera::viewer {

/// The pose that brings a whole box into view, with the orientation of `pose`: focused on the box's centre at the image
/// centre, its corners inside the image with a small margin and between the near and the far plane. `aspect` is width
/// over height. An empty box is treated as one about the origin, a point as one about it, of radius 1 m.
CameraPose frameBounds(const scenes::Box3& boundsWS, const CameraPose& pose, const scenes::Camera& lens, double aspect);

} // namespace tessera::viewer
