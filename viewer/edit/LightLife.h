#pragma once
#include <cstddef>
#include <optional>

#include "scenes/Scene.h"

/// Edits of how a light moves, turns and shines over time: keyframes, and the way that its place goes.
namespace tessera::viewer {

/// Keys stand this far apart at least, so that one can be taken hold of.
inline constexpr double kLeastKeyGapSeconds = 1e-3;
inline constexpr double kLeastPeriodSeconds = 1e-2;

/// The keyframes of a member; null: it has none.
const scenes::LightKeys* keysOf(const scenes::Light& light, scenes::LightKeyed member);

/// Adds a key of a member at a time, with what the light shows then but its flicker, so that the light stays as it is
/// then. Where there is a key already, within kLeastKeyGapSeconds, nothing is added. Keys of the position end another
/// way to move, and those of the direction end looking ahead. Returns the number of the key that stands there.
std::size_t addKey(scenes::Light& light, scenes::LightKeyed member, double timeSeconds);
/// Takes a key away. With the last one the member is what that key said, for good.
void removeKey(scenes::Light& light, scenes::LightKeyed member, std::size_t key);
/// Moves a key to another time, as far as its neighbours let it.
void moveKey(scenes::Light& light, scenes::LightKeyed member, std::size_t key, double timeSeconds);
/// Gives a key a value, x of a number; a direction of any length above 0. Without one nothing changes.
void setKey(scenes::Light& light, scenes::LightKeyed member, std::size_t key, const glm::dvec3& value);
/// Splines get tangents that lead from each key's neighbour before it to the one after it.
void setInterpolation(scenes::Light& light, scenes::LightKeyed member, scenes::Interpolation interpolation);
void setRepeat(scenes::Light& light, scenes::LightKeyed member, scenes::KeyRepeat repeat);

/// Lets the place of a light, which has one, go another way, from where it is at this time: a circle, a line or a
/// square of about a size, or the way that it goes now as far as the other kind can say it.
void chooseWay(scenes::Light& light, scenes::LightAnimationKind kind, double timeSeconds, double sizeMetres);

/// Adds a point of a path behind another: in the middle of the way to the next, or beyond an open path's end.
void addPathPoint(scenes::Light& light, std::size_t behind);
/// These change nothing, and return false, where the path would have no length or fewer than two points.
bool removePathPoint(scenes::Light& light, std::size_t point);
bool movePathPoint(scenes::Light& light, std::size_t point, const glm::dvec3& placeWS);

} // namespace tessera::viewer
