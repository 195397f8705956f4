#pragma once
#include "scenes/Scene.h"

/// Textures of the scene `lamps`. All tile along u; v points down.
namespace tessera::scenes::builtin::lamps {

inline constexpr double kSpinesMetres = 1.6; ///< length of shelf that the texture of spines covers
inline constexpr float kBoardsMetres = 2.4f; ///< size of floor that its texture covers, in both directions

Image spineColors(); ///< backs of books from the shelf (v = 1) to their tops (v = 0)
Image boardColors(); ///< oak boards, tiles along v too

} // namespace tessera::scenes::builtin::lamps
