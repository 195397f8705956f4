#pragma once
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/LoadLedger.h"

namespace tessera::scenes::gltf {

/// A glTF file cut into its JSON text and, for .glb, its binary chunk.
struct Container {
    std::string json;
    std::optional<std::vector<std::byte>> binary;
};

/// Reads a .gltf or .glb; which one it is follows from its first bytes, not from its name.
/// Source: glTF 2.0 section 4.4, "Binary glTF Layout". Throws InputError naming the file and the broken part.
Container readContainer(const std::filesystem::path& file, LoadLedger& ledger);

} // namespace tessera::scenes::gltf
