#pragma once
#include "scenes/Scene.h"

/// The pictures of the scene `models`. All tile in both directions; v points down.
namespace tessera::scenes::builtin::models {

Image terrazzoColors();  ///< stone chips of four colours in a pale ground
Image lanternColors();   ///< paper between ribs, bright where the lamp is near
Image glazeColors();     ///< bands that are glossy, and bands between them that hardly are
Image swirlDirections(); ///< RG direction in tangent space as n/2 + 1/2, B strength: arcs as a rotating brush leaves
                         ///< them
Image fibreColors();     ///< twill of black fibres, two directions
Image fibreDirections(); ///< RG direction of those fibres, B strength
Image flakeNormals();    ///< facets that lie nearly flat
Image peelNormals();     ///< the soft waves of sprayed lacquer
Image clothColors();     ///< a checked cloth of coloured threads
Image clothNormals();    ///< its threads, over and under
Image fuzzRoughness();   ///< A: how far the cloth's hairs stray
Image glowColors();      ///< light from thin cracks

} // namespace tessera::scenes::builtin::models
