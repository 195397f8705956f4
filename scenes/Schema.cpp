#include "scenes/Schema.h"

#include <algorithm>
#include <cassert>

#include "embeddedSchemas.gen.h"

namespace tessera::scenes {

std::string_view sceneSchema() {
    const auto files = embeddedSchemas();
    const auto found = std::ranges::find(files, std::string_view("scene.schema.json"), &EmbeddedFile::path);
    assert(found != files.end() && "the schema is embedded");
    return found->text;
}

} // namespace tessera::scenes
