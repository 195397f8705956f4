#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

/// What is fuzzed: readers of files that somebody else may have made.
namespace tessera::fuzz {

/// More would only slow the fuzzer: nothing that is read here needs as much.
inline constexpr std::size_t kMemoryLimitBytes = std::size_t{256} << 20;

struct Target {
    std::string_view name;     ///< also of its folder of seeds, tests/fuzz/corpus/NAME
    std::string_view fileName; ///< of the input, in a folder of its own
    /// Reads the file. Returns, or throws InputError; anything else is a finding.
    void (*read)(const std::filesystem::path& file);
};

std::span<const Target> targets();

} // namespace tessera::fuzz
