#pragma once
#include "scenes/Scene.h"

/// What a scene is given where its author left it out, so that everything loaded can be drawn and seen.
namespace tessera::scenes {

class LoadLedger;

/// Of a scene that addDefaultLight() lights.
inline constexpr const char* kDefaultLightWarning =
    "the scene has no light: lit by the built-in environment 'studio'; --environment chooses another, "
    "--no-default-light none";

/// Name of a supplied camera.
inline constexpr const char* kDefaultName = "default";

/// A scene without a camera gets one of 45 degrees that looks along -(1, 0.7, 1) at the centre of the bounds from
/// 1.2 r / sin(22.5 degrees), r being half the bounds' diagonal; a warning says so. An empty scene is seen as one of
/// radius 1 m about the origin. Throws InputError when the bounds are too large to be numbers.
void addDefaultCamera(Scene& scene);

/// A scene without lights and environment gets the built-in studio with a blurred backdrop, unless every material in
/// use is unlit; a warning says so. It is turned to stand around the scene's camera (the one its options name, else the
/// first) as around that of addDefaultCamera().
void addDefaultLight(Scene& scene, LoadLedger& ledger);

} // namespace tessera::scenes
