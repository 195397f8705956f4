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
#include "scenes/ImportOptions.h"
#include "scenes/Scene.h"

namespace tessera::scenes {

/// Half of the machine's memory, or of the limit of the process's control groups if that is less.
std::uint64_t defaultMemoryLimitBytes();

/// The lowest memory limit of the process's control groups and their parents; none without a limit. `membership` lists
/// the groups, `groups` is their root folder. Source: Linux, cgroups(7), both versions.
std::optional<std::uint64_t> groupLimitBytes(const std::filesystem::path& membership = "/proc/self/cgroup",
                                             const std::filesystem::path& groups = "/sys/fs/cgroup");

/// "512 B", "1.5 KiB", "2.0 GiB".
std::string sizeText(std::uint64_t bytes);

/// Thrown when a load would exceed its memory limit. Importers do not substitute anything for the refused data.
class MemoryRefused : public InputError {
public:
    using InputError::InputError;
};

/// State of one load: import options, the files read, a progress callback, and the memory budget. Importers charge
/// memory before they allocate it, so that a small file that declares huge sizes is refused early. One load has one
/// ledger: it cannot be copied, and importers do not make their own. Reads beside a loaded scene use a ledger that
/// starts with that scene's memory.
class LoadLedger {
public:
    /// Without a limit: defaultMemoryLimitBytes().
    explicit LoadLedger(std::optional<std::uint64_t> limitBytes = {}, ImportOptions importOptions = {});
    LoadLedger(const LoadLedger&) = delete;
    LoadLedger& operator=(const LoadLedger&) = delete;

    /// Throws MemoryRefused when `bytes` more would exceed the limit; `who` returns the "file: place" of the request.
    template <typename Who>
    void charge(std::uint64_t bytes, Who&& who) {
        if (bytes > limitBytes_ - usedBytes_) refuse(who(), bytes);
        usedBytes_ += bytes;
    }

    std::uint64_t usedBytes() const { return usedBytes_; }
    /// Releases all memory charged since usedBytes() was `markBytes`, except `keptBytes`.
    void settle(std::uint64_t markBytes, std::uint64_t keptBytes) {
        usedBytes_ = std::min(markBytes + keptBytes, limitBytes_);
    }

    const ImportOptions& importOptions() const { return importOptions_; }
    /// Sets the variant named by a scene file. The caller's option takes precedence, then outer files over inner ones.
    void requestVariant(std::optional<std::string> variant) { importOptions_.variant = std::move(variant); }

    /// Sets the progress callback, which may be empty: called from any thread with the computed fraction of a built-in
    /// environment's map. Its exceptions end the load and are rethrown.
    void reportEnvironment(std::function<void(double)> progress) { environmentProgress_ = std::move(progress); }
    const std::function<void(double)>& environmentProgress() const { return environmentProgress_; }

    /// Records a repaired flaw of an image, "file: flaw; repair".
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
    ImportOptions importOptions_;
    std::uint64_t usedBytes_ = 0; ///< at most limitBytes_
    std::vector<std::string> files_, warnings_;
    std::function<void(double)> environmentProgress_;
};

/// Memory of parts of a scene, in bytes.
std::uint64_t bytesOf(const Mesh& mesh);
std::uint64_t bytesOf(const Shape& shape);
std::uint64_t bytesOf(const Clip& clip);
std::uint64_t bytesOf(const Rig& rig);
std::uint64_t bytesOf(const Scene& scene);

} // namespace tessera::scenes
