#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <variant>

#include <glm/glm.hpp>

#include "scenes/Camera.h"
#include "scenes/Light.h"
#include "scenes/Material.h"
#include "scenes/Texture.h"

/// The properties that clips can animate. Source: glTF 2.0 specification, section 3.11; KHR_animation_pointer.
namespace tessera::scenes {

/// The property that an animation channel changes; animatedProperties() describes each.
enum class AnimatedProperty : std::uint8_t {
    Translation,
    Rotation,
    Scale,
    NodeVisibility, ///< 0 or 1; multiplies Scale, and LightIntensity of lights below (AnimationChannel::factor)
    Weights,
    LightColor,
    LightIntensity,
    LightRange,
    LightInnerCone,
    LightOuterCone,
    BaseColor,
    Emissive,
    Metallic,
    PerceptualRoughness,
    NormalScale,
    OcclusionStrength,
    AlphaCutoff,
    EmissiveStrength, ///< multiplies Emissive (AnimationChannel::factor)
    Ior,
    SpecularFactor,
    SpecularColor,
    AnisotropyStrength,
    AnisotropyRotation,
    Clearcoat,
    ClearcoatRoughness,
    ClearcoatNormalScale,
    SheenColor,
    SheenRoughness,
    Iridescence,
    IridescenceIor,
    IridescenceLeastThickness,
    IridescenceThickness,
    Transmission,
    Thickness,
    AttenuationDistance,
    AttenuationColor,
    Dispersion,
    TextureOffset,
    TextureScale,
    TextureRotation,
    CameraFovY,
    CameraPerspectiveNear,
    CameraPerspectiveFar,
    CameraHalfHeight,
    CameraOrthographicNear,
    CameraOrthographicFar,
    Count
};

/// The kind of scene element that has a property. Texture: the transform of one of a material's textures.
enum class AnimatedOwner : std::uint8_t { Node, Weights, Light, Material, Texture, Camera };

/// Whether the owner's properties are listed in Rig::numbers.
constexpr bool ownsNumbers(AnimatedOwner owner) {
    return owner != AnimatedOwner::Node && owner != AnimatedOwner::Weights;
}

/// Whether RestNumber::element indexes Scene::materials.
constexpr bool isOfMaterial(AnimatedOwner owner) {
    return owner == AnimatedOwner::Material || owner == AnimatedOwner::Texture;
}

/// The data member of the owner that holds the property.
using AnimatedMember =
    std::variant<std::monostate, float Light::*, glm::vec3 Light::*, float Material::*, glm::vec3 Material::*,
                 glm::vec4 Material::*, float TextureTransform::*, glm::vec2 TextureTransform::*, double Camera::*>;

/// The components of a member; unused ones are 0, and all are 0 if `owner` lacks the member.
template <typename Owner>
glm::dvec4 numberOf(const Owner& owner, const AnimatedMember& member) {
    glm::dvec4 number(0.0);
    std::visit(
        [&](auto memberOfAny) {
            if constexpr (requires { owner.*memberOfAny; }) {
                const auto& value = owner.*memberOfAny;
                if constexpr (std::is_floating_point_v<std::decay_t<decltype(value)>>)
                    number.x = value;
                else
                    for (glm::length_t i = 0; i < value.length(); ++i) number[i] = value[i];
            }
        },
        member);
    return number;
}

struct AnimatedPropertyInfo {
    AnimatedProperty property;
    AnimatedOwner owner;   ///< selects the Rig list that AnimationChannel::target indexes
    std::string_view path; ///< in glTF, relative to the node, light, material, texture info or camera
    int width;             ///< components of a value; 0: one per morph target
    AnimatedMember member{};
    /// Bounds of animated values, besides those of the member itself.
    double least = -kInfinity, most = kInfinity;

