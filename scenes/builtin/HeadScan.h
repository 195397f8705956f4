#pragma once
#include <filesystem>
#include <optional>

#include "scenes/LoadLedger.h"
#include "scenes/Scene.h"

namespace tessera::scenes::builtin {

/// The folder LeePerrySmith below the one the environment variable TESSERA_ASSETS names, if it holds head.obj.
std::optional<std::filesystem::path> headScanFolder();

/// Adds the scanned head (Infinite Realities, CC BY 3.0) with its albedo, specular and object-space normal map,
/// standing on `bottomY` and `heightMetres` high. Throws InputError naming the file that is missing or broken.
int addHeadScan(Scene& scene, const std::filesystem::path& folder, double bottomY, double heightMetres,
                LoadLedger& ledger);

} // namespace tessera::scenes::builtin
