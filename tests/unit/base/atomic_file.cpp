#include "base/AtomicFile.h"

#include <atomic>
#include <fcntl.h>
#include <stdexcept>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include <gmock/gmock.h>

#include "tests/support/ErrorText.h"
#include "tests/support/FileSizeLimit.h"
#include "tests/unit/validation/Samples.h"

namespace tessera {
namespace {

namespace fs = std::filesystem;
using test::errorText;
using test::FileSizeLimit;
using testing::StartsWith;
using validation::readText;
using validation::TemporaryFolder;

TEST(AtomicFile, theFileHoldsExactlyTheBytesGiven) {
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

TEST(AtomicFile, aFailedWriteKeepsTheOldFileAndNeverLeavesATemporary) {
    const TemporaryFolder folder;
    writeFileAtomically(folder.file("a.txt"), "old");
    const std::string path = folder.file("a.txt");
    std::string message;
    {
        const FileSizeLimit fullDisk(1000);
        message = errorText<std::runtime_error>([&] { writeFileAtomically(path, std::string(100'000, 'x')); });
    }
    EXPECT_THAT(message, StartsWith("cannot write " + path + ": File too large"));
    EXPECT_EQ(readText(path), "old");
    EXPECT_EQ(folder.entries(), 1u);
}

TEST(AtomicFile, aPrivateFileIsReplacedByWayOfAPrivateOne) {
    const TemporaryFolder folder;
    const std::string path = folder.file("secret.txt");
    writeFileAtomically(path, "old");
    fs::permissions(path, fs::perms(0600));
    const ::mode_t mask = ::umask(0);
    std::atomic<bool> isDone = false;
    std::atomic<int> seen = 0, open = 0;
    std::thread watcher([&] {
        while (!isDone)
            for (const auto& entry : fs::directory_iterator(folder.path())) {
                std::error_code ignored;
                if (entry.path().extension() != ".tmp") continue;
                const fs::perms permissions = fs::status(entry.path(), ignored).permissions();
                if (permissions == fs::perms::unknown || ignored) continue;
                ++seen;
                if ((permissions & fs::perms(077)) != fs::perms::none) ++open;
            }
    });
    const std::string text(std::size_t{1} << 24, 'x');
    for (int i = 0; i < 100 && seen == 0; ++i) writeFileAtomically(path, text);
    isDone = true;
    watcher.join();
    ::umask(mask);
    EXPECT_GT(seen, 0);
    EXPECT_EQ(open, 0);
    EXPECT_EQ(fs::status(path).permissions(), fs::perms(0600));
}

TEST(AtomicFile, theMessageNamesThePathTheReasonAndTheRemedy) {
    const TemporaryFolder folder;
    EXPECT_EQ(errorText<std::runtime_error>([&] { writeFileAtomically(folder.path(), "x"); }),
              "cannot write " + folder.path() + ": it is a folder; name a file in it");
    EXPECT_EQ(errorText<std::runtime_error>([&] { writeFileAtomically(folder.file("no/a.txt"), "x"); }),
              "cannot write " + folder.file("no/a.txt") + ": there is no folder " + folder.file("no") +
                  "; create it or name another");
    EXPECT_EQ(errorText<std::runtime_error>([&] { writeFileAtomically("", "x"); }),
              "cannot write \"\": the name is empty; name a file");
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(AtomicFile, aNameThatTheFileSystemCannotHoldIsFoundBeforeTheWork) {
    const TemporaryFolder folder;
    const std::string path = folder.file(std::string(300, 'a'));
    EXPECT_EQ(errorText<std::runtime_error>([&] { requireWritable(path); }),
              "cannot write " + path + ": File name too long; give a shorter one");
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(AtomicFile, aPipeIsNotReplacedByAFile) {
    const TemporaryFolder folder;
    const std::string path = folder.file("pipe");
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    const int reader = ::open(path.c_str(), O_RDWR | O_NONBLOCK); // a pipe without a reader would make the writer wait
    ASSERT_GE(reader, 0);
    writeFileAtomically(path, "text");
    char bytes[8] = {};
    EXPECT_EQ(::read(reader, bytes, sizeof(bytes)), 4);
    EXPECT_STREQ(bytes, "text");
    EXPECT_TRUE(fs::is_fifo(path));
    ::close(reader);
}

TEST(AtomicFile, aFileGivenAsADeviceIsNotReplaced) {
    const TemporaryFolder folder;
    const int file = ::open(folder.file("out").c_str(), O_RDWR | O_CREAT, 0600);
    ASSERT_GE(file, 0);
    // As when standard output is redirected to a file: later writes through it must reach that same file.
    writeFileAtomically(fmt::format("/dev/fd/{}", file), "text");
    char bytes[8] = {};
    EXPECT_EQ(::read(file, bytes, sizeof(bytes)), 4);
    EXPECT_STREQ(bytes, "text");
    ::close(file);
}

TEST(AtomicFile, aLinkStaysALinkAndItsTargetIsWritten) {
    const TemporaryFolder folder;
    writeFileAtomically(folder.file("target"), "old");
    fs::create_symlink("target", folder.file("link"));
    writeFileAtomically(folder.file("link"), "new");
    EXPECT_TRUE(fs::is_symlink(folder.file("link")));
    EXPECT_EQ(readText(folder.file("target")), "new");
}

TEST(AtomicFile, aLinkToAFileThatIsNotThereYetMakesThatFile) {
    const TemporaryFolder folder;
    fs::create_directory(folder.file("deep"));
    fs::create_symlink("deep/second", folder.file("first"));
    fs::create_symlink("target", folder.file("deep/second"));
    writeFileAtomically(folder.file("first"), "new");
    EXPECT_TRUE(fs::is_symlink(folder.file("first")));
    EXPECT_TRUE(fs::is_symlink(folder.file("deep/second")));
    EXPECT_EQ(readText(folder.file("deep/target")), "new");
    fs::create_symlink("circle", folder.file("circle"));
    EXPECT_ANY_THROW(writeFileAtomically(folder.file("circle"), "new"));
}

TEST(AtomicFile, permissionsOfTheOldFileAreKept) {
    const TemporaryFolder folder;
    writeFileAtomically(folder.file("a"), "old");
    fs::permissions(folder.file("a"), fs::perms::owner_read | fs::perms::owner_write);
    writeFileAtomically(folder.file("a"), "new");
    EXPECT_EQ(fs::status(folder.file("a")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

} // namespace
} // namespace tessera
