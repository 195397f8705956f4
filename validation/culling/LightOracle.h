#pragma once
#include <cstdint>
#include <optional>

#include "engine/Renderer.h"
#include "validation/culling/VisitedLights.h"

/// Validates light culling: compares the lights that each pixel needs, found by testing all of them, with those it
/// visited. Works in double precision from the plain scene and the depth buffer. Shares only the layout of the lists
/// (shaders/shared/light_lists.h) with the culling code, and reads them back from the GPU.
namespace tessera::validation {

/// Counts over a frame's surfaces of one layer. A light is needed at a pixel that it reaches: within its range and
/// outer cone, before its surface if that is flat and one-sided, with colour x intensity above 0. Lights that reach
/// everywhere are needed at every covered pixel and counted separately, since they cannot be culled. A needed pair is
/// missed if it was not visited; where lists leave out lights behind surfaces, only if the light is in front.
struct LightOracleFigures {
    std::uint64_t covered = 0;        ///< pixels that show a surface
    std::uint64_t needed = 0;         ///< pairs of a covered pixel and a light that reaches it
    std::uint64_t neededLit = 0;      ///< those whose light lies in front of the surface, n.l > 0
    std::uint64_t evaluated = 0;      ///< pairs that the frame's pixels visited
    std::uint64_t everywhere = 0;     ///< pairs of a covered pixel and a light that reaches everywhere, all visited
    std::uint64_t everywhereLit = 0;  ///< those whose light is in front of the surface and shines on it
    std::uint64_t falseNegatives = 0; ///< pairs missed, see above; must be 0
    std::uint64_t evaluatedP99 = 0, evaluatedMax = 0; ///< visited lights per covered pixel, `everywhere` included
    std::size_t entries = 0, cells = 0, listBytes = 0;
    CellFigures occupied; ///< the cells that contain a surface, and the lights of each
    struct Pair {
        int x = 0, y = 0; ///< pixel, from the top left
        int light = 0;    ///< index into Scene::lights
    };
    std::optional<Pair> firstMissing;

    /// evaluated / needed; none where nothing is needed.
    std::optional<double> tightness() const;
    /// evaluated / neededLit.
    std::optional<double> litTightness() const;
    double perPixel(std::uint64_t pairs) const { return covered == 0 ? 0.0 : double(pairs) / double(covered); }
};

/// Inputs of the oracle; image rows from the bottom, as in OpenGL.
struct OracleInput {
    const scenes::Scene& scene;
    frame::FrameSettings settings;
    const engine::DrawnLists& drawn;
    std::span<const float> depth; ///< of the surfaces to judge, reverse-Z, one per pixel; 0: no surface
    /// RGBA per pixel. Empty: neededLit is not counted, and lists must hold the lights behind surfaces as well.
    std::span<const float> normalWS;
    SurfaceLayer layer = SurfaceLayer::Opaque; ///< of the surfaces
    std::span<const std::uint8_t> isLit = {};  ///< per pixel, 0: its surface is unlit; empty: all are lit
};
LightOracleFigures judgeLights(const OracleInput& input); ///< throws std::invalid_argument without required normals

/// Draws the frame and validates its opaque surfaces on all cores; a million pixels and a thousand lights take some
/// seconds.
LightOracleFigures judgeLights(engine::Renderer& renderer, engine::Technique technique,
                               const frame::FrameSettings& settings);

} // namespace tessera::validation
