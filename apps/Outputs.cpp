#include "apps/Outputs.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "base/AtomicFile.h"
#include "base/Error.h"

namespace tessera::app {
namespace {

std::string canonicalName(const std::string& path) {
    std::error_code failure;
    const std::filesystem::path canonical =
        std::filesystem::weakly_canonical(std::filesystem::absolute(path, failure), failure);
    return failure ? std::string() : canonical.string();
}

bool isWithin(const std::string& identity, const std::string& folder) {
    return identity.size() > folder.size() && identity.starts_with(folder) && identity[folder.size()] == '/';
}

} // namespace

bool isStandardOutput(const std::string& path) {
    return path == "-";
}

void requireOutput(const std::string& path) {
    if (!isStandardOutput(path)) requireWritable(path);
}

/// A file that does not exist yet is identified by its canonical folder and its name. The folder is cached: an image
/// sequence resolves it once.
std::string Outputs::identityOf(const std::string& path) const {
    if (path.empty() || isStandardOutput(path)) return {};
    std::error_code failure;
    if (std::filesystem::exists(std::filesystem::symlink_status(path, failure))) {
        const std::filesystem::file_status status = std::filesystem::status(path, failure);
        const bool isFile = !std::filesystem::exists(status) || std::filesystem::is_regular_file(status);
        return isFile ? canonicalName(path) : std::string();
    }
    const std::filesystem::path name(path);
    if (!name.has_filename()) return canonicalName(path);
    const std::string folder = name.parent_path().string();
    const auto [known, isNew] = canonicalFolders_.try_emplace(folder);
    if (isNew) known->second = canonicalName(folder.empty() ? "." : folder);
    return known->second.empty() ? std::string() : (known->second / name.filename()).string();
}

Outputs::Outputs(const std::vector<std::string>& paths) {
    for (const std::string& path : paths) add(path);
}

void Outputs::requireNotRead(const std::string& file, const std::string& identity) const {
    if (!read_.contains(identity)) return;
    throw InputError(fmt::format("{}: is read for this, and would be written over; name another file", file));
}

void Outputs::add(const std::string& path) {
    const std::string identity = identityOf(path);
    if (identity.empty()) return;
    requireNotRead(path, identity);
    if (!outputs_.try_emplace(identity, path).second)
        throw InputError(fmt::format("{}: two outputs have this name; give each its own", path));
}

void Outputs::addFolder(const std::string& folder) {
    folders_.insert(canonicalName(folder));
    for (const std::string& identity : read_)
        if (isWithin(identity, canonicalName(folder))) requireNotRead(identity, identity);
}

void Outputs::reads(const std::vector<std::string>& files) {
    for (const std::string& file : files) {
        const std::string identity = identityOf(file);
        if (identity.empty()) continue;
        read_.insert(identity);
        if (const auto output = outputs_.find(identity); output != outputs_.end())
            requireNotRead(output->second, identity);
        for (const std::string& folder : folders_)
            if (isWithin(identity, folder)) requireNotRead(file, identity);
    }
}

const std::string& Outputs::at(const std::string& path) const {
    const std::string identity = identityOf(path);
    const bool isRegistered =
        identity.empty() || outputs_.contains(identity) ||
        std::ranges::any_of(folders_, [&](const auto& folder) { return isWithin(identity, folder); });
    if (!isRegistered)
        throw std::logic_error(
            fmt::format("{}: is written, but no output is registered for it; call Outputs::add() first", path));
    return path;
}

void Outputs::write(const std::string& path, std::string_view text) const {
    if (isStandardOutput(path))
        fmt::print("{}", text);
    else
        writeFileAtomically(at(path), text);
}

} // namespace tessera::app
