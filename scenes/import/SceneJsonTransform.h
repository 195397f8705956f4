#pragma once
#include "scenes/import/JsonReader.h"

namespace tessera::scenes::scenejson {

/// 16 numbers, column by column as in glTF, of an affine matrix.
glm::dmat4 readMatrix(const JsonValue& value);

/// The keys "transform" ({translation, rotation or eulerDegrees, scale}) or "matrix" of an object; the identity without
/// both. Scale comes first, then rotation, then translation; euler angles turn about the fixed axes X, then Y, then Z.
/// Throws InputError for both keys at once. A transform may flatten what it places.
glm::dmat4 readTransform(JsonObject& object);

/// True when the matrix only rotates and moves, to the tolerance of checkScene().
bool isRigid(const glm::dmat4& matrix);

} // namespace tessera::scenes::scenejson
