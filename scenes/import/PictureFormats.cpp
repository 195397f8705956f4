#include <array>

#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes {

std::span<const PictureFormat> pictureFormats() {
    using namespace std::string_view_literals;
    static constexpr std::array kFormats = {
        PictureFormat{"png", {{"\x89PNG\r\n\x1a\n"sv}}, {"png"}, decodePng, nullptr},
        PictureFormat{"jpeg", {{"\xff\xd8\xff"sv}}, {"jpg", "jpeg"}, decodeByOiio, claimedSizeOfJpeg},
        PictureFormat{"openexr", {{"\x76\x2f\x31\x01"sv}}, {"exr"}, decodeByOiio, claimedSizeOfExr},
        PictureFormat{"hdr", {{"#?"sv}}, {"hdr"}, decodeByOiio, nullptr},
        PictureFormat{"pfm", {{"PF\n"sv}, {"Pf\n"sv}}, {"pfm"}, decodePfm, nullptr},
        PictureFormat{"tiff", {{"II*\0"sv}, {"MM\0*"sv}}, {"tif", "tiff"}, decodeByOiio, claimedSizeOfTiff},
        PictureFormat{"webp", {{"WEBP"sv, 8}}, {"webp"}, decodeByOiio, claimedSizeOfWebp},
        PictureFormat{"bmp", {{"BM"sv}}, {"bmp"}, decodeByStb, nullptr},
        PictureFormat{"gif", {{"GIF8"sv}}, {"gif"}, decodeByOiio, claimedSizeOfGif},
        PictureFormat{"tga", {}, {"tga"}, decodeByStb, nullptr},
        PictureFormat{"psd", {{"8BPS"sv}}, {}, nullptr, nullptr},
        PictureFormat{"dds", {{"DDS "sv}}, {}, nullptr, nullptr},
        PictureFormat{"ktx", {{"\xabKTX 11"sv}}, {}, nullptr, nullptr},
        PictureFormat{"ktx2", {{"\xabKTX 20"sv}}, {}, nullptr, nullptr},
        PictureFormat{"jpeg2000", {{"\0\0\0\x0cjP  "sv}}, {}, nullptr, nullptr},
    };
    return kFormats;
}

} // namespace tessera::scenes
