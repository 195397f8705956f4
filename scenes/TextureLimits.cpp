#include "scenes/TextureLimits.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "scenes/AveragedMap.h"
#include "scenes/LoadLedger.h"
#include "scenes/import/Repairs.h"

namespace tessera::scenes {
namespace {

void averageLargeImages(Scene& scene, const std::string& source, LoadLedger& ledger, Repairs& repairs) {
    struct Use {
        bool isTexture = false, isSrgb = false;
    };
    std::vector<Use> uses(scene.images.size());
    for (const Material& material : scene.materials)
        for (std::size_t slot = 0; slot < kTextureSlotCount; ++slot) {
            const auto image = std::size_t(material.textures[slot].image);
            if (image >= uses.size()) continue; // none, or one that checkScene() rejects
            uses[image].isTexture = true;
            uses[image].isSrgb |= infoOf(TextureSlot(slot)).isSrgb;
        }
    for (std::size_t i = 0; i < uses.size(); ++i) {
        Image& image = scene.images[i];
        if (!uses[i].isTexture || std::max(image.width, image.height) <= kMostTextureSide) continue;
        const int width = std::min(image.width, kMostTextureSide), height = std::min(image.height, kMostTextureSide);
        repairs.note(source, 0, fmt::format("its averages in {}x{} texels are drawn", width, height),
                     "the picture '{}' has {}x{} texels, and textures have at most {} a side", image.name, image.width,
                     image.height, kMostTextureSide);
        const std::uint64_t mark = ledger.usedBytes();
        ledger.charge(std::uint64_t(width) * std::uint64_t(height) * texelBytes(image.format),
                      [&] { return fmt::format("{}: the averages of '{}'", source, image.name); });
        image = averagedPicture(image, width, height, uses[i].isSrgb);
        ledger.settle(mark, 0);
    }
}

using TexCoords = std::array<std::vector<glm::vec2>, 2>;

/// Clamps texture coordinates; returns whether any changed. Infinity and NaN stay; checkScene() rejects them.
bool clampCoordinates(TexCoords& texCoords) {
    constexpr auto kMost = float(kMostTextureNumber);
    bool isChanged = false;
    for (std::vector<glm::vec2>& set : texCoords)
        for (glm::vec2& uv : set)
            for (int i = 0; i < 2; ++i)
                if (std::isfinite(uv[i]) && std::abs(uv[i]) > kMost) {
                    uv[i] = std::clamp(uv[i], -kMost, kMost);
                    isChanged = true;
                }
    return isChanged;
}

/// Maximum absolute coordinates of each set.
using Reach = std::array<glm::dvec2, 2>;

Reach reachOf(const TexCoords& texCoords) {
    Reach reach{};
    for (std::size_t set = 0; set < texCoords.size(); ++set)
        for (const glm::vec2& uv : texCoords[set]) reach[set] = glm::max(reach[set], glm::dvec2(glm::abs(uv)));
    return reach;
}

/// Keeps texel indices within 32 bits: coordinates beyond +-2^29 texels are scaled to +-2^10, where all renderers find
/// the same ones, and offsets beyond it are wrapped or clamped. Returns whether the image changes.
bool keepPlaces(TextureUse& use, const Image& image, const Reach& reach) {
    constexpr double kMostTexels = 1 << 29, kKeptTexels = 1 << 10;
    TextureTransform& transform = use.transform;
    const double side = std::max({image.width, image.height, 1});
    const glm::dvec2 uv = reach[std::size_t(std::clamp(use.texCoordSet, 0, 1))];
    const double repeats = glm::dot(glm::abs(glm::dvec2(transform.scale)), uv); // whatever the rotation
    const bool isChanged = repeats * side > kMostTexels;
    if (isChanged) transform.scale = glm::vec2(glm::dvec2(transform.scale) * (kKeptTexels / side / repeats));
    for (int i = 0; i < 2; ++i) {
        float& offset = transform.offset[i];
        if (!(std::abs(double(offset)) * side > kMostTexels)) continue;
        // The image does not change: mirrored textures repeat after 2, and clamped ones still show their edge.
        const bool isClamped = (i == 0 ? use.sampler.wrapU : use.sampler.wrapV) == Wrap::ClampToEdge;
        offset = isClamped ? std::copysign(float(kMostTexels / side), offset) : std::fmod(offset, 2.0f);
    }
    return isChanged;
}

void keepTexturePlaces(Scene& scene, const std::string& source, Repairs& repairs) {
    const auto note = [&](const std::string& what) { repairs.note(source, 0, "drawn with fewer repeats", "{}", what); };
    std::vector<bool> isClamped;
    std::vector<Reach> ofMeshes, ofMaterials(scene.materials.size(), Reach{});
    for (Mesh& mesh : scene.meshes) {
        isClamped.push_back(clampCoordinates(mesh.texCoords));
        ofMeshes.push_back(reachOf(mesh.texCoords));
    }
    for (Shape& shape : scene.rig.shapes) {
        clampCoordinates(shape.rest.texCoords); // the same as of its mesh
        for (MorphTarget& target : shape.targets) clampCoordinates(target.texCoords);
    }
    const auto hasTexture = [](const Material& material) {
        return std::ranges::any_of(material.textures, [](const TextureUse& use) { return use.image != kNone; });
    };
    for (const Node& node : scene.nodes)
        for (const MeshInstance& instance : node.instances) {
            const auto material = std::size_t(instance.material), mesh = std::size_t(instance.mesh);
            if (material >= ofMaterials.size() || mesh >= ofMeshes.size()) continue; // checkScene() refuses it
            for (std::size_t set = 0; set < ofMeshes[mesh].size(); ++set)
                ofMaterials[material][set] = glm::max(ofMaterials[material][set], ofMeshes[mesh][set]);
            if (isClamped[mesh] && hasTexture(scene.materials[material]))
                note(fmt::format("mesh '{}' has texture coordinates beyond {:.3g}", scene.meshes[mesh].name,
                                 kMostTextureNumber));
        }
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        for (std::size_t slot = 0; slot < kTextureSlotCount; ++slot) {
            TextureUse& use = scene.materials[i].textures[slot];
            if (std::size_t(use.image) >= scene.images.size()) continue; // none
            if (keepPlaces(use, scene.images[std::size_t(use.image)], ofMaterials[i]))
                note(fmt::format("material '{}' repeats its {} past 2^30 texels", scene.materials[i].name,
                                 infoOf(TextureSlot(slot)).what));
        }
}

} // namespace

void keepTextureLimits(Scene& scene, const std::string& source, LoadLedger& ledger) {
    Repairs repairs(ledger.importOptions().isStrict);
    averageLargeImages(scene, source, ledger, repairs);
    keepTexturePlaces(scene, source, repairs);
    const std::vector<std::string> warnings = repairs.warnings();
    scene.warnings.insert(scene.warnings.end(), warnings.begin(), warnings.end());
}

} // namespace tessera::scenes
