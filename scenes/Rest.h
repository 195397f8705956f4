#pragma once
#include <cstddef>
#include <vector>

#include "scenes/Scene.h"

/// The numbers at rest (Rig::numbers), which a scene has where no clip that plays changes them.
namespace tessera::scenes {

/// Takes the scene's present numbers as those at rest, of all that clips may change. To be called before a clip is
/// posed: a scene file may say other numbers than the model that its clips come from.
void takeRest(Scene& scene);

/// The scene's materials, with the numbers at rest in place of those that clips which play change.
std::vector<Material> restingMaterials(const Scene& scene);

/// The same of one of them.
Material restingMaterial(const Scene& scene, std::size_t index);
/// What an edit of a posed material makes of it at rest: a number that a clip which plays changes stays at rest where
/// the edit leaves it alone.
Material editedAtRest(const Scene& scene, std::size_t index, Material edited);
/// Puts a material in the place of another, and takes its numbers as those at rest. The scene then holds it as the
/// clips that play pose it at that time.
void replaceMaterial(Scene& scene, std::size_t index, Material resting, double timeSeconds);

/// Puts all numbers that clips which play change to rest.
void restPlayed(Scene& scene);
/// Puts all numbers of lights that clips may change to rest.
void restLights(Scene& scene);

} // namespace tessera::scenes
