#pragma once
#include "scenes/Scene.h"

/// The pictures of the scene `lamps`. All tile along u; v points down.
namespace tessera::scenes::builtin::lamps {

inline constexpr double kSpinesMetres = 1.6; ///< of a shelf that the picture of spines covers
inline constexpr float kBoardsMetres = 2.4f; ///< of the floor that its picture covers, in both directions

Image spineColors(); ///< backs of books from the shelf (v = 1) to their tops (v = 0)
Image boardColors(); ///< oak boards, tiles along v too

} // namespace tessera::scenes::builtin::lamps
