#pragma once
#include <array>
#include <vector>

#include "scenes/Scene.h"

namespace tessera::scenes::builtin::lamps {

/// Kinds of lamps in the reading hall.
enum class Lamp {
    Shelf,     ///< strips under the boards of the bookcases, down and towards the books
    CaseEnd,   ///< upright strips on the cases, towards the nave
    Luminaire, ///< sheets that hang over the nave and shine down and up
    Gallery,   ///< panels under the galleries
    Desk,      ///< under the shades of the desk lamps
    Washer,    ///< strips over the galleries, down and towards the books on the outer walls
    Count
};

/// All lamps of a kind are rectangles of one size, colour and radiance.
struct LampKind {
    Lamp lamp;
    const char* name;
    glm::vec3 color;   ///< linear, the largest channel 1
    float radiance;    ///< cd/m2
    float widthMetres; ///< along its longer side
    float heightMetres;
    float rangeMetres; ///< from its middle
    bool isTwoSided;
};
extern const std::array<LampKind, static_cast<std::size_t>(Lamp::Count)> kLampKinds;

/// Kinds, positions and properties of all 1000 lamps.
inline constexpr int kLampPlaces = 1000;
struct LampPlace {
    Lamp lamp;
    Light light;
};
std::vector<LampPlace> lampPlaces();

/// The visible glowing surfaces of a kind, in world space, placed where their own light does not illuminate them.
Mesh glowingSurfaces(const std::vector<LampPlace>& places, Lamp lamp);

/// Adds `count` of the lights; if there are more than places, further ones are scattered around these.
void addLamps(Scene& scene, const std::vector<LampPlace>& places, int count);

} // namespace tessera::scenes::builtin::lamps
