#include "renderer/shader/SourceTree.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

#include "base/Error.h"
#include "shaders/Embedded.h"

namespace tessera::shader {
namespace {

constexpr const char* kFolderVariable = "TESSERA_SHADERS";

std::filesystem::path checkedFolder(std::filesystem::path folder, std::string_view source) {
    std::error_code error;
    if (!std::filesystem::is_directory(folder, error))
        throw InputError(fmt::format("{}: no such shader folder{}", folder.string(), source));
    return folder;
}

} // namespace

SourceTree::SourceTree() {
    const char* folder = std::getenv(kFolderVariable);
    if (folder && *folder != '\0')
        folder_ = checkedFolder(
            folder, fmt::format("; correct or unset the environment variable {}, which names it", kFolderVariable));
}

SourceTree::SourceTree(std::filesystem::path folder)
    : folder_(checkedFolder(std::move(folder), "; name the folder that holds lib/ and passes/")) {}

SourceTree SourceTree::embedded() {
    return SourceTree(Embedded{});
}

std::optional<std::string> SourceTree::read(std::string_view path) const {
    if (isEmbedded() && !std::filesystem::path(path).is_absolute()) {
        const std::optional<std::string_view> text = shaders::embeddedShader(path);
        return text ? std::optional<std::string>(*text) : std::nullopt;
    }
    const std::filesystem::path file = folder_ / path;
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (!stream) throw InputError(fmt::format("{}: the shader cannot be read; check its permissions", file.string()));
    return text;
}

std::string SourceTree::describe() const {
    return isEmbedded() ? "the embedded shaders" : folder_.string();
}

std::optional<std::filesystem::file_time_type> SourceTree::newestChange() const {
    if (isEmbedded()) return std::nullopt;
    std::optional<std::filesystem::file_time_type> newest;
    // Files may vanish while editors save them; errors are ignored, and the next call tries again.
    std::error_code error;
    for (std::filesystem::recursive_directory_iterator entry(folder_, error), end; !error && entry != end;
         entry.increment(error)) {
        std::error_code timeError;
        const auto time = entry->last_write_time(timeError);
        if (!timeError) newest = std::max(newest.value_or(time), time);
    }
    return newest;
}

} // namespace tessera::shader
