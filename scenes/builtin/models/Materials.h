#pragma once
#include "scenes/Scene.h"

namespace tessera::scenes::builtin::models {

/// The materials on show, from left to right: the teaching models; gloss that has a direction; layers.
struct Exhibits {
    std::vector<int> teaching;
    std::vector<int> directional;
    std::vector<int> layered;
};
/// Adds them, and their pictures, to the scene.
Exhibits addExhibits(Scene& scene);

} // namespace tessera::scenes::builtin::models
