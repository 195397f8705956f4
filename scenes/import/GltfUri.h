#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tessera::scenes::gltf {

bool isDataUri(std::string_view uri);

/// The bytes of "data:[media type][;base64],..." (RFC 2397). Throws InputError saying what is wrong with it.
std::vector<std::byte> decodeDataUri(std::string_view uri);

/// The file that a relative URI names: percent-decoded (RFC 3986) UTF-8, relative to `folder`. A URI that no file
/// answers to when decoded but one does as it stands is taken as it stands. Throws InputError for absolute URIs with a
/// scheme.
std::filesystem::path fileOfUri(std::string_view uri, const std::filesystem::path& folder);

} // namespace tessera::scenes::gltf
