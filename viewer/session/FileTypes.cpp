#include "viewer/session/FileTypes.h"

#include <algorithm>

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

} // namespace tessera::viewer
