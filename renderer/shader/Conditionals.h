#pragma once
#include <cstddef>
#include <vector>

#include "renderer/shader/LineScanner.h"

namespace tessera::shader {

/// Follows #if ... #endif through a file, as far as includes need it: how deep a line stands, and whether it belongs to
/// the C++ part of a header that both languages share. Unbalanced directives are left for the driver to report.
class Conditionals {
public:
    void follow(const Directive& directive);
    std::size_t depth() const { return branches_.size(); }
    bool inCpp() const;

private:
    enum class Branch { Other, Cpp, Glsl }; ///< Cpp and Glsl: of a conditional on __cplusplus
    std::vector<Branch> branches_;
};

} // namespace tessera::shader
