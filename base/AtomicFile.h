#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tessera {

/// Writes a whole file or nothing: the bytes go to a temporary file in the same folder, which then takes the name of
/// `path`. When anything fails the temporary is removed, an earlier file of that name stays as it was, and
/// std::runtime_error names the path, the reason and the remedy. Links are followed; the permissions of an earlier file
/// are kept. Devices and pipes (/dev/stdout) cannot be replaced and are written directly.
void writeFileAtomically(const std::string& path, std::string_view text);
void writeFileAtomically(const std::string& path, std::span<const std::uint8_t> bytes);

/// Throws writeFileAtomically()'s exception early if no file can be written at `path`.
void requireWritable(const std::string& path);

/// Removes the temporary files of ongoing writes in all threads. Async-signal-safe, for handlers of terminating
/// signals; the writes must not continue afterwards.
void removeTemporaries() noexcept;

} // namespace tessera
