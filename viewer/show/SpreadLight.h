#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "viewer/session/Look.h"

namespace tessera::viewer {

/// Side of the atlases, in texels, of pictures that pass while the light they spread over surfaces changes.
inline constexpr int kPassingAtlasTexels = 128;

/// The first of the looks that spreads light over surfaces, where the light is the same in all that do; none where none
/// does, or where each needs its own.
std::optional<Look> sharedSpread(const scenes::Scene& scene, std::span<const Look> looks);

/// How many tiles are lit at once while nobody waits for a picture: so many that input is answered all the same.
class SpreadPace {
public:
    std::size_t tiles() const { return tiles_; } ///< first 1, which tells what a slice costs besides
    /// A slice of so many took so long, without what was spent on compiling.
    void took(double ms);

private:
    std::size_t tiles_ = 1;
    std::optional<double> leastMs_; ///< of all slices
};

/// What the light that the renderer keeps spread over surfaces was spread for. To spread it anew over whole atlases
/// takes seconds, so a picture that only passes uses small ones.
class SpreadLight {
public:
    /// Whether pictures of these looks, drawn one after the other, need light that is not kept. `edits` counts those of
    /// lights and materials.
    bool isAnew(const scenes::Scene& scene, std::span<const Look> looks, std::uint64_t edits) const;
    /// They were drawn, with whole atlases. The renderer drops what so many pictures one after the other do not use.
    void drew(const scenes::Scene& scene, std::span<const Look> looks, std::uint64_t edits, int mostIdlePictures);
    /// Nothing of use is kept: small atlases are to take its place, or the picture may be given up.
    void forget() { kept_.reset(); }

private:
    struct Kept {
        Look look;
        std::uint64_t edits = 0;
        int idlePictures = 0;
    };
    std::optional<Kept> kept_; ///< of the last look that spread light: the renderer keeps one
};

} // namespace tessera::viewer
