#pragma once
#include "scenes/import/SceneJsonFiles.h"

namespace tessera::scenes::scenejson {

/// A new material: its name, its model and the model's parameters. Throws InputError for parameters that the model does
/// not have.
Material readMaterial(const JsonValue& value, Images& images);

/// Changes the parameters an override gives, and no others; "model" changes the model first. The caller reads the key
/// that says which materials are meant.
void changeMaterial(JsonObject& object, Material& material, Images& images);

} // namespace tessera::scenes::scenejson
