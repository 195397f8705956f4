#pragma once
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/LoadLedger.h"
#include "scenes/import/Repairs.h"

namespace tessera::scenes::obj {

/// A picture that a statement names, and the statement's options.
struct MtlPicture {
    const char* keyword = ""; ///< of the statement, in MTL's spelling
    int line = 0;
    std::string name;       ///< as written; relative to the library's folder
    glm::vec2 offset{0.0f}; ///< -o, v up
    glm::vec2 scale{1.0f};  ///< -s, v up
    bool clamp = false;
    float bumpMultiplier = 1.0f; ///< -bm
};

/// A flaw of a material's statements, noted where the material is drawn.
struct MtlFlaw {
    int line;
    std::string text;
    std::string_view repair;
};

/// A material of an MTL file, or one that no file defines: then nothing is stated. Unset values are not 0.
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
    std::optional<float> illumination;          ///< illum, the number of a model
    std::optional<MtlPicture> diffusePicture;   ///< map_Kd
    std::optional<MtlPicture> specularPicture;  ///< map_Ks
    std::optional<MtlPicture> emissionPicture;  ///< map_Ke
    std::optional<MtlPicture> opacityPicture;   ///< map_d
    std::optional<MtlPicture> roughnessPicture; ///< map_Pr
    std::optional<MtlPicture> metalnessPicture; ///< map_Pm
    std::optional<MtlPicture> normalPicture;    ///< norm
    std::optional<MtlPicture> bumpPicture;      ///< map_bump or bump
};

/// The materials of the texts behind usemtl, `names`, in their order, looked up in the libraries that the texts behind
/// mtllib name beside `objFile`; the first definition counts. A missing library or material is noted; the material then
/// states nothing. Names may end in comments, unless a name with '#' is defined.
std::vector<MtlMaterial> findMaterials(const std::vector<std::string>& names, const std::vector<std::string>& libraries,
                                       const std::filesystem::path& objFile, Repairs& repairs, LoadLedger& ledger);

} // namespace tessera::scenes::obj
