#include "viewer/save/Recovery.h"

#include <cerrno>
#include <charconv>
#include <csignal>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <unistd.h>

#include <fmt/format.h>

#include "viewer/save/SaveScene.h"

namespace tessera::viewer {
namespace {

namespace fs = std::filesystem;

/// Whether a folder is that of another process that still runs.
bool isInUse(const fs::path& folder) {
    const std::string name = folder.filename().string();
    int process = 0;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), process);
    if (error != std::errc() || end != name.data() + name.size() || process <= 0) return true; // nobody knows
    return process != int(getpid()) && (kill(process, 0) == 0 || errno != ESRCH);
}

} // namespace

Recovery::Recovery(std::optional<fs::path> folder) : folder_(std::move(folder)) {}

std::optional<fs::path> Recovery::left() const {
    std::optional<fs::path> latest;
    fs::file_time_type latestTime;
    std::error_code error;
    if (!folder_) return latest;
    for (const fs::directory_entry& process : fs::directory_iterator(*folder_, error)) {
        if (isInUse(process.path())) continue;
        for (const fs::directory_entry& entry : fs::directory_iterator(process.path(), error)) {
            if (entry.path().extension() != ".json") continue;
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
    fs::remove(file.parent_path(), ignored); // unless there are others
}

bool Recovery::isBehind(const OpenScene& open) const {
    if (!folder_) return false;
    if (!open.isEdited()) return kept_.has_value();
    return !kept_ || kept_->edits != open.edits() || kept_->source != open.source();
}

void Recovery::keep(const OpenScene& open) {
    if (!folder_) return;
    if (!open.isEdited()) return forget();
    const fs::path folder = *folder_ / std::to_string(getpid());
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw std::runtime_error(fmt::format("cannot make the folder {}, which edits are kept in until they are saved: "
                                             "{}; check the permissions above it",
                                             folder.string(), error.message()));
    const fs::path file = folder / fmt::format("tessera-{}.json", savedStem(open.source()));
    saveScene(file.string(), open.scene(), open.origin(), open.environmentView());
    if (kept_ && kept_->file != file) fs::remove(kept_->file, error);
    kept_ = Kept{file, open.source(), open.edits()};
}

void Recovery::forget() {
    if (kept_) discard(kept_->file);
    kept_.reset();
}

} // namespace tessera::viewer
