#include "base/PictureFile.h"

#include <bit>
#include <cmath>
#include <ctime>
#include <limits>

#include <fmt/chrono.h>
#include <gmock/gmock.h>

#include "base/Error.h"
#include "tests/support/ErrorText.h"
#include "tests/support/UnderLedger.h"
#include "tests/unit/validation/Samples.h"
#include "validation/pictures/ReadPicture.h"

namespace tessera::validation {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::vector<std::uint32_t> colourBits(const Picture& picture) {
    std::vector<std::uint32_t> bits;
    for (std::size_t i = 0; i < picture.pixelCount(); ++i)
        for (int c = 0; c < 3; ++c) bits.push_back(std::bit_cast<std::uint32_t>(picture.pixel(i)[c]));
    return bits;
}

Picture extremes() {
    using Limits = std::numeric_limits<float>;
    Picture picture = pictureOf(3, 2,
                                {{Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()},
                                 {Limits::denorm_min(), -Limits::denorm_min(), Limits::min() / 3},
                                 {Limits::max(), Limits::lowest(), Limits::min()},
                                 {-0.f, 0.f, 1.f},
                                 {0.1f, 1.f / 3.f, 65505.f},
                                 {std::bit_cast<float>(0x7fc12345u), 1e-20f, 1e20f}});
    picture.covered = {1, 0, 1, 0, 0, 1};
    return picture;
}

TEST(PictureFile, exrKeepsEveryBitAndTheCoverage) {
    const TemporaryFolder folder;
    const Picture written = extremes();
    writeExr(folder.file("a.exr"), written);
    const Picture read = underLedger(readPicture, folder.file("a.exr"));
    EXPECT_EQ(read.width, 3);
    EXPECT_EQ(read.height, 2);
    EXPECT_EQ(colourBits(read), colourBits(written));
    EXPECT_EQ(read.covered, written.covered);
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(PictureFile, exrOfAPictureWithoutGeometryIsReadBackUncovered) {
    const TemporaryFolder folder;
    Picture picture = greyPicture(2, 1, 1.f);
    picture.covered = {0, 0};
    writeExr(folder.file("a.exr"), picture);
    EXPECT_THAT(underLedger(readPicture, folder.file("a.exr")).covered, ElementsAre(0, 0));
}

TEST(PictureFile, exrOfOnePictureIsTheSameFile) {
    const TemporaryFolder folder;
    writeExr(folder.file("a.exr"), extremes());
    writeExr(folder.file("b.exr"), extremes());
    EXPECT_EQ(readText(folder.file("a.exr")), readText(folder.file("b.exr")));
    EXPECT_THAT(readText(folder.file("a.exr")), HasSubstr("tessera"));
    const std::time_t now = std::time(nullptr);
    EXPECT_THAT(readText(folder.file("a.exr")), Not(HasSubstr(fmt::format("{:%Y:%m}", *std::gmtime(&now)))));
}

TEST(PictureFile, pngIsDecodedFromSrgbToLinear) {
    const TemporaryFolder folder;
    writePng(folder.file("a.png"), {2, 1, {0, 255, 188, 10, 11, 128}});
    const Picture picture = underLedger(readPicture, folder.file("a.png"));
    EXPECT_THAT(picture.covered, ElementsAre(1, 1));
    // IEC 61966-2-1 by hand: x / 12.92 up to 10/255, ((x + 0.055) / 1.055)^2.4 above; 1e-6 is the rounding of fp32.
    EXPECT_EQ(picture.pixel(0)[0], 0.f);
    EXPECT_EQ(picture.pixel(0)[1], 1.f);
    EXPECT_NEAR(picture.pixel(0)[2], 0.502886458, 1e-6);
    EXPECT_NEAR(picture.pixel(1)[0], 10.0 / 255.0 / 12.92, 1e-6);
    EXPECT_NEAR(picture.pixel(1)[1], 0.00334653576, 1e-6);
    EXPECT_NEAR(picture.pixel(1)[2], 0.215860500, 1e-6);
}

TEST(PictureFile, pfmIsReadLinearAndFromTheTop) {
    const TemporaryFolder folder;
    // PFM stores its rows from the bottom; a negative scale means little-endian.
    const float rows[2][3] = {{1.f, 2.f, 3.f}, {4.f, 5.f, 1e-20f}};
    writeText(folder.file("a.pfm"), "PF\n1 2\n-1.0\n" + std::string(reinterpret_cast<const char*>(rows), sizeof(rows)));
    const Picture picture = underLedger(readPicture, folder.file("a.pfm"));
    ASSERT_EQ(picture.height, 2);
    EXPECT_THAT(picture.rgba, ElementsAre(4.f, 5.f, 1e-20f, 1.f, 1.f, 2.f, 3.f, 1.f));
    // One channel is grey; a positive scale means big-endian and multiplies.
    writeText(folder.file("b.pfm"), std::string("Pf\n1 1\n2\n\x3f\x80\0\0", 14));
    EXPECT_THAT(underLedger(readPicture, folder.file("b.pfm")).rgba, ElementsAre(2.f, 2.f, 2.f, 1.f));
}

TEST(PictureFile, aBrokenInputIsAnInputErrorThatNamesTheFile) {
    const TemporaryFolder folder;
    writeExr(folder.file("whole.exr"), greyPicture(64, 64, 0.25f));
    const std::string whole = readText(folder.file("whole.exr"));
    writeText(folder.file("cut.exr"), whole.substr(0, whole.size() / 2));
    writeText(folder.file("cut-in-header.exr"), whole.substr(0, 40));
    writeText(folder.file("text.png"), "not a picture");
    writeText(folder.file("empty.exr"), "");
    writeText(folder.file("cut.pfm"), "PF\n2 2\n-1.0\n1234");
    writeText(folder.file("huge.pfm"), "PF\n2000000000 2000000000\n-1.0\n");
    for (const char* name :
         {"cut.exr", "cut-in-header.exr", "text.png", "empty.exr", "huge.pfm", "cut.pfm", "absent.exr", ""}) {
        const std::string path = folder.file(name);
        const std::string message = test::errorText<InputError>([&] { underLedger(readPicture, path); });
        EXPECT_THAT(message, AllOf(StartsWith(path + ": "), HasSubstr("; "), Not(HasSubstr("\n"))));
    }
}

/// Returns the error of reading a file with these bytes, without the file's name.
std::string refusalOf(const TemporaryFolder& folder, const std::string& name, const std::string& bytes) {
    writeText(folder.file(name), bytes);
    const std::string message = test::errorText<InputError>([&] { underLedger(readPicture, folder.file(name)); });
    EXPECT_THAT(message, StartsWith(folder.file(name) + ": "));
    return message.substr(std::min(message.size(), folder.file(name).size() + 2));
}

TEST(PictureFile, onlyReadersOfTexturesAreUsed) {
    const TemporaryFolder folder;
    // "null" makes images from nothing, "mp4" opens films, and the readers of IFF and DPX crash on broken files.
    for (const char* extension : {"null", "mp4", "raw", "vdb", "iff", "dpx", "psd"})
        EXPECT_EQ(refusalOf(folder, std::string("a.") + extension, "FOR4"),
                  fmt::format("the picture format {} is not supported; convert the picture to png, jpeg, openexr, hdr, "
                              "pfm, tiff, webp, bmp, gif or tga",
                              extension));
    writePng(folder.file("a.png"), {2, 1, {0, 255, 188, 10, 11, 128}});
    writeText(folder.file("a.null"), readText(folder.file("a.png")));
    EXPECT_EQ(underLedger(readPicture, folder.file("a.null")).width, 2);
}

TEST(PictureFile, picturesAreChargedBeforeTheyAreDecoded) {
    const TemporaryFolder folder;
    writeExr(folder.file("a.exr"), greyPicture(512, 512, 1.f));
    const std::uint64_t kept = 512 * 512 * 17; // four floats and a coverage byte per pixel
    scenes::LoadLedger ledger(std::uint64_t{32} << 20);
    readPicture(folder.file("a.exr"), ledger);
    EXPECT_EQ(ledger.usedBytes(), kept);
    EXPECT_THAT(ledger.files(), ElementsAre(folder.file("a.exr")));
    EXPECT_THAT(
        test::errorText<InputError>([&] { underLedger(readPicture, folder.file("a.exr"), std::uint64_t{2} << 20); }),
        HasSubstr("a.exr: the picture of 512x512 texels: needs 4.0 MiB of memory"));
}

TEST(PictureFile, aPictureWithADataWindowIsComparedAsDisplayed) {
    const TemporaryFolder folder;
    writeExr(folder.file("a.exr"), greyPicture(2, 2, 1.f));
    std::string cropped = readText(folder.file("a.exr"));
    const std::string window = std::string("displayWindow\0box2i\0\x10\0\0\0", 24);
    const std::size_t at = cropped.find(window);
    ASSERT_NE(at, std::string::npos);
    cropped.replace(at + window.size(), 4, 4, '\xff'); // its left edge is -1
    writeText(folder.file("b.exr"), cropped);
    const Picture picture = underLedger(readPicture, folder.file("b.exr"));
    EXPECT_EQ(picture.width, 3);
    EXPECT_THAT(picture.covered, ElementsAre(0, 1, 1, 0, 1, 1));
    EXPECT_EQ(picture.pixel(0)[0], 0.f);
    EXPECT_EQ(picture.pixel(4)[0], 1.f);
}

TEST(PictureFile, anUnwritableOutputIsARuntimeErrorAndNeverAnInputError) {
    const TemporaryFolder folder;
    const std::string path = folder.file("none/a.exr");
    EXPECT_THROW(
        {
            try {
                writeExr(path, greyPicture(1, 1, 1.f));
            } catch (const InputError&) {
                FAIL() << "an InputError means exit code 2; writing fails with 1";
            }
        },
        std::runtime_error);
    EXPECT_THAT(test::errorText<std::runtime_error>([&] {
                    writePng(path, {1, 1, {0, 0, 0}});
                }),
                HasSubstr("cannot write " + path));
    EXPECT_EQ(folder.entries(), 0u);
}

} // namespace
} // namespace tessera::validation
