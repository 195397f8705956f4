#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "viewer/session/Look.h"

namespace tessera::viewer {

/// Side of the atlases, in texels, of pictures that pass while the light they spread over surfaces changes.
inline constexpr int kPassingAtlasTexels = 128;

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
