#include "apps/OutputFolder.h"

#include <algorithm>
#include <filesystem>
#include <functional>
#include <stdexcept>

#include <fmt/format.h>

#include "base/AtomicFile.h"
#include "base/Utf8.h"

namespace tessera::app {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& folder, const std::string& reason) {
    throw std::runtime_error(fmt::format("cannot write into the folder '{}': {}; name another", folder, reason));
}

} // namespace

void requireFolderPlace(const std::string& folder) {
    if (folder.empty()) fail(folder, "its name is empty");
    std::error_code ignored;
    fs::path existing = fs::absolute(folder);
    while (!fs::exists(fs::symlink_status(existing, ignored)) && existing.has_relative_path())
        existing = existing.parent_path();
    if (!fs::is_directory(existing, ignored)) fail(folder, existing.string() + " is not a folder");
    try {
        requireWritable((existing / "index.html").string());
    } catch (const std::runtime_error&) {
        fail(folder, existing.string() + " cannot be written to");
    }
}

void makeFolder(const std::string& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) fail(folder, error.message());
}

std::string pictureFile(const std::string& name, const std::string& extension) {
    std::string file = name;
    std::erase_if(file, [](char c) { return c == '(' || c == ')'; });
    std::ranges::replace_if(
        file, [](unsigned char c) { return c <= ' ' || c == 0x7f || c == '/' || c == '\\' || c == ':'; }, '_');
    if (file.starts_with('.')) file.front() = '_'; // would be a hidden file
    constexpr std::size_t kMostBytes = 200;        // file systems allow 255
    if (file.size() > kMostBytes)
        file = fmt::format("{}_{:016x}", beginningOf(file, kMostBytes), std::hash<std::string>()(name));
    return (file.empty() ? "picture" : file) + extension;
}

} // namespace tessera::app
