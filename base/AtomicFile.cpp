#include "base/AtomicFile.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#if __has_include(<unistd.h>)
#include <fcntl.h>
#include <unistd.h>
#endif

namespace tessera {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, std::string_view reason) {
    throw std::runtime_error(fmt::format("cannot write {}: {}", path, reason));
}

[[noreturn]] void failWithErrno(const std::string& path, int error) {
    const bool isFull = error == ENOSPC || error == EDQUOT || error == EFBIG;
    fail(path, std::generic_category().message(error) +
                   (isFull ? "; free some space or name another place" : "; name another place"));
}

void writeAndClose(std::FILE* file, std::string_view bytes, const std::string& path, bool toDisk) {
    bool good = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() && std::fflush(file) == 0;
#if __has_include(<unistd.h>)
    // Without fsync a power cut after the rename can leave an empty file under the new name.
    good = good && (!toDisk || ::fsync(fileno(file)) == 0);
#endif
    const int error = errno;
    const bool closed = std::fclose(file) == 0;
    if (!good) failWithErrno(path, error);
    if (!closed) failWithErrno(path, errno);
}

bool mayWriteOver(const fs::path& target) {
#if __has_include(<unistd.h>)
    return ::access(target.c_str(), W_OK) == 0;
#else
    return (fs::status(target).permissions() & fs::perms::owner_write) != fs::perms::none;
#endif
}

/// The path of a temporary file for the signal handler, which may neither allocate nor wait for a lock.
struct ListedName {
    enum State : int { kFree, kClaimed, kListed };
    std::atomic<int> state = kFree;
    std::array<char, 4096> text{}; ///< PATH_MAX of Linux; longer names cannot be opened
};
static_assert(std::atomic<int>::is_always_lock_free);
std::array<ListedName, 8> listedNames; ///< a program rarely writes two files at a time

/// Lists a path for the signal handler during its lifetime; does nothing if all slots are taken.
class NameListing {
public:
    explicit NameListing(const std::string& name) {
        for (ListedName& place : listedNames) {
            int expected = ListedName::kFree;
            if (name.size() >= place.text.size()) return;
            if (!place.state.compare_exchange_strong(expected, ListedName::kClaimed)) continue;
            name.copy(place.text.data(), name.size());
            place.text[name.size()] = '\0';
            place.state = ListedName::kListed;
            place_ = &place;
            return;
        }
    }
    ~NameListing() {
        if (place_ != nullptr) place_->state = ListedName::kFree;
    }
    NameListing(const NameListing&) = delete;
    NameListing& operator=(const NameListing&) = delete;

private:
    ListedName* place_ = nullptr;
};

/// A random name: the target's name with a suffix could exceed the file system's limit.
fs::path temporaryName(const fs::path& folder) {
    std::random_device random;
    return folder / fmt::format(".tessera-{:08x}{:08x}.tmp", random(), random());
}

/// Creates a file for writing with the permissions of the file that it replaces, so private content stays private.
/// Returns null on failure, with the reason in errno.
std::FILE* createFile(const fs::path& path, const fs::file_status& earlier) {
#if __has_include(<unistd.h>)
    const fs::perms permissions = fs::exists(earlier) ? earlier.permissions() : fs::perms(0666);
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, ::mode_t(permissions));
    return descriptor < 0 ? nullptr : ::fdopen(descriptor, "wb");
#else
    static_cast<void>(earlier);
    return std::fopen(path.c_str(), "wbx");
#endif
}

/// A temporary file beside the target, removed by the destructor unless renamed to it.
class Temporary {
public:
    /// `earlier`: status of the file that it may replace.
    Temporary(const fs::path& folder, const fs::file_status& earlier, const std::string& shownPath)
        : path_(temporaryName(folder)), listing_(path_.string()), file_(createFile(path_, earlier)) {
        if (file_ == nullptr) failWithErrno(shownPath, errno);
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;
    ~Temporary() {
        std::error_code ignored;
        if (!renamed_) fs::remove(path_, ignored);
    }

    std::FILE* file() const { return file_; }
    const fs::path& path() const { return path_; }
    void renameTo(const fs::path& target, const std::string& shownPath) {
        std::error_code error;
        fs::rename(path_, target, error);
        if (error) fail(shownPath, error.message());
        renamed_ = true;
    }

private:
    fs::path path_;
    NameListing listing_; ///< listed before the file exists, until it is removed or renamed
    std::FILE* file_;
    bool renamed_ = false;
};

/// Destination of the bytes: a file that replaces `target`, or a device or pipe written directly.
struct Place {
    fs::file_status status;
    bool isStream;
    fs::path target, folder;
};

Place placeOf(const std::string& path) {
    if (path.empty()) fail("\"\"", "the name is empty; name a file");
    std::error_code ignored, unknown;
    const fs::file_status status = fs::status(path, unknown);
    if (unknown == std::errc::filename_too_long) fail(path, unknown.message() + "; give a shorter one");
    if (fs::is_directory(status)) fail(path, "it is a folder; name a file in it");

    // /dev/stdout may be a regular file, which must not be replaced.
    if (fs::exists(status) && (!fs::is_regular_file(status) || path.starts_with("/dev/")))
        return {status, true, path, {}};

    // Follows links, also to a file that does not exist yet.
    constexpr int kMostLinks = 40; // limit of Linux
    fs::path target = path;
    for (int links = 0; fs::is_symlink(fs::symlink_status(target, ignored)); ++links) {
        std::error_code error;
        const fs::path next = fs::read_symlink(target, error);
        if (error) fail(path, error.message());
        if (links == kMostLinks) fail(path, "it is a link that leads in a circle; name another file");
        target = next.is_absolute() ? next : target.parent_path() / next;
    }
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, ignored))
        fail(path, fmt::format("there is no folder {}; create it or name another", folder.string()));
    if (fs::exists(status) && !mayWriteOver(target)) fail(path, "it is write-protected; name another file");
    return {status, false, target, folder};
}

} // namespace

void writeFileAtomically(const std::string& path, std::string_view text) {
    const Place place = placeOf(path);
    if (place.isStream) {
        std::FILE* file = std::fopen(path.c_str(), "wb");
        if (file == nullptr) failWithErrno(path, errno);
        writeAndClose(file, text, path, false);
        return;
    }
    Temporary temporary(place.folder, place.status, path);
    writeAndClose(temporary.file(), text, path, true);
    std::error_code ignored;
    if (fs::exists(place.status)) fs::permissions(temporary.path(), place.status.permissions(), ignored);
    temporary.renameTo(place.target, path);
}

void writeFileAtomically(const std::string& path, std::span<const std::uint8_t> bytes) {
    writeFileAtomically(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

void requireWritable(const std::string& path) {
    const Place place = placeOf(path);
    // Only creating and removing a file tests this reliably on every file system.
    if (!place.isStream) {
        const Temporary probe(place.folder, place.status, path);
        std::fclose(probe.file());
    }
}

void removeTemporaries() noexcept {
    for (const ListedName& name : listedNames) {
        if (name.state != ListedName::kListed) continue;
#if __has_include(<unistd.h>)
        ::unlink(name.text.data()); // std::remove() need not be async-signal-safe
#else
        std::remove(name.text.data());
#endif
    }
}

} // namespace tessera
