#pragma once
#include <nlohmann/json.hpp>

#include "scenes/import/Repairs.h"

// Renamed: a program that links this library may contain its own tinygltf, built with other options.
#define tinygltf tessera_tinygltf
#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_INCLUDE_JSON
#include <tiny_gltf.h>
#undef tinygltf

namespace tessera::scenes::gltf {

namespace tiny = tessera_tinygltf;

/// Checks the properties of a document that its scene uses (GltfSchema.cpp): JSON types, ranges, choices, and that
/// each index names an element. Clamps numbers, and leaves out other flaws with the least that is nothing without them.
/// Returns a document of these properties alone: tinygltf ignores values of a wrong type without a message, keeps the
/// low 32 bits of integers, and copies all other values. Integers written with a decimal point (24.0) become integers.
/// Moves texts out of `document`. Charges the ledger for tinygltf's copy of the result. Throws InputError "file:
/// /json/pointer: what" where the load is strict.
nlohmann::json checkedProperties(nlohmann::json& document, const std::string& file, LoadLedger& ledger,
                                 Repairs& repairs);

/// Parses a document of checkedProperties() by tinygltf. `buffers` stays empty and images have only name, uri and
/// bufferView, because tinygltf reads and decodes all of them at once. Throws InputError with tinygltf's message.
tiny::Model tinyModel(nlohmann::json checked, const std::string& file, LoadLedger& ledger);

} // namespace tessera::scenes::gltf
