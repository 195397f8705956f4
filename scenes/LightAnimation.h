#pragma once
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Interpolation.h"

/// How lights move, turn and shine over time, as plain data; lightAtTime() (scenes/Scene.h) evaluates it.
namespace tessera::scenes {

enum class LightAnimationKind : std::uint8_t {
    Orbit,  ///< circles `axis` through `center` once in `periodSeconds`
    Wobble, ///< position + amplitude * sin(2 pi (t / period + phase)), each axis
    Path,   ///< runs along a line through `points` at constant speed once in `periodSeconds`: around, or there and back
    Keyframes ///< as `keys` say
};

/// How a path runs through its points.
enum class PathLine : std::uint8_t {
    Straight,  ///< from each to the next
    CatmullRom ///< a smooth curve without loops or cusps between points: centripetal
};

/// What follows the last key time, and what is before the first.
enum class KeyRepeat : std::uint8_t {
    Once,    ///< all stays as it is there
    Loop,    ///< from the first key again
    PingPong ///< backwards to the first key, and again
};

/// What keyframes can say of a light; keyedMembers() says what each of them is.
enum class LightKeyed : std::uint8_t { Position, Direction, Color, Intensity, Count };

/// Keyframes of a member of a light.
struct LightKeys {
    LightKeyed of = LightKeyed::Position;
    std::vector<double> timesSeconds; ///< ascending, at least one
    std::vector<glm::dvec3> values;   ///< by key, as the member; x where that is a number
    Interpolation interpolation = Interpolation::Linear;
    KeyRepeat repeat = KeyRepeat::Once;
    std::vector<glm::dvec3> inTangents; ///< by key, per second, as glTF's; these two are of CubicSpline
    std::vector<glm::dvec3> outTangents;
    bool operator==(const LightKeys&) const = default;
};

/// Moves the position of a light that has one, as a closed function of time, so that any time can be asked for
/// directly.
struct LightAnimation {
    LightAnimationKind kind = LightAnimationKind::Orbit;
    double periodSeconds = 1.0;
    double phase = 0.0; ///< share of the period, 0..1
    glm::dvec3 centerWS{0.0};
    glm::dvec3 axisWS{0.0, 1.0, 0.0};
    glm::dvec3 amplitudeMetres{0.0};
    std::vector<glm::dvec3> pointsWS; ///< Path: not all in one place
    PathLine line = PathLine::Straight;
    bool isOpen = false;     ///< Path: from the first point to the last and back, rather than around
    bool looksAhead = false; ///< Path: a light's direction is the way it goes, whatever keyframes say
    LightKeys keys;          ///< Keyframes: of the position
    bool operator==(const LightAnimation&) const = default;
};

/// Multiplies a light's intensity by flickerAt().
struct LightFlicker {
    static constexpr double kMostHertz = 1000.0;
    double amplitude = 0.5;   ///< 0..1: the factor stays within 1 - amplitude and 1 + amplitude
    double frequencyHz = 8.0; ///< above 0: nothing in it is faster
    int seed = 0;             ///< >= 0: lights of different seeds flicker differently
    bool operator==(const LightFlicker&) const = default;
};

} // namespace tessera::scenes
