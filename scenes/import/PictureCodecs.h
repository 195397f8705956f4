#pragma once
#include <limits>
#include <type_traits>

#include "scenes/import/Importers.h"

namespace tessera::scenes {

struct PictureFormat;

/// What a picture's header says of it.
struct PictureSize {
    std::int64_t width = 0, height = 0; ///< texels
    std::uint64_t bytesATexel = 0;      ///< that decoding takes, copies counted
    std::uint64_t bytes = 0;            ///< that it takes besides, for a row of tiles or the like
};

/// A picture that is to be decoded.
struct PictureSource {
    std::span<const std::byte> bytes; ///< of its file
    const std::string& name;          ///< in messages
    const PictureFormat& format;
    LoadLedger& ledger;

    /// Throws InputError.
    [[noreturn]] void fail(std::string_view why, std::string_view what = "is broken or cut short") const;
    void require(bool isGood, std::string_view why) const {
        if (!isGood) fail(why);
    }
    /// Charges the ledger. Throws InputError for a picture that no texture can be, that the ledger has no room for, or
    /// that its file cannot hold; before memory is reserved for the texels.
    void charge(const PictureSize& size) const;
    /// A picture of black texels. `bytesATexel`: that decoding takes.
    DecodedPicture blank(int width, int height, TexelFormat texels, std::uint64_t bytesATexel) const;
    /// Makes a warning of the ledger of a flawed picture that is drawn. Throws InputError where the load is strict.
    void noteRepair(const std::string& flaw, const std::string& repair) const;
};

/// Throws InputError.
using DecodePicture = DecodedPicture(const PictureSource& source);

/// Bytes that all files of a format have at one place.
struct PictureSignature {
    std::string_view bytes;
    std::size_t offset = 0;
};

/// All that is known of a format. OpenImageIO has many more readers, some of which crash on broken files, and some open
/// what is no picture at all; none of them is ever asked.
struct PictureFormat {
    std::string_view name;          ///< in messages, and OpenImageIO's
    PictureSignature signatures[2]; ///< either identifies the format; none: its extension does
    std::string_view extensions[2]; ///< lower case
    DecodePicture* decode;          ///< null: known by its first bytes and refused by name
    /// Texels that a byte of a file may hold at most: a header that claims more is refused before memory is reserved
    /// for them. 0 where a codec packs one colour without a bound, and the ledger alone counts.
    std::int64_t maxTexelsAByte = 0;
    /// The size that the header claims, for readers that reserve memory, or take seconds, as soon as they see it; 0 x 0
    /// where they are to say what is wrong. Throws std::runtime_error for claims that cannot be true.
    PictureSize (*claimedSize)(std::span<const std::byte> bytes) = nullptr;
    /// Takes descriptions, profiles and the like, which the reader would keep or crash on, out of a copy of the file.
    /// Throws like claimedSize.
    void (*takeOutMetadata)(std::span<std::byte> bytes) = nullptr;
};
std::span<const PictureFormat> pictureFormats();

PictureSize claimedSizeOfExr(std::span<const std::byte> bytes);
PictureSize claimedSizeOfGif(std::span<const std::byte> bytes);
PictureSize claimedSizeOfJpeg(std::span<const std::byte> bytes);
PictureSize claimedSizeOfTiff(std::span<const std::byte> bytes);

/// Of the Exif segment; 1, upright, where there is none.
int orientationOfJpeg(std::span<const std::byte> bytes);
void takeOutMetadataOfTiff(std::span<std::byte> bytes);

/// Leaves of a TIFF's directories the first, and of that the first entry of each of these tags. False, and nothing is
/// changed, where the file does not hold it.
bool keepTiffTags(std::span<std::byte> tiff, std::span<const std::uint16_t> tags);

/// The tag Orientation, also behind the bytes with which Exif begins; 1, upright, where there is none that can be read.
int orientationOfTiff(std::span<const std::byte> tiff);

/// Turns an image as stored with this Exif orientation, 1 to 8, upright. Charges the ledger for the copy.
void turnUpright(Image& image, int orientation, LoadLedger& ledger);

/// Where an image's texels lie within the displayed one.
struct DisplayWindow {
    std::int64_t left, top; ///< of the first texel, which may lie outside
    int width, height;
};
/// Copies an image into the black one that is displayed, which stays transparent where it does not reach if `hasAlpha`.
void placeInWindow(const Image& image, const DisplayWindow& window, bool hasAlpha, Image& placed);

/// Calls `use` with a number of the type of a texel's channels.
template <typename Use>
decltype(auto) withChannel(TexelFormat format, Use&& use) {
    if (format == TexelFormat::Rgba8Unorm) return use(std::uint8_t{});
    if (format == TexelFormat::Rgba16Unorm) return use(std::uint16_t{});
    return use(float{});
}
/// 1 as a channel of this type stores it.
template <typename Channel>
inline constexpr Channel kOneOf = std::is_integral_v<Channel> ? std::numeric_limits<Channel>::max() : Channel(1);

/// An image's texels, or their channels.
template <typename Value>
std::span<Value> texelsOf(Image& image) {
    return {reinterpret_cast<Value*>(image.texels.data()), image.texels.size() / sizeof(Value)};
}
template <typename Value>
std::span<const Value> texelsOf(const Image& image) {
    return {reinterpret_cast<const Value*>(image.texels.data()), image.texels.size() / sizeof(Value)};
}

/// By OpenImageIO's reader of that format, and no other.
DecodePicture decodeByOiio;
/// Radiance HDR by OpenImageIO, which confuses two orientations and knows neither EXPOSURE lines nor XYZ.
DecodePicture decodeHdr;
/// JPEG by libjpeg itself: OpenImageIO discards what precedes a fault.
DecodePicture decodeJpeg;
/// PNG by libpng itself: OpenImageIO lets it print to stderr what is wrong.
DecodePicture decodePng;
/// WebP by libwebp itself: OpenImageIO multiplies colours by alpha.
DecodePicture decodeWebp;
/// BMP and TGA by stb_image: OpenImageIO's readers crash on palettes that are shorter than what refers to them.
DecodePicture decodeByStb;
/// PFM, which is a header and floats.
DecodePicture decodePfm;

} // namespace tessera::scenes
