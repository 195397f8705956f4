#include <webp/encode.h>

#include "GltfBuilder.h"
#include "base/PictureLibrary.h"
#include "tests/support/TempFolder.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/scenes/PictureBytes.h"

namespace tessera::scenes::gltf::test {
namespace {

using scenes::test::pngOf;
using scenes::test::storedTexels;

const std::string kRgb = pngOf(1, 1, 8, 2, "\x01\x02\x03");

/// The advice that ends every refusal.
const std::string kConvert = "; convert the picture to png, jpeg, openexr, hdr, pfm, tiff, webp, bmp, gif or tga";

using Texels8 = std::vector<std::uint8_t>;

Image decoded(const Bytes& bytes, const std::string& name) {
    LoadLedger ledger;
    return decodeImage(bytes, name, ledger);
}

std::string decodeError(const Bytes& bytes, const std::string& name) {
    return scenes::test::inputErrorOf([&] { decoded(bytes, name); });
}

TEST(Image, greyIsReplicatedAndMissingAlphaIsOne) {
    EXPECT_EQ(storedTexels<std::uint8_t>(decoded(bytesOf(pngOf(2, 1, 8, 0, "\x07\xc8")), "grey")),
              (Texels8{7, 7, 7, 255, 200, 200, 200, 255}));
    EXPECT_EQ(storedTexels<std::uint8_t>(decoded(bytesOf(pngOf(1, 1, 8, 4, "\x09\x4d")), "grey")),
              (Texels8{9, 9, 9, 77}));
    EXPECT_EQ(storedTexels<std::uint8_t>(decoded(bytesOf(kRgb), "rgb")), (Texels8{1, 2, 3, 255}));
}

TEST(Image, colorIsNotMultipliedByAlpha) {
    const Image image = decoded(pngRedBlue(), "red and blue");
    EXPECT_EQ(image.format, TexelFormat::Rgba8Unorm);
    EXPECT_EQ(image.width, 2);
    EXPECT_EQ(image.height, 1);
    EXPECT_EQ(storedTexels<std::uint8_t>(image), (Texels8{255, 0, 0, 255, 10, 20, 200, 128}));
}

TEST(Image, colorsOfWebpAreNotMultipliedByAlpha) {
    const Texels8 rgba{255, 188, 0, 128, 255, 188, 0, 1, 255, 188, 0, 255, 10, 20, 200, 77};
    std::uint8_t* file = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), 2, 2, 8, &file);
    const std::span stored = std::as_bytes(std::span(file, size));
    const Bytes bytes(stored.begin(), stored.end());
    WebPFree(file);
    EXPECT_EQ(storedTexels<std::uint8_t>(decoded(bytes, "leaf.webp")), rgba);
}

/// OpenEXR multiplies colours by alpha (Technical Introduction to OpenEXR, "Alpha"), glTF does not.
TEST(Image, colorsOfExrAreDividedByAlphaInTexturesAlone) {
    const tessera::test::TempFolder folder;
    const float rgba[] = {0.5f, 0.25f, 0.125f, 0.25f, 3.0f, 2.0f, 1.0f, 0.0f};
    const std::vector<std::uint8_t> file = PictureLibrary::get().encodeExr(2, 1, rgba);
    const std::filesystem::path path = folder.write("leaf.exr", std::string(file.begin(), file.end()));
    LoadLedger ledger;
    EXPECT_EQ(storedTexels<float>(readImage(path, ledger)), (std::vector<float>{2, 1, 0.5f, 0.25f, 3, 2, 1, 0}));
    EXPECT_EQ(storedTexels<float>(readPicture(path, ledger).image),
              (std::vector<float>{0.5f, 0.25f, 0.125f, 0.25f, 3, 2, 1, 0}));
}

TEST(Image, sixteenBitsAreKept) {
    const Image image = decoded(bytesOf(pngOf(1, 1, 16, 2, "\x03\xe8\x07\xd0\xff\xff")), "deep");
    EXPECT_EQ(image.format, TexelFormat::Rgba16Unorm);
    EXPECT_EQ(storedTexels<std::uint16_t>(image), (std::vector<std::uint16_t>{1000, 2000, 65535, 65535}));
}

TEST(Image, radianceIsReadExactlyAsFloat) {
    const Image image = decoded(bytesOf("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x40\x20\x82"), "sky");
    EXPECT_EQ(image.format, TexelFormat::Rgba32Float);
    const std::vector<float> texels = storedTexels<float>(image);
    ASSERT_EQ(texels.size(), 4u);
    // RGBE has an 8-bit mantissa; some readers add half a step, 2^-7 here.
    EXPECT_NEAR(texels[0], 2.0f, 0.01f);
    EXPECT_NEAR(texels[1], 1.0f, 0.01f);
    EXPECT_NEAR(texels[2], 0.5f, 0.01f);
    EXPECT_EQ(texels[3], 1.0f);
}

