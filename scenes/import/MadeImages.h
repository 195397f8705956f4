#pragma once
#include <array>
#include <string>

#include "scenes/LoadLedger.h"
#include "scenes/Scene.h"

/// Images that importers make: stand-ins for those that cannot be read, and combinations of others.
namespace tessera::scenes {

/// A checkerboard of 8 x 8 squares, magenta and dark grey, opaque. Where a texture holds no colours, no picture can
/// stand in: the texture is left out there, and the material's factor holds alone.
Image standInPicture(LoadLedger& ledger, const std::string& who);

/// Ends the warning of a picture that cannot be read, after the reason.
inline constexpr const char* kStandInText = "; its colours are a checkerboard, and what else it holds is left out";

/// Whether a picture at this slot shows colours.
inline bool takesStandIn(TextureSlot slot) {
    return infoOf(slot).isSrgb;
}

/// Where a channel of a packed picture comes from: offset + scale x a channel of a picture, or 1 where `image` is null.
struct ChannelSource {
    const Image* image = nullptr;
    int channel = 0;                  ///< 0..3
    double scale = 1.0, offset = 0.0; ///< of stored values, 0..1 for integer formats
};

/// A picture with each channel taken from its source, as large as the largest source and of the first source's format.
/// Smaller sources are repeated texel by texel (nearest), which is exact for whole ratios. No transfer function is
/// applied.
Image packChannels(const std::string& name, const std::array<ChannelSource, 4>& sources);

/// True when some texel's alpha is below 1.
bool hasAlpha(const Image& image);

} // namespace tessera::scenes
