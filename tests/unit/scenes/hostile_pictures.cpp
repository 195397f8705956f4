#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "scenes/import/PictureCodecs.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/TempFolder.h"

namespace tessera::scenes {
namespace {

using test::inputErrorOf;
using testing::AllOf;
using testing::HasSubstr;

const std::filesystem::path kSeeds = std::filesystem::path(TESSERA_SOURCE_DIR) / "tests/fuzz/corpus";

std::string bytesOfSeed(const char* name) {
    std::ifstream stream(kSeeds / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

Image decoded(const std::string& bytes, const std::string& name, std::optional<std::uint64_t> limitBytes = {}) {
    LoadLedger ledger(limitBytes);
    return decodeImage(std::as_bytes(std::span(bytes)), name, ledger);
}

std::string refusalOf(const std::string& bytes, const std::string& name, std::optional<std::uint64_t> limitBytes = {}) {
    return inputErrorOf([&] { decoded(bytes, name, limitBytes); });
}

TEST(HostilePicture, nothingIsReadBeforeTheBeginningOfAnExr) {
    // Its table says that a line begins at 2^64 - 1, which OpenImageIO takes for -1.
    EXPECT_THAT(refusalOf(bytesOfSeed("picture/line_offset.exr"), "a"),
                HasSubstr("Unexpected end of file); save it again"));
}

TEST(HostilePicture, aReaderThatOpenImageIoLacksIsNoBrokenPicture) {
    const auto failureOf = [](const char* format) {
        LoadLedger ledger;
        try {
            decodeByOiio({}, "a", PictureFormat{format, {}, {}, decodeByOiio}, ledger);
        } catch (const InputError&) {
        } catch (const std::runtime_error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(failureOf("nosuch"), AllOf(testing::StartsWith("a: OpenImageIO cannot read nosuch ("),
                                           testing::EndsWith("); install it with that format")));
    EXPECT_EQ(failureOf("softimage"), "a: this OpenImageIO cannot read softimage from memory; install 2.4 or newer");
}

/// A line of /proc/self/status, or 0.
std::uint64_t statusBytes(std::string_view key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(key)) return 1024 * std::stoull(line.substr(key.size()));
    return 0;
}

/// By how much the process grows at most while this runs. Source: Linux, proc(5): 5 sets the peak to what is in use.
std::uint64_t growthOf(const std::function<void()>& action) {
    std::ofstream clear("/proc/self/clear_refs");
    EXPECT_TRUE(clear << 5 << std::flush) << "the peak stays what it was, and nothing can be measured";
    const std::uint64_t before = statusBytes("VmHWM:");
    EXPECT_GT(before, 0u);
    action();
    return statusBytes("VmHWM:") - before;
}

TEST(HostilePicture, aProgressiveJpegIsChargedBeforeItsReaderReservesIt) {
    std::string jpeg = bytesOfSeed("picture/progressive.jpg"); // 4000 x 4000 texels, none of which it holds
    EXPECT_LT(growthOf([&] { EXPECT_THAT(refusalOf(jpeg, "a"), HasSubstr("claims 4000x4000 texels")); }), 8 * kMiB);
    jpeg.resize(4096); // what may hold them
    EXPECT_LT(growthOf([&] {
                  EXPECT_THAT(refusalOf(jpeg, "a", 64 * kMiB),
                              HasSubstr("a: the picture of 4000x4000 texels: asks for 91.6 MiB"));
              }),
              8 * kMiB);
}

TEST(HostilePicture, theCopyThatAReaderHoldsIsChargedWithTheTexels) {
    std::string jpeg = bytesOfSeed("picture/progressive.jpg");
    jpeg.resize(4096);
    // 6 bytes per texel are coefficients, 3 are handed over, 4 are kept.
    EXPECT_THAT(refusalOf(jpeg, "a", 128 * kMiB), HasSubstr("asks for 106.8 MiB of memory, and 91.6 MiB are in use"));
}

TEST(HostilePicture, scansOfAJpegAreBounded) {
    std::string jpeg = bytesOfSeed("picture/progressive.jpg");
    const std::size_t height = jpeg.find("\xff\xc2") + 5, scan = jpeg.find("\xff\xda");
    jpeg.replace(height, 4, "\0\x10\0\x10", 4);
    const std::string first = jpeg.substr(scan, jpeg.size() - 2 - scan);
    const auto withScans = [&](int count) {
        std::string scans;
        for (int i = 0; i < count; ++i) scans += first;
        return jpeg.substr(0, scan) + scans + "\xff\xd9";
    };
    EXPECT_EQ(decoded(withScans(100), "a").width, 16);
    EXPECT_EQ(refusalOf(withScans(101), "a"), "a: the jpeg picture cannot be decoded (it has more than 100 scans, each "
                                              "of which takes as long as a picture); save it again");
}

TEST(HostilePicture, everyKindOfWebpIsChargedBeforeItsReaderReservesIt) {
    for (const char* seed : {"picture/lossy.webp", "picture/lossless.webp", "picture/canvas.webp"}) {
        std::string webp = bytesOfSeed(seed);
        webp.resize(8192);
        EXPECT_THAT(refusalOf(webp, seed, 64 * kMiB),
                    HasSubstr("webp: the picture of 8000x8000 texels: asks for 488.3 MiB of memory, and 8.0 KiB are"));
    }
}

/// An entry of a TIFF's directory. `isPlace`: its value is a place in what follows the directory.
struct TiffEntry {
    int tag, type;
    std::uint32_t count, value;
    bool isPlace = false;
};
constexpr int kByte = 1, kAscii = 2, kShort = 3, kLong = 4, kLong8 = 16;

enum class ByteOrder { Little, Big };

std::string numberText(std::uint32_t number, int bytes, ByteOrder order) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += char(number >> (8 * (order == ByteOrder::Big ? bytes - 1 - i : i)));
    return text;
}

std::string tiffOf(const std::vector<TiffEntry>& entries, const std::string& rest,
                   ByteOrder order = ByteOrder::Little) {
    const auto number = [&](std::uint32_t value, int bytes) { return numberText(value, bytes, order); };
    const auto places = std::uint32_t(8 + 2 + 12 * entries.size() + 4);
    std::string tiff = (order == ByteOrder::Big ? "MM" : "II") + number(42, 2) + number(8, 4);
    tiff += number(std::uint32_t(entries.size()), 2);
    for (const TiffEntry& entry : entries) {
        tiff += number(std::uint32_t(entry.tag), 2) + number(std::uint32_t(entry.type), 2) + number(entry.count, 4);
        const int bytes = entry.type == kByte ? 1 : entry.type == kShort ? 2 : 4;
        if (bytes < 4 && entry.count == 1 && !entry.isPlace)
            tiff += number(entry.value, bytes) + std::string(std::size_t(4 - bytes), '\0');
        else
            tiff += number(entry.value + (entry.isPlace ? places : 0), 4);
    }
    return tiff + number(0, 4) + rest;
}

/// One grey texel, 0x7f, the first of what follows the directory.
std::vector<TiffEntry> oneTexel() {
    return {{256, kShort, 1, 1},      {257, kShort, 1, 1}, {258, kShort, 1, 8}, {262, kShort, 1, 1},
            {273, kLong, 1, 0, true}, {278, kShort, 1, 1}, {279, kLong, 1, 1}};
}

/// A texel with one more entry, of type `type`, that has this value.
std::string tiffWith(int tag, const std::string& value, int type = kByte) {
    std::vector<TiffEntry> entries = oneTexel();
    const std::size_t size = type == kShort ? 2 : 1;
    entries.push_back({tag, type, std::uint32_t(value.size() / size), 1, true});
    return tiffOf(entries, '\x7f' + value);
}

/// Elements within elements, which OpenImageIO follows by recursion.
std::string nestedXmp(int levels) {
    std::string xmp = "<rdf:Description>";
    for (int i = 0; i < levels; ++i) xmp += "<a>";
    for (int i = 0; i < levels; ++i) xmp += "</a>";
    return xmp + "</rdf:Description>";
}

TEST(HostilePicture, theDescriptionOfATiffIsNotRead) {
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

TEST(HostilePicture, valuesOfTagsThatDecodingDoesNotNeedAreNotCopied) {
    constexpr int kTags = 300, kExif = 34665;
    const std::string shared(kMiB, '\x7f');
    std::vector<TiffEntry> entries = oneTexel(), elsewhere;
    for (int i = 0; i < kTags; ++i) entries.push_back({40000 + i, kByte, kMiB, 0, true});
    const std::string inFirst = tiffOf(entries, shared);
    // The directory of Exif stands behind the texel, and its value behind that.
    entries = oneTexel();
    entries.push_back({kExif, kLong, 1, 1, true});
    const auto value = std::uint32_t(8 + 2 + 12 * entries.size() + 4 + 1 + 2 + 12 * kTags + 4);
    std::string directory = numberText(kTags, 2, ByteOrder::Little);
    for (int i = 0; i < kTags; ++i)
        directory += numberText(std::uint32_t(50000 + i), 2, ByteOrder::Little) +
                     numberText(kByte, 2, ByteOrder::Little) + numberText(kMiB, 4, ByteOrder::Little) +
                     numberText(value, 4, ByteOrder::Little);
    const std::string inExif = tiffOf(entries, '\x7f' + directory + std::string(4, '\0') + shared);
    for (const std::string& tiff : {inFirst, inExif})
        EXPECT_LT(growthOf([&] { EXPECT_EQ(decoded(tiff, "a").texels.at(0), std::byte{0x7f}); }), 16 * kMiB);
}

TEST(HostilePicture, aTiffIsNotReadWhoseDirectoryIsNotInTheFile) {
    for (const std::uint32_t place : {4u, 1000u}) {
        std::string tiff = tiffOf(oneTexel(), "\x7f");
        tiff.replace(4, 4, numberText(place, 4, ByteOrder::Little));
        EXPECT_THAT(refusalOf(tiff, "a"), HasSubstr("(its directory of tags is not in the file)"));
    }
}

/// 16 x 16 grey texels in a tile that claims these sides, by numbers of this type.
std::string tiledTiff(int type, std::uint32_t tileSide, ByteOrder order, std::uint32_t side = 16) {
    const std::string rest = type == kLong8 ? numberText(tileSide, 4, order) + std::string(4, '\0') : std::string();
    const TiffEntry width{322, type, 1, type == kLong8 ? 0 : tileSide, type == kLong8};
    TiffEntry height = width;
    height.tag = 323;
    return tiffOf({{256, kShort, 1, side},
                   {257, kShort, 1, side},
                   {258, kShort, 1, 8},
                   {262, kShort, 1, 1},
                   {277, kShort, 1, 1},
                   width,
                   height,
                   {324, kLong, 1, std::uint32_t(rest.size()), true},
                   {325, kLong, 1, 256}},
                  rest + std::string(256, '\x7f'), order);
}

TEST(HostilePicture, tilesOfATiffAreChargedWhole) {
    const std::string tiff = bytesOfSeed("picture/large_tiles.tif"); // 16 x 16 texels in a tile of 16384 x 16384
    EXPECT_THAT(refusalOf(tiff, "a", 64 * kMiB), HasSubstr("a: the picture of 16x16 texels: asks for 512.0 MiB"));
    for (const ByteOrder order : {ByteOrder::Little, ByteOrder::Big}) {
        EXPECT_THAT(refusalOf(tiledTiff(kLong, 16384, order), "a", 64 * kMiB), HasSubstr("asks for 512.0 MiB"));
        EXPECT_THAT(refusalOf(tiledTiff(kLong, 0xfffffff0, order), "a"), HasSubstr("asks for"));
        for (const int type : {kByte, kShort, kLong})
            EXPECT_EQ(decoded(tiledTiff(type, 16, order), "a").texels.at(0), std::byte{0x7f});
        EXPECT_THAT(refusalOf(tiledTiff(kLong8, 16384, order), "a"),
                    HasSubstr("(its tag 322 is of type 16, where 1 (BYTE), 3 (SHORT) or 4 (LONG) is needed)"));
    }
}

TEST(HostilePicture, tilesBeyondAPictureDoNotCountAsItsSide) {
    const auto refusalOfSide = [](std::uint32_t side) {
        return refusalOf(tiledTiff(kLong, 256, ByteOrder::Little, side), "a", 64 * kMiB);
    };
    // 64 tiles of 256 would be 16384.
    EXPECT_THAT(refusalOfSide(16383), HasSubstr("a: the picture of 16383x16383 texels: asks for 1.2 GiB"));
    EXPECT_THAT(refusalOfSide(16385), HasSubstr("a: the picture has 16385x16385 texels; at most"));
}

TEST(HostilePicture, stripsOfATiffAreChargedWhole) {
    std::vector<TiffEntry> entries = oneTexel();
    entries[0].value = entries[1].value = 8192;
    const auto refusal = [&] { return refusalOf(tiffOf(entries, "\x7f"), "a", 64 * kMiB); };
    EXPECT_THAT(refusal(), HasSubstr("asks for 320.0 MiB of memory, and 16.")); // the texels, beside a row
    entries[5].value = 16384;
    EXPECT_THAT(refusal(), HasSubstr("asks for 128.0 MiB of memory, and 99 B are"));
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
    return format->decode(std::as_bytes(std::span(bytes)), "a", *format, ledger).tags;
}

/// A description that claims an orientation, which only Exif's and TIFF's own tags tell.
std::string xmpOfOrientation(int levels) {
    std::string xmp = "<rdf:Description tiff:Orientation='6'>";
    for (int i = 0; i < levels; ++i) xmp += "<a>";
    return xmp + "</rdf:Description>";
}

TEST(HostilePicture, theDescriptionOfAJpegIsNotRead) {
    const std::string begin("http://ns.adobe.com/xap/1.0/\0", 29);
    for (const int levels : {0, 21000}) {
        const std::string xmp = segmentOf(0xe1, begin + xmpOfOrientation(levels));
        for (const std::string& jpeg : {jpegWith(xmp), jpegWith('\xff' + xmp)})
            EXPECT_EQ(tagsOf(jpeg, "jpeg").orientation, 1);
    }
}

TEST(HostilePicture, orientationAndSoftwareOfAJpegAreRead) {
    for (const ByteOrder order : {ByteOrder::Little, ByteOrder::Big}) {
        const PictureTags tags = tagsOf(jpegWith(segmentOf(0xe1, exifOf(6, "brushes", order))), "jpeg");
        EXPECT_EQ(tags.orientation, 6);
        EXPECT_EQ(tags.software, "brushes");
    }
    // Of what is cut short nothing is read.
    EXPECT_EQ(tagsOf(jpegWith(segmentOf(0xe1, exifOf(6, "", ByteOrder::Big).substr(0, 40))), "jpeg").orientation, 1);
}

TEST(HostilePicture, orientationAndSoftwareOfATiffAreRead) {
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

/// The seed, lossless, with one more chunk that its flags tell of.
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

/// The flags that its reader sees.
int flagsOf(std::string webp) {
    takeOutMetadataOfWebp(std::as_writable_bytes(std::span(webp)));
    return webp[20];
}

TEST(HostilePicture, theDescriptionOfAWebpIsNotRead) {
    const std::string webp = webpWith(kXmpFlag, "XMP ", nestedXmp(1000));
    EXPECT_EQ(flagsOf(webp), 0);
    EXPECT_EQ(decoded(webp, "a").texels, decoded(bytesOfSeed("picture/small.webp"), "a").texels);
}

TEST(HostilePicture, theOrientationOfAWebpIsReadUnlessItIsBroken) {
    const std::string good = exifOf(6, "brushes", ByteOrder::Little);
    EXPECT_EQ(tagsOf(webpWith(kExifFlag, "EXIF", good), "webp").orientation, 6);
    // OpenImageIO takes six bytes off a chunk of three.
    for (const std::string& broken : {std::string("II*"), good.substr(0, 30), good + "EXIF"}) {
        const std::string webp = webpWith(kExifFlag, "EXIF", broken);
        EXPECT_EQ(flagsOf(webp), 0);
        EXPECT_EQ(tagsOf(webp, "webp").orientation, 1);
    }
}

TEST(HostilePicture, aPictureOfOneColourIsNotTooSmallAFile) {
    const Image image = decoded(bytesOfSeed("picture/one_colour.webp"), "a"); // 4096 x 4096 in 704 bytes
    EXPECT_EQ(image.width, 4096);
    EXPECT_EQ(image.texels.back(), std::byte{0xff});
}

TEST(HostilePicture, aBmpThatBeginsAtItsTopIsRead) {
    std::string bmp = bytesOfSeed("picture/small.bmp");
    constexpr std::size_t kTexels = 54;
    for (std::size_t i = kTexels; i < bmp.size(); ++i) bmp[i] = char(i);
    const Image fromBottom = decoded(bmp, "a");
    bmp.replace(22, 4, numberText(std::uint32_t(-fromBottom.height), 4, ByteOrder::Little));
    const Image fromTop = decoded(bmp, "a");
    ASSERT_EQ(fromTop.height, fromBottom.height);
    const auto row = std::ptrdiff_t(4 * fromTop.width);
    for (int y = 0; y < fromTop.height; ++y)
        EXPECT_TRUE(std::equal(fromTop.texels.begin() + y * row, fromTop.texels.begin() + (y + 1) * row,
                               fromBottom.texels.end() - (y + 1) * row))
            << y;
}

TEST(HostilePicture, aBmpOfANegativeWidthIsCalledBroken) {
    std::string bmp = bytesOfSeed("picture/small.bmp");
    bmp.replace(18, 4, "\xfc\xff\xff\xff");
    EXPECT_EQ(refusalOf(bmp, "a"), "a: the header claims -4x4 texels; the file is broken");
}

TEST(HostilePicture, textsOfAPngAreNotKept) {
    // One compressed text of 7.9 MB, and nine copies of it.
    std::string png = bytesOfSeed("picture/text.png");
    constexpr std::size_t kHeaderEnd = 33;
    const std::string text = png.substr(kHeaderEnd, png.find("IDAT") - 4 - kHeaderEnd);
    for (int i = 0; i < 9; ++i) png.insert(kHeaderEnd, text);
    EXPECT_LT(growthOf([&] { EXPECT_EQ(decoded(png, "a").width, 1); }), 4 * kMiB);
}

TEST(HostilePicture, theTransferFunctionOfAPngIsRead) {
    const std::string png = bytesOfSeed("picture/text.png");
    const std::string isLight("\0\0\0\4gAMA\0\1\x86\xa0\x31\xe8\x96\x5f", 16);
    const std::string isSrgb("\0\0\0\1sRGB\0\xae\xce\x1c\xe9", 13);
    const auto isLinearWith = [&](const std::string& chunks) {
        constexpr std::size_t kHeaderEnd = 33;
        const std::string picture = std::string(png).insert(kHeaderEnd, chunks);
        LoadLedger ledger;
        return decodePng(std::as_bytes(std::span(picture)), "a", {}, ledger).tags.isLinear;
    };
    EXPECT_FALSE(isLinearWith(""));
    EXPECT_TRUE(isLinearWith(isLight));
    EXPECT_FALSE(isLinearWith(isSrgb + isLight));
}

TEST(HostilePicture, aBmpOrTgaThatEndsEarlyIsRefused) {
    struct Seed {
        const char* name;
        std::vector<int> firstTexel; ///< at the top left
    };
    const Seed seeds[] = {{"picture/small.bmp", {0, 1, 2, 255}},
                          {"tga/palette.tga", {8, 7, 6, 255}},
                          {"tga/rgba.tga", {2, 1, 0, 3}},
                          {"tga/rle.tga", {3, 2, 1, 255}}};
    for (const Seed& seed : seeds) {
        const std::string whole = bytesOfSeed(seed.name);
        const Image image = decoded(whole, seed.name);
        ASSERT_GE(image.texels.size(), 4u);
        for (std::size_t i = 0; i < 4; ++i)
            EXPECT_EQ(std::to_integer<int>(image.texels[i]), seed.firstTexel[i]) << seed.name;
        for (std::size_t size = 2; size < whole.size(); ++size)
            EXPECT_THAT(refusalOf(whole.substr(0, size), seed.name),
                        HasSubstr("picture is broken or cut short (the file ends early); save it again"))
                << seed.name << " cut to " << size;
    }
}

TEST(HostilePicture, aTgaWithMoreBehindItsTexelsIsRead) {
    // More than stb_image reads ahead, and lines longer than that.
    std::string tga = bytesOfSeed("tga/rgba.tga").substr(0, 18);
    tga[12] = 100;
    tga.append(2 * 100 * 4, '\x7f');
    EXPECT_EQ(decoded(tga, "a.tga").texels, std::vector<std::byte>(800, std::byte{0x7f}));
    EXPECT_EQ(decoded(tga + std::string(300, 'x'), "a.tga").texels, std::vector<std::byte>(800, std::byte{0x7f}));
    EXPECT_THAT(refusalOf(tga.substr(0, tga.size() - 1), "a.tga"), HasSubstr("the file ends early"));
}

TEST(HostilePicture, theDisplayWindowOfAnExrIsNotItsSize) {
    std::string exr = bytesOfSeed("picture/small.exr");
    const std::size_t most = exr.find("displayWindow") + 14 + 6 + 4 + 8;
    exr.replace(most, 8, "\x3f\x9c\0\0\x3f\x9c\0\0", 8); // to 39999, 39999
    EXPECT_EQ(decoded(exr, "a").width, 4);
}

} // namespace
} // namespace tessera::scenes
