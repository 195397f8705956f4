#pragma once
#include <string_view>

namespace tessera::scenes {

/// The JSON Schema (draft 7) of Tessera's .json scenes, for editors and for programs that write such files. The
/// importer's own checks are stricter than a schema can be; they refuse everything that the schema refuses.
std::string_view sceneSchema();

} // namespace tessera::scenes
