#pragma once
#include "scenes/write/JsonFields.h"

/// JSON of a scene's elements for .json scenes. What the keys of their type cannot express, such as the cone of a point
/// light that was a spot and may become one again, is stored under "fields", so that elements are read back exactly.
namespace tessera::scenes::write {

/// `texture` is the document's name for the light's texture. A light whose type has none loses it.
Json lightJson(const Light& light, const std::string& texture = "");
Json cameraJson(const Camera& camera);
/// Images are referenced by their index in the base.
Json materialJson(const Material& material, std::size_t images);

/// The angle in degrees with the fewest digits that is read back as the same radians, or as near as possible.
Json degreesOf(float angleRadians);
Json degreesOf(double angleRadians);

} // namespace tessera::scenes::write
