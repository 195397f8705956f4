#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>
#include <tiny_gltf.h>

#include "scenes/LoadLedger.h"

namespace tessera::scenes::gltf {

/// A parsed glTF file of sound shape (GltfShape.h). Buffers and images are not loaded: what is never used is never
/// read.
struct Document {
    std::string file;             ///< as the caller named it, for messages
    std::filesystem::path folder; ///< relative URIs start here
    nlohmann::json json;          ///< the document as written; read for buffers, images and unsigned 64-bit properties
    std::optional<std::vector<std::byte>> binary; ///< the binary chunk of a .glb
    tinygltf::Model model; ///< everything but buffers, images, skins, animations and morph targets
    LoadLedger& ledger;
    int bufferViewCount = 0; ///< an accessor's bufferView from here on stands for none

    /// Throws InputError "file: place: what".
    [[noreturn]] void fail(std::string_view place, std::string_view what) const;
    /// Charges the ledger for what `kind` `index`, such as accessors 3, is about to take.
    void charge(std::uint64_t bytes, std::string_view kind, int index) const;
};

/// Throws InputError when the file is missing, broken, of another glTF version or requires an extension that is not
/// supported.
Document loadDocument(const std::filesystem::path& file, LoadLedger& ledger);

/// The optional extensions that the document uses and the importer leaves out.
std::vector<std::string> ignoredExtensions(const Document& document);

/// The extension `name` of an element, or null.
const tinygltf::Value* findExtension(const tinygltf::ExtensionMap& extensions, const std::string& name);

/// The number `name` in an extension's object, or `otherwise` when it is absent.
double numberIn(const tinygltf::Value& object, const std::string& name, double otherwise);

} // namespace tessera::scenes::gltf
