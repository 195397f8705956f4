#pragma once
#include <cstdint>
#include <optional>

#include "engine/Renderer.h"
#include "validation/culling/VisitedLights.h"

/// The judge of light culling: which lights each pixel needs, found by trying all of them, and which it visited. In
/// double precision, from the plain scene and the depth buffer, by tests of its own; with the culling code it shares
/// only the layout of the lists (shaders/shared/light_lists.h), which it reads as the GPU had them.
namespace tessera::validation {

/// Counts over a frame's surfaces of one layer. A light is needed at a pixel that it reaches: closer than its range,
/// inside its outer cone, and before its surface where that is flat and shines from one side, with colour and
/// intensity. Lights that reach everywhere are needed at every covered pixel; they are counted apart, since there is
/// nothing to cull. A pair is missed if it was needed and not visited; where lists leave out lights behind surfaces, if
/// it was needed and lit.
struct LightOracleFigures {
    std::uint64_t covered = 0;        ///< pixels that show a surface
    std::uint64_t needed = 0;         ///< pairs of a covered pixel and a light that reaches it
    std::uint64_t neededLit = 0;      ///< those whose light lies in front of the surface, n.l > 0
    std::uint64_t evaluated = 0;      ///< pairs that the frame's pixels visited
    std::uint64_t everywhere = 0;     ///< pairs of a covered pixel and a light that reaches everywhere, all visited
    std::uint64_t everywhereLit = 0;  ///< those whose light lies in front of the surface, to which it shines
    std::uint64_t falseNegatives = 0; ///< pairs missed, see above; must be 0
    std::uint64_t evaluatedP99 = 0, evaluatedMax = 0; ///< lights visited by a covered pixel, those everywhere included
    std::size_t entries = 0, cells = 0, listBytes = 0;
    CellFigures occupied; ///< the cells that a surface lies in, and the lights that each holds
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

/// Pictures that the oracle looks at; rows from the bottom, as OpenGL has them.
struct OracleInput {
    const scenes::Scene& scene;
    frame::FrameSettings settings;
    const engine::DrawnLists& drawn;
    std::span<const float> depth; ///< of the surfaces to judge, reverse-Z, one per pixel; 0: no surface
    /// RGBA a pixel; empty: neededLit is not counted, and lists must hold the lights behind surfaces as well.
    std::span<const float> normalWS;
    SurfaceLayer layer = SurfaceLayer::Opaque;     ///< that the surfaces belong to
    std::span<const std::uint8_t> takesLight = {}; ///< 0 a pixel whose surface is unlit; empty: all are lit
};
LightOracleFigures judgeLights(const OracleInput& input); ///< throws std::invalid_argument without normals needed

/// Draws the frame and judges its opaque surfaces. Works on all cores; a million pixels and a thousand lights take some
/// seconds.
LightOracleFigures judgeLights(engine::Renderer& renderer, engine::Technique technique,
                               const frame::FrameSettings& settings);

} // namespace tessera::validation
