#include "scenes/import/FileBytes.h"

#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "base/Error.h"

namespace tessera::scenes {

std::vector<std::byte> readFileBytes(const std::filesystem::path& file, LoadLedger& ledger) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status))
        throw InputError(fmt::format("{}: there is no such file; check the name and the folder", file.string()));
    if (!std::filesystem::is_regular_file(status))
        throw InputError(fmt::format("{}: is not a regular file; name the file itself", file.string()));
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    std::ifstream stream(file, std::ios::binary);
    if (error || !stream) throw InputError(fmt::format("{}: cannot be opened; check its permissions", file.string()));
    ledger.addFile(file);
    ledger.charge(size, [&] { return file.string(); });
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    if (size > 0 && !stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        throw InputError(
            fmt::format("{}: only {} of its {} bytes could be read", file.string(), stream.gcount(), size));
    return bytes;
}

} // namespace tessera::scenes
