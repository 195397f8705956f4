#pragma once
#include <array>
#include <span>
#include <variant>

#include "scenes/Material.h"

/// The layers of materials (MaterialModelInfo::hasLayers) as scene files spell them: a table that their reader and
/// their writer follow. Bounds are those of kMaterialFields.
namespace tessera::scenes {

struct LayerParameter {
    const char* key;
    std::variant<float Material::*, glm::vec3 Material::*> member;
    TextureSlot slot = TextureSlot::Count; ///< of the texture that scales it; Count: none
    /// The key is the texture's, the number its scale; neither is there without a texture.
    bool isNormalMap = false;
};

/// In the order of scene files. The first parameter is the layer's strength: where it is 0, nothing is written.
using MaterialLayer = std::span<const LayerParameter>;

namespace detail {
inline constexpr LayerParameter kClearcoat[] = {
    {"clearcoat", &Material::clearcoat, TextureSlot::Clearcoat},
    {"clearcoatPerceptualRoughness", &Material::clearcoatPerceptualRoughness, TextureSlot::ClearcoatRoughness},
    {"clearcoatNormalMap", &Material::clearcoatNormalScale, TextureSlot::ClearcoatNormal, true}};
inline constexpr LayerParameter kSheen[] = {
    {"sheenColor", &Material::sheenColor, TextureSlot::SheenColor},
    {"sheenPerceptualRoughness", &Material::sheenPerceptualRoughness, TextureSlot::SheenRoughness}};
inline constexpr LayerParameter kIridescence[] = {
    {"iridescence", &Material::iridescence, TextureSlot::Iridescence},
    {"iridescenceIor", &Material::iridescenceIor},
    {"iridescenceThicknessNm", &Material::iridescenceThicknessNm, TextureSlot::IridescenceThickness},
    {"iridescenceLeastThicknessNm", &Material::iridescenceLeastThicknessNm}};
inline constexpr LayerParameter kTransmission[] = {
    {"transmission", &Material::transmission, TextureSlot::Transmission},
    {"thicknessMetres", &Material::thicknessMetres, TextureSlot::Thickness},
    {"attenuationColor", &Material::attenuationColor},
    {"attenuationDistanceMetres", &Material::attenuationDistanceMetres},
    {"dispersion", &Material::dispersion}};
inline constexpr std::array<MaterialLayer, 4> kMaterialLayers{kClearcoat, kSheen, kIridescence, kTransmission};
} // namespace detail

constexpr std::span<const MaterialLayer> materialLayers() {
    return detail::kMaterialLayers;
}

} // namespace tessera::scenes
