#pragma once
#include <cstddef>
#include <filesystem>

/// Readers of files that somebody else may have made. Each returns, or throws InputError; anything else is a finding.
namespace tessera::fuzz {

/// More would only slow the fuzzer: nothing that is read here needs as much.
inline constexpr std::size_t kMemoryLimitBytes = std::size_t{256} << 20;

#define TARGET(name, fileName, read) void read(const std::filesystem::path& file);
#include "tests/fuzz/Targets.inc"
#undef TARGET

} // namespace tessera::fuzz
