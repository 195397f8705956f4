#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "scenes/LoadLedger.h"
#include "scenes/Scene.h"
#include "scenes/import/JsonReader.h"

namespace tessera::scenes::scenejson {

/// Begins the name of a built-in scene where documents name files.
inline constexpr std::string_view kBuiltinPrefix = "builtin:";

/// The file that a name in a document means: relative names start at the document's folder, and ${TESSERA_ASSETS}
/// stands for that environment variable, as nothing else does. Throws InputError when the variable is not set or the
/// file is missing.
std::filesystem::path resolveFile(const JsonValue& name);

/// The pictures of a scene, each decoded once however often it is named.
class Images {
public:
    /// The first `baseImages` pictures are those of the document's base, which it may name by number.
    Images(Scene& scene, std::size_t baseImages, const LoadLedger& ledger)
        : scene_(scene), baseImages_(baseImages), ledger_(ledger) {}

    /// Throws InputError naming the place in the document and the file.
    int image(const JsonValue& fileName);
    int baseImage(const JsonValue& index) const;

private:
    Scene& scene_;
    std::size_t baseImages_;
    const LoadLedger& ledger_;
    std::map<std::string, int> imageOfFile_;
};

/// A file name alone, or {file or image, texCoord, transform: {offset, scale, rotationDegrees},
/// sampler: {magFilter, minFilter, wrapU, wrapV}}, where `image` is the number of one of the base's.
/// The second form reads those keys of an object that has more.
TextureUse readTexture(const JsonValue& value, Images& images);
TextureUse readTexture(JsonObject& object, Images& images);

} // namespace tessera::scenes::scenejson
