#pragma once
#include <optional>

#include <glm/glm.hpp>

#include "scenes/Scene.h"
#include "scenes/Shadows.h"

namespace tessera::reference {

/// How textures are read: the picture alone, or with smaller levels as a driver's hardware does (see Filtering.h).
enum class Filtering { Exact, Hardware };

/// What is rendered of a scene.
struct Settings {
    glm::ivec2 sizePixels{1280, 720};
    scenes::Camera camera;
    double timeSeconds = 0.0;     ///< of animated lights
    std::optional<int> soloLight; ///< index into Scene::lights: only this one shines
    scenes::ShadowRequest shadows;
    int shadowRings = 16;  ///< of a light with a size, four times as many rays each
    int shadowSamples = 0; ///< rays that a program tries: their noise is allowed it too; 0: none is
    bool specular = true;  ///< false leaves the specular lobe out
    Filtering filtering = Filtering::Exact;
    bool leeway = true;          ///< whether to find other values that the definition allows (Rendered::alternatives)
    double rangeTolerance = 0.0; ///< unit of colour x intensity: A B C lights end where they fall to it; 0: nowhere
};

} // namespace tessera::reference
