#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/LoadLedger.h"

namespace tessera::scenes::obj {

/// An OBJ file after every statement has been checked, rewritten so that tinyobjloader reads it as it is meant:
/// that parser takes a word that is no number for 0, drops faces whose vertices come later in the file, cuts concave
/// polygons wrongly and names at a space, and knows no continued lines. All attributes stand first, indices are
/// absolute, polygons are triangles, and the material in use is called by its number in `materials`.
struct CheckedText {
    std::string text;
    std::vector<std::string> libraries; ///< what mtllib says, as written
    std::vector<std::string> materials; ///< the names usemtl uses; `text` says "usemtl 0", "usemtl 1" ...
    std::vector<std::string> warnings;
};

/// Throws InputError "file:line: ..." for a number that is none or not finite, a face's index that is out of range, and
/// "file: ..." when there is no face. Charges the ledger for all that is made of the text.
CheckedText checkText(std::string_view text, const std::filesystem::path& file, LoadLedger& ledger);

} // namespace tessera::scenes::obj
