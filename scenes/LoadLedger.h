#pragma once
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/Error.h"
#include "scenes/ImportWishes.h"
#include "scenes/Scene.h"

namespace tessera::scenes {

/// Half of the machine's memory, or of what the control groups of the process may use where that is less.
std::uint64_t defaultMemoryLimitBytes();

/// The least that the control groups in which the process is, and those above them, may use; none without a limit.
/// `membership` says which they are, `groups` is the folder of all. Source: Linux, cgroups(7), both versions.
std::optional<std::uint64_t> groupLimitBytes(const std::filesystem::path& membership = "/proc/self/cgroup",
                                             const std::filesystem::path& groups = "/sys/fs/cgroup");

/// "512 B", "1.5 KiB", "2.0 GiB".
std::string sizeText(std::uint64_t bytes);

/// A load would take more memory than it may. No importer draws anything else instead.
class MemoryRefused : public InputError {
public:
    using InputError::InputError;
};

/// How one load is to read models, the files it has read, whom it tells how far it is, and the memory it may take.
/// Importers charge memory before they reserve it, so that a small file that asks for much is refused before the memory
/// is gone. One load has one ledger: it cannot be copied, and no importer makes one of its own. What a command reads
/// beside a loaded scene has a ledger that begins with what that scene takes.
class LoadLedger {
public:
    /// Without a limit: defaultMemoryLimitBytes().
    explicit LoadLedger(std::optional<std::uint64_t> limitBytes = {}, ImportWishes wishes = {});
    LoadLedger(const LoadLedger&) = delete;
    LoadLedger& operator=(const LoadLedger&) = delete;

    /// Throws MemoryRefused when `bytes` more would exceed the limit; `who` is called for the "file: place" of the
    /// request.
    template <typename Who>
    void charge(std::uint64_t bytes, Who&& who) {
        if (bytes > limitBytes_ - usedBytes_) refuse(who(), bytes);
        usedBytes_ += bytes;
    }

    std::uint64_t usedBytes() const { return usedBytes_; }
    /// Of all charged since usedBytes() was `markBytes`, only `keptBytes` are still there.
    void settle(std::uint64_t markBytes, std::uint64_t keptBytes) {
        usedBytes_ = std::min(markBytes + keptBytes, limitBytes_);
    }

    const ImportWishes& wishes() const { return wishes_; }
    /// For what a scene file says itself. Who asks for the load goes first, and files before those that they name.
    void wishVariant(std::optional<std::string> variant) { wishes_.variant = std::move(variant); }

    /// Is called, unless it is empty, with the share of a built-in environment's map that is computed, from any thread.
    /// What it throws ends the load, and is thrown.
    void tellEnvironment(std::function<void(double)> told) { environmentTold_ = std::move(told); }
    const std::function<void(double)>& environmentTold() const { return environmentTold_; }

    /// Flaws of pictures that are repaired, "file: flaw; repair".
    void warn(std::string text) {
        constexpr std::size_t kMost = 100;
        if (warnings_.size() < kMost) warnings_.push_back(std::move(text));
    }
    std::vector<std::string> takeWarnings() { return std::exchange(warnings_, {}); }

    void addFile(const std::filesystem::path& file) { files_.push_back(file.string()); }
    const std::vector<std::string>& files() const { return files_; }

private:
    [[noreturn]] void refuse(const std::string& who, std::uint64_t bytes) const;

    std::uint64_t limitBytes_;
    ImportWishes wishes_;
    std::uint64_t usedBytes_ = 0; ///< at most limitBytes_
    std::vector<std::string> files_, warnings_;
    std::function<void(double)> environmentTold_;
};

/// Bytes that parts of a scene hold.
std::uint64_t bytesOf(const Mesh& mesh);
std::uint64_t bytesOf(const Shape& shape);
std::uint64_t bytesOf(const Clip& clip);
std::uint64_t bytesOf(const Rig& rig);
std::uint64_t bytesOf(const Scene& scene);

} // namespace tessera::scenes
