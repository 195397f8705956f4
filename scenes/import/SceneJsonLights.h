#pragma once
#include "scenes/Scene.h"
#include "scenes/import/JsonReader.h"

namespace tessera::scenes::scenejson {

/// A light of any type of lightTypes(), with its falloff and animation; `index` names a nameless one. Throws
/// InputError; "area" and "environment" are refused with what to write instead.
Light readLight(const JsonValue& value, std::size_t index);

/// A perspective or orthographic camera, placed by position and target or direction, or by a matrix.
Camera readCamera(const JsonValue& value, std::size_t index);

} // namespace tessera::scenes::scenejson
