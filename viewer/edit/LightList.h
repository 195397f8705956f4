#pragma once
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "viewer/camera/CameraPose.h"

/// Edits of a scene's lights. Names stay as they are while others come and go, so that a list of them does not jump.
namespace tessera::viewer {

using Lights = std::vector<scenes::Light>;

/// What a list calls a light: by its name, else by its number.
std::string lightLabel(const Lights& lights, std::size_t index);

/// A name without the number that tells copies apart: "lamp" of "lamp 2".
std::string withoutNumber(const std::string& name);

/// `wanted` if no light has that name, else with the least number from 2 on behind it ("lamp 2").
std::string freeLightName(const Lights& lights, const std::string& wanted);

/// A light under a name that is free.
scenes::Light newLight(const Lights& lights, scenes::Light light);

/// Copies of lights, the numbers behind their names counted on ("lamp 2").
Lights copiesOfLights(const Lights& lights, const std::set<int>& indices);

/// Where the light of an index is after `put` lights came in the place of `taken` from `first` on; none where it was
/// one of those that went. As many as went are the same lights, changed.
std::optional<int> indexAfter(int index, std::size_t first, std::size_t taken, std::size_t put);

/// Solo of a light: on, or off where it was on already.
std::optional<int> toggledSolo(std::optional<int> solo, std::size_t index);

/// Gives a light a type. One that becomes an area light falls off as such, and gets a radius where it has none: a
/// hundredth of the scene's size. A rectangle that becomes a polygon keeps its corners, unless the polygon's were set
/// before; an outline that holds next to no area becomes a square. All else stays, also what the type has no use for.
void chooseType(scenes::Light& light, scenes::LightType type, double sceneSizeMetres);

/// Gives lights types like that, so that a light that became an area light and is none any more gets back how it fell
/// off, and that it had no radius, and one that is no polygon any more which corners it had, unless it was given others
/// since. Of each light, by its index.
class TypeChooser {
public:
    void choose(std::size_t index, scenes::Light& changed, scenes::LightType type, double sceneSizeMetres);
    /// Stays with the lights after `put` came in the place of `taken` from `first` on.
    void follow(std::size_t first, std::size_t taken, std::size_t put);
    /// Others are there now.
    void forget() { before_.clear(); }

private:
    /// What a light had before it became of a type that needs more, and what it was given then.
    struct Before {
        scenes::Falloff falloff = scenes::Falloff::InverseSquare;
        float radiusMetres = 0.0f, givenMetres = 0.0f;
        scenes::LightCorners corners, givenCorners;
    };
    std::map<std::size_t, Before> before_;
};

/// Moves a corner of a polygon; false, and no change, where its corners would make no outline.
bool moveCorner(scenes::Light& light, std::size_t corner, const glm::vec2& placeMetres);

/// Adds a corner in the middle of the last edge, and takes the last corner away. False, and no change, where there are
/// as many or as few as there can be, or the others make no outline.
bool addCorner(scenes::Light& light);
bool removeCorner(scenes::Light& light);

/// Turns a light to a direction of any length above 0; the width of a rectangle, and a polygon's x, stays across it,
/// turned as little as can be.
void turnLight(scenes::Light& light, const glm::dvec3& directionWS);

/// Lets the width of a rectangle, or a polygon's x, run along a vector, of which counts what is across the light's
/// direction. Returns false, and changes nothing, where that is nothing.
bool layLight(scenes::Light& light, const glm::dvec3& alongWS);

/// Puts a light, with its path where it is animated, so that it is at a place at this time.
void placeLight(scenes::Light& light, double timeSeconds, const glm::dvec3& positionWS);

/// Moves a light, with its path where it is animated, so that it follows a drag across the picture at its own depth.
/// What lies behind the eye moves as if it were at the focus. Directional lights have no place and stay.
void moveLight(scenes::Light& light, double timeSeconds, const CameraPose& pose, const scenes::Camera& lens,
               const glm::dvec2& dragPixels, double heightPixels);

/// Lets a light circle about the vertical axis through a centre beside it, from where it is at this time.
void orbitLight(scenes::Light& light, double radiusMetres, double periodSeconds, double timeSeconds);

/// Ends an animation and keyframes: the light stays as it is at this time, and flickers on.
void stopLight(scenes::Light& light, double timeSeconds);

/// Begins or ends its flicker, which is not that of lights of other indices.
void letFlicker(scenes::Light& light, bool flickers, std::size_t index);

} // namespace tessera::viewer
