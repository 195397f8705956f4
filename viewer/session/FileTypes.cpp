#include "viewer/session/FileTypes.h"

#include <algorithm>
#include <cassert>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/Extension.h"

namespace tessera::viewer {
namespace {

using Opens = FileType::Opens;
using Saves = FileType::Saves;

constexpr FileType kFileTypes[] = {
    {".gltf", Opens::Scene, Saves::Nothing, "a glTF model"},
    {".glb", Opens::Scene, Saves::Nothing, "a glTF model in one file"},
    {".obj", Opens::Scene, Saves::Nothing, "a Wavefront model"},
    {".json", Opens::Scene, Saves::Scene, "the scene with every edit"},
    {".hdr", Opens::Environment, Saves::Nothing, "an environment"},
    {".exr", Opens::Environment, Saves::Radiance, "the picture's linear radiance, 32 bits a channel"},
    {".png", Opens::Nothing, Saves::Display, "the picture as a display shows it"},
};

} // namespace

std::span<const FileType> fileTypes() {
    return kFileTypes;
}

const FileType* fileTypeOf(const std::filesystem::path& file) {
    const auto found = std::ranges::find(kFileTypes, std::string_view(extensionOf(file)), &FileType::extension);
    return found != std::end(kFileTypes) ? found : nullptr;
}

Dropped takeDropped(std::span<const std::string> files) {
    constexpr std::size_t kMostNamed = 3; // of the other files: a whole folder may be dropped
    assert(!files.empty());
    auto taken = std::ranges::find_if(files, [](const std::string& file) {
        const FileType* const type = fileTypeOf(file);
        return type != nullptr && type->opens != Opens::Nothing;
    });
    if (taken == files.end()) taken = files.begin();
    Dropped dropped{*taken, {}};
    if (files.size() == 1) return dropped;
    const auto nameOf = [](const std::string& file) { return std::filesystem::path(file).filename().string(); };
    std::vector<std::string> others;
    for (auto file = files.begin(); file != files.end() && others.size() < kMostNamed; ++file)
        if (file != taken) others.push_back(nameOf(*file));
    const std::size_t more = files.size() - 1 - others.size();
    dropped.left = fmt::format("Of {} files dropped at once {} opens; not {}{}", files.size(), nameOf(*taken),
                               fmt::join(others, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
    return dropped;
}

} // namespace tessera::viewer
