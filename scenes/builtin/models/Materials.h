#pragma once
#include "scenes/Scene.h"

namespace tessera::scenes::builtin::models {

/// The exhibited materials, from left to right: the teaching models; anisotropic gloss; layers.
struct Exhibits {
    std::vector<int> teaching;
    std::vector<int> directional;
    std::vector<int> layered;
};
/// Adds the materials and their textures to the scene.
Exhibits addExhibits(Scene& scene);

} // namespace tessera::scenes::builtin::models
