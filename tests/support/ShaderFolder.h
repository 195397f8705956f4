#pragma once
#include <cstdlib>
#include <filesystem>

namespace tessera::test {

/// The product's shader folder: the one that TESSERA_SHADERS names, as for the program (`./test --mutants` puts faults
/// there), else that of the sources.
inline std::filesystem::path shaderFolder() {
    const char* named = std::getenv("TESSERA_SHADERS");
    return named ? std::filesystem::path(named) : std::filesystem::path(TESSERA_SOURCE_DIR) / "shaders";
}

} // namespace tessera::test
