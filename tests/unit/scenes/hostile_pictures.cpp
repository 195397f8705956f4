// Images that are broken, truncated or claim more memory than their files justify.
#include <algorithm>

#include "scenes/import/PictureCodecs.h"
#include "tests/unit/scenes/PictureBytes.h"

namespace tessera::scenes {
namespace {

using namespace test;
using testing::AllOf;
using testing::HasSubstr;

TEST(HostilePicture, nothingIsReadBeforeTheBeginningOfAnExr) {
    // Its table puts a line at 2^64 - 1, which OpenImageIO reads as -1.
    EXPECT_THAT(refusalOf(bytesOfSeed("picture/line_offset.exr"), "a"),
                HasSubstr("Unexpected end of file); save it again"));
}

TEST(HostilePicture, aReaderThatOpenImageIoLacksIsNoBrokenPicture) {
    const auto failureOf = [](const char* format) {
        LoadLedger ledger;
        try {
            decodeByOiio({{}, "a", PictureFormat{format, {}, {}, decodeByOiio}, ledger});
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

TEST(HostilePicture, aProgressiveJpegIsChargedBeforeItsReaderReservesIt) {
    std::string jpeg = bytesOfSeed("picture/progressive.jpg"); // 4000 x 4000 texels, none of which it holds
    EXPECT_LT(growthOf([&] { EXPECT_THAT(refusalOf(jpeg, "a"), HasSubstr("claims 4000x4000 texels")); }), 8 * kMiB);
    jpeg.resize(4096); // enough bytes to hold them
    EXPECT_LT(growthOf([&] {
                  EXPECT_THAT(refusalOf(jpeg, "a", 64 * kMiB),
                              HasSubstr("a: the picture of 4000x4000 texels: needs 91.6 MiB"));
              }),
              8 * kMiB);
}

TEST(HostilePicture, theCopyThatAReaderHoldsIsChargedWithTheTexels) {
    std::string jpeg = bytesOfSeed("picture/progressive.jpg");
    jpeg.resize(4096);
    // 6 bytes per texel are coefficients, 4 are kept.
    EXPECT_THAT(refusalOf(jpeg, "a", 128 * kMiB), HasSubstr("needs 61.0 MiB of memory, and 91.6 MiB are in use"));
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

TEST(HostilePicture, sidesAndTexelsAreBounded) {
    const std::string name = "a";
    const PictureFormat format{};
    LoadLedger ledger;
    const auto charge = [&](int width, int height) {
        PictureSource{{}, name, format, ledger}.charge({width, height, 0, 0});
    };
    for (const auto& [width, height] : {std::pair(1048576, 256), {256, 1048576}, {16384, 16384}, {1, 1}})
        EXPECT_NO_THROW(charge(width, height)) << width;
    for (const auto& [width, height] : {std::pair(1048577, 1), {1, 1048577}, {16385, 16384}, {1048576, 257}})
        EXPECT_THAT(inputErrorOf([&, w = width, h = height] { charge(w, h); }),
                    HasSubstr("at most 1048576 a side and 268435456 in all can be used"));
    for (const auto& [width, height] : {std::pair(0, 1), {1, 0}})
        EXPECT_THAT(inputErrorOf([&, w = width, h = height] { charge(w, h); }), HasSubstr("the file is broken"));
}

TEST(HostilePicture, everyKindOfWebpIsChargedBeforeItsReaderReservesIt) {
    for (const char* seed : {"picture/lossy.webp", "picture/lossless.webp", "picture/canvas.webp"}) {
        std::string webp = bytesOfSeed(seed);
        webp.resize(8192);
        EXPECT_THAT(refusalOf(webp, seed, 64 * kMiB),
                    HasSubstr("webp: the picture of 8000x8000 texels: needs 488.3 MiB of memory, and 0 B are"));
    }
}

TEST(HostilePicture, valuesOfTagsThatDecodingDoesNotNeedAreNotCopied) {
    constexpr int kTags = 300, kExif = 34665;
    const std::string shared(kMiB, '\x7f');
    std::vector<TiffEntry> entries = oneTexel(), elsewhere;
    for (int i = 0; i < kTags; ++i) entries.push_back({40000 + i, kByte, kMiB, 0, true});
    const std::string inFirst = tiffOf(entries, shared);
    // The Exif directory follows the texel, and its value follows the directory.
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

/// 16 x 16 grey texels in a tile with these claimed sides, stored as numbers of this type.
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
    EXPECT_THAT(refusalOf(tiff, "a", 64 * kMiB), HasSubstr("a: the picture of 16x16 texels: needs 512.0 MiB"));
    for (const ByteOrder order : {ByteOrder::Little, ByteOrder::Big}) {
        EXPECT_THAT(refusalOf(tiledTiff(kLong, 16384, order), "a", 64 * kMiB), HasSubstr("needs 512.0 MiB"));
        EXPECT_THAT(refusalOf(tiledTiff(kLong, 0xfffffff0, order), "a"), HasSubstr("needs"));
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
    // 64 tiles of 256 cover 16384.
    EXPECT_THAT(refusalOfSide(16383), HasSubstr("a: the picture of 16383x16383 texels: needs 1.2 GiB"));
    EXPECT_THAT(refusalOfSide(16385), HasSubstr("a: the picture has 16385x16385 texels; at most"));
}

TEST(HostilePicture, stripsOfATiffAreChargedWhole) {
    std::vector<TiffEntry> entries = oneTexel();
    entries[0].value = entries[1].value = 8192;
    const auto refusal = [&] { return refusalOf(tiffOf(entries, "\x7f"), "a", 64 * kMiB); };
    EXPECT_THAT(refusal(), HasSubstr("needs 320.0 MiB of memory, and 16.")); // the texels, beside a row
    entries[5].value = 16384;
    EXPECT_THAT(refusal(), HasSubstr("needs 128.0 MiB of memory"));
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
