#pragma once
#include <cstddef>
#include <vector>

#include "scenes/Scene.h"

/// Rest values (Rig::numbers): a scene's values while no active clip animates them.
namespace tessera::scenes {

/// Stores the scene's current values as rest values of everything that clips can change. Call it before a clip is
/// posed: a scene file may override values of the model that its clips come from.
void takeRest(Scene& scene);

/// The scene's materials, with rest values in place of those that active clips change.
std::vector<Material> restingMaterials(const Scene& scene);

/// The same for one material.
Material restingMaterial(const Scene& scene, std::size_t index);
/// Converts an edited posed material to its rest state: values that active clips change keep their rest value unless
/// edited.
Material editedAtRest(const Scene& scene, std::size_t index, Material edited);
/// Replaces a material and stores its values as rest values. The scene then holds it as posed by the active clips at
/// `timeSeconds`.
void replaceMaterial(Scene& scene, std::size_t index, Material resting, double timeSeconds);

/// Restores the rest values of everything that active clips change.
void restPlayed(Scene& scene);
/// Restores the rest values of all lights.
void restLights(Scene& scene);

} // namespace tessera::scenes
