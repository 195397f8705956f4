#pragma once
#include <array>
#include <span>
#include <variant>

#include "scenes/Material.h"

/// Keys of material layers (MaterialModelInfo::hasLayers) in scene files: a table for reader and writer. Bounds are
/// those of kMaterialFields.
namespace tessera::scenes {

struct LayerParameter {
    const char* key;
    std::variant<float Material::*, glm::vec3 Material::*> member;
    TextureSlot slot = TextureSlot::Count; ///< slot of the texture that scales it; Count: none
    /// The key holds a texture, and the member its scale; omitted without a texture.
    bool isNormalMap = false;
};

/// Parameters in the order of scene files. The first is the layer's strength: if it is 0, nothing is written.
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
