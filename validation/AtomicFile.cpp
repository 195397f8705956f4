#include "validation/AtomicFile.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#if __has_include(<unistd.h>)
#include <unistd.h>
#endif

namespace tessera::validation {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, std::string_view reason) {
    throw std::runtime_error(fmt::format("cannot write {}: {}", path, reason));
}

[[noreturn]] void failWithErrno(const std::string& path, int error) {
    fail(path, std::generic_category().message(error) + "; free the place or name another file");
}

void writeAndClose(std::FILE* file, std::string_view bytes, const std::string& path, bool toDisk) {
    bool good = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size() && std::fflush(file) == 0;
#if __has_include(<unistd.h>)
    // Without it a power cut after the rename can leave the new name with an empty file.
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

/// A new file beside the target, gone again unless it has taken the target's name.
class Temporary {
public:
    Temporary(const fs::path& folder, const std::string& shownPath) {
        std::random_device random;
        for (int attempt = 0; attempt < 100; ++attempt) {
            // A name of its own, because the target's with a suffix can exceed what the file system allows.
            path_ = folder / fmt::format(".tessera-{:08x}{:08x}.tmp", random(), random());
            file_ = std::fopen(path_.c_str(), "wbx");
            if (file_ != nullptr) return;
            if (errno != EEXIST) break;
        }
        failWithErrno(shownPath, errno);
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
    std::FILE* file_ = nullptr;
    bool renamed_ = false;
};

} // namespace

void writeFileAtomically(const std::string& path, std::string_view text) {
    if (path.empty()) fail("\"\"", "the name is empty; name a file");
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (fs::is_directory(status)) fail(path, "it is a folder; name a file in it");

    const bool isStream = fs::exists(status) && !fs::is_regular_file(status);
    if (isStream || path.starts_with("/dev/")) {
        std::FILE* file = std::fopen(path.c_str(), "wb");
        if (file == nullptr) failWithErrno(path, errno);
        writeAndClose(file, text, path, false);
        return;
    }

    fs::path target = path;
    if (fs::is_symlink(fs::symlink_status(target, ignored))) {
        std::error_code error;
        target = fs::weakly_canonical(target, error);
        if (error) fail(path, error.message());
    }
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!fs::is_directory(folder, ignored))
        fail(path, fmt::format("there is no folder {}; create it or name another", folder.string()));
    if (fs::exists(status) && !mayWriteOver(target)) fail(path, "it is write-protected; name another file");

    Temporary temporary(folder, path);
    writeAndClose(temporary.file(), text, path, true);
    if (fs::exists(status)) fs::permissions(temporary.path(), status.permissions(), ignored);
    temporary.renameTo(target, path);
}

void writeFileAtomically(const std::string& path, std::span<const std::uint8_t> bytes) {
    writeFileAtomically(path, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

} // namespace tessera::validation
