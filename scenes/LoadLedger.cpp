#include "scenes/LoadLedger.h"

#include <algorithm>
#include <fstream>
#include <set>

#include <fmt/format.h>
#include <unistd.h>

#include "base/Error.h"

namespace tessera::scenes {
namespace {

constexpr std::uint64_t kUnknownMachineBytes = std::uint64_t{8} << 30;

template <typename Element>
std::uint64_t bytesOf(const std::vector<Element>& elements) {
    return elements.size() * sizeof(Element);
}

/// Memory on the heap, without the object itself.
std::uint64_t bytesWithin(const LightKeys& keys) {
    return bytesOf(keys.timesSeconds) + bytesOf(keys.values) + bytesOf(keys.inTangents) + bytesOf(keys.outTangents);
}

} // namespace

std::uint64_t defaultMemoryLimitBytes() {
    std::uint64_t machineBytes = kUnknownMachineBytes;
    const long pages = sysconf(_SC_PHYS_PAGES), pageBytes = sysconf(_SC_PAGESIZE);
    if (pages > 0 && pageBytes > 0)
        machineBytes = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(pageBytes);
    return std::min(machineBytes, groupLimitBytes().value_or(machineBytes)) / 2;
}

std::optional<std::uint64_t> groupLimitBytes(const std::filesystem::path& membership,
                                             const std::filesystem::path& groups) {
    std::optional<std::uint64_t> least;
    std::ifstream lines(membership);
    // Each line is NUMBER:CONTROLLERS:/PATH; version 2 names no controllers.
    for (std::string line; std::getline(lines, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const bool isVersion2 = controllers == ",,";
        if (!isVersion2 && controllers.find(",memory,") == std::string::npos) continue;
        const std::filesystem::path root = isVersion2 ? groups : groups / "memory";
        // In a container the path may be the host's, and only the root exists.
        std::filesystem::path group = (root / line.substr(std::min(second + 2, line.size()))).lexically_normal();
        const bool isBelowRoot = std::ranges::mismatch(root, group).in1 == root.end();
        if (!isBelowRoot) group = root;
        while (true) {
            // A number, or "max".
            std::ifstream file(group / (isVersion2 ? "memory.max" : "memory.limit_in_bytes"));
            if (std::uint64_t bytes = 0; file >> bytes && bytes > 0) least = std::min(bytes, least.value_or(bytes));
            if (group == root || !group.has_relative_path()) break;
            group = group.parent_path();
        }
    }
    return least;
}

std::string sizeText(std::uint64_t bytes) {
    if (bytes < 1024) return fmt::format("{} B", bytes);
    double size = static_cast<double>(bytes) / 1024.0;
    const char* unit = "KiB";
    for (const char* larger : {"MiB", "GiB", "TiB", "PiB", "EiB"}) {
        if (size < 1024.0) break;
        size /= 1024.0;
        unit = larger;
    }
    return fmt::format("{:.1f} {}", size, unit);
}

LoadLedger::LoadLedger(std::optional<std::uint64_t> limitBytes, ImportOptions importOptions)
    : limitBytes_(limitBytes ? *limitBytes : defaultMemoryLimitBytes()), importOptions_(std::move(importOptions)) {}

void LoadLedger::refuse(const std::string& who, std::uint64_t bytes) const {
    throw MemoryRefused(
        fmt::format("{}: needs {} of memory, and {} are in use; a load may take {}; use a smaller file, or raise "
                    "the memory limit",
                    who, sizeText(bytes), sizeText(usedBytes_), sizeText(limitBytes_)));
}

std::uint64_t bytesOf(const Mesh& mesh) {
    return sizeof(Mesh) + mesh.name.size() + bytesOf(mesh.positionsOS) + bytesOf(mesh.normalsOS) +
           bytesOf(mesh.tangentsOS) + bytesOf(mesh.texCoords[0]) + bytesOf(mesh.texCoords[1]) + bytesOf(mesh.colors) +
           bytesOf(mesh.indices);
}

std::uint64_t bytesOf(const Shape& shape) {
    std::uint64_t bytes = sizeof(Shape) + bytesOf(shape.rest) + bytesOf(shape.joints) + bytesOf(shape.weights);
    for (const MorphTarget& target : shape.targets)
        bytes += sizeof(MorphTarget) + bytesOf(target.positionsOS) + bytesOf(target.normalsOS) +
                 bytesOf(target.tangentsOS) + bytesOf(target.texCoords[0]) + bytesOf(target.texCoords[1]) +
                 bytesOf(target.colors);
    return bytes;
}

std::uint64_t bytesOf(const Clip& clip) {
    std::uint64_t bytes = sizeof(Clip) + clip.name.size() + bytesOf(clip.channels);
    for (const AnimationSampler& sampler : clip.samplers)
        bytes += sizeof(AnimationSampler) + bytesOf(sampler.timesSeconds) + bytesOf(sampler.values);
    return bytes;
}

std::uint64_t bytesOf(const Rig& rig) {
    std::uint64_t bytes = bytesOf(rig.playing) + bytesOf(rig.nodes) + bytesOf(rig.weights) + bytesOf(rig.numbers) +
                          bytesOf(rig.deformed) + bytesOf(rig.lights) + bytesOf(rig.cameras);
    for (const Clip& clip : rig.clips) bytes += bytesOf(clip);
    for (const std::vector<float>& rest : rig.weights) bytes += bytesOf(rest);
    for (const Skin& skin : rig.skins)
        bytes += sizeof(Skin) + skin.name.size() + bytesOf(skin.joints) + bytesOf(skin.jointFromBind);
    for (const Shape& shape : rig.shapes) bytes += bytesOf(shape);
    return bytes;
}

std::uint64_t bytesOf(const Scene& scene) {
    std::uint64_t bytes =
        sizeof(Scene) + bytesOf(scene.rig) + bytesOf(scene.materials) + bytesOf(scene.lights) + bytesOf(scene.cameras);
    for (const Image& image : scene.images) bytes += sizeof(Image) + image.name.size() + image.texels.size();
    if (scene.environment) bytes += scene.environment->source.size() + scene.environment->map.texels.size();
    for (const Material& material : scene.materials) bytes += material.name.size();
    for (const Mesh& mesh : scene.meshes) bytes += bytesOf(mesh);
    for (const Node& node : scene.nodes) bytes += sizeof(Node) + node.name.size() + bytesOf(node.instances);
    std::set<const LightPicture*> pictures; // lights may share a texture
    for (const Light& light : scene.lights) {
        bytes += light.name.size();
        if (light.texture && pictures.insert(&*light.texture).second)
            bytes += sizeof(LightPicture) + light.texture->source.size() + light.texture->map.texels.size();
        if (light.animation) bytes += bytesOf(light.animation->pointsWS) + bytesWithin(light.animation->keys);
        bytes += bytesOf(light.keyframes);
        for (const LightKeys& keys : light.keyframes) bytes += bytesWithin(keys);
    }
    for (const Camera& camera : scene.cameras) bytes += camera.name.size();
    for (const auto& [key, option] : scene.options.requested) {
        bytes += sizeof(key) + sizeof(option) + key.size();
        if (const auto* text = std::get_if<std::string>(&option)) bytes += text->size();
        if (const auto* list = std::get_if<std::vector<double>>(&option)) bytes += bytesOf(*list);
    }
    for (const auto* words : {&scene.variants, &scene.notes, &scene.warnings})
        for (const std::string& text : *words) bytes += sizeof(std::string) + text.size();
    return bytes;
}

} // namespace tessera::scenes
