#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "scenes/LoadLedger.h"
#include "scenes/Scene.h"
#include "scenes/import/JsonReader.h"

namespace tessera::scenes::scenejson {

/// The file that a name in a document means: relative names start at the document's folder, and ${TESSERA_ASSETS}
/// stands for that environment variable, as nothing else does. Throws InputError when the variable is not set or the
/// file is missing.
std::filesystem::path resolveFile(const JsonValue& name);

/// The pictures that a document may name. The first `baseImages` of the scene are those of the document's base, which
/// are named by number.
class Images {
public:
    /// Reads files into the scene, each once however often it is named.
    Images(Scene& scene, std::size_t baseImages, LoadLedger& ledger)
        : baseImages_(baseImages), scene_(&scene), ledger_(&ledger) {}
    /// Reads none: a document that names a file is refused.
    explicit Images(std::size_t baseImages) : baseImages_(baseImages) {}

    /// Throws InputError naming the place in the document and the file.
    int image(const JsonValue& fileName);
    int baseImage(const JsonValue& index) const;

private:
    std::size_t baseImages_;
    Scene* scene_ = nullptr;
    LoadLedger* ledger_ = nullptr;
    std::map<std::string, int> imageOfFile_;
};

/// A file name alone, or {file or image, texCoord, transform: {offset, scale, rotationDegrees},
/// sampler: {magFilter, minFilter, wrapU, wrapV}}, where `image` is the number of one of the base's.
/// The second form reads those keys of an object that has more.
TextureUse readTexture(const JsonValue& value, Images& images);
TextureUse readTexture(JsonObject& object, Images& images);

} // namespace tessera::scenes::scenejson
