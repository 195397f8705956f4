// Metadata of image files: orientation, software and transfer function are read; descriptions and texts are neither
// read nor kept.
#include <algorithm>

#include "scenes/import/PictureCodecs.h"
#include "tests/unit/scenes/PictureBytes.h"

namespace tessera::scenes {
namespace {

using namespace test;

/// Nested elements, which OpenImageIO follows by recursion.
std::string nestedXmp(int levels) {
    std::string xmp = "<rdf:Description>";
    for (int i = 0; i < levels; ++i) xmp += "<a>";
    for (int i = 0; i < levels; ++i) xmp += "</a>";
    return xmp + "</rdf:Description>";
}

TEST(PictureMetadata, theDescriptionOfATiffIsNotRead) {
    constexpr int kXmp = 700;
    const std::string nested = nestedXmp(60000);
    std::string wide;
    for (const char c : nested) wide += {c, '\0'};
    for (const std::string& tiff :
         {tiffWith(kXmp, nested), tiffWith(kXmp, "<x:xmpmeta><!--" + nested + "--></x:xmpmeta>"),
          tiffWith(kXmp, "<?" + nested), tiffWith(kXmp, "<x q='" + nested + "'/>"), tiffWith(kXmp, wide, kShort),
          tiffWith(kXmp, "<!DOCTYPE x>" + nested)})
        EXPECT_EQ(decoded(tiff, "a").texels.at(0), std::byte{0x7f});
}

/// A segment of a JPEG: APP1 is 0xe1.
std::string segmentOf(int marker, const std::string& value) {
    return std::string{'\xff', char(marker)} + numberText(std::uint32_t(value.size() + 2), 2, ByteOrder::Big) + value;
}

std::string jpegWith(const std::string& segments) {
    return bytesOfSeed("picture/small.jpg").insert(2, segments);
}

/// "Exif" with an orientation, a software and more.
std::string exifOf(int orientation, const std::string& software, ByteOrder order) {
    const auto bytes = std::uint32_t(software.size() + 1);
    return std::string("Exif\0\0", 6) + tiffOf({{270, kAscii, bytes, 0, true},
                                                {274, kShort, 1, std::uint32_t(orientation)},
                                                {305, kAscii, bytes, 0, true},
                                                {34665, kLong, 1, 8}},
                                               software + '\0', order);
}

PictureTags tagsOf(const std::string& bytes, std::string_view formatName) {
    LoadLedger ledger;
    const auto format = std::ranges::find(pictureFormats(), formatName, &PictureFormat::name);
    return format->decode({std::as_bytes(std::span(bytes)), "a", *format, ledger}).tags;
}

/// A description with an orientation, which only tags of Exif and TIFF may set.
std::string xmpOfOrientation(int levels) {
    std::string xmp = "<rdf:Description tiff:Orientation='6'>";
    for (int i = 0; i < levels; ++i) xmp += "<a>";
    return xmp + "</rdf:Description>";
}

TEST(PictureMetadata, theDescriptionOfAJpegIsNotRead) {
    const std::string begin("http://ns.adobe.com/xap/1.0/\0", 29);
    for (const int levels : {0, 21000}) {
        const std::string xmp = segmentOf(0xe1, begin + xmpOfOrientation(levels));
        for (const std::string& jpeg : {jpegWith(xmp), jpegWith('\xff' + xmp)})
            EXPECT_EQ(tagsOf(jpeg, "jpeg").orientation, 1);
    }
}

TEST(PictureMetadata, theOrientationOfAJpegIsRead) {
    for (const ByteOrder order : {ByteOrder::Little, ByteOrder::Big})
        EXPECT_EQ(tagsOf(jpegWith(segmentOf(0xe1, exifOf(6, "brushes", order))), "jpeg").orientation, 6);
    // Truncated segments are not read.
    EXPECT_EQ(tagsOf(jpegWith(segmentOf(0xe1, exifOf(6, "", ByteOrder::Big).substr(0, 20))), "jpeg").orientation, 1);
    EXPECT_EQ(tagsOf(jpegWith("\xff\xe1" + std::string("\0\0", 2)), "jpeg").orientation, 1);
}

TEST(PictureMetadata, orientationAndSoftwareOfATiffAreRead) {
    std::vector<TiffEntry> entries = oneTexel();
    entries.push_back({305, kAscii, 8, 1, true});
    entries.insert(entries.begin() + 5, {274, kShort, 1, 6});
    const PictureTags tags = tagsOf(tiffOf(entries, std::string("\x7f"
                                                                "brushes\0",
                                                                9)),
                                    "tiff");
    EXPECT_EQ(tags.orientation, 6);
    EXPECT_EQ(tags.software, "brushes");
}

/// The seed, lossless, with one more chunk that its flags announce.
std::string webpWith(int flag, const std::string& name, const std::string& value) {
    const auto chunk = [](const std::string& chunkName, const std::string& bytes) {
        return chunkName + numberText(std::uint32_t(bytes.size()), 4, ByteOrder::Little) + bytes +
               std::string(bytes.size() % 2, '\0');
    };
    const Image small = decoded(bytesOfSeed("picture/small.webp"), "a");
    const auto side = [](int texels) { return numberText(std::uint32_t(texels - 1), 3, ByteOrder::Little); };
    const std::string chunks =
        "WEBP" + chunk("VP8X", char(flag) + std::string(3, '\0') + side(small.width) + side(small.height)) +
        bytesOfSeed("picture/small.webp").substr(12) + chunk(name, value);
    return chunk("RIFF", chunks);
}
constexpr int kXmpFlag = 0x04, kExifFlag = 0x08;

TEST(PictureMetadata, theDescriptionOfAWebpIsNotRead) {
    const std::string webp = webpWith(kXmpFlag, "XMP ", nestedXmp(1000));
    EXPECT_EQ(decoded(webp, "a").texels, decoded(bytesOfSeed("picture/small.webp"), "a").texels);
    EXPECT_EQ(tagsOf(webp, "webp").orientation, 1);
}

TEST(PictureMetadata, theOrientationOfAWebpIsReadUnlessItIsBroken) {
    const std::string good = exifOf(6, "brushes", ByteOrder::Little);
    for (const std::string& exif : {good, good.substr(6)})
        EXPECT_EQ(tagsOf(webpWith(kExifFlag, "EXIF", exif), "webp").orientation, 6);
    for (const std::string& broken : {std::string("II*"), good.substr(0, 10), exifOf(9, "", ByteOrder::Big)})
        EXPECT_EQ(tagsOf(webpWith(kExifFlag, "EXIF", broken), "webp").orientation, 1);
}

TEST(PictureMetadata, textsOfAPngAreNotKept) {
    // One compressed text of 7.9 MB, and nine copies of it.
    std::string png = bytesOfSeed("picture/text.png");
    constexpr std::size_t kHeaderEnd = 33;
    const std::string text = png.substr(kHeaderEnd, png.find("IDAT") - 4 - kHeaderEnd);
    for (int i = 0; i < 9; ++i) png.insert(kHeaderEnd, text);
    EXPECT_LT(growthOf([&] { EXPECT_EQ(decoded(png, "a").width, 1); }), 4 * kMiB);
}

TEST(PictureMetadata, theTransferFunctionOfAPngIsRead) {
    const std::string png = bytesOfSeed("picture/text.png");
    const auto gamma = [](std::uint32_t parts) { return pngChunk("gAMA", numberText(parts, 4, ByteOrder::Big)); };
    const std::string isLight = gamma(100000);
    const std::string isSrgb("\0\0\0\1sRGB\0\xae\xce\x1c\xe9", 13);
    const auto isLinearWith = [&](const std::string& chunks) {
        constexpr std::size_t kHeaderEnd = 33;
        const std::string picture = std::string(png).insert(kHeaderEnd, chunks);
        LoadLedger ledger;
        return decodePng({std::as_bytes(std::span(picture)), "a", PictureFormat(), ledger}).tags.isLinear;
    };
    EXPECT_FALSE(isLinearWith(""));
    EXPECT_TRUE(isLinearWith(isLight));
    EXPECT_FALSE(isLinearWith(isSrgb + isLight));
    for (const std::uint32_t rounded : {99504u, 100496u}) EXPECT_TRUE(isLinearWith(gamma(rounded))) << rounded;
    for (const std::uint32_t other : {99496u, 100504u}) EXPECT_FALSE(isLinearWith(gamma(other))) << other;
}

} // namespace
} // namespace tessera::scenes
