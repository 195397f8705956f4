#pragma once
#include <set>

#include "scenes/import/Repairs.h"

namespace tessera::scenes::obj {

/// An image that a statement names, and the statement's options.
struct MtlPicture {
    const char* keyword = ""; ///< of the statement, in MTL's spelling
    int line = 0;
    std::string name;       ///< as written; relative to the library's folder
    glm::vec2 offset{0.0f}; ///< -o, v up
    glm::vec2 scale{1.0f};  ///< -s, v up
    bool clamp = false;
    float bumpMultiplier = 1.0f; ///< -bm
};

/// A flaw of a material's statements, reported if the material is drawn.
struct MtlFlaw {
    int line;
    std::string text;
    std::string_view repair;
};

/// A material of an MTL file. If no file defines it, all values are unset, which is not the same as 0.
struct MtlMaterial {
    std::string name;
    std::string file; ///< the library that defines it; empty: none does
    int line = 0;
    std::vector<MtlFlaw> flaws;
    std::set<std::string> unsupported; ///< statements and options that are left out

    std::optional<glm::vec3> diffuse;           ///< Kd
    std::optional<glm::vec3> specular;          ///< Ks
    std::optional<glm::vec3> emission;          ///< Ke
    std::optional<float> exponent;              ///< Ns
    std::optional<float> ior;                   ///< Ni
    std::optional<float> opacity;               ///< d
    std::optional<float> transparency;          ///< Tr, which d overrides
    std::optional<float> perceptualRoughness;   ///< Pr
    std::optional<float> metalness;             ///< Pm
    std::optional<float> illumination;          ///< illum, the number of an illumination model
    std::optional<MtlPicture> diffusePicture;   ///< map_Kd
    std::optional<MtlPicture> specularPicture;  ///< map_Ks
    std::optional<MtlPicture> emissionPicture;  ///< map_Ke
    std::optional<MtlPicture> opacityPicture;   ///< map_d
    std::optional<MtlPicture> roughnessPicture; ///< map_Pr
    std::optional<MtlPicture> metalnessPicture; ///< map_Pm
    std::optional<MtlPicture> normalPicture;    ///< norm
    std::optional<MtlPicture> bumpPicture;      ///< map_bump or bump
};

/// Looks up the materials `names` (the texts after usemtl), in order, in `libraries` (the texts after mtllib) relative
/// to `objFile`; the first definition counts. A missing library or material is noted; all values of the material are
/// then unset. Names may end in comments, unless a name with '#' is defined.
std::vector<MtlMaterial> findMaterials(const std::vector<std::string>& names, const std::vector<std::string>& libraries,
                                       const std::filesystem::path& objFile, Repairs& repairs, LoadLedger& ledger);

/// Adds materials of MTL files to a scene, with the images they name; an image used twice is decoded once. Every
/// material becomes metallic_roughness, so that those of one file keep their relative brightness (`lambert` has no
/// 1/pi), except for illum 0, MTL's constant colour, which becomes single_color. docs/scene-format.md has the table.
class MaterialConverter {
public:
    MaterialConverter(Scene& scene, Repairs& repairs, LoadLedger& ledger)
        : scene_(scene), repairs_(repairs), ledger_(ledger) {}

    /// Adds a material and returns its index. Null or undefined: grey, roughness 0.5, not metallic. Unlit, for points
    /// and lines: base colour plus emission. Notes the material's flaws. An unreadable image becomes a stand-in, with a
    /// warning naming MTL file, material and image; a strict load throws InputError with the same text.
    int add(const MtlMaterial* mtl, bool isUnlit);

    /// Warns of unsupported statements of all materials.
    void finish();

private:
    Material converted(const MtlMaterial& mtl);
    /// Has no image if the file cannot be read and the slot has no stand-in.
    TextureUse textureUse(const MtlMaterial& mtl, const MtlPicture& picture, TextureSlot slot);
    /// The same without stand-ins.
    TextureUse pictureUse(const MtlMaterial& mtl, const MtlPicture& picture);
    int standIn(const MtlMaterial& mtl);
    int image(const MtlMaterial& mtl, const MtlPicture& picture);
    void setOpacity(const MtlMaterial& mtl, Material& material);
    void setMetallicRoughness(const MtlMaterial& mtl, Material& material);
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
    std::map<Channels, int> packed_; ///< packed images
};

} // namespace tessera::scenes::obj
