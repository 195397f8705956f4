#pragma once
#include <cstddef>
#include <optional>

#include "scenes/Scene.h"

/// Edits of a light's animation: keyframes, and the path of its position.
namespace tessera::viewer {

/// Least time between keys, so that each can be grabbed.
inline constexpr double kLeastKeyGapSeconds = 1e-3;
inline constexpr double kLeastPeriodSeconds = 1e-2;

/// The keyframes of a member; null if it has none.
const scenes::LightKeys* keysOf(const scenes::Light& light, scenes::LightKeyed member);

/// Adds a key of a member at a time with the light's value then, without flicker, so that the light does not change. No
/// effect if a key exists within kLeastKeyGapSeconds. Keys of the position replace another path type, and those of the
/// direction end looking ahead. Returns the index of the key at that time.
std::size_t addKey(scenes::Light& light, scenes::LightKeyed member, double timeSeconds);
/// Removes a key. After the last one, the member keeps the value of that key.
void removeKey(scenes::Light& light, scenes::LightKeyed member, std::size_t key);
/// Moves a key to another time, limited by its neighbours.
void moveKey(scenes::Light& light, scenes::LightKeyed member, std::size_t key, double timeSeconds);
/// Sets the value of a key: numbers in x, directions of any length above 0. No effect for a direction of length 0.
void setKey(scenes::Light& light, scenes::LightKeyed member, std::size_t key, const glm::dvec3& value);
/// Splines get tangents along the line from each key's previous to its next neighbour.
void setInterpolation(scenes::Light& light, scenes::LightKeyed member, scenes::Interpolation interpolation);
void setRepeat(scenes::Light& light, scenes::LightKeyed member, scenes::KeyRepeat repeat);

/// Changes the path type of a light with a position, keeping the current position: a circle, a line or a square of
/// about a size, or the current path as far as the other type can represent it.
void chooseWay(scenes::Light& light, scenes::LightAnimationKind kind, double timeSeconds, double sizeMetres);

/// Adds a point of a path after another: halfway to the next point, or beyond the end of an open path.
void addPathPoint(scenes::Light& light, std::size_t behind);
/// These return false without effect if the path would have no length or fewer than two points.
bool removePathPoint(scenes::Light& light, std::size_t point);
bool movePathPoint(scenes::Light& light, std::size_t point, const glm::dvec3& placeWS);

} // namespace tessera::viewer
