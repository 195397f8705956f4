#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "scenes/LoadLedger.h"
#include "scenes/Scene.h"

/// One importer a file format. Each returns the scene as the file says it (no default camera or light) and throws
/// InputError naming the file and the place in it; features that are not supported but not required become warnings.
/// The ledger is charged for the memory it takes.
namespace tessera::scenes {

/// glTF 2.0, .gltf and .glb
Scene importGltf(const std::filesystem::path& file, LoadLedger& ledger);
/// Wavefront OBJ with MTL
Scene importObj(const std::filesystem::path& file, LoadLedger& ledger);
/// Tessera's own .json, see docs/scene-format.md
Scene importSceneJson(const std::filesystem::path& file, LoadLedger& ledger);

/// Decodes a picture file, or bytes of one (`name` then serves error messages). PNG, JPEG, OpenEXR, Radiance HDR, TIFF,
/// WebP, BMP and GIF are told by their first bytes, whatever the name says; TGA, which has no signature, by the name's
/// extension .tga. No other format is read.
Image readImage(const std::filesystem::path& file, LoadLedger& ledger);
Image decodeImage(std::span<const std::byte> bytes, const std::string& name, LoadLedger& ledger);

} // namespace tessera::scenes
