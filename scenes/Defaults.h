#pragma once
#include <optional>

#include "scenes/Scene.h"

/// What a scene is given where its author left it out, so that everything loaded can be drawn and seen.
namespace tessera::scenes {

class LoadLedger;

/// Of a scene that addDefaultLight() lights.
inline constexpr const char* kDefaultLightWarning =
    "the scene has no light: lit by the built-in environment 'studio'; --environment chooses another, "
    "--no-default-light leaves it dark";

/// Name of a supplied camera.
inline constexpr const char* kDefaultName = "default";

/// Of a scene that addDefaultCamera() gives one.
inline constexpr const char* kDefaultCameraWarning =
    "the scene has no camera: the supplied one, 'default', shows all of it";

/// A scene without a camera gets one of 45 degrees that sees all of it (framingOf()) in a picture of an aspect, width
/// over height, else of that which its options ask for, else of 16:9; a warning says so. Its near plane does not depend
/// on the aspect. Throws InputError when the bounds are too large to be numbers.
void addDefaultCamera(Scene& scene, std::optional<double> aspect = {});
/// Whether its camera is that one.
bool isCameraSupplied(const Scene& scene);

/// A scene without lights and environment gets the built-in studio with a blurred backdrop, unless every material in
/// use is unlit; a warning says so. It is turned to stand around the scene's camera (the one its options name, else the
/// first) as around that of addDefaultCamera().
void addDefaultLight(Scene& scene, LoadLedger& ledger);

} // namespace tessera::scenes
