#pragma once
#include <functional>

#include "scenes/Scene.h"
#include "scenes/import/JsonReader.h"

namespace tessera::scenes::scenejson {

/// The picture that a document names; throws InputError at the name.
using ReadLightTexture = std::function<LightTexture(const JsonValue& fileName)>;

/// A light of any type of lightTypes(), with its falloff and animation; `index` names a nameless one. Throws
/// InputError; "area" and "environment" are refused with what to write instead.
Light readLight(const JsonValue& value, std::size_t index, const ReadLightTexture& readTexture);
/// The same where a light that names a picture is refused.
Light readLight(const JsonValue& value, std::size_t index);

/// A perspective or orthographic camera, placed by position and target or direction, or by a matrix.
Camera readCamera(const JsonValue& value, std::size_t index);

} // namespace tessera::scenes::scenejson
