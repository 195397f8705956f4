#include <array>

#include "scenes/builtin/Builtin.h"

namespace tessera::scenes {

std::span<const BuiltinScene> builtinScenes() {
    constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;
    static constexpr std::array kScenes = {
        BuiltinScene{"hall", "colonnaded hall, many materials, 256 coloured lamps, sky and sun: the default",
                     builtin::makeHall, 16 * kMiB, 391048, 258, 15},
        BuiltinScene{"spheres", "roughness against metalness: what a material change looks like", builtin::makeSpheres,
                     kMiB, 276420, 4, 57},
        BuiltinScene{"models", "every material model, gloss with a direction, coats and cloth", builtin::makeModels,
                     8 * kMiB, 66838, 12, 19},
        BuiltinScene{"lattice", "256 solids and any number of lights, specified to the last digit: for benchmarks",
                     builtin::makeLattice, kMiB, 192000, 256, 9},
        BuiltinScene{"room", "closed room with radiances known in closed form: for correctness", builtin::makeRoom,
                     kMiB, 30, 1, 10},
        BuiltinScene{"shadow_truth", "soft shadows of shares known in closed form: for correctness",
                     builtin::makeShadowTruth, kMiB, 1028, 2, 2},
        BuiltinScene{"head", "bust with an object-space normal map, wall and floor", builtin::makeHead, 80 * kMiB,
                     43130, 4, 4},
        BuiltinScene{"head_skin", "bust of skin, over which light diffuses, with a light behind its ears",
                     builtin::makeHeadSkin, 160 * kMiB, 90086, 4, 4},
        BuiltinScene{"head_marble", "the same of veined marble, which light passes through", builtin::makeHeadMarble,
                     160 * kMiB, 90086, 4, 4},
        BuiltinScene{"diffusion_truth", "diffused light known in closed form: for correctness",
                     builtin::makeDiffusionTruth, kMiB, 1032, 1, 3},
        BuiltinScene{"lamps", "reading hall at night, 1000 lights with an area: for benchmarks", builtin::makeLamps,
                     4 * kMiB, 56160, 1000, 17},
        BuiltinScene{"studio", "products of seven materials, lit by lights of four shapes", builtin::makeProductStudio,
                     4 * kMiB, 57216, 6, 9},
        BuiltinScene{"glass", "bottles, tumblers, a prism and coloured panes on a table in the studio",
                     builtin::makeGlass, 16 * kMiB, 46286, 3, 16},
    };
    return kScenes;
}

} // namespace tessera::scenes
