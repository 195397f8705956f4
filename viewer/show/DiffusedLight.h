#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "viewer/session/Look.h"

namespace tessera::viewer {

/// Side of the irradiance atlases, in texels, of images that do not stay, while their irradiance changes.
inline constexpr int kPassingAtlasTexels = 128;

/// The first look that diffuses irradiance, if all that do so have the same irradiance; none if none does, or if they
/// differ.
std::optional<Look> sharedDiffusion(const scenes::Scene& scene, std::span<const Look> looks);

/// Number of tiles to light in one slice while idle: as many as keep the response to input fast.
class DiffusionPace {
public:
    std::size_t tiles() const { return tiles_; } ///< initially 1, to measure a slice's fixed cost
    /// Records the time of a slice of tiles() tiles, without compiling shaders.
    void took(double ms);

private:
    std::size_t tiles_ = 1;
    std::optional<double> leastMs_; ///< of any slice
};

/// Tracks what the renderer's diffused irradiance was computed for. Recomputing it for full atlases takes seconds, so
/// images that do not stay use small ones.
class DiffusedLight {
public:
    /// Whether images of these looks, drawn one after the other, need irradiance that is not kept. `edits` is
    /// OpenScene::pictureEdits().
    bool isAnew(const scenes::Scene& scene, std::span<const Look> looks, std::uint64_t edits) const;
    /// Records that they were drawn with full atlases. The renderer drops what `mostIdlePictures` images do not use.
    void drew(const scenes::Scene& scene, std::span<const Look> looks, std::uint64_t edits, int mostIdlePictures);
    /// Nothing useful is kept: small atlases will replace it, or the image may be aborted.
    void forget() { kept_.reset(); }

private:
    struct Kept {
        Look look;
        std::uint64_t edits = 0;
        int idlePictures = 0;
    };
    std::optional<Kept> kept_; ///< of the last look that diffused irradiance: the renderer keeps one
};

} // namespace tessera::viewer
