#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace tessera {

/// Writes a whole file or nothing: the bytes go to a temporary file in the same folder, which then takes the name of
/// `path`. When anything fails the temporary is removed, an earlier file of that name stays as it was, and
/// std::runtime_error names the path, the reason and the remedy. Links are followed; the permissions of an earlier file
/// are kept. Devices and pipes (/dev/stdout) cannot be replaced and are written straight.
void writeFileAtomically(const std::string& path, std::string_view text);
void writeFileAtomically(const std::string& path, std::span<const std::uint8_t> bytes);

/// Throws writeFileAtomically()'s exception for a path where no file can be written, before the work is done in vain.
void requireWritable(const std::string& path);

/// Removes the temporaries of the writes under way in any thread. Async-signal-safe, for the handlers of signals that
/// end the program; the writes themselves must not go on afterwards.
void removeTemporaries() noexcept;

} // namespace tessera
