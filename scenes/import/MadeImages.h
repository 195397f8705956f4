#pragma once
#include <array>
#include <string>
#include <vector>

#include "scenes/LoadLedger.h"
#include "scenes/Scene.h"

/// Made by importers: stand-ins for unreadable images and missing coordinates, and combinations of channels.
namespace tessera::scenes {

/// A checkerboard of 8 x 8 squares, magenta and dark grey, opaque. Textures that hold no colours have no stand-in: they
/// are left out, and only the material's factor applies.
Image standInPicture(LoadLedger& ledger, const std::string& who);

/// The end of the warning about an unreadable image, after the reason.
inline constexpr const char* kStandInText = "; its colours are a checkerboard, and what else it holds is left out";

/// Whether textures of this slot hold colours, which a stand-in can replace.
inline bool usesStandIn(TextureSlot slot) {
    return infoOf(slot).isSrgb;
}

/// Texture coordinates of a mesh without any: each vertex in the mesh's bounds, seen along the axis nearest to its
/// normal.
std::vector<glm::vec2> boxCoordinates(const Mesh& mesh);

/// The source of a channel of a packed image: offset + scale x a channel of `image`, or 1 if `image` is null.
struct ChannelSource {
    const Image* image = nullptr;
    int channel = 0;                  ///< 0..3
    double scale = 1.0, offset = 0.0; ///< of stored values, 0..1 for integer formats
};

/// Packs channels into an image with the size of the largest source and the format of the first. Smaller sources are
/// sampled by nearest texel, which is exact for integer ratios. No transfer function is applied.
Image packChannels(const std::string& name, const std::array<ChannelSource, 4>& sources);

/// True when some texel's alpha is below 1.
bool hasAlpha(const Image& image);

} // namespace tessera::scenes
