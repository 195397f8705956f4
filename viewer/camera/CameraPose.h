#pragma once
#include "scenes/CameraChange.h"
#include "viewer/camera/Heading.h"

namespace tessera::viewer {

/// The state of a camera that OrbitCamera and FlyCamera exchange: position, orientation and focus.
struct CameraPose {
    glm::dvec3 eyeWS{0.0};
    Heading heading;
    double focusMetres = 1.0;      ///< distance from the eye to the orbit pivot ahead, > 0
    double halfHeightMetres = 1.0; ///< half the image height, orthographic cameras
    double nearMetres = 0.1;       ///< if the focus is at nearFocusMetres or beyond
    double nearFocusMetres = 1.0;  ///< a shorter focus moves the near plane closer (perspective cameras), > 0
    double farMetres = 1.0;
    bool operator==(const CameraPose&) const = default;
};

/// The pose of a scene's camera. The focus is at the depth of the bounds' centre if that lies ahead, else half a
/// diagonal ahead; without bounds 1 m ahead. The camera's near plane is kept at that focus and beyond.
CameraPose poseOf(const scenes::Camera& camera, const scenes::Box3& boundsWS);
/// The same with a given focus distance, > 0.
CameraPose poseOf(const scenes::Camera& camera, double focusMetres);

/// The pose moved to another eye and target, which is its new focus, with the same roll. Unchanged if both are the same
/// point.
CameraPose between(const CameraPose& pose, const glm::dvec3& eyeWS, const glm::dvec3& targetWS);
glm::dvec3 targetOf(const CameraPose& pose);

/// The pose as a command-line change of the camera `start`: eye, target and other differences. The viewer draws
/// changedCamera() of it, so that both are bit-identical.
scenes::CameraChange changeOf(const CameraPose& pose, const scenes::Camera& start);

/// `start` in this pose: changedCamera(start, changeOf(pose, start)).
scenes::Camera cameraAt(const CameraPose& pose, const scenes::Camera& start);

/// Metres per pixel at a depth.
double metresPerPixel(const scenes::Camera& lens, const CameraPose& pose, double depthMetres, double heightPixels);

} // namespace tessera::viewer
