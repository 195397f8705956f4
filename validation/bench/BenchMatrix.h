#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "engine/Techniques.h"
#include "renderer/frame/FrameSettings.h"
#include "scenes/LoadLedger.h"

namespace tessera::validation {

/// What `tessera bench` runs through: the Cartesian product of these lists. An empty list stands for one entry, what
/// the settings of the command line say.
struct BenchMatrix {
    /// A method, or a setting of one (MethodKey.h): its key and the texts of its values.
    struct SettingValues {
        std::string_view key;
        std::vector<std::string> texts;
    };
    std::vector<engine::Technique> techniques; ///< empty: all
    std::vector<culling::Method> methods;      ///< empty: every method that the technique takes
    bool preferredMethodsOnly = false;         ///< without methods: the one alone that the technique prefers
    std::vector<int> tilesPixels;
    std::vector<frame::LayoutInfo> layouts;
    std::vector<frame::LightingStage> stages;
    std::vector<int> lights;
    std::vector<glm::ivec2> sizesPixels;
    std::vector<double> rangeTolerances;
    std::vector<SettingValues> settings; ///< of each key that varies; not empty
};

/// Points that a matrix may ask for at most in a scene: more would take weeks, and memory without a bound.
inline constexpr std::size_t kMostMatrixPoints = 100'000;
/// Combinations of values of settings among them, which are compared with each other.
inline constexpr std::size_t kMostMatrixVariants = 1'000;

/// "technique, culling, ...": all keys.
std::string matrixKeys();

/// Reads the matrix of a JSON object of arrays with these keys. `source` names it in messages. Throws InputError that
/// names the line and column of broken syntax, a key that is given twice, or the key or value and the nearest valid
/// ones, or the number of points or variants where it is too large. The ledger is charged for it.
BenchMatrix parseMatrix(std::string_view json, const std::string& source, scenes::LoadLedger& ledger);

} // namespace tessera::validation
