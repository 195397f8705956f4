#pragma once
#include <string>

#include "scenes/Scene.h"

/// Textures of the hall. Tiling ones repeat seamlessly and cover the metres named; v points down.
namespace tessera::scenes::builtin::hall {

inline constexpr float kFloorTextureMetres = 2.0f;
Image floorColors();    ///< light and dark slabs with inlaid squares
Image floorRoughness(); ///< G roughness, B metalness: polished slabs, dull joints
Image floorNormals();

inline constexpr float kAshlarTextureMetres = 2.0f;
Image ashlarColors(); ///< blocks of hewn stone in four courses
Image ashlarNormals();

Image marbleColors(); ///< white, veined

inline constexpr float kMosaicTextureMetres = 0.5f;
Image mosaicNormals(); ///< stones set by hand, each tilted a little

Image carpetColors(); ///< u across, once; v along, repeating
Image bannerColors(const std::string& name, const glm::dvec3& field);

} // namespace tessera::scenes::builtin::hall
