#pragma once
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scenes/LoadLedger.h"
#include "scenes/Scene.h"
#include "scenes/import/MtlLibrary.h"

namespace tessera::scenes::obj {

/// Adds materials of MTL files to a scene, with the pictures they name; a picture used twice is decoded once.
///
/// Every material becomes metallic_roughness, so that those of one file keep their relative brightness (`lambert` has
/// no 1/pi), except for illum 0, MTL's constant colour, which becomes single_color.
///   base colour   Kd x map_Kd, white where not stated
///   opacity       d (or 1 - Tr) x map_d; alpha mode Mask with map_d, else Blend where d < 1
///   roughness     Pr x map_Pr, else from Ns (Blinn-Phong exponent to GGX alpha), else 0.5
///   metalness     Pm x map_Pm, else 0
///   specular      Ks x map_Ks tints the dielectric reflectance; illum 1 has none
///   ior           Ni where it exceeds 1 (exporters write 1 for "not set"), else 1.5
///   emission      Ke x map_Ke
///   normals       norm, else map_bump or bump taken for a tangent-space normal map, with a warning
class MaterialConverter {
public:
    MaterialConverter(Scene& scene, Repairs& repairs, LoadLedger& ledger)
        : scene_(scene), repairs_(repairs), ledger_(ledger) {}

    /// The index of the new material; null or undefined: grey, half rough, not metallic. Unlit, for points and lines:
    /// base colour plus emission. Notes the material's flaws. For a picture that cannot be read a stand-in is drawn,
    /// with a warning naming MTL file, material and picture; a strict load throws InputError with the same text.
    int add(const MtlMaterial* mtl, bool isUnlit);

    /// Warns of the statements of all materials that are not supported.
    void finish();

private:
    Material converted(const MtlMaterial& mtl);
    /// Of no image where the picture cannot be read and nothing can stand in for it.
    TextureUse textureUse(const MtlMaterial& mtl, const MtlPicture& picture, TextureSlot slot);
    /// The same without regard to what a stand-in can be.
    TextureUse pictureUse(const MtlMaterial& mtl, const MtlPicture& picture);
    int standIn(const MtlMaterial& mtl);
    int image(const MtlMaterial& mtl, const MtlPicture& picture);
    void setOpacity(const MtlMaterial& mtl, Material& material);
    void setMetallicRoughness(const MtlMaterial& mtl, Material& material);
    void setSpecular(const MtlMaterial& mtl, Material& material);
    void setNormalMap(const MtlMaterial& mtl, Material& material);
    void warn(const MtlMaterial& mtl, const std::string& what);
    void warnOfNothingShown(const MtlMaterial& mtl);
    /// Images, which may be kNone, and their channels.
    using Channels = std::array<std::pair<int, int>, 4>;
    int packed(const MtlMaterial& mtl, const std::string& name, const Channels& channels);

    Scene& scene_;
    Repairs& repairs_;
    LoadLedger& ledger_;
    std::map<std::string, std::set<std::string>> unsupported_; ///< statements and options by library
    std::map<std::string, int> imageOfFile_; ///< by folder and name, and by path; kNone: it cannot be read
    int standIn_ = kNone;
    std::map<Channels, int> packed_; ///< images made of others
};

} // namespace tessera::scenes::obj