    constexpr AnimatedPropertyInfo(AnimatedProperty property_, AnimatedOwner owner_, std::string_view path_, int width_)
        : property(property_), owner(owner_), path(path_), width(width_) {}
    template <typename Owner, typename Value>
    constexpr AnimatedPropertyInfo(AnimatedProperty property_, AnimatedOwner owner_, std::string_view path_,
                                   Value Owner::*member_, double least_ = -kInfinity, double most_ = kInfinity)
        : property(property_), owner(owner_), path(path_), width(widthOf<Value>()), member(member_), least(least_),
          most(most_) {}

private:
    template <typename Value>
    static consteval int widthOf() {
        if constexpr (std::is_floating_point_v<Value>)
            return 1;
        else
            return int(Value::length());
    }
};

namespace detail {
// Just inside 0 and 180 degrees, where the projection degenerates.
inline constexpr double kLeastFovRadians = 1e-6, kMostFovRadians = 3.14159;

inline constexpr auto kAnimatedProperties = [] {
    using P = AnimatedProperty;
    using O = AnimatedOwner;
    return std::to_array<AnimatedPropertyInfo>({
        {P::Translation, O::Node, "translation", 3},
        {P::Rotation, O::Node, "rotation", 4},
        {P::Scale, O::Node, "scale", 3},
        {P::NodeVisibility, O::Node, "extensions/KHR_node_visibility/visible", 1},
        {P::Weights, O::Weights, "weights", 0},
        {P::LightColor, O::Light, "color", &Light::color},
        {P::LightIntensity, O::Light, "intensity", &Light::intensity},
        {P::LightRange, O::Light, "range", &Light::rangeMetres},
        {P::LightInnerCone, O::Light, "spot/innerConeAngle", &Light::innerConeRadians},
        {P::LightOuterCone, O::Light, "spot/outerConeAngle", &Light::outerConeRadians},
        {P::BaseColor, O::Material, "pbrMetallicRoughness/baseColorFactor", &Material::baseColor},
        {P::Emissive, O::Material, "emissiveFactor", &Material::emissive},
        {P::Metallic, O::Material, "pbrMetallicRoughness/metallicFactor", &Material::metallic},
        {P::PerceptualRoughness, O::Material, "pbrMetallicRoughness/roughnessFactor", &Material::perceptualRoughness},
        {P::NormalScale, O::Material, "normalTexture/scale", &Material::normalScale},
        {P::OcclusionStrength, O::Material, "occlusionTexture/strength", &Material::occlusionStrength},
        {P::AlphaCutoff, O::Material, "alphaCutoff", &Material::alphaCutoff},
        {P::EmissiveStrength, O::Material, "extensions/KHR_materials_emissive_strength/emissiveStrength", 1},
        {P::Ior, O::Material, "extensions/KHR_materials_ior/ior", &Material::ior, 1.0},
        {P::SpecularFactor, O::Material, "extensions/KHR_materials_specular/specularFactor", &Material::specularFactor},
        {P::SpecularColor, O::Material, "extensions/KHR_materials_specular/specularColorFactor",
         &Material::specularColor},
        {P::AnisotropyStrength, O::Material, "extensions/KHR_materials_anisotropy/anisotropyStrength",
         &Material::anisotropyStrength},
        {P::AnisotropyRotation, O::Material, "extensions/KHR_materials_anisotropy/anisotropyRotation",
         &Material::anisotropyRotationRadians},
        {P::Clearcoat, O::Material, "extensions/KHR_materials_clearcoat/clearcoatFactor", &Material::clearcoat},
        {P::ClearcoatRoughness, O::Material, "extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor",
         &Material::clearcoatPerceptualRoughness},
        {P::ClearcoatNormalScale, O::Material, "extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale",
         &Material::clearcoatNormalScale},
        {P::SheenColor, O::Material, "extensions/KHR_materials_sheen/sheenColorFactor", &Material::sheenColor},
        {P::SheenRoughness, O::Material, "extensions/KHR_materials_sheen/sheenRoughnessFactor",
         &Material::sheenPerceptualRoughness},
        {P::Iridescence, O::Material, "extensions/KHR_materials_iridescence/iridescenceFactor", &Material::iridescence},
        {P::IridescenceIor, O::Material, "extensions/KHR_materials_iridescence/iridescenceIor",
         &Material::iridescenceIor},
        {P::IridescenceLeastThickness, O::Material, "extensions/KHR_materials_iridescence/iridescenceThicknessMinimum",
         &Material::iridescenceLeastThicknessNm},
        {P::IridescenceThickness, O::Material, "extensions/KHR_materials_iridescence/iridescenceThicknessMaximum",
         &Material::iridescenceThicknessNm},
        {P::Transmission, O::Material, "extensions/KHR_materials_transmission/transmissionFactor",
         &Material::transmission},
        {P::Thickness, O::Material, "extensions/KHR_materials_volume/thicknessFactor", &Material::thicknessMetres},
        {P::AttenuationDistance, O::Material, "extensions/KHR_materials_volume/attenuationDistance",
         &Material::attenuationDistanceMetres, 1e-6},
        {P::AttenuationColor, O::Material, "extensions/KHR_materials_volume/attenuationColor",
         &Material::attenuationColor},
        {P::Dispersion, O::Material, "extensions/KHR_materials_dispersion/dispersion", &Material::dispersion},
        {P::TextureOffset, O::Texture, "extensions/KHR_texture_transform/offset", &TextureTransform::offset,
         -kMostTextureNumber, kMostTextureNumber},
        {P::TextureScale, O::Texture, "extensions/KHR_texture_transform/scale", &TextureTransform::scale,
         -kMostTextureNumber, kMostTextureNumber},
        {P::TextureRotation, O::Texture, "extensions/KHR_texture_transform/rotation",
         &TextureTransform::rotationRadians},
        {P::CameraFovY, O::Camera, "perspective/yfov", &Camera::fovYRadians, kLeastFovRadians, kMostFovRadians},
        {P::CameraPerspectiveNear, O::Camera, "perspective/znear", &Camera::nearMetres, kNearestPlaneMetres,
         kFarthestMetres},
        {P::CameraPerspectiveFar, O::Camera, "perspective/zfar", &Camera::farMetres, kNearestPlaneMetres},
        {P::CameraHalfHeight, O::Camera, "orthographic/ymag", &Camera::halfHeightMetres, kNearestPlaneMetres,
         kFarthestMetres},
        {P::CameraOrthographicNear, O::Camera, "orthographic/znear", &Camera::nearMetres, 0.0, kFarthestMetres},
        {P::CameraOrthographicFar, O::Camera, "orthographic/zfar", &Camera::farMetres, kNearestPlaneMetres},
    });
}();
consteval bool areAnimatedPropertiesSound() {
    for (std::size_t i = 0; i < kAnimatedProperties.size(); ++i)
        if (kAnimatedProperties[i].property != AnimatedProperty(i)) return false;
    return kAnimatedProperties.size() == std::size_t(AnimatedProperty::Count);
}
static_assert(areAnimatedPropertiesSound(), "the table of animated properties follows the enumeration");
} // namespace detail

/// The single table of animated properties, indexed by AnimatedProperty.
constexpr std::span<const AnimatedPropertyInfo> animatedProperties() {
    return detail::kAnimatedProperties;
}
constexpr const AnimatedPropertyInfo& infoOf(AnimatedProperty property) {
    return detail::kAnimatedProperties[std::size_t(property)];
}

} // namespace tessera::scenes
