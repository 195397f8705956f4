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

TEST(HostilePicture, nothingIsEverReadBeforeTheBeginningOfAnExr) {
    // Its table says that a line begins at 2^64 - 1, which OpenImageIO takes for -1.
    EXPECT_THAT(refusalOf(bytesOfSeed("picture/line_offset.exr"), "a"),
                HasSubstr("Unexpected end of file); save it again"));
}

TEST(HostilePicture, whatOpenImageIoLacksIsNeverTakenForABrokenPicture) {
    const auto failureOf = [](const char* format) {
        LoadLedger ledger;
        try {
            decodeByOiio({}, "a", PictureFormat{format, {}, {}, decodeByOiio, nullptr}, ledger);
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

TEST(HostilePicture, aProgressiveJpegIsAlwaysChargedBeforeItsReaderReservesIt) {
    std::string jpeg = bytesOfSeed("picture/progressive.jpg"); // 4000 x 4000 texels, none of which it holds
    EXPECT_LT(growthOf([&] { EXPECT_THAT(refusalOf(jpeg, "a"), HasSubstr("claims 4000x4000 texels")); }), 8 * kMiB);
    jpeg.resize(4096); // what may hold them
    EXPECT_LT(growthOf([&] {
                  EXPECT_THAT(refusalOf(jpeg, "a", 64 * kMiB),
                              HasSubstr("a: the picture of 4000x4000 texels: asks for 91.6 MiB"));
              }),
              8 * kMiB);
}

TEST(HostilePicture, theCopyThatAReaderHoldsIsAlwaysChargedWithTheTexels) {
    std::string jpeg = bytesOfSeed("picture/progressive.jpg");
    jpeg.resize(4096);
    // 6 bytes a texel are coefficients, 3 are handed over, 4 are kept.
    EXPECT_THAT(refusalOf(jpeg, "a", 128 * kMiB), HasSubstr("asks for 106.8 MiB of memory, and 91.6 MiB are in use"));
}

TEST(HostilePicture, scansOfAJpegAreAlwaysBounded) {
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

TEST(HostilePicture, everyKindOfWebpIsAlwaysChargedBeforeItsReaderReservesIt) {
    for (const char* seed : {"picture/lossy.webp", "picture/lossless.webp", "picture/canvas.webp"}) {
        std::string webp = bytesOfSeed(seed);
        webp.resize(8192);
        EXPECT_THAT(refusalOf(webp, seed, 64 * kMiB),
                    HasSubstr("webp: the picture of 8000x8000 texels: asks for 488.3 MiB of memory, and 0 B are"));
    }
}

/// A TIFF of one grey texel whose XMP description is this.
std::string tiffOf(const std::string& xmp) {
    std::string tiff("II*\0\x08\0\0\0\x08\0", 10);
    const auto entry = [&](int tag, int type, std::uint32_t count, std::uint32_t value) {
        for (const std::uint32_t half : {std::uint32_t(tag), std::uint32_t(type)})
            tiff += {char(half), char(half >> 8)};
        for (const std::uint32_t word : {count, value})
            for (int byte = 0; byte < 4; ++byte) tiff += char(word >> (8 * byte));
    };
    constexpr std::uint32_t kEnd = 10 + 8 * 12 + 4;
    for (const int tag : {256, 257}) entry(tag, 3, 1, 1); // one by one
    entry(258, 3, 1, 8);
    entry(262, 3, 1, 1);
    entry(273, 4, 1, kEnd);
    entry(278, 3, 1, 1);
    entry(279, 4, 1, 1);
    entry(700, 1, std::uint32_t(xmp.size()), kEnd + 1);
    return tiff + std::string(4, '\0') + '\x7f' + xmp;
}

TEST(HostilePicture, theDescriptionOfATiffNeverNestsDeeperThanItsReaderCanFollow) {
    const auto nested = [](int levels, const std::string& between) {
        std::string xmp = "<rdf:RDF><rdf:Description>";
        for (int i = 0; i < levels; ++i) xmp += "<a>" + between;
        for (int i = 0; i < levels; ++i) xmp += "</a>";
        return tiffOf(xmp + "</rdf:Description></rdf:RDF>");
    };
    EXPECT_EQ(decoded(nested(100, ""), "a").texels[0], std::byte{0x7f});
    // What looks like an end and is none hides nothing.
    for (const char* between : {"", "<!--</a>-->", "<![CDATA[</a>]]>", "<?</a>?>", "<b c='</a>'/>", "<b c=\"/>\"></b>"})
        EXPECT_THAT(refusalOf(nested(50000, between), "a"), HasSubstr("its XMP description nests more than 256 deep"));
    EXPECT_THAT(refusalOf(tiffOf("<!DOCTYPE a [</a></a></a>]><a>"), "a"), HasSubstr("nests more than 256 deep"));
}

TEST(HostilePicture, tilesOfATiffAreAlwaysChargedWhole) {
    const std::string tiff = bytesOfSeed("picture/large_tiles.tif"); // 16 x 16 texels in a tile of 16384 x 16384
    EXPECT_THAT(refusalOf(tiff, "a", 64 * kMiB), HasSubstr("the header claims 16384x16384 texels"));
}

TEST(HostilePicture, aBmpThatBeginsAtItsTopIsRead) {
    std::string bmp = bytesOfSeed("picture/small.bmp");
    const Image fromBottom = decoded(bmp, "a");
    for (int i = 0; i < 4; ++i) bmp[std::size_t(22 + i)] = char(std::uint32_t(-fromBottom.height) >> (8 * i));
    const Image fromTop = decoded(bmp, "a");
    ASSERT_EQ(fromTop.height, fromBottom.height);
    const auto row = std::ptrdiff_t(4 * fromTop.width);
    EXPECT_TRUE(std::equal(fromTop.texels.begin(), fromTop.texels.begin() + row, fromBottom.texels.end() - row));
}

TEST(HostilePicture, textsOfAPngAreNeverKept) {
    // One compressed text of 7.9 MB, and nine copies of it.
    std::string png = bytesOfSeed("picture/text.png");
    constexpr std::size_t kHeaderEnd = 33;
    const std::string text = png.substr(kHeaderEnd, png.find("IDAT") - 4 - kHeaderEnd);
    for (int i = 0; i < 9; ++i) png.insert(kHeaderEnd, text);
    EXPECT_LT(growthOf([&] { EXPECT_EQ(decoded(png, "a").width, 1); }), 4 * kMiB);
}

TEST(HostilePicture, whatAPngSaysOfItsNumbersIsAlwaysRead) {
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

TEST(HostilePicture, aBmpOrTgaThatEndsEarlyIsAlwaysRefused) {
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

TEST(HostilePicture, aTgaWithMoreBehindItsTexelsIsAlwaysRead) {
    // More than stb_image reads ahead, and lines longer than that.
    std::string tga = bytesOfSeed("tga/rgba.tga").substr(0, 18);
    tga[12] = 100;
    tga.append(2 * 100 * 4, '\x7f');
    EXPECT_EQ(decoded(tga, "a.tga").texels, std::vector<std::byte>(800, std::byte{0x7f}));
    EXPECT_EQ(decoded(tga + std::string(300, 'x'), "a.tga").texels, std::vector<std::byte>(800, std::byte{0x7f}));
    EXPECT_THAT(refusalOf(tga.substr(0, tga.size() - 1), "a.tga"), HasSubstr("the file ends early"));
}

TEST(HostilePicture, whatAnExrIsShownInIsNeverTakenForItsSize) {
    std::string exr = bytesOfSeed("picture/small.exr");
    const std::size_t most = exr.find("displayWindow") + 14 + 6 + 4 + 8;
    exr.replace(most, 8, "\x3f\x9c\0\0\x3f\x9c\0\0", 8); // to 39999, 39999
    EXPECT_EQ(decoded(exr, "a").width, 4);
}

} // namespace
} // namespace tessera::scenes
