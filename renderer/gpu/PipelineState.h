#pragma once
#include <cstdint>

namespace tessera::gpu {

/// Depth is reversed: 1 at the near plane, 0 infinitely far; "Greater" passes fragments nearer than the stored depth.
enum class DepthTest : std::uint8_t { Off, Greater, GreaterEqual, Equal, Less, LessEqual, Always };
enum class CullFace : std::uint8_t { None, Back, Front };
enum class Blend : std::uint8_t {
    None,
    Additive,           ///< target + source, alpha too
    AdditiveCovering,   ///< target + source; the target's alpha becomes the coverage
    AlphaPremultiplied, ///< source + (1 - alpha) target
    Max,                ///< the larger of target and source, by channel
    AlphaStraight,      ///< alpha source + (1 - alpha) target; the target's alpha becomes the coverage
    Transmitting        ///< source + the shader's second output x target, by channel; alpha as AlphaStraight
};

/// The fixed-function state of a draw, set as a whole so that nothing leaks from one pass into the next.
struct PipelineState {
    DepthTest depthTest = DepthTest::Off;
    bool depthWrite = false; ///< needs a depth test other than Off, as in GL
    CullFace cullFace = CullFace::None;
    bool frontFaceClockwise = false; ///< mirrored nodes: an odd number of negative scales
    Blend blend = Blend::None;       ///< applies to every floating-point or normalised colour attachment
    bool colorWrite = true;
    bool alphaToCoverage = false;
    /// Disables clipping at the near and far plane, e.g. for shadow casters in front of a light's near plane.
    bool depthClamp = false;
    bool bothSides = false;        ///< SceneGpu disables culling of single-sided surfaces too
    bool farSides = false;         ///< SceneGpu draws only back faces of transmissive surfaces with volume
    bool farSidesOfClosed = false; ///< farSides of closed meshes only
    float slopeBias = 0.0f;        ///< factor of the maximum depth slope per pixel, added to a triangle's depth
    float mostSlopeBias = 0.0f;    ///< limit of the added depth, same sign, if the driver supports it; 0: unlimited
    bool operator==(const PipelineState&) const = default;
};

} // namespace tessera::gpu
