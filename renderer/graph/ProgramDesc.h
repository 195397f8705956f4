#pragma once
#include <compare>
#include <string>
#include <utility>
#include <vector>

namespace tessera::graph {

using Defines = std::vector<std::pair<std::string, std::string>>; ///< name, value; an empty value is fine

/// One variant of a program: its entry files below shaders/ (unused stages empty) and its defines.
struct ProgramDesc {
    std::string name; ///< for messages and labels
    std::string vertex;
    std::string fragment;
    std::string compute;
    Defines defines;
    std::string geometry = {}; ///< between vertex and fragment
    auto operator<=>(const ProgramDesc&) const = default;

    /// Equal for equal variants, whatever the order of the defines: "lighting|v|f|||A=1;B=2".
    std::string key() const;
};

} // namespace tessera::graph
