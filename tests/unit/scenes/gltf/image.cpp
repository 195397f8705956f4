#include <gtest/gtest.h>
#include <webp/encode.h>

#include "GltfBuilder.h"
#include "base/PictureLibrary.h"
#include "tests/support/TempFolder.h"
#include "tests/support/UnderLedger.h"

namespace tessera::scenes::gltf::test {
namespace {

const std::vector<unsigned char> kGrey /* 7, 200 */ = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
    0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x01, 0x08, 0x00, 0x00, 0x00, 0x00, 0xd1, 0x49, 0x20, 0x56, 0x00,
    0x00, 0x00, 0x0b, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x60, 0x3f, 0x01, 0x00, 0x00, 0xd9, 0x00,
    0xd0, 0xd7, 0xa6, 0x22, 0x3c, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
const std::vector<unsigned char> kGreyAlpha /* 9, alpha 77 */ = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00,
    0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x04, 0x00, 0x00, 0x00, 0xb5, 0x1c, 0x0c, 0x02, 0x00,
    0x00, 0x00, 0x0b, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0xe0, 0xf4, 0x05, 0x00, 0x00, 0x62, 0x00,
    0x57, 0x6b, 0xc1, 0x29, 0xf3, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
const std::vector<unsigned char> kRgb /* 1, 2, 3 */ = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
    0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00, 0x00, 0x90, 0x77, 0x53, 0xde, 0x00, 0x00, 0x00,
    0x0c, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x60, 0x64, 0x62, 0x06, 0x00, 0x00, 0x0e, 0x00, 0x07, 0xd7,
    0x6f, 0xe4, 0x78, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
const std::vector<unsigned char> kRgb16 /* 1000, 2000, 65535 */ = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
    0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x10, 0x02, 0x00, 0x00, 0x00, 0xc0, 0xe7, 0x8f, 0x9d, 0x00, 0x00, 0x00,
    0x0f, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x60, 0x7e, 0xc1, 0x7e, 0xe1, 0xff, 0x7f, 0x00, 0x0a, 0x2a,
    0x03, 0xc1, 0x1a, 0x3d, 0xed, 0xf9, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
const std::vector<unsigned char> kHugeClaim /* says 16000 x 16000 */ = {
    0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52, 0x00, 0x00,
    0x3e, 0x80, 0x00, 0x00, 0x3e, 0x80, 0x08, 0x06, 0x00, 0x00, 0x00, 0x41, 0x7e, 0xdf, 0xde, 0x00, 0x00, 0x00,
    0x0c, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x60, 0xa0, 0x3d, 0x00, 0x00, 0x00, 0x64, 0x00, 0x01, 0x86,
    0x64, 0x3c, 0x35, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
const std::vector<unsigned char> kHdr /* (128, 64, 32) x 2^(130 - 136) */ = {
    0x23, 0x3f, 0x52, 0x41, 0x44, 0x49, 0x41, 0x4e, 0x43, 0x45, 0x0a, 0x46, 0x4f, 0x52, 0x4d, 0x41, 0x54,
    0x3d, 0x33, 0x32, 0x2d, 0x62, 0x69, 0x74, 0x5f, 0x72, 0x6c, 0x65, 0x5f, 0x72, 0x67, 0x62, 0x65, 0x0a,
    0x0a, 0x2d, 0x59, 0x20, 0x31, 0x20, 0x2b, 0x58, 0x20, 0x31, 0x0a, 0x80, 0x40, 0x20, 0x82};
const std::vector<unsigned char> kTga /* lower row 10, 20, 30, upper row 40, 50, 60 */ = {
    0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x01, 0x00, 0x02, 0x00, 0x18, 0x00, 0x1e, 0x14, 0x0a, 0x3c, 0x32, 0x28};

template <typename T>
std::vector<T> texelsOf(const Image& image) {
    std::vector<T> texels(image.texels.size() / sizeof(T));
    std::memcpy(texels.data(), image.texels.data(), image.texels.size());
    return texels;
}

/// What every refused picture may be converted to.
const std::string kConvert = "; convert the picture to png, jpeg, openexr, hdr, pfm, tiff, webp, bmp, gif or tga";

using Texels8 = std::vector<std::uint8_t>;

Image decoded(const Bytes& bytes, const std::string& name) {
    LoadLedger ledger;
    return decodeImage(bytes, name, ledger);
}

std::string decodeError(const Bytes& bytes, const std::string& name) {
    try {
        decoded(bytes, name);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Image, greyIsReplicatedAndMissingAlphaIsOne) {
    EXPECT_EQ(texelsOf<std::uint8_t>(decoded(bytesOf(kGrey), "grey")), (Texels8{7, 7, 7, 255, 200, 200, 200, 255}));
    EXPECT_EQ(texelsOf<std::uint8_t>(decoded(bytesOf(kGreyAlpha), "grey")), (Texels8{9, 9, 9, 77}));
    EXPECT_EQ(texelsOf<std::uint8_t>(decoded(bytesOf(kRgb), "rgb")), (Texels8{1, 2, 3, 255}));
}

TEST(Image, colorIsNotMultipliedByAlpha) {
    const Image image = decoded(pngRedBlue(), "red and blue");
    EXPECT_EQ(image.format, TexelFormat::Rgba8Unorm);
    EXPECT_EQ(image.width, 2);
    EXPECT_EQ(image.height, 1);
    EXPECT_EQ(texelsOf<std::uint8_t>(image), (Texels8{255, 0, 0, 255, 10, 20, 200, 128}));
}

TEST(Image, colorsOfWebpAreNotMultipliedByAlpha) {
    const Texels8 rgba{255, 188, 0, 128, 255, 188, 0, 1, 255, 188, 0, 255, 10, 20, 200, 77};
    std::uint8_t* file = nullptr;
    const std::size_t size = WebPEncodeLosslessRGBA(rgba.data(), 2, 2, 8, &file);
    const std::span stored = std::as_bytes(std::span(file, size));
    const Bytes bytes(stored.begin(), stored.end());
    WebPFree(file);
    EXPECT_EQ(texelsOf<std::uint8_t>(decoded(bytes, "leaf.webp")), rgba);
}

/// OpenEXR multiplies colours by alpha (Technical Introduction to OpenEXR, "Alpha"), glTF does not.
TEST(Image, colorsOfExrAreDividedByAlphaInTexturesAlone) {
    const tessera::test::TempFolder folder;
    const float rgba[] = {0.5f, 0.25f, 0.125f, 0.25f, 3.0f, 2.0f, 1.0f, 0.0f};
    const std::vector<std::uint8_t> file = PictureLibrary::get().encodeExr(2, 1, rgba);
    const std::filesystem::path path = folder.write("leaf.exr", std::string(file.begin(), file.end()));
    LoadLedger ledger;
    EXPECT_EQ(texelsOf<float>(readImage(path, ledger)), (std::vector<float>{2, 1, 0.5f, 0.25f, 3, 2, 1, 0}));
    EXPECT_EQ(texelsOf<float>(readPicture(path, ledger).image),
              (std::vector<float>{0.5f, 0.25f, 0.125f, 0.25f, 3, 2, 1, 0}));
}

TEST(Image, sixteenBitsAreKept) {
    const Image image = decoded(bytesOf(kRgb16), "deep");
    EXPECT_EQ(image.format, TexelFormat::Rgba16Unorm);
    EXPECT_EQ(texelsOf<std::uint16_t>(image), (std::vector<std::uint16_t>{1000, 2000, 65535, 65535}));
}

TEST(Image, radianceIsReadExactlyAsFloat) {
    const Image image = decoded(bytesOf(kHdr), "sky");
    EXPECT_EQ(image.format, TexelFormat::Rgba32Float);
    const std::vector<float> texels = texelsOf<float>(image);
    ASSERT_EQ(texels.size(), 4u);
    // RGBE has an 8-bit mantissa; some readers add half a step, 2^-7 here.
    EXPECT_NEAR(texels[0], 2.0f, 0.01f);
    EXPECT_NEAR(texels[1], 1.0f, 0.01f);
    EXPECT_NEAR(texels[2], 0.5f, 0.01f);
    EXPECT_EQ(texels[3], 1.0f);
}

TEST(Image, rowsStartAtTheTop) {
    const Folder folder;
    const Image image = underLedger(readImage, folder.write("two rows.tga", bytesOf(kTga)));
    EXPECT_EQ(texelsOf<std::uint8_t>(image), (Texels8{40, 50, 60, 255, 10, 20, 30, 255}));
}

TEST(Image, formatIsFoundByContentBeforeExtension) {
    const Folder folder;
    EXPECT_EQ(underLedger(readImage, folder.write("wrong.jpg", bytesOf(kRgb))).width, 1);
    EXPECT_EQ(underLedger(readImage, folder.write("none", bytesOf(kRgb))).width, 1);
}

TEST(Image, unusablePicturesAreRefusedByName) {
    EXPECT_EQ(decodeError({}, "a.png"), "a.png: the picture is empty (0 bytes); save it again");
    EXPECT_EQ(decodeError(bytesOf(std::vector<char>{'a', 'b', 'c'}), "thing"),
              "thing: is in no known picture format" + kConvert);
    const std::string ktx2 = "\xabKTX 20\xbb\r\n\x1a\n";
    EXPECT_EQ(decodeError(bytesOf(std::vector<char>(ktx2.begin(), ktx2.end())), "t"),
              "t: the picture format ktx2 is not supported" + kConvert);
    EXPECT_EQ(decodeError(bytesOf(std::vector<char>{'a', 'b', 'c'}), "a.nonsense"),
              "a.nonsense: the picture format nonsense is not supported" + kConvert);
    Bytes cut = pngRedBlue();
    cut.resize(45); // inside the texels
    EXPECT_NE(decodeError(cut, "cut.png").find("cut.png: the png picture is broken or cut short"), std::string::npos);
    cut.resize(20); // inside the header
    EXPECT_NE(decodeError(cut, "cut.png").find("cut.png: the png picture is broken or cut short"), std::string::npos);
    EXPECT_NE(decodeError(bytesOf(kHugeClaim), "huge.png").find("the header claims 16000x16000 texels, more than"),
              std::string::npos);
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
    const Texels8 texel = texelsOf<std::uint8_t>(decoded(bytesOf(bmp), "a.bmp"));
    ASSERT_EQ(texel.size(), 4u); // of a colour that stb_image does not set
    EXPECT_EQ(texel[3], 255);
}

TEST(Image, readersOfOtherFormatsAreNotAsked) {
    const Folder folder;
    // "null" makes pictures of nothing, "mp4" opens films, and those of IFF and DPX crash on what is broken.
    for (const char* extension : {"null", "mp4", "raw", "vdb", "iff", "dpx", "cin", "psd", "jp2", "ptx", "txt"}) {
        const std::string name = std::string("a.") + extension;
        const std::string error = decodeError(bytesOf(std::vector<char>{'F', 'O', 'R', '4', 0, 0}), name);
        EXPECT_EQ(error, name + ": the picture format " + extension + " is not supported" + kConvert);
    }
    const std::string psd = "8BPS";
    EXPECT_NE(decodeError(bytesOf(std::vector<char>(psd.begin(), psd.end())), "a.png").find("format psd is not"),
              std::string::npos);
    for (const char* misnamed : {"a.png", "a.jpg", "a.exr", "a.gif"})
        EXPECT_NE(decodeError(bytesOf(std::vector<char>{'n', 'o'}), misnamed).find("is in no known picture format"),
                  std::string::npos);
}

} // namespace
} // namespace tessera::scenes::gltf::test
