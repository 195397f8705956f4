#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "engine/Techniques.h"
#include "renderer/frame/FrameSettings.h"
#include "scenes/LoadLedger.h"

namespace tessera::validation {

/// The points of `tessera bench`: the Cartesian product of these lists. An empty list stands for one entry, the value
/// from the command line.
struct BenchMatrix {
    /// A method, or a setting of one (MethodKey.h): its key and the texts of its values.
    struct SettingValues {
        std::string_view key;
        std::vector<std::string> texts;
    };
    std::vector<engine::Technique> techniques; ///< empty: all
    std::vector<culling::Method> methods;      ///< empty: every method that the technique supports
    bool preferredMethodsOnly = false;         ///< if methods is empty: only the technique's preferred one
    std::vector<int> tilesPixels;
    std::vector<frame::LayoutInfo> layouts;
    std::vector<frame::LightingStage> stages;
    std::vector<int> lights;
    std::vector<glm::ivec2> sizesPixels;
    std::vector<double> rangeTolerances;
    std::vector<SettingValues> settings; ///< one entry per varied key, each with at least one text
};

/// Maximum number of points per scene: more would take weeks, and unbounded memory.
inline constexpr std::size_t kMostMatrixPoints = 100'000;
/// Maximum number of combinations of setting values, which are compared pairwise.
inline constexpr std::size_t kMostMatrixVariants = 1'000;

/// "technique, culling, ...": all keys.
std::string matrixKeys();

/// Parses a JSON object of arrays with these keys. `source` names it in messages. Throws InputError, which names the
/// line and column of a syntax error, a duplicate key, the invalid key or value with the nearest valid ones, or the
/// number of points or variants if too large. Charges its memory to the ledger.
BenchMatrix parseMatrix(std::string_view json, const std::string& source, scenes::LoadLedger& ledger);

} // namespace tessera::validation
