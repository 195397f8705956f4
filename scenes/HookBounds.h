#pragma once
#include <cstddef>
#include <span>

#include "scenes/HookTokens.h"

/// Bounds on what a driver makes of a hook. Measured with Mesa 22.3, which crashes on sums of 20,000 terms and on
/// arrays of 65,536 numbers, and takes 16 s for 200,000 words and signs of functions and 9 s for 1,000 branches.
namespace tessera::scenes {

inline constexpr std::size_t kMostHookOperators = 4000; ///< that stand in each other's operands
inline constexpr std::size_t kMostHookNesting = 256;    ///< of brackets, blocks and statements
inline constexpr std::size_t kMostStructNesting = 16;
/// With a function's body in the place of each of its calls, which is what drivers make of them:
inline constexpr std::size_t kMostHookSize = 50'000;       ///< words and signs
inline constexpr std::size_t kMostHookBranches = 500;      ///< if, case, break, continue and loops
inline constexpr std::size_t kMostHookArrays = 4096;       ///< numbers in arrays
inline constexpr std::size_t kMostHookIterations = 60'000; ///< per loop whose count is a constant of the text

/// Throws HookFault where the tokens exceed a bound. What is no GLSL is left to the driver.
void requireBounds(std::span<const HookToken> tokens);

} // namespace tessera::scenes
