#pragma once
#include <cstddef>
#include <span>

#include "scenes/HookTokens.h"

/// Bounds on a hook's compiled code, so that Mesa 22.3 compiles it in seconds and 200 MB: it crashes on sums of 20,000
/// terms and on arrays of 65,536 numbers, and takes seconds for 1,000 branches, 50 loops or 20 inverse(dmat4).
namespace tessera::scenes {

inline constexpr std::size_t kMostHookOperators = 1000; ///< per statement
inline constexpr std::size_t kMostHookNesting = 256;    ///< depth of nested brackets, blocks and calls
inline constexpr std::size_t kMostStructNesting = 16;
/// Counted with all calls inlined, as drivers do:
inline constexpr std::size_t kMostHookSize = 50'000;       ///< words and signs
inline constexpr std::size_t kMostHookOperations = 20'000; ///< operators and functions, times their components
inline constexpr std::size_t kMostHookBranches = 200;      ///< if, ?:, &&, ||, case, break and continue; a loop is 20
inline constexpr std::size_t kMostHookArrays = 1024;       ///< numbers in arrays
inline constexpr std::size_t kMostComparedNumbers = 16;    ///< components of a value in a statement with == or !=

/// Throws HookFault if the tokens exceed a bound. Invalid GLSL is left to the driver.
void requireBounds(std::span<const HookToken> tokens);

} // namespace tessera::scenes
