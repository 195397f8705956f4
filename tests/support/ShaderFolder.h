#pragma once
#include <cstdlib>
#include <filesystem>

namespace tessera::test {

/// Where the product's shaders lie: the folder that TESSERA_SHADERS names, as for the program (`./test --mutants` puts
/// faults there), else the source folder's.
inline std::filesystem::path shaderFolder() {
    const char* named = std::getenv("TESSERA_SHADERS");
    return named ? std::filesystem::path(named) : std::filesystem::path(TESSERA_SOURCE_DIR) / "shaders";
}

} // namespace tessera::test
