#pragma once
#include <cstddef>
#include <string>

#include "scenes/Scene.h"

/// How cameras of a scene are called, as cameraCalled() takes it.
namespace tessera::scenes {

/// Its name, or its number where it has no name or its name chooses another camera.
std::string nameOfCamera(const Scene& scene, std::size_t camera);

/// "'side', 'top' and 3 more": the other cameras of the scene, of many the first five; empty where there are
/// none.
std::string otherCamerasText(const Scene& scene, std::size_t camera);

} // namespace tessera::scenes
