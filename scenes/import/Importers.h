#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "scenes/Scene.h"

/// One importer a file format. Each returns the scene as the file says it (no default camera or light) and throws
/// InputError naming the file and the place in it; features that are not supported but not required become warnings.
namespace tessera::scenes {

Scene importGltf(const std::filesystem::path& file);      ///< glTF 2.0, .gltf and .glb
Scene importObj(const std::filesystem::path& file);       ///< Wavefront OBJ with MTL
Scene importSceneJson(const std::filesystem::path& file); ///< Tessera's own .json, see docs/scene-format.md

/// Decodes a picture file, or bytes of one (`name` then serves error messages and the format's extension may be empty).
Image readImage(const std::filesystem::path& file);
Image decodeImage(std::span<const std::byte> bytes, const std::string& name);

} // namespace tessera::scenes
