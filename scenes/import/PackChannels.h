#pragma once
#include <array>
#include <string>

#include "scenes/Scene.h"

namespace tessera::scenes {

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
