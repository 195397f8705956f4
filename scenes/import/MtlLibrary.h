#pragma once
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <tiny_obj_loader.h>

#include "scenes/LoadLedger.h"

namespace tessera::scenes::obj {

/// A material of an MTL file, or one that no file defines (then nothing is stated).
struct MtlMaterial {
    std::string name;
    std::filesystem::path file;   ///< that defines it; pictures are named relative to its folder. Empty: none does
    std::set<std::string> stated; ///< keywords the file gives, in MTL's spelling: an absent value is not 0
    tinyobj::material_t values{};

    bool states(const char* keyword) const { return stated.contains(keyword); }
};

/// Reads one MTL file through tinyobjloader, in the file's order. Its statements are checked and rewritten first: that
/// parser takes a word that is no number for 0 and reads past a texture option with fewer than three numbers.
/// Throws InputError "file:line: ..."; what is not supported is added to `warnings`.
std::vector<MtlMaterial> readMtl(const std::filesystem::path& file, std::vector<std::string>& warnings,
                                 LoadLedger& ledger);

/// The materials called `names`, looked up in the libraries that `libraries` (texts of mtllib statements) name beside
/// `objFile`; the first definition counts. A missing library or an undefined material is a warning; the material then
/// states nothing.
std::vector<MtlMaterial> findMaterials(const std::vector<std::string>& names, const std::vector<std::string>& libraries,
                                       const std::filesystem::path& objFile, std::vector<std::string>& warnings,
                                       LoadLedger& ledger);

} // namespace tessera::scenes::obj
