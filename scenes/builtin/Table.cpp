#include <array>

#include "scenes/builtin/Builtin.h"

namespace tessera::scenes {

std::span<const BuiltinScene> builtinScenes() {
    constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;
    static constexpr std::array kScenes = {
        BuiltinScene{"hall", "colonnaded hall, many materials, 256 coloured lamps, sky and sun: the default",
                     builtin::makeHall, 16 * kMiB},
        BuiltinScene{"spheres", "roughness against metalness: what a material change looks like", builtin::makeSpheres,
                     kMiB},
        BuiltinScene{"models", "every material model, gloss with a direction, coats and cloth", builtin::makeModels,
                     8 * kMiB},
        BuiltinScene{"lattice", "256 solids and any number of lights, specified to the last digit: for benchmarks",
                     builtin::makeLattice, kMiB},
        BuiltinScene{"room", "closed room with radiances known in closed form: for correctness", builtin::makeRoom,
                     kMiB},
        BuiltinScene{"shadow_truth", "soft shadows of shares known in closed form: for correctness",
                     builtin::makeShadowTruth, kMiB},
        BuiltinScene{"head", "bust with an object-space normal map, wall and floor", builtin::makeHead, 80 * kMiB},
        BuiltinScene{"head_skin", "bust of skin, over which light diffuses, with a light behind its ears",
                     builtin::makeHeadSkin, 160 * kMiB},
        BuiltinScene{"head_marble", "the same of veined marble, which light passes through", builtin::makeHeadMarble,
                     160 * kMiB},
        BuiltinScene{"diffusion_truth", "diffused light known in closed form: for correctness",
                     builtin::makeDiffusionTruth, kMiB},
        BuiltinScene{"lamps", "reading hall at night, 1000 lights with an area: for benchmarks", builtin::makeLamps,
                     4 * kMiB},
        BuiltinScene{"studio", "products of seven materials, lit by lights of four shapes", builtin::makeProductStudio,
                     4 * kMiB},
        BuiltinScene{"glass", "bottles, tumblers, a prism and coloured panes on a table in the studio",
                     builtin::makeGlass, 16 * kMiB},
    };
    return kScenes;
}

} // namespace tessera::scenes
