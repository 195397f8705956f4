#pragma once
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Interpolation.h"

/// Animation data of lights: position, direction, colour and intensity over time; lightAtTime() (scenes/Scene.h)
/// evaluates it.
namespace tessera::scenes {

enum class LightAnimationKind : std::uint8_t {
    Orbit,    ///< circles `axis` through `center` once in `periodSeconds`
    Wobble,   ///< position + amplitude * sin(2 pi (t / period + phase)), each axis
    Path,     ///< follows a path through `points` at constant speed once in `periodSeconds`: around, or there and back
    Keyframes ///< interpolates `keys`
};

/// The curve of a path between its points.
enum class PathLine : std::uint8_t {
    Straight,  ///< straight segments
    CatmullRom ///< a smooth curve without loops or cusps between points: centripetal
};

/// The values before the first and after the last key time.
enum class KeyRepeat : std::uint8_t {
    Once,    ///< hold the first and the last value
    Loop,    ///< repeat from the first key
    PingPong ///< alternate between backward and forward
};

/// Members of a light that keyframes can animate; keyedMembers() describes each.
enum class LightKeyed : std::uint8_t { Position, Direction, Color, Intensity, Count };

/// Keyframes of a member of a light.
struct LightKeys {
    LightKeyed of = LightKeyed::Position;
    std::vector<double> timesSeconds; ///< ascending, at least one
    std::vector<glm::dvec3> values;   ///< by key; x for scalar members
    Interpolation interpolation = Interpolation::Linear;
    KeyRepeat repeat = KeyRepeat::Once;
    std::vector<glm::dvec3> inTangents; ///< by key, per second, as in glTF; both tangents only for CubicSpline
    std::vector<glm::dvec3> outTangents;
    bool operator==(const LightKeys&) const = default;
};

/// Moves a light's position as a closed function of time, so that any time can be evaluated directly.
struct LightAnimation {
    LightAnimationKind kind = LightAnimationKind::Orbit;
    double periodSeconds = 1.0;
    double phase = 0.0; ///< fraction of the period, 0..1
    glm::dvec3 centerWS{0.0};
    glm::dvec3 axisWS{0.0, 1.0, 0.0};
    glm::dvec3 amplitudeMetres{0.0};
    std::vector<glm::dvec3> pointsWS; ///< Path: not all in one place
    PathLine line = PathLine::Straight;
    bool isOpen = false;     ///< Path: from the first point to the last and back, rather than around
    bool looksAhead = false; ///< Path: the light faces its direction of travel, overriding keyframes
    LightKeys keys;          ///< Keyframes: of the position
    bool operator==(const LightAnimation&) const = default;
};

/// Multiplies a light's intensity by flickerAt().
struct LightFlicker {
    static constexpr double kMostHertz = 1000.0;
    double amplitude = 0.5;   ///< 0..1: the factor stays within 1 - amplitude and 1 + amplitude
    double frequencyHz = 8.0; ///< above 0: the highest frequency in it
    int seed = 0;             ///< >= 0: lights of different seeds flicker differently
    bool operator==(const LightFlicker&) const = default;
};

} // namespace tessera::scenes
