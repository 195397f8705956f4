#include "viewer/save/Recovery.h"

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fmt/format.h>

#include "viewer/save/SaveScene.h"

namespace tessera::viewer {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLock = "lock"; ///< in each run's folder

bool areEdits(const fs::path& file) {
    return file.extension() == ".json";
}

[[noreturn]] void failToKeep(const fs::path& folder, const std::string& reason) {
    throw std::runtime_error(fmt::format("cannot make the folder {}, which edits are kept in until they are saved: {}; "
                                         "check the permissions above it",
                                         folder.string(), reason));
}

} // namespace

FileLock::FileLock(const fs::path& file) : descriptor_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
    if (descriptor_ < 0) throw std::runtime_error(std::generic_category().message(errno));
    ::flock(descriptor_, LOCK_EX); // without file system locks, edits are saved all the same
}

FileLock::~FileLock() {
    ::close(descriptor_);
}

bool FileLock::isHeld(const fs::path& file) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
    if (descriptor < 0) return false;
    const bool isHeld = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    ::close(descriptor);
    return isHeld;
}

Recovery::Recovery(std::optional<fs::path> folder) : folder_(std::move(folder)) {}

std::optional<fs::path> Recovery::left() const {
    std::optional<fs::path> latest;
    fs::file_time_type latestTime;
    std::error_code error;
    if (!folder_) return latest;
    for (const fs::directory_entry& run : fs::directory_iterator(*folder_, error)) {
        if (FileLock::isHeld(run.path() / kLock)) continue;
        for (const fs::directory_entry& entry : fs::directory_iterator(run.path(), error)) {
            if (!areEdits(entry.path())) continue;
            const fs::file_time_type time = entry.last_write_time(error);
            if (error || (latest && time <= latestTime)) continue;
            latest = entry.path();
            latestTime = time;
        }
    }
    return latest;
}

void Recovery::discard(const fs::path& file) {
    std::error_code ignored;
    fs::remove(file, ignored);
    for (const fs::directory_entry& other : fs::directory_iterator(file.parent_path(), ignored))
        if (areEdits(other.path())) return;
    fs::remove(file.parent_path() / kLock, ignored);
    fs::remove(file.parent_path(), ignored);
}

const fs::path& Recovery::ownFolder() {
    std::error_code error;
    if (lock_ && fs::exists(own_ / kLock, error)) return own_;
    lock_.reset(); // the folder was deleted
    fs::create_directories(*folder_, error);
    // An earlier run may have had the same process number.
    int number = 1;
    do {
        own_ = *folder_ / (std::to_string(getpid()) + (number == 1 ? "" : fmt::format("-{}", number)));
        ++number;
    } while (!fs::create_directory(own_, error) && !error);
    if (error) failToKeep(own_, error.message());
    try {
        lock_.emplace(own_ / kLock);
    } catch (const std::exception& fault) {
        failToKeep(own_, fault.what());
    }
    return own_;
}

bool Recovery::isBehind(const OpenScene& open) const {
    if (!folder_) return false;
    if (!open.isEdited()) return kept_.has_value();
    return !kept_ || kept_->edits != open.edits() || kept_->source != open.source();
}

void Recovery::keep(const OpenScene& open) {
    if (!folder_) return;
    if (!open.isEdited()) return forget();
    const fs::path file = ownFolder() / fmt::format("tessera-{}.json", savedStem(open.source()));
    saveScene(file.string(), open.scene(), open.origin(), open.environmentView(), open.viewpoints());
    std::error_code ignored;
    if (kept_ && kept_->file != file) fs::remove(kept_->file, ignored);
    kept_ = Kept{file, open.source(), open.edits()};
}

void Recovery::forget() {
    if (lock_) discard(kept_ ? kept_->file : own_ / kLock);
    kept_.reset();
    lock_.reset();
}

} // namespace tessera::viewer
