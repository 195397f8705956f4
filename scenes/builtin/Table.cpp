#include <array>

#include "scenes/builtin/Builtin.h"

namespace tessera::scenes {

std::span<const BuiltinScene> builtinScenes() {
    static constexpr std::array kScenes = {
        BuiltinScene{"hall", "colonnaded hall, many materials, 256 coloured lights: the default", builtin::makeHall},
        BuiltinScene{"spheres", "roughness against metalness: what a material change looks like", builtin::makeSpheres},
        BuiltinScene{"models", "every material model, gloss with a direction, coats and cloth", builtin::makeModels},
        BuiltinScene{"lattice", "256 solids and any number of lights, specified to the last digit: for benchmarks",
                     builtin::makeLattice},
        BuiltinScene{"room", "closed room with radiances known in closed form: for correctness", builtin::makeRoom},
        BuiltinScene{"head", "bust with an object-space normal map, wall and floor", builtin::makeHead},
    };
    return kScenes;
}

} // namespace tessera::scenes
