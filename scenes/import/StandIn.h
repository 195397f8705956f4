#pragma once
#include <string>

#include "scenes/LoadLedger.h"

/// What is drawn for pictures that cannot be read, so that a model is seen all the same.
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

} // namespace tessera::scenes
