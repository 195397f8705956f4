#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/LoadLedger.h"

namespace tessera::scenes::obj {

/// A picture that a statement names, and the statement's options.
struct MtlPicture {
    const char* keyword = ""; ///< of the statement, in MTL's spelling
    std::string name;         ///< as written; relative to the library's folder
    glm::vec2 offset{0.0f};   ///< -o, v up
    glm::vec2 scale{1.0f};    ///< -s, v up
    bool clamp = false;
    float bumpMultiplier = 1.0f; ///< -bm
};

/// A material of an MTL file, or one that no file defines: then nothing is stated. What is not stated is not 0.
struct MtlMaterial {
    std::string name;
    std::string file; ///< the library that defines it; empty: none does

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

/// The materials called `names`, all different, looked up in the libraries that `libraries` (texts of mtllib
/// statements) name beside `objFile`; the first definition counts. A missing library or an undefined material is a
/// warning; the material then states nothing. What is not supported is a warning too; a statement that is wrong throws
/// InputError "file:line: ...".
std::vector<MtlMaterial> findMaterials(const std::vector<std::string>& names, const std::vector<std::string>& libraries,
                                       const std::filesystem::path& objFile, std::vector<std::string>& warnings,
                                       LoadLedger& ledger);

} // namespace tessera::scenes::obj
