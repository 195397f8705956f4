#pragma once
#include <string_view>

namespace tessera::scenes {

/// The JSON Schema (draft 7) of Tessera's .json scenes, for editors and for programs that write such files. The
/// importer's own checks say more than a schema can; what the schema refuses, they refuse too.
std::string_view sceneSchema();

} // namespace tessera::scenes
