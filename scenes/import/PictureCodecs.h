#pragma once
#include <limits>
#include <type_traits>

#include "scenes/import/Importers.h"

namespace tessera::scenes {

struct PictureFormat;

/// The size that an image's header claims.
struct PictureSize {
    std::int64_t width = 0, height = 0; ///< texels
    std::uint64_t bytesATexel = 0;      ///< memory for decoding, including copies
    std::uint64_t bytes = 0;            ///< further memory for decoding, such as for a row of tiles
};

/// An image to decode.
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
    /// Charges the ledger before memory is allocated for the texels. Throws InputError for an image that is too large
    /// for a texture, for the ledger, or for its file.
    void charge(const PictureSize& size) const;
    /// An image of black texels. `bytesATexel`: memory for decoding.
    DecodedPicture blank(int width, int height, TexelFormat texels, std::uint64_t bytesATexel) const;
    /// Adds a ledger warning about a flawed image that is drawn. Throws InputError if the load is strict.
    void noteRepair(const std::string& flaw, const std::string& repair) const;
};

/// Throws InputError.
using DecodePicture = DecodedPicture(const PictureSource& source);

/// Bytes that all files of a format have at the same offset.
struct PictureSignature {
    std::string_view bytes;
    std::size_t offset = 0;
};

/// An image format. OpenImageIO has many more readers. Some of them crash on broken files or open files that are not
/// images; those are never used.
struct PictureFormat {
    std::string_view name;          ///< in messages, and OpenImageIO's
    PictureSignature signatures[2]; ///< either identifies the format; none: its extension does
    std::string_view extensions[2]; ///< lower case
    DecodePicture* decode;          ///< null: recognised by its first bytes and refused by name
    /// Maximum texels per byte of a file: a header that claims more is refused before memory is allocated for them. 0
    /// if a codec packs one colour without a bound, so that only the ledger limits them.
    std::int64_t maxTexelsAByte = 0;
    /// The size that the header claims, for readers that allocate memory, or take seconds, as soon as they see it. A
    /// size of 0 leaves the error to the reader. Throws std::runtime_error for impossible claims.
    PictureSize (*claimedSize)(std::span<const std::byte> bytes) = nullptr;
    /// Removes descriptions, profiles and the like, which the reader would keep or crash on, from a copy of the file.
    /// Throws like claimedSize.
    void (*takeOutMetadata)(std::span<std::byte> bytes) = nullptr;
};
std::span<const PictureFormat> pictureFormats();

PictureSize claimedSizeOfExr(std::span<const std::byte> bytes);
PictureSize claimedSizeOfGif(std::span<const std::byte> bytes);
PictureSize claimedSizeOfJpeg(std::span<const std::byte> bytes);
PictureSize claimedSizeOfTiff(std::span<const std::byte> bytes);

/// The orientation in the Exif segment; 1, upright, if there is none.
int orientationOfJpeg(std::span<const std::byte> bytes);
void takeOutMetadataOfTiff(std::span<std::byte> bytes);

/// Keeps only a TIFF's first directory, and of that the first entry of each of these tags. Returns false without
/// changes if the directory is not in the file.
bool keepTiffTags(std::span<std::byte> tiff, std::span<const std::uint16_t> tags);

/// The tag Orientation, also after an Exif header; 1, upright, if none can be read.
int orientationOfTiff(std::span<const std::byte> tiff);

/// Turns an image stored with this Exif orientation, 1 to 8, upright. Charges the ledger for the copy.
void turnUpright(Image& image, int orientation, LoadLedger& ledger);

/// Position of an image's texels in the displayed image, and its size.
struct DisplayWindow {
    std::int64_t left, top; ///< of the first texel, which may lie outside
    int width, height;
};
/// Copies an image into the black displayed one. With `hasAlpha`, texels outside the image stay transparent.
void placeInWindow(const Image& image, const DisplayWindow& window, bool hasAlpha, Image& placed);

/// Calls `use` with a value of the C++ type of a texel's channels.
template <typename Use>
decltype(auto) withChannel(TexelFormat format, Use&& use) {
    if (format == TexelFormat::Rgba8Unorm) return use(std::uint8_t{});
    if (format == TexelFormat::Rgba16Unorm) return use(std::uint16_t{});
    return use(float{});
}
/// The value 1 as stored by a channel of this type.
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

/// Decodes by OpenImageIO's reader of that format only.
DecodePicture decodeByOiio;
/// Radiance HDR by OpenImageIO, which confuses two orientations and ignores EXPOSURE lines and XYZ.
DecodePicture decodeHdr;
/// JPEG by libjpeg: OpenImageIO discards the texels before an error.
DecodePicture decodeJpeg;
/// PNG by libpng: OpenImageIO lets it print errors to stderr.
DecodePicture decodePng;
/// WebP by libwebp: OpenImageIO premultiplies colours by alpha.
DecodePicture decodeWebp;
/// BMP and TGA by stb_image: OpenImageIO's readers crash on palettes that are too short for their indices.
DecodePicture decodeByStb;
/// PFM, which is a header and floats.
DecodePicture decodePfm;

} // namespace tessera::scenes
