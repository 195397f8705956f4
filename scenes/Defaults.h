#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "scenes/Scene.h"

/// Defaults for what a scene's author left out, so that everything loaded is visible.
namespace tessera::scenes {

class LoadLedger;

/// Name of a supplied camera.
inline constexpr const char* kDefaultName = "default";

/// Adds a camera with a vertical field of view of 45 degrees to a scene without one. It fits the whole scene
/// (framingOf()) into `aspect` (width over height), else into the aspect of the scene's options, else into 16:9. Scenes
/// that surround their middle are viewed from inside (framingInside()). The near plane does not depend on the aspect.
void addDefaultCamera(Scene& scene, std::optional<double> aspect = {});

/// Removes the scene's cameras and its choice of one, so that addDefaultCamera() replaces them.
void leaveOutCameras(Scene& scene);

/// Adds the built-in studio with a blurred backdrop to a scene without lights and environment, unless every material in
/// use is unlit. The studio is rotated around the scene's camera (the one its options name, else the first) as around
/// that of addDefaultCamera().
void addDefaultLight(Scene& scene, LoadLedger& ledger);

/// Adds that studio to a model with its own lights too, since metals and glass need something to reflect. It gives a
/// quarter of the luminance of the model's lights, or what they lack for a bright image if that is more. Call after
/// addDefaultExposure().
void addFillLight(Scene& scene, LoadLedger& ledger);

/// A scene's original environment, kept while another map replaces it.
struct OwnEnvironment {
    std::string source;         ///< as Environment::source; empty: the scene has none, or a supplied one
    EnvironmentView view;       ///< its rotation and intensity
    float studioDegrees = 0.0f; ///< rotation of a built-in studio if the scene has no environment
};
OwnEnvironment ownEnvironmentOf(const Scene& scene);

/// Rotation of a built-in studio chosen for a scene without an environment: with a supplied camera that of
/// addDefaultLight(), else 0.
float chosenStudioDegrees(const Scene& scene);

/// Gives a map that replaces a scene's environment the rotation of the original. The scene's own map, chosen again,
/// also gets its intensity back. If the scene had none, a built-in studio gets OwnEnvironment::studioDegrees.
void layAs(const OwnEnvironment& own, Environment& chosen);

/// Sets the exposure of a model with only its own lights to fit its camera's view, if needed (Exposure.h): model
/// formats store no exposure, and exporters may use any unit.
void addDefaultExposure(Scene& scene);

/// Selects the tone map khronos_neutral for a lit model: its format stores none, and highlights would clip. Colours of
/// a fully unlit model are displayed as they are.
void addDefaultToneMap(Scene& scene);

/// Where users change the supplied defaults: options of the command line, or the viewer's panels.
enum class Advice : std::uint8_t { Options, Panels };

/// Describes in one line the camera, light and exposure that were supplied, and how to change them; empty if none were.
std::string suppliedText(const Scene& scene, Advice advice = Advice::Options);

} // namespace tessera::scenes
