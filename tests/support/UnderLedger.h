#pragma once
#include <cstdint>
#include <optional>
#include <utility>

#include "scenes/LoadLedger.h"

// In the namespace of LoadLedger, so that calls find it.
namespace tessera::scenes {

inline constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;

inline ImportOptions strictly() {
    ImportOptions importOptions;
    importOptions.isStrict = true;
    return importOptions;
}

/// Calls `read` on `input` with a separate ledger, for tests that read one file.
template <typename Read, typename Input>
auto underLedger(const Read& read, const Input& input, std::optional<std::uint64_t> limitBytes = {},
                 ImportOptions importOptions = {}) {
    LoadLedger ledger(limitBytes, std::move(importOptions));
    return read(input, ledger);
}

} // namespace tessera::scenes
