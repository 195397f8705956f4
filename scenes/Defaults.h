#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "scenes/Scene.h"

/// What a scene is given where its author left it out, so that everything loaded can be drawn and seen.
namespace tessera::scenes {

class LoadLedger;

/// Name of a supplied camera.
inline constexpr const char* kDefaultName = "default";

/// A scene without a camera gets one of 45 degrees that sees all of it (framingOf()) in a picture of an aspect, width
/// over height, else of that which its options ask for, else of 16:9; one that surrounds its middle is seen from inside
/// (framingInside()). Its near plane does not depend on the aspect.
/// Throws InputError when the bounds are too large to be numbers.
void addDefaultCamera(Scene& scene, std::optional<double> aspect = {});

/// Takes away the scene's own cameras and its wish for one of them, so that addDefaultCamera() gives it one in their
/// place.
void leaveOutCameras(Scene& scene);

/// A scene without lights and environment gets the built-in studio with a blurred backdrop, unless every material in
/// use is unlit. It is turned to stand around the scene's camera (the one its options name, else the first) as around
/// that of addDefaultCamera().
void addDefaultLight(Scene& scene, LoadLedger& ledger);

/// A model with lights of its own gets that studio too: metals and glass show what is around them. Its light is a
/// quarter of its own lights', or what these lack of a bright picture. Called after addDefaultExposure().
void addFillLight(Scene& scene, LoadLedger& ledger);

/// What is kept of a scene's own environment where another map takes its place.
struct OwnEnvironment {
    std::string source;         ///< as Environment::source; empty: there is none of its own, or one was supplied
    EnvironmentView view;       ///< how it lies and shines
    float studioDegrees = 0.0f; ///< turn of a built-in studio where there is none
};
OwnEnvironment ownEnvironmentOf(const Scene& scene);

/// The turn of a built-in studio that is chosen for a scene without an environment: around a supplied camera it stands
/// as one that addDefaultLight() gives; else 0.
float chosenStudioDegrees(const Scene& scene);

/// Turns a map that was chosen in the place of a scene's own environment as that is turned. The scene's own map, chosen
/// again, is as bright as before too. Where there was none of its own, a built-in studio gets the turn above.
void layAs(const OwnEnvironment& own, Environment& chosen);

/// A model that is lit by lights of its own alone gets the exposure that fits what its camera sees, where that is
/// needed (Exposure.h): its format has none, and what writes it may count in any unit.
void addDefaultExposure(Scene& scene);

/// A lit model gets the tone map khronos_neutral: its format asks for none, and highlights would burn out. Colours of a
/// model that is unlit throughout are shown as they are.
void addDefaultToneMap(Scene& scene);

/// What chooses others than those that a scene was given: options of the command line, or the viewer's panels.
enum class Advice : std::uint8_t { Options, Panels };

/// One line for people: which camera, light and exposure the scene was given, and what chooses others. Empty where it
/// was given none.
std::string suppliedText(const Scene& scene, Advice advice = Advice::Options);

} // namespace tessera::scenes
