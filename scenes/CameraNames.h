#pragma once
#include <cstddef>
#include <string>

#include "scenes/Scene.h"

/// Names of a scene's cameras, as accepted by cameraCalled().
namespace tessera::scenes {

/// The camera's name, or its index if it has no name or the name selects another camera.
std::string nameOfCamera(const Scene& scene, std::size_t camera);

/// "'side', 'top' and 3 more": the scene's other cameras, at most five by name; empty if there are none.
std::string otherCamerasText(const Scene& scene, std::size_t camera);

} // namespace tessera::scenes
