#include <array>

#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {

namespace {

/// Deflate reaches 1032 bytes per byte, and a grey texel may have one bit; Huffman codes of a JPEG's blocks and runs of
/// the others stay below.
constexpr std::int64_t kMaxTexelsAByte = 16384;

} // namespace

std::span<const PictureFormat> pictureFormats() {
    using namespace std::string_view_literals;
    static constexpr std::array kFormats = {
        PictureFormat{"png", {{"\x89PNG\r\n\x1a\n"sv}}, {"png"}, decodePng, kMaxTexelsAByte},
        PictureFormat{"jpeg", {{"\xff\xd8\xff"sv}}, {"jpg", "jpeg"}, decodeJpeg, kMaxTexelsAByte, claimedSizeOfJpeg},
        PictureFormat{"openexr", {{"\x76\x2f\x31\x01"sv}}, {"exr"}, decodeByOiio, kMaxTexelsAByte, claimedSizeOfExr},
        PictureFormat{"hdr", {{"#?"sv}}, {"hdr"}, decodeHdr, kMaxTexelsAByte},
        PictureFormat{"pfm", {{"PF\n"sv}, {"Pf\n"sv}}, {"pfm"}, decodePfm, kMaxTexelsAByte},
        PictureFormat{"tiff",
                      {{"II*\0"sv}, {"MM\0*"sv}},
                      {"tif", "tiff"},
                      decodeByOiio,
                      0,
                      claimedSizeOfTiff,
                      takeOutMetadataOfTiff},
        PictureFormat{"webp", {{"WEBP"sv, 8}}, {"webp"}, decodeWebp},
        PictureFormat{"bmp", {{"BM"sv}}, {"bmp"}, decodeByStb, kMaxTexelsAByte},
        PictureFormat{"gif", {{"GIF8"sv}}, {"gif"}, decodeByOiio, kMaxTexelsAByte, claimedSizeOfGif},
        PictureFormat{"tga", {}, {"tga"}, decodeByStb, kMaxTexelsAByte},
        PictureFormat{"psd", {{"8BPS"sv}}, {}, nullptr},
        PictureFormat{"dds", {{"DDS "sv}}, {}, nullptr},
        PictureFormat{"ktx", {{"\xabKTX 11"sv}}, {}, nullptr},
        PictureFormat{"ktx2", {{"\xabKTX 20"sv}}, {}, nullptr},
        PictureFormat{"jpeg2000", {{"\0\0\0\x0cjP  "sv}}, {}, nullptr},
    };
    return kFormats;
}

} // namespace tessera::scenes
