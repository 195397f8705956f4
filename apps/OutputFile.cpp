#include "apps/OutputFile.h"

#include <filesystem>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "scenes/Error.h"
#include "validation/AtomicFile.h"

namespace tessera::app {
namespace {

/// One text for all names of a file, which need not exist; nothing for what is no file: a device, a pipe.
std::string identityOf(const std::string& path) {
    if (path.empty() || isStandardOutput(path)) return {};
    std::error_code failure;
    const std::filesystem::file_status status = std::filesystem::status(path, failure);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) return {};
    const std::filesystem::path canonical =
        std::filesystem::weakly_canonical(std::filesystem::absolute(path, failure), failure);
    return failure ? std::string() : canonical.string();
}

} // namespace

bool isStandardOutput(const std::string& path) {
    return path == "-";
}

void requireOutput(const std::string& path) {
    if (!isStandardOutput(path)) validation::requireWritable(path);
}

void requireNotRead(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
    std::set<std::string> read, written;
    for (const std::string& input : inputs) read.insert(identityOf(input));
    for (const std::string& output : outputs) {
        const std::string identity = identityOf(output);
        if (identity.empty()) continue;
        if (read.contains(identity))
            throw InputError(fmt::format("{}: is read for this, and would be written over; name another file", output));
        if (!written.insert(identity).second)
            throw InputError(fmt::format("{}: two outputs have this name; give each its own", output));
    }
}

void writeOutput(const std::string& path, std::string_view text) {
    if (isStandardOutput(path))
        fmt::print("{}", text);
    else
        validation::writeFileAtomically(path, text);
}

} // namespace tessera::app
