// Damaged or truncated image files are decoded as far as possible.
#include <cstdio> // jpeglib.h needs it first
#include <random>

#include <jpeglib.h>

#include "base/PictureLibrary.h"
#include "tests/unit/scenes/PictureBytes.h"

namespace tessera::scenes {
namespace {

using namespace test;

constexpr int kNoisySide = 48;

/// 48x48 random texels, which compress badly.
std::vector<std::uint8_t> noise() {
    std::mt19937 random(7);
    std::vector<std::uint8_t> rgb(kNoisySide * kNoisySide * 3);
    for (std::uint8_t& value : rgb) value = std::uint8_t(random() % 256);
    return rgb;
}

std::string noisyJpeg(bool isProgressive) {
    std::vector<std::uint8_t> rgb = noise();
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = jpeg.image_height = kNoisySide;
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    if (isProgressive) jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    for (std::size_t row = 0; row < kNoisySide; ++row) {
        JSAMPLE* texels = rgb.data() + row * kNoisySide * 3;
        jpeg_write_scanlines(&jpeg, &texels, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    const std::string file(reinterpret_cast<const char*>(bytes), size);
    std::free(bytes);
    return file;
}

std::string noisyPng() {
    const std::vector<std::uint8_t> rgb = noise();
    const std::vector<std::uint8_t> file = PictureLibrary::get().encodePng(kNoisySide, kNoisySide, rgb.data());
    return {file.begin(), file.end()};
}

/// Returns where the check sum of the only IDAT chunk begins.
std::size_t endOfTexels(const std::string& png) {
    const std::size_t name = png.find("IDAT");
    std::uint32_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | std::uint8_t(png[name - 4 + i]);
    EXPECT_EQ(png.substr(name + 4 + length + 8, 4), "IEND");
    return name + 4 + length;
}

struct LenientRead {
    Image image;
    std::vector<std::string> warnings;
};

LenientRead readLeniently(const std::string& bytes, const std::string& name) {
    LoadLedger ledger;
    LenientRead result;
    result.image = decodeImage(std::as_bytes(std::span(bytes)), name, ledger);
    result.warnings = ledger.takeWarnings();
    return result;
}

std::string strictRefusalOf(const std::string& bytes, const std::string& name) {
    LoadLedger ledger({}, strictly());
    return inputErrorOf([&] { decodeImage(std::as_bytes(std::span(bytes)), name, ledger); });
}

/// Returns the number of equal rows, from the top, of two images of one size.
int sameRows(const Image& a, const Image& b) {
    EXPECT_EQ(a.texels.size(), b.texels.size());
    const std::size_t rowBytes = a.texels.size() / std::size_t(a.height);
    int rows = 0;
    while (rows < a.height && std::equal(a.texels.begin() + std::ptrdiff_t(std::size_t(rows) * rowBytes),
                                         a.texels.begin() + std::ptrdiff_t(std::size_t(rows + 1) * rowBytes),
                                         b.texels.begin() + std::ptrdiff_t(std::size_t(rows) * rowBytes)))
        ++rows;
    return rows;
}

void expectOneWarning(const LenientRead& broken, const std::string& bytes, const std::string& name) {
    EXPECT_THAT(broken.warnings,
                ElementsAre(testing::AllOf(HasSubstr(name + ": the "), HasSubstr(" picture is broken or cut short ("),
                                           HasSubstr("); drawn as far as it can be read"))));
    EXPECT_THAT(strictRefusalOf(bytes, name), HasSubstr("; save it again"));
}

TEST(BrokenPictures, aPngWithAllItsTexelsIsDrawnWhole) {
    const std::string png = noisyPng();
    const std::size_t end = endOfTexels(png);
    const LenientRead whole = readLeniently(png, "a.png");
    EXPECT_THAT(whole.warnings, IsEmpty());
    const std::string noEnd = png.substr(0, end + 4);
    std::string wrongCrc = png, wrongSum = png, noCrc = png.substr(0, end);
    wrongCrc[end] = char(~wrongCrc[end]);
    wrongSum[end - 1] = char(~wrongSum[end - 1]); // the check sum of zlib
    const std::size_t name = png.find("IDAT");
    wrongSum.replace(end, 4, numberText(crcOf(wrongSum.substr(name, end - name)), 4, ByteOrder::Big));
    for (const std::string& broken : {noEnd, wrongCrc, wrongSum, noCrc}) {
        const LenientRead result = readLeniently(broken, "a.png");
        EXPECT_EQ(sameRows(result.image, whole.image), kNoisySide);
        expectOneWarning(result, broken, "a.png");
    }
}

TEST(BrokenPictures, aPngThatIsCutShortIsDrawnUpToThere) {
    const std::string png = noisyPng();
    const LenientRead whole = readLeniently(png, "a.png");
    const std::size_t first = png.find("IDAT") + 4, texels = endOfTexels(png) - first;
    const std::string half = png.substr(0, first + texels / 2);
    const LenientRead result = readLeniently(half, "a.png");
    EXPECT_NEAR(sameRows(result.image, whole.image), kNoisySide / 2, 1);
    EXPECT_EQ(result.image.texels.back(), std::byte{0}) << "transparent below";
    expectOneWarning(result, half, "a.png");
    std::string damaged = png;
    damaged.replace(first + texels / 2, 40, 40, '\xff');
    expectOneWarning(readLeniently(damaged, "a.png"), damaged, "a.png");
    EXPECT_THAT(refusalOf(png.substr(0, first + 8), "a.png"), HasSubstr("cut short")) << "it has no row";
    EXPECT_THAT(refusalOf(png.substr(0, 20), "a.png"), HasSubstr("cut short"));
}

TEST(BrokenPictures, aJpegThatIsCutShortIsDrawnUpToThere) {
    for (const bool isProgressive : {false, true}) {
        const std::string jpeg = noisyJpeg(isProgressive);
        const LenientRead whole = readLeniently(jpeg, "a.jpg");
        EXPECT_THAT(whole.warnings, IsEmpty());
        const LenientRead noEnd = readLeniently(jpeg.substr(0, jpeg.size() - 2), "a.jpg");
        EXPECT_THAT(noEnd.warnings, IsEmpty());
        EXPECT_EQ(noEnd.image.texels, whole.image.texels);
        // Half of the data after the header of the first scan.
        const std::size_t scan = jpeg.find("\xff\xda");
        ASSERT_NE(scan, std::string::npos);
        const std::string cut = jpeg.substr(0, scan + 2 + (jpeg.size() - scan) / 2);
        const LenientRead result = readLeniently(cut, "a.jpg");
        if (!isProgressive) {
            EXPECT_NEAR(sameRows(result.image, whole.image), kNoisySide / 2, 16);
        }
        EXPECT_EQ(result.image.texels.back(), std::byte{0xff});
        expectOneWarning(result, cut, "a.jpg");
        EXPECT_THAT(refusalOf(jpeg.substr(0, scan), "a.jpg"), HasSubstr("cut short"));
    }
}

TEST(BrokenPictures, noCutOfAFileEndsTheProgram) {
    for (const std::string& file : {noisyPng(), bytesOfSeed("picture/palette.png"), noisyJpeg(false), noisyJpeg(true),
                                    bytesOfSeed("picture/small.hdr")})
        for (std::size_t size = 1; size < file.size(); size += 1 + file.size() / 200) {
            try {
                const LenientRead result = readLeniently(file.substr(0, size), "a.hdr");
                EXPECT_EQ(result.image.texels.size(), std::size_t(result.image.width) *
                                                          std::size_t(result.image.height) *
                                                          texelBytes(result.image.format));
            } catch (const InputError& error) {
                EXPECT_THAT(error.what(), HasSubstr("a.hdr: "));
            }
        }
}

} // namespace
} // namespace tessera::scenes
