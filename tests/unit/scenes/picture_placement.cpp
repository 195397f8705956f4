// Placement of a file's texels in its image, and factors by which they were multiplied.
#include <cmath>
#include <cstring>

#include "base/PictureLibrary.h"
#include "scenes/Environment.h"
#include "tests/unit/scenes/PictureBytes.h"

namespace tessera::scenes {
namespace {

using namespace test;

/// A Radiance image of grey texels, the powers of 2 with these exponents.
std::string hdrOf(const std::string& resolution, const std::vector<int>& exponents, const std::string& lines = "") {
    std::string file = "#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n";
    for (const int exponent : exponents) file += std::string(3, '\x80') + char(129 + exponent);
    return file;
}

/// Exponents of the red values, without the half step, 2^-8, that OpenImageIO adds.
std::vector<int> exponentsOf(const Image& image) {
    std::vector<int> exponents;
    const std::vector<float> texels = storedTexels<float>(image);
    for (std::size_t at = 0; at < texels.size(); at += 4) exponents.push_back(int(std::lround(std::log2(texels[at]))));
    return exponents;
}

/// Source: Ward, "Radiance File Formats": the first axis crosses scanlines, and Y points up.
TEST(PicturePlacement, theEightOrientationsOfRadiancePicturesAreTurnedUpright) {
    const struct {
        const char* resolution;
        std::vector<int> stored;
    } files[] = {
        {"-Y 2 +X 3", {0, 1, 2, 3, 4, 5}}, {"-Y 2 -X 3", {2, 1, 0, 5, 4, 3}}, {"+Y 2 -X 3", {5, 4, 3, 2, 1, 0}},
        {"+Y 2 +X 3", {3, 4, 5, 0, 1, 2}}, {"+X 3 -Y 2", {0, 3, 1, 4, 2, 5}}, {"+X 3 +Y 2", {3, 0, 4, 1, 5, 2}},
        {"-X 3 -Y 2", {2, 5, 1, 4, 0, 3}}, {"-X 3 +Y 2", {5, 2, 4, 1, 3, 0}},
    };
    for (const auto& file : files) {
        const Image image = decoded(hdrOf(file.resolution, file.stored), "sky.hdr");
        EXPECT_EQ(image.width, 3) << file.resolution;
        EXPECT_EQ(image.height, 2) << file.resolution;
        EXPECT_THAT(exponentsOf(image), ElementsAre(0, 1, 2, 3, 4, 5)) << file.resolution;
    }
}

TEST(PicturePlacement, radianceIsDividedByEveryExposureAndColourCorrection) {
    const std::string lines = "EXPOSURE=2\nEXPOSURE= 4.0\n\tEXPOSURE=1000\nCOLORCORR=1 2 0.5\n";
    const std::vector<float> texels = storedTexels<float>(decoded(hdrOf("-Y 1 +X 1", {3}, lines), "sky.hdr"));
    EXPECT_NEAR(texels[0], 1.0f, 0.01f);
    EXPECT_NEAR(texels[1], 0.5f, 0.01f);
    EXPECT_NEAR(texels[2], 2.0f, 0.02f);
    EXPECT_EQ(texels[3], 1.0f);
}

TEST(PicturePlacement, anExposureThatIsNoFactorIsTakenAsOne) {
    for (const char* line :
         {"EXPOSURE=0", "EXPOSURE=-1", "EXPOSURE=nan", "EXPOSURE=inf", "EXPOSURE=", "COLORCORR=1 2"}) {
        const std::string file = hdrOf("-Y 1 +X 1", {3}, std::string(line) + "\n");
        LoadLedger ledger, strict({}, strictly());
        const std::span bytes = std::as_bytes(std::span(file));
        EXPECT_NEAR(storedTexels<float>(decodeImage(bytes, "sky.hdr", ledger))[1], 8.0f, 0.1f) << line;
        EXPECT_THAT(ledger.takeWarnings(),
                    ElementsAre("sky.hdr: '" + std::string(line) + "' of its header is no factor above 0; taken as 1"));
        EXPECT_THAT(inputErrorOf([&] { decodeImage(bytes, "sky.hdr", strict); }), HasSubstr("no factor above 0"));
    }
}

TEST(PicturePlacement, radianceAsXyzBecomesRedGreenAndBlue) {
    // X = Y = Z, so that these are the sums of the rows of IEC 61966-2-1's matrix.
    std::string file = hdrOf("-Y 1 +X 1", {0});
    const float stored = storedTexels<float>(decoded(file, "sky.hdr"))[0];
    file.replace(file.find("rgbe"), 4, "xyze");
    const std::vector<float> texels = storedTexels<float>(decoded(file, "sky.hdr"));
    EXPECT_NEAR(texels[0], 1.2048f * stored, 1e-6f);
    EXPECT_NEAR(texels[1], 0.9484f * stored, 1e-6f);
    EXPECT_NEAR(texels[2], 0.9087f * stored, 1e-6f);
}

TEST(PicturePlacement, aRadianceHeaderWithoutFormatOrWithLongLinesIsRead) {
    std::string bare = hdrOf("-Y 1 +X 2", {0, 1});
    bare.erase(bare.find("FORMAT"), 23);
    EXPECT_THAT(exponentsOf(decoded(bare, "sky.hdr")), ElementsAre(0, 1));
    const std::string history = "pcomb " + std::string(5000, 'x') + "\r\n";
    EXPECT_THAT(exponentsOf(decoded(hdrOf("-Y 1 +X 2", {0, 1}, history), "sky.hdr")), ElementsAre(0, 1));
    for (const char* resolution : {"", "-Y 1", "-Y 1 +Y 1", "-Y 0 +X 1", "-Y 1.5 +X 1", "*Y 1 +X 1", "-Y 1e300 +X 1"})
        EXPECT_THAT(refusalOf(hdrOf(resolution, {0, 1}), "sky.hdr"), HasSubstr("ends without a resolution"));
}

/// An EXR of 3x2 texels, 1 to 6, with this display window.
std::string exrIn(std::array<int, 4> displayed, float alpha) {
    std::vector<float> texels;
    for (int i = 1; i <= 6; ++i) texels.insert(texels.end(), {float(i), 0.0f, 0.0f, alpha});
    const std::vector<std::uint8_t> written = PictureLibrary::get().encodeExr(3, 2, texels.data());
    std::string file(written.begin(), written.end());
    const std::string window = std::string("displayWindow\0box2i\0\x10\0\0\0", 24);
    std::memcpy(file.data() + file.find(window) + window.size(), displayed.data(), sizeof displayed);
    return file;
}

std::vector<float> redsOf(const Image& image) {
    std::vector<float> reds;
    const std::vector<float> texels = storedTexels<float>(image);
    for (std::size_t at = 0; at < texels.size(); at += 4) reds.push_back(texels[at]);
    return reds;
}

TEST(PicturePlacement, texelsOfAnExrLieWhereItsDisplayWindowShowsThem) {
    const auto reds = [](std::array<int, 4> displayed) { return redsOf(decoded(exrIn(displayed, 1.0f), "a.exr")); };
    EXPECT_THAT(reds({0, 0, 2, 1}), ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_THAT(reds({-1, -1, 2, 2}), ElementsAre(0, 0, 0, 0, 0, 1, 2, 3, 0, 4, 5, 6, 0, 0, 0, 0));
    EXPECT_THAT(reds({1, 0, 2, 0}), ElementsAre(2, 3));
    EXPECT_THAT(reds({2, 1, 4, 2}), ElementsAre(6, 0, 0, 0, 0, 0));
    EXPECT_THAT(reds({7, 0, 8, 0}), ElementsAre(0, 0));
    EXPECT_THAT(reds({-900000000, 0, -899999999, 0}), ElementsAre(0, 0));
    EXPECT_EQ(storedTexels<float>(decoded(exrIn({2, 1, 3, 1}, 1.0f), "a.exr"))[7], 0.0f)
        << "transparent beside the texels";
    LoadLedger ledger;
    const std::string wide = exrIn({0, 0, 2000000, 0}, 1.0f);
    EXPECT_THAT(redsOf(decodeImage(std::as_bytes(std::span(wide)), "a.exr", ledger)), ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_THAT(ledger.takeWarnings(),
                ElementsAre("a.exr: its display window of 2000001x1 texels is too large; the 3x2 "
                            "texels of its data window are taken alone"));
    for (const std::array<int, 4>& empty : {std::array{0, 0, 2, -1}, std::array{0, 0, -1, 1}})
        EXPECT_THAT(refusalOf(exrIn(empty, 1.0f), "a.exr"), HasSubstr("cannot be decoded"));
    EXPECT_THAT(refusalOf(exrIn({0, 0, 9999, 9999}, 1.0f), "a.exr", 64 * kMiB), HasSubstr("needs 1.5 GiB"));
}

TEST(PicturePlacement, environmentsAndPicturesToCompareAreTurnedByExifButTexturesAreNot) {
    // The seed's rows differ; orientation 3 rotates it by 180 degrees.
    const TempFolder folder;
    const std::string exif = std::string("Exif\0\0", 6) + tiffOf({{274, kShort, 1, 3}}, "");
    std::string jpeg = bytesOfSeed("picture/small.jpg");
    jpeg.insert(2, "\xff\xe1" + numberText(std::uint32_t(exif.size() + 2), 2, ByteOrder::Big) + exif);
    const auto file = folder.write("a.jpg", jpeg);
    const Image stored = underLedger(readImage, file), upright = underLedger(readPicture, file).image;
    ASSERT_EQ(stored.texels.size(), upright.texels.size());
    EXPECT_EQ(stored.texels, decoded(bytesOfSeed("picture/small.jpg"), "a.jpg").texels);
    const std::size_t texels = stored.texels.size() / 4;
    EXPECT_NE(stored.texels, upright.texels);
    for (std::size_t i = 0; i < texels; ++i)
        EXPECT_EQ(std::memcmp(&stored.texels[4 * i], &upright.texels[4 * (texels - 1 - i)], 4), 0);
}

} // namespace
} // namespace tessera::scenes
