#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "scenes/import/Importers.h"

namespace tessera::scenes {

struct PictureFormat;

/// Decodes the bytes of a picture; `name` serves messages. Throws InputError.
using DecodePicture = DecodedPicture(std::span<const std::byte> bytes, const std::string& name,
                                     const PictureFormat& format, LoadLedger& ledger);

/// What a picture's header says of it.
struct PictureSize {
    std::int64_t width = 0, height = 0; ///< texels
    std::uint64_t bytesATexel = 0;      ///< that decoding takes, copies counted
    std::uint64_t bytes = 0;            ///< that it takes besides, for a row of tiles or the like
};

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
    /// The size that the header claims, for readers that reserve memory, or take seconds, as soon as they see it.
    /// Throws std::runtime_error for claims that cannot be true.
    PictureSize (*claimedSize)(std::span<const std::byte> bytes) = nullptr;
    /// Takes descriptions, profiles and the like, which the reader would keep or crash on, out of a copy of the file.
    /// Comes before claimedSize, and throws like it.
    void (*takeOutMetadata)(std::span<std::byte> bytes) = nullptr;
};
std::span<const PictureFormat> pictureFormats();

/// Charges the ledger. Throws InputError for a picture that no texture can be, that the ledger has no room for, or that
/// its file cannot hold; before memory is reserved for the texels.
void requirePictureSize(const PictureSize& size, std::span<const std::byte> file, const std::string& name,
                        const PictureFormat& format, LoadLedger& ledger);

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

/// The tag Orientation; 1, upright, where there is none that can be read.
int orientationOfTiff(std::span<const std::byte> tiff);

/// Turns an image as stored with this Exif orientation, 1 to 8, upright. Charges the ledger for the copy.
void turnUpright(Image& image, int orientation, LoadLedger& ledger);

/// Where an image's texels lie within the displayed one.
struct DisplayWindow {
    std::int64_t left, top; ///< of the first texel, which may lie outside
    int width, height;
};
/// The displayed image: black where the texels do not reach, and transparent there if `hasAlpha`.
Image placedInWindow(const Image& image, const DisplayWindow& window, bool hasAlpha);

/// Makes a warning of the ledger of a flawed picture that is drawn. Throws InputError where the load is strict.
void noteRepair(const std::string& name, const std::string& flaw, const std::string& repair, LoadLedger& ledger);

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
