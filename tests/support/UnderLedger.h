#pragma once
#include <cstdint>
#include <optional>
#include <utility>

#include "scenes/LoadLedger.h"

// In the namespace of LoadLedger, so that calls find it.
namespace tessera::scenes {

inline constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;

inline ImportWishes strictly() {
    ImportWishes wishes;
    wishes.isStrict = true;
    return wishes;
}

/// Calls `read` on `input` with a separate ledger, for tests that read one file.
template <typename Read, typename Input>
auto underLedger(const Read& read, const Input& input, std::optional<std::uint64_t> limitBytes = {},
                 ImportWishes wishes = {}) {
    LoadLedger ledger(limitBytes, std::move(wishes));
    return read(input, ledger);
}

} // namespace tessera::scenes
