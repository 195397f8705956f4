#pragma once
#include "scenes/LoadLedger.h"
#include "scenes/Scene.h"
#include "scenes/import/JsonReader.h"

namespace tessera::scenes::scenejson {

/// {file, materials: [names], mayMoveMetres, parameters: [{name, value, least, most}]}, in place of the hook that the
/// scene has; null: it has none; {values: {name: number}}: the same with other values of its parameters. Without
/// `materials` it changes all that the scene has. Throws InputError naming the place in the document, or file and line
/// where the file is at fault.
void readHook(const JsonValue& value, Scene& scene, LoadLedger& ledger);

} // namespace tessera::scenes::scenejson
