#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/import/NamedFile.h"

namespace tessera::scenes::gltf {

bool isDataUri(std::string_view uri);

/// The bytes of "data:[media type][;base64],..." (RFC 2397). Throws InputError saying what is wrong with it.
std::vector<std::byte> decodeDataUri(std::string_view uri);

/// The file that a URI names: percent-decoded (RFC 3986) UTF-8, or as it stands where a file answers to that alone,
/// relative to `folder`, in the spellings that fileNamed() knows. Throws InputError for a scheme other than `file`.
NamedFile fileOfUri(std::string_view uri, const std::filesystem::path& folder);

} // namespace tessera::scenes::gltf
