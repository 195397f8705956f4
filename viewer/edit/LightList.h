#pragma once
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "viewer/camera/CameraPose.h"

/// Edits of a scene's lights. Adding and removing lights does not rename others, so that lists do not jump.
namespace tessera::viewer {

using Lights = std::vector<scenes::Light>;

/// The label of a light in lists: its name, else its number.
std::string lightLabel(const Lights& lights, std::size_t index);

/// A name without the number of a copy: "lamp" for "lamp 2".
std::string withoutNumber(const std::string& name);

/// `wanted` if no light has that name, else followed by the smallest free number from 2 on ("lamp 2").
std::string freeLightName(const Lights& lights, const std::string& wanted);

/// The light with an unused name.
scenes::Light newLight(const Lights& lights, scenes::Light light);

/// Copies of lights, with the next free numbers after their names ("lamp 2").
Lights copiesOfLights(const Lights& lights, const std::set<int>& indices);

/// Index of a light after `put` lights have replaced `taken` ones from `first` on; none if it was among the replaced.
/// Equal counts mean the same lights, changed.
std::optional<int> indexAfter(int index, std::size_t first, std::size_t taken, std::size_t put);

/// Toggles the solo state of a light.
std::optional<int> toggledSolo(std::optional<int> solo, std::size_t index);

/// Changes the type of a light. An area light gets inverse-square falloff, and a radius of a hundredth of the scene's
/// size if it has none. A rectangle that becomes a polygon keeps its corners, unless the polygon's were set before; a
/// degenerate outline becomes a square. All else stays, including values that the type does not use.
void chooseType(scenes::Light& light, scenes::LightType type, double sceneSizeMetres);

/// Changes types like that, and restores on the way back what a change had set: falloff and missing radius of a light
/// that is no longer an area light, and corners of one that is no longer a polygon, unless they were edited since. Per
/// light index.
class TypeChooser {
public:
    void choose(std::size_t index, scenes::Light& changed, scenes::LightType type, double sceneSizeMetres);
    /// Updates the indices after `put` lights have replaced `taken` ones from `first` on.
    void follow(std::size_t first, std::size_t taken, std::size_t put);
    /// All lights have been replaced.
    void forget() { before_.clear(); }

private:
    /// Values of a light before it got a type that needs more, and the values it was given then.
    struct Before {
        scenes::Falloff falloff = scenes::Falloff::InverseSquare;
        float radiusMetres = 0.0f, givenMetres = 0.0f;
        scenes::LightCorners corners, givenCorners;
    };
    std::map<std::size_t, Before> before_;
};

/// Moves a corner of a polygon. Returns false without effect if the outline would be invalid.
bool moveCorner(scenes::Light& light, std::size_t corner, const glm::vec2& placeMetres);

/// Adds a corner in the middle of the last edge, or removes the last corner. Returns false without effect at the limits
/// of the count, or if the outline would be invalid.
bool addCorner(scenes::Light& light);
bool removeCorner(scenes::Light& light);

/// Turns a light to a direction of any length above 0. The width of a rectangle, or a polygon's x, stays perpendicular
/// to it, turned as little as possible.
void turnLight(scenes::Light& light, const glm::dvec3& directionWS);

/// Aligns the width of a rectangle, or a polygon's x, with the component of a vector perpendicular to the light's
/// direction. Returns false without effect if that is zero.
bool layLight(scenes::Light& light, const glm::dvec3& alongWS);

/// Moves a light, with its path if it is animated, so that it is at a position at this time.
void placeLight(scenes::Light& light, double timeSeconds, const glm::dvec3& positionWS);

/// Moves a light, with its path if it is animated, along with a drag across the image at its own depth. A light behind
/// the eye moves as if at the focus. Directional lights have no position and stay.
void moveLight(scenes::Light& light, double timeSeconds, const CameraPose& pose, const scenes::Camera& lens,
               const glm::dvec2& dragPixels, double heightPixels);

/// Lets a light orbit the vertical axis through a centre beside it, beginning at its position at this time.
void orbitLight(scenes::Light& light, double radiusMetres, double periodSeconds, double timeSeconds);

/// Ends an animation and keyframes: the light keeps its values at this time, and its flicker.
void stopLight(scenes::Light& light, double timeSeconds);

/// Starts or ends flicker, which differs between light indices.
void letFlicker(scenes::Light& light, bool flickers, std::size_t index);

} // namespace tessera::viewer
