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
/// The image-based light of the scene that importGltf() reads, alone. Throws InputError where there is none.
Environment importGltfEnvironment(const std::filesystem::path& file, LoadLedger& ledger,
                                  std::vector<std::string>& warnings);
/// Wavefront OBJ with MTL
Scene importObj(const std::filesystem::path& file, LoadLedger& ledger);
/// Tessera's own .json, see docs/scene-format.md
Scene importSceneJson(const std::filesystem::path& file, LoadLedger& ledger);

/// A picture file's data besides its texels, for callers that show the picture itself; for a texture the scene says
/// how it is meant.
struct PictureTags {
    std::string software;      ///< that wrote it; empty where the format's decoder does not tell
    bool isLinear = false;     ///< its numbers are light itself: floating point, or declared linear
    int orientation = 1;       ///< TIFF's tag; 1 is upright
    bool isAssociated = false; ///< colours are multiplied by alpha
};
struct DecodedPicture {
    Image image;
    PictureTags tags;
};

/// Decodes a picture file, or bytes of one (`name` then serves error messages), and turns it upright. Which format it
/// is in follows from its first bytes, regardless of the name; TGA, which has no signature, is recognised by the
/// extension .tga. No format is read but those of pictureFormats() (PictureCodecs.h). Flaws that are repaired become
/// warnings of the ledger.
DecodedPicture readPicture(const std::filesystem::path& file, LoadLedger& ledger);
/// The same as textures: not turned by Exif's or TIFF's tag, and colours that are multiplied by alpha, as in OpenEXR
/// files, are divided by it where it is above 0. Source: glTF 2.0, sections 3.8.2 and 3.9.4.
Image readImage(const std::filesystem::path& file, LoadLedger& ledger);
Image decodeImage(std::span<const std::byte> bytes, const std::string& name, LoadLedger& ledger);

} // namespace tessera::scenes
