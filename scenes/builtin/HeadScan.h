#pragma once
#include <filesystem>
#include <optional>

#include <glm/glm.hpp>

#include "scenes/LoadLedger.h"
#include "scenes/Scene.h"

namespace tessera::scenes::builtin {

/// The folder LeePerrySmith below the one the environment variable TESSERA_ASSETS names, if it holds head.obj.
std::optional<std::filesystem::path> headScanFolder();

/// Colours of the scanned head: none for its albedo and specular maps, or one linear colour.
using ScanPaint = std::optional<glm::vec3>;

/// Adds the scanned head (Infinite Realities, CC BY 3.0) with its object-space normal map, painted, standing on
/// `bottomY` and `heightMetres` high. Returns its material. Throws InputError naming the file that is missing or
/// broken.
int addHeadScan(Scene& scene, const std::filesystem::path& folder, double bottomY, double heightMetres,
                const ScanPaint& paint, LoadLedger& ledger);

} // namespace tessera::scenes::builtin
