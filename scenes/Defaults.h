#pragma once
#include "scenes/Scene.h"

/// What a scene is given where its author left it out, so that everything loaded can be drawn and seen.
namespace tessera::scenes {

/// Name of a supplied camera or light.
inline constexpr const char* kDefaultName = "default";

/// A scene without a camera gets one of 45 degrees that looks along -(1, 0.7, 1) at the centre of the bounds from
/// 1.2 r / sin(22.5 degrees), r being half the bounds' diagonal; a warning says so. An empty scene is seen as one of
/// radius 1 m about the origin. Throws InputError when the bounds are too large to be numbers.
void addDefaultCamera(Scene& scene);

/// A scene without lights gets one white directional light of 3 lux along the forward axis of its camera (the one its
/// options name, else the first), unless every material in use is unlit; a warning says so.
void addDefaultLight(Scene& scene);

/// Turns the light that addDefaultLight() gave along the forward axis of the camera that is drawn; lights of the
/// author's stay. For whoever chooses or moves a camera after the scene was loaded.
void aimDefaultLight(Scene& scene, const Camera& camera);

} // namespace tessera::scenes
