#pragma once
#include <cstddef>

#include "scenes/Limits.h"
#include "shaders/shared/hook.h"

/// Loop sizes with which shaders visit all lights despite the iteration limit of Mesa's software rasterisers.
namespace tessera::frame {

/// Most iterations of all loops of a shader, nested ones included, summed over invocations that run together (up to
/// kMostLanesTogether). Beyond it every loop ends after its first iteration, without an error. Source:
/// LP_MAX_TGSI_LOOP_ITERATIONS in Mesa's gallivm/lp_bld_limits.h.
inline constexpr std::size_t kMostLoopIterations = 65535;
inline constexpr std::size_t kMostLanesTogether = 16;
/// Iterations reserved for loops other than those over lights: texture filters, the cells of a tile.
inline constexpr std::size_t kOtherLoopIterations = 2048;
/// Most iterations of the loops of a scene's hook.
inline constexpr std::size_t kMostHookIterations = HOOK_ITERATIONS_MOST;
static_assert(kMostHookIterations <= kMostLoopIterations - kOtherLoopIterations);

/// Most lights per round of lib/lighting/lighting.glsl's loop, which is unrolled by that number.
inline constexpr std::size_t kMostLightsPerRound = 8;

/// Most iterations for lighting a surface with so many lights per round. Bitmasks (zbin) take more than lists: an extra
/// round for the rest of each word of 32 lights, and steps over empty words, which lanes that run together may take one
/// after the other.
constexpr std::size_t loopIterations(std::size_t lights, std::size_t lightsPerRound) {
    const std::size_t words = (lights + 31) / 32;
    const std::size_t wordsAStep = lightsPerRound == 1 ? 1 : 2 * lightsPerRound; // lib/light/light_cursor.glsl
    return words * (32 / lightsPerRound + 2) + kMostLanesTogether * (words / wordsAStep + 1);
}

/// LIGHTS_PER_ROUND of a frame: the least power of two with which every light is visited.
constexpr std::size_t lightsPerRound(std::size_t lights) {
    std::size_t perRound = 1;
    while (perRound < kMostLightsPerRound &&
           loopIterations(lights, perRound) > kMostLoopIterations - kOtherLoopIterations)
        perRound *= 2;
    return perRound;
}
static_assert(loopIterations(scenes::kMostLights, lightsPerRound(scenes::kMostLights)) <=
              kMostLoopIterations - kOtherLoopIterations);

/// Steps of a traversal of the caster tree in a detailed scene (lib/shadow/caster_walk.glsl).
inline constexpr std::size_t kCasterWalkSteps = 150;

/// CASTER_STEPS, the traversal steps that an iteration unrolls, for so many shadow rays per pixel. Unrolling four costs
/// 1.2 to 1.7 times as much as one.
constexpr std::size_t casterSteps(std::size_t rays) {
    return rays <= 256 ? 1 : rays <= 1024 ? 4 : 16;
}

/// Iterations of lib/shadow: a ray with its traversal, the texels of pcf, and the searched and averaged texels of pcss.
constexpr std::size_t rayIterations(std::size_t steps) {
    return 1 + (kCasterWalkSteps + steps - 1) / steps;
}
constexpr std::size_t pcfIterations(std::size_t widthTexels) {
    return (widthTexels + 1) * (widthTexels + 2);
}
constexpr std::size_t pcssIterations(std::size_t samples) {
    return 2 * samples;
}

} // namespace tessera::frame
