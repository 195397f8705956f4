#pragma once
#include <string>

#include <nlohmann/json_fwd.hpp>

namespace tessera::scenes::gltf {

/// Checks every property the importer reads against the glTF 2.0 schema: JSON types, required properties, number
/// ranges, enumerations, and that each index points at an element that exists. Integers written with a decimal point
/// (24.0) become integers. Throws InputError "`file`: json-pointer: what is wrong".
void checkShape(nlohmann::json& document, const std::string& file);

} // namespace tessera::scenes::gltf
