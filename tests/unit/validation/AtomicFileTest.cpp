#include "validation/AtomicFile.h"

#include <csignal>
#include <stdexcept>
#include <sys/resource.h>

#include <gmock/gmock.h>

#include "tests/unit/validation/Samples.h"

namespace tessera::validation {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

/// Makes every write beyond `bytes` of a file fail, as a full disk does, while it lives.
class FileSizeLimit {
public:
    explicit FileSizeLimit(rlim_t bytes) : oldHandler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &old_);
        const rlimit limit{bytes, old_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, oldHandler_);
    }

private:
    rlimit old_{};
    void (*oldHandler_)(int);
};

TEST(AtomicFile, theFileAlwaysHoldsExactlyTheBytesGiven) {
    const TemporaryFolder folder;
    const std::string text("first\0second\r\n", 14);
    writeFileAtomically(folder.file("a.txt"), text);
    EXPECT_EQ(readText(folder.file("a.txt")), text);
    writeFileAtomically(folder.file("a.txt"), "");
    EXPECT_EQ(readText(folder.file("a.txt")), "");
    const std::vector<std::uint8_t> bytes = {0, 255, 10};
    writeFileAtomically(folder.file("a.txt"), bytes);
    EXPECT_EQ(readText(folder.file("a.txt")), std::string("\0\xff\n", 3));
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, aFailedWriteAlwaysKeepsTheOldFileAndNeverLeavesATemporary) {
    const TemporaryFolder folder;
    writeFileAtomically(folder.file("a.txt"), "old");
    const std::string path = folder.file("a.txt");
    std::string message;
    {
        const FileSizeLimit fullDisk(1000);
        message = errorOf<std::runtime_error>([&] { writeFileAtomically(path, std::string(100'000, 'x')); });
    }
    EXPECT_THAT(message, StartsWith("cannot write " + path + ": File too large"));
    EXPECT_EQ(readText(path), "old");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, theMessageAlwaysNamesThePathTheReasonAndTheRemedy) {
    const TemporaryFolder folder;
    EXPECT_EQ(errorOf<std::runtime_error>([&] { writeFileAtomically(folder.path(), "x"); }),
              "cannot write " + folder.path() + ": it is a folder; name a file in it");
    EXPECT_EQ(errorOf<std::runtime_error>([&] { writeFileAtomically(folder.file("no/a.txt"), "x"); }),
              "cannot write " + folder.file("no/a.txt") + ": there is no folder " + folder.file("no") +
                  "; create it or name another");
    EXPECT_EQ(errorOf<std::runtime_error>([&] { writeFileAtomically("", "x"); }),
              "cannot write \"\": the name is empty; name a file");
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(AtomicFile, aDeviceIsNeverReplacedByAFile) {
    writeFileAtomically("/dev/null", "x");
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_THAT(errorOf<std::runtime_error>([] { writeFileAtomically("/dev/full", "x"); }),
                HasSubstr("cannot write /dev/full: No space left on device"));
}

TEST(AtomicFile, aLinkAlwaysStaysALinkAndItsTargetIsWritten) {
    const TemporaryFolder folder;
    writeFileAtomically(folder.file("target"), "old");
    fs::create_symlink("target", folder.file("link"));
    writeFileAtomically(folder.file("link"), "new");
    EXPECT_TRUE(fs::is_symlink(folder.file("link")));
    EXPECT_EQ(readText(folder.file("target")), "new");
}

TEST(AtomicFile, permissionsOfTheOldFileAreAlwaysKept) {
    const TemporaryFolder folder;
    writeFileAtomically(folder.file("a"), "old");
    fs::permissions(folder.file("a"), fs::perms::owner_read | fs::perms::owner_write);
    writeFileAtomically(folder.file("a"), "new");
    EXPECT_EQ(fs::status(folder.file("a")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

} // namespace
} // namespace tessera::validation