TEST(Image, rowsStartAtTheTop) {
    const Folder folder;
    // Lower row 10, 20, 30, upper row 40, 50, 60.
    const std::string tga("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\2\0\x18\0\x1e\x14\x0a\x3c\x32\x28", 24);
    const Image image = underLedger(readImage, folder.write("two rows.tga", tga));
    EXPECT_EQ(storedTexels<std::uint8_t>(image), (Texels8{40, 50, 60, 255, 10, 20, 30, 255}));
}

TEST(Image, formatIsFoundByContentBeforeExtension) {
    const Folder folder;
    EXPECT_EQ(underLedger(readImage, folder.write("wrong.jpg", bytesOf(kRgb))).width, 1);
    EXPECT_EQ(underLedger(readImage, folder.write("none", bytesOf(kRgb))).width, 1);
}

TEST(Image, unusablePicturesAreRefusedByName) {
    EXPECT_EQ(decodeError({}, "a.png"), "a.png: the picture is empty (0 bytes); save it again");
    EXPECT_EQ(decodeError(bytesOf("abc"), "thing"), "thing: is in no known picture format" + kConvert);
    const std::string ktx2 = "\xabKTX 20\xbb\r\n\x1a\n";
    EXPECT_EQ(decodeError(bytesOf(ktx2), "t"), "t: the picture format ktx2 is not supported" + kConvert);
    EXPECT_EQ(decodeError(bytesOf("abc"), "a.nonsense"),
              "a.nonsense: the picture format nonsense is not supported" + kConvert);
    Bytes cut = pngRedBlue();
    cut.resize(45); // inside the texels
    EXPECT_THAT(decodeError(cut, "cut.png"), HasSubstr("cut.png: the png picture is broken or cut short"));
    cut.resize(20); // inside the header
    EXPECT_THAT(decodeError(cut, "cut.png"), HasSubstr("cut.png: the png picture is broken or cut short"));
    EXPECT_THAT(decodeError(bytesOf(pngOf(1, 1, 8, 6, std::string(4, '\0'), 16000)), "huge.png"),
                HasSubstr("the header claims 16000x16000 texels, more than"));
    EXPECT_THROW(underLedger(readImage, "/nowhere/at/all.png"), InputError);
}

TEST(Image, paletteIndicesBeyondThePaletteAreNotReadPastIt) {
    // Four colours, and texels of four bytes that refer to colours far beyond them.
    std::vector<std::uint8_t> tga{0, 1, 1, 0, 0, 4, 0, 24, 0, 0, 0, 0, 2, 0, 2, 0, 32, 0};
    tga.insert(tga.end(), 12, 7);
    tga.insert(tga.end(), 16, 0x7f);
    std::vector<std::uint8_t> bmp{'B', 'M', 0, 0, 0, 0, 0, 0, 0, 0, 58, 0, 0, 0, 40,
                                  0,   0,   0, 1, 0, 0, 0, 1, 0, 0, 0,  1, 0, 8, 0};
    bmp.resize(46, 0);
    bmp.insert(bmp.end(), {1, 0, 0, 0, 0, 0, 0, 0}); // one colour
    bmp.insert(bmp.end(), {9, 9, 9, 0, 255, 255, 255, 255});
    EXPECT_EQ(decodeError(bytesOf(tga), "a.tga"),
              "a.tga: the tga picture is broken or cut short (unknown image type); save it again");
    const Texels8 texel = storedTexels<std::uint8_t>(decoded(bytesOf(bmp), "a.bmp"));
    ASSERT_EQ(texel.size(), 4u); // a colour that stb_image leaves unset
    EXPECT_EQ(texel[3], 255);
}

TEST(Image, readersOfOtherFormatsAreNotTried) {
    const Folder folder;
    // "null" makes images from nothing, "mp4" opens films, and the readers of IFF and DPX crash on broken files.
    for (const char* extension : {"null", "mp4", "raw", "vdb", "iff", "dpx", "cin", "psd", "jp2", "ptx", "txt"}) {
        const std::string name = std::string("a.") + extension;
        const std::string error = decodeError(bytesOf(std::vector<char>{'F', 'O', 'R', '4', 0, 0}), name);
        EXPECT_EQ(error, name + ": the picture format " + extension + " is not supported" + kConvert);
    }
    const std::string psd = "8BPS";
    EXPECT_THAT(decodeError(bytesOf(psd), "a.png"), HasSubstr("format psd is not"));
    for (const char* misnamed : {"a.png", "a.jpg", "a.exr", "a.gif"})
        EXPECT_THAT(decodeError(bytesOf("no"), misnamed), HasSubstr("is in no known picture format"));
}

} // namespace
} // namespace tessera::scenes::gltf::test
