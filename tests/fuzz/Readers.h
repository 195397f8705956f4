#pragma once
#include <cstddef>
#include <filesystem>

/// Readers of files from untrusted sources. Each returns, or throws InputError; anything else is a finding.
namespace tessera::fuzz {

/// A higher limit would only slow the fuzzer: no input here needs as much.
inline constexpr std::size_t kMemoryLimitBytes = std::size_t{256} << 20;

#define TARGET(name, fileName, read) void read(const std::filesystem::path& file);
#include "tests/fuzz/Targets.inc"
#undef TARGET

} // namespace tessera::fuzz
