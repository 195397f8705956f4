#pragma once
#include "scenes/CameraChange.h"
#include "viewer/camera/Heading.h"

namespace tessera::viewer {

/// Position, direction and field of view of a camera, which orbiting and flying pass to each other.
struct CameraPose {
    glm::dvec3 eyeWS{0.0};
    Heading heading;
    double focusMetres = 1.0;      ///< distance ahead of the eye of the point that orbiting turns about, > 0
    double halfHeightMetres = 1.0; ///< of the picture, orthographic cameras
    double nearMetres = 0.1;       ///< at nearFocusMetres and beyond
    double nearFocusMetres = 1.0;  ///< a focus nearer than this takes the near plane along, perspective cameras; > 0
    double farMetres = 1.0;
    bool operator==(const CameraPose&) const = default;
};

/// The pose of a scene's camera. It focuses on the depth of the bounds' centre where that lies ahead, else on what is
/// a half diagonal ahead; without bounds on 1 m ahead. The near plane is the camera's own at that focus and beyond.
CameraPose poseOf(const scenes::Camera& camera, const scenes::Box3& boundsWS);
/// The same with the focus that many metres ahead, > 0.
CameraPose poseOf(const scenes::Camera& camera, double focusMetres);

/// The pose with another eye or target, what its focus is in: it looks from the one to the other, with its roll. As it
/// was where they are one point.
CameraPose between(const CameraPose& pose, const glm::dvec3& eyeWS, const glm::dvec3& targetWS);
glm::dvec3 targetOf(const CameraPose& pose);

/// The command line's form of the pose of a camera that started as `start`: eye, target and other differences. The
/// viewer draws the result of changedCamera() on it, so that both are the same to the last bit.
scenes::CameraChange changeOf(const CameraPose& pose, const scenes::Camera& start);

/// `start` in this pose: changedCamera(start, changeOf(pose, start)).
scenes::Camera cameraAt(const CameraPose& pose, const scenes::Camera& start);

/// Metres that one pixel shows at a depth.
double metresPerPixel(const scenes::Camera& lens, const CameraPose& pose, double depthMetres, double heightPixels);

} // namespace tessera::viewer
