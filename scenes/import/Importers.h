#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "scenes/LoadLedger.h"
#include "scenes/Scene.h"

/// One importer per file format. Each returns the scene of the file without a default camera or light, and charges the
/// ledger for its memory. Throws InputError naming the file and the position in it; unsupported features that are not
/// required become warnings.
namespace tessera::scenes {

/// glTF 2.0, .gltf and .glb
Scene importGltf(const std::filesystem::path& file, LoadLedger& ledger);
/// Only the image-based light of the scene that importGltf() reads. Throws InputError if there is none.
Environment importGltfEnvironment(const std::filesystem::path& file, LoadLedger& ledger,
                                  std::vector<std::string>& warnings);
/// Wavefront OBJ with MTL
Scene importObj(const std::filesystem::path& file, LoadLedger& ledger);
/// Tessera's own .json, see docs/scene-format.md
Scene importSceneJson(const std::filesystem::path& file, LoadLedger& ledger);

/// Metadata of an image file, for callers that show the image itself; the meaning of a texture is defined by the scene.
struct PictureTags {
    std::string software;      ///< that wrote it; empty if the decoder does not report it
    bool isLinear = false;     ///< values are linear: floating point, or declared linear
    int orientation = 1;       ///< TIFF's tag; 1 is upright
    bool isAssociated = false; ///< colours are multiplied by alpha
};
struct DecodedPicture {
    Image image;
    PictureTags tags;
};

/// Decodes an image file and turns it upright. The first bytes determine the format, regardless of the name; TGA, which
/// has no signature, is recognised by the extension .tga. Reads only the formats of pictureFormats() (PictureCodecs.h).
/// Repaired flaws become warnings of the ledger.
DecodedPicture readPicture(const std::filesystem::path& file, LoadLedger& ledger);
/// Decodes a texture from a file or from bytes (`name` is for messages). Ignores the orientation tag of Exif or TIFF.
/// Divides premultiplied colours, as in OpenEXR files, by alpha where it is above 0. Source: glTF 2.0, sections 3.8.2
/// and 3.9.4.
Image readImage(const std::filesystem::path& file, LoadLedger& ledger);
Image decodeImage(std::span<const std::byte> bytes, const std::string& name, LoadLedger& ledger);

} // namespace tessera::scenes
