#pragma once
#include <cstddef>
#include <vector>

#include "renderer/shader/LineScanner.h"

namespace tessera::shader {

/// Tracks #if ... #endif through a file for the expansion of includes: the nesting depth of a line, and whether it
/// belongs to the C++ part of a header shared by both languages. The driver reports unbalanced directives.
class Conditionals {
public:
    void follow(const Directive& directive);
    std::size_t depth() const { return branches_.size(); }
    bool inCpp() const;

private:
    enum class Branch { Other, Cpp, Glsl }; ///< Cpp and Glsl: branches of a conditional on __cplusplus
    std::vector<Branch> branches_;
};

} // namespace tessera::shader
