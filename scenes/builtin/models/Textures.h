#pragma once
#include "scenes/Scene.h"

/// Textures of the scene `models`. All tile in both directions; v points down.
namespace tessera::scenes::builtin::models {

Image terrazzoColors();  ///< stone chips of four colours in a pale ground
Image lanternColors();   ///< paper between ribs, bright where the lamp is near
Image glazeColors();     ///< glossy bands, and hardly glossy ones between them
Image swirlDirections(); ///< RG direction in tangent space as n/2 + 1/2, B strength: arcs like those of a rotating
                         ///< brush
Image fibreColors();     ///< twill of black fibres, two directions
Image fibreDirections(); ///< RG direction of those fibres, B strength
Image flakeNormals();    ///< flakes that lie nearly flat
Image peelNormals();     ///< the soft waves of sprayed lacquer
Image clothColors();     ///< a checked cloth of coloured threads
Image clothNormals();    ///< its threads, over and under
Image fuzzRoughness();   ///< A roughness: how far the cloth's hairs stray
Image glowColors();      ///< light from thin cracks

} // namespace tessera::scenes::builtin::models
