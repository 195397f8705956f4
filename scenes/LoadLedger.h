#pragma once
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenes/Scene.h"

namespace tessera::scenes {

/// Half of the machine's memory, or of what its control group may use where that is less.
std::uint64_t defaultMemoryLimitBytes();

/// "512 B", "1.5 KiB", "2.0 GiB".
std::string sizeText(std::uint64_t bytes);

/// What one load has read, and the memory it may take. Importers charge what they are about to reserve, so that a small
/// file that asks for much is refused before the memory is gone. Copies are the same ledger.
class LoadLedger {
public:
    explicit LoadLedger(std::optional<std::uint64_t> limitBytes = {});

    /// Throws InputError when `bytes` more would exceed the limit; `who` is called for "file: place" of what asks.
    template <typename Who>
    void charge(std::uint64_t bytes, Who&& who) const {
        if (bytes > state_->limitBytes - state_->usedBytes) refuse(who(), bytes);
        state_->usedBytes += bytes;
    }

    std::uint64_t usedBytes() const { return state_->usedBytes; }
    /// Of all charged since usedBytes() was `markBytes`, only `keptBytes` are still there.
    void settle(std::uint64_t markBytes, std::uint64_t keptBytes) const {
        state_->usedBytes = std::min(markBytes + keptBytes, state_->limitBytes);
    }

    void addFile(const std::filesystem::path& file) const { state_->files.push_back(file.string()); }
    const std::vector<std::string>& files() const { return state_->files; }

private:
    [[noreturn]] void refuse(const std::string& who, std::uint64_t bytes) const;

    struct State {
        std::uint64_t limitBytes = 0;
        std::uint64_t usedBytes = 0; ///< at most limitBytes
        std::vector<std::string> files;
    };
    std::shared_ptr<State> state_;
};

/// Bytes that parts of a scene hold.
std::uint64_t bytesOf(const Mesh& mesh);
std::uint64_t bytesOf(const Scene& scene);

} // namespace tessera::scenes
