#pragma once
#include "scenes/write/JsonFields.h"

/// Elements of a scene as .json scenes have them. What the keys of their type cannot say, such as the cone of a point
/// light that was a spot and may become one again, stands under "fields": every element is read back as it is.
namespace tessera::scenes::write {

/// `texture` is what the document calls the light's picture. A light whose type takes none loses it.
Json lightJson(const Light& light, const std::string& texture = "");
Json cameraJson(const Camera& camera);
/// Its pictures are named by their number in the base.
Json materialJson(const Material& material, std::size_t images);

/// The angle in the fewest decimal degrees that are read back as the same radians, or as near as can be.
Json degreesOf(float angleRadians);
Json degreesOf(double angleRadians);

} // namespace tessera::scenes::write
