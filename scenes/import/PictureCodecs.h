#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "scenes/LoadLedger.h"

namespace tessera::scenes {

/// What a picture's header says of it.
struct PictureSize {
    std::int64_t width = 0, height = 0; ///< texels
    std::uint64_t bytesATexel = 0;      ///< that decoding takes, copies counted
};

/// Charges the ledger. Throws InputError for a picture that no texture can be, that the ledger has no room for, or that
/// its file cannot hold; before memory is reserved for the texels.
void requirePictureSize(const PictureSize& size, std::span<const std::byte> file, const std::string& name,
                        LoadLedger& ledger);

/// What the headers of formats claim whose readers reserve memory, or take seconds, as soon as they see it; else 0 x 0.
PictureSize claimedSize(std::span<const std::byte> bytes, const std::string& format);

/// PNG by libpng itself: OpenImageIO lets it print to stderr what is wrong. Throws InputError.
Image decodePng(std::span<const std::byte> bytes, const std::string& name, LoadLedger& ledger);

/// BMP and TGA by stb_image: OpenImageIO's readers crash on palettes that are shorter than what refers to them. Throws
/// InputError.
Image decodeBmpOrTga(std::span<const std::byte> bytes, const std::string& name, LoadLedger& ledger);

} // namespace tessera::scenes
