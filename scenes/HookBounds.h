#pragma once
#include <cstddef>
#include <span>

#include "scenes/HookTokens.h"

/// Bounds on what a driver makes of a hook, so that Mesa 22.3 compiles one in seconds and 200 MB: it crashes on sums of
/// 20,000 terms and on arrays of 65,536 numbers, and takes seconds for 1,000 branches, 50 loops or 20 inverse(dmat4).
namespace tessera::scenes {

inline constexpr std::size_t kMostHookOperators = 1000; ///< of a statement
inline constexpr std::size_t kMostHookNesting = 256;    ///< of brackets and blocks
inline constexpr std::size_t kMostStructNesting = 16;
/// With a function's body in the place of each of its calls, which is what drivers make of them:
inline constexpr std::size_t kMostHookSize = 50'000;       ///< words and signs
inline constexpr std::size_t kMostHookOperations = 20'000; ///< operators and functions, for each number that they take
inline constexpr std::size_t kMostHookBranches = 200;      ///< if, ?:, &&, ||, case, break and continue; a loop is 20
inline constexpr std::size_t kMostHookArrays = 1024;       ///< numbers in arrays
inline constexpr std::size_t kMostComparedNumbers = 16;    ///< of a value in a statement with == or !=

/// Throws HookFault where the tokens exceed a bound. What is no GLSL is left to the driver.
void requireBounds(std::span<const HookToken> tokens);

} // namespace tessera::scenes
