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

} // namespace
} // namespace tessera::scenes
