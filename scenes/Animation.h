#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Camera.h"
#include "scenes/Interpolation.h"
#include "scenes/Light.h"
#include "scenes/Material.h"
#include "scenes/Mesh.h"
#include "scenes/Texture.h"

/// What moves in a scene, as plain data: clips of keyframes, skins and morph targets. scenes/Pose.h says how the scene
/// looks at a time. Source: glTF 2.0 specification, sections 3.7.3, 3.7.2.2 and 3.11; KHR_animation_pointer.
namespace tessera::scenes {

// ---- Clips ---------------------------------------------------------------------------------------------------------

/// A curve over time: clamped before its first key and after its last.
struct AnimationSampler {
    Interpolation interpolation = Interpolation::Linear;
    int width = 1;                   ///< numbers of a value
    std::vector<float> timesSeconds; ///< of the keys, ascending; at least one
    std::vector<float> values;       ///< by key a value; CubicSpline: in-tangent (1/s), value and out-tangent

    /// How many values a key has.
    std::size_t valuesPerKey() const { return interpolation == Interpolation::CubicSpline ? 3 : 1; }
};

/// The value of a curve at a time, `width` numbers. A rotation is a unit quaternion.
void valueAt(const AnimationSampler& sampler, bool isRotation, double timeSeconds, std::span<double> value);

/// What a channel of a clip changes; animatedProperties() says what each of them is.
enum class AnimatedProperty : std::uint8_t {
    Translation,
    Rotation,
    Scale,
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
    EmissiveStrength, ///< multiplies Emissive: AnimationChannel::factor
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

/// Texture: a material's use of one.
enum class AnimatedOwner : std::uint8_t { Node, Weights, Light, Material, Texture, Camera };

/// Whether what it owns is in Rig::numbers.
constexpr bool ownsNumbers(AnimatedOwner owner) {
    return owner != AnimatedOwner::Node && owner != AnimatedOwner::Weights;
}

/// Whether that counts in Scene::materials.
constexpr bool isOfMaterial(AnimatedOwner owner) {
    return owner == AnimatedOwner::Material || owner == AnimatedOwner::Texture;
}

/// A member of what owns the property.
using AnimatedMember =
    std::variant<std::monostate, float Light::*, glm::vec3 Light::*, float Material::*, glm::vec3 Material::*,
                 glm::vec4 Material::*, float TextureTransform::*, glm::vec2 TextureTransform::*, double Camera::*>;

/// The numbers of a member of its owner, the others 0.
glm::dvec4 numberOf(const Light& light, const AnimatedMember& member);
glm::dvec4 numberOf(const Material& material, const AnimatedMember& member);
glm::dvec4 numberOf(const TextureTransform& transform, const AnimatedMember& member);
glm::dvec4 numberOf(const Camera& camera, const AnimatedMember& member);

struct AnimatedPropertyInfo {
    AnimatedProperty property;
    AnimatedOwner owner;   ///< whose list of Rig a channel's target counts in
    std::string_view path; ///< in glTF, from the node, light, material, texture's place or camera
    int width;             ///< numbers of a value; 0: one a morph target
    AnimatedMember member{};
    /// Bounds of what a clip says, within those that the member has anyway.
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
};

namespace detail {
// Short of 0 and of 180 degrees, at which a picture has no size.
inline constexpr double kLeastFovRadians = 1e-6, kMostFovRadians = 3.14159;

inline constexpr std::array kAnimatedProperties{
    AnimatedPropertyInfo{AnimatedProperty::Translation, AnimatedOwner::Node, "translation", 3},
    AnimatedPropertyInfo{AnimatedProperty::Rotation, AnimatedOwner::Node, "rotation", 4},
    AnimatedPropertyInfo{AnimatedProperty::Scale, AnimatedOwner::Node, "scale", 3},
    AnimatedPropertyInfo{AnimatedProperty::Weights, AnimatedOwner::Weights, "weights", 0},
    AnimatedPropertyInfo{AnimatedProperty::LightColor, AnimatedOwner::Light, "color", 3, &Light::color},
    AnimatedPropertyInfo{AnimatedProperty::LightIntensity, AnimatedOwner::Light, "intensity", 1, &Light::intensity},
    AnimatedPropertyInfo{AnimatedProperty::LightRange, AnimatedOwner::Light, "range", 1, &Light::rangeMetres},
    AnimatedPropertyInfo{AnimatedProperty::LightInnerCone, AnimatedOwner::Light, "spot/innerConeAngle", 1,
                         &Light::innerConeRadians},
    AnimatedPropertyInfo{AnimatedProperty::LightOuterCone, AnimatedOwner::Light, "spot/outerConeAngle", 1,
                         &Light::outerConeRadians},
    AnimatedPropertyInfo{AnimatedProperty::BaseColor, AnimatedOwner::Material, "pbrMetallicRoughness/baseColorFactor",
                         4, &Material::baseColor},
    AnimatedPropertyInfo{AnimatedProperty::Emissive, AnimatedOwner::Material, "emissiveFactor", 3, &Material::emissive},
    AnimatedPropertyInfo{AnimatedProperty::Metallic, AnimatedOwner::Material, "pbrMetallicRoughness/metallicFactor", 1,
                         &Material::metallic},
    AnimatedPropertyInfo{AnimatedProperty::PerceptualRoughness, AnimatedOwner::Material,
                         "pbrMetallicRoughness/roughnessFactor", 1, &Material::perceptualRoughness},
    AnimatedPropertyInfo{AnimatedProperty::NormalScale, AnimatedOwner::Material, "normalTexture/scale", 1,
                         &Material::normalScale},
    AnimatedPropertyInfo{AnimatedProperty::OcclusionStrength, AnimatedOwner::Material, "occlusionTexture/strength", 1,
                         &Material::occlusionStrength},
    AnimatedPropertyInfo{AnimatedProperty::AlphaCutoff, AnimatedOwner::Material, "alphaCutoff", 1,
                         &Material::alphaCutoff},
    AnimatedPropertyInfo{AnimatedProperty::EmissiveStrength, AnimatedOwner::Material,
                         "extensions/KHR_materials_emissive_strength/emissiveStrength", 1},
    AnimatedPropertyInfo{AnimatedProperty::Ior, AnimatedOwner::Material, "extensions/KHR_materials_ior/ior", 1,
                         &Material::ior, 1.0},
    AnimatedPropertyInfo{AnimatedProperty::SpecularFactor, AnimatedOwner::Material,
                         "extensions/KHR_materials_specular/specularFactor", 1, &Material::specularFactor},
    AnimatedPropertyInfo{AnimatedProperty::SpecularColor, AnimatedOwner::Material,
                         "extensions/KHR_materials_specular/specularColorFactor", 3, &Material::specularColor},
    AnimatedPropertyInfo{AnimatedProperty::AnisotropyStrength, AnimatedOwner::Material,
                         "extensions/KHR_materials_anisotropy/anisotropyStrength", 1, &Material::anisotropyStrength},
    AnimatedPropertyInfo{AnimatedProperty::AnisotropyRotation, AnimatedOwner::Material,
                         "extensions/KHR_materials_anisotropy/anisotropyRotation", 1,
                         &Material::anisotropyRotationRadians},
    AnimatedPropertyInfo{AnimatedProperty::Clearcoat, AnimatedOwner::Material,
                         "extensions/KHR_materials_clearcoat/clearcoatFactor", 1, &Material::clearcoat},
    AnimatedPropertyInfo{AnimatedProperty::ClearcoatRoughness, AnimatedOwner::Material,
                         "extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", 1,
                         &Material::clearcoatPerceptualRoughness},
    AnimatedPropertyInfo{AnimatedProperty::ClearcoatNormalScale, AnimatedOwner::Material,
                         "extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale", 1,
                         &Material::clearcoatNormalScale},
    AnimatedPropertyInfo{AnimatedProperty::SheenColor, AnimatedOwner::Material,
                         "extensions/KHR_materials_sheen/sheenColorFactor", 3, &Material::sheenColor},
    AnimatedPropertyInfo{AnimatedProperty::SheenRoughness, AnimatedOwner::Material,
                         "extensions/KHR_materials_sheen/sheenRoughnessFactor", 1, &Material::sheenPerceptualRoughness},
    AnimatedPropertyInfo{AnimatedProperty::Iridescence, AnimatedOwner::Material,
                         "extensions/KHR_materials_iridescence/iridescenceFactor", 1, &Material::iridescence},
    AnimatedPropertyInfo{AnimatedProperty::IridescenceIor, AnimatedOwner::Material,
                         "extensions/KHR_materials_iridescence/iridescenceIor", 1, &Material::iridescenceIor},
    AnimatedPropertyInfo{AnimatedProperty::IridescenceLeastThickness, AnimatedOwner::Material,
                         "extensions/KHR_materials_iridescence/iridescenceThicknessMinimum", 1,
                         &Material::iridescenceLeastThicknessNm},
    AnimatedPropertyInfo{AnimatedProperty::IridescenceThickness, AnimatedOwner::Material,
                         "extensions/KHR_materials_iridescence/iridescenceThicknessMaximum", 1,
                         &Material::iridescenceThicknessNm},
    AnimatedPropertyInfo{AnimatedProperty::Transmission, AnimatedOwner::Material,
                         "extensions/KHR_materials_transmission/transmissionFactor", 1, &Material::transmission},
    AnimatedPropertyInfo{AnimatedProperty::Thickness, AnimatedOwner::Material,
                         "extensions/KHR_materials_volume/thicknessFactor", 1, &Material::thicknessMetres},
    AnimatedPropertyInfo{AnimatedProperty::AttenuationDistance, AnimatedOwner::Material,
                         "extensions/KHR_materials_volume/attenuationDistance", 1, &Material::attenuationDistanceMetres,
                         1e-6},
    AnimatedPropertyInfo{AnimatedProperty::AttenuationColor, AnimatedOwner::Material,
                         "extensions/KHR_materials_volume/attenuationColor", 3, &Material::attenuationColor},
    AnimatedPropertyInfo{AnimatedProperty::Dispersion, AnimatedOwner::Material,
                         "extensions/KHR_materials_dispersion/dispersion", 1, &Material::dispersion},
    AnimatedPropertyInfo{AnimatedProperty::TextureOffset, AnimatedOwner::Texture,
                         "extensions/KHR_texture_transform/offset", 2, &TextureTransform::offset},
    AnimatedPropertyInfo{AnimatedProperty::TextureScale, AnimatedOwner::Texture,
                         "extensions/KHR_texture_transform/scale", 2, &TextureTransform::scale},
    AnimatedPropertyInfo{AnimatedProperty::TextureRotation, AnimatedOwner::Texture,
                         "extensions/KHR_texture_transform/rotation", 1, &TextureTransform::rotationRadians},
    AnimatedPropertyInfo{AnimatedProperty::CameraFovY, AnimatedOwner::Camera, "perspective/yfov", 1,
                         &Camera::fovYRadians, kLeastFovRadians, kMostFovRadians},
    AnimatedPropertyInfo{AnimatedProperty::CameraPerspectiveNear, AnimatedOwner::Camera, "perspective/znear", 1,
                         &Camera::nearMetres, kNearestPlaneMetres, kFarthestMetres},
    AnimatedPropertyInfo{AnimatedProperty::CameraPerspectiveFar, AnimatedOwner::Camera, "perspective/zfar", 1,
                         &Camera::farMetres, kNearestPlaneMetres},
    AnimatedPropertyInfo{AnimatedProperty::CameraHalfHeight, AnimatedOwner::Camera, "orthographic/ymag", 1,
                         &Camera::halfHeightMetres, kNearestPlaneMetres, kFarthestMetres},
    AnimatedPropertyInfo{AnimatedProperty::CameraOrthographicNear, AnimatedOwner::Camera, "orthographic/znear", 1,
                         &Camera::nearMetres, 0.0, kFarthestMetres},
    AnimatedPropertyInfo{AnimatedProperty::CameraOrthographicFar, AnimatedOwner::Camera, "orthographic/zfar", 1,
                         &Camera::farMetres, kNearestPlaneMetres},
};
consteval bool areAnimatedPropertiesSound() {
    for (std::size_t i = 0; i < kAnimatedProperties.size(); ++i)
        if (kAnimatedProperties[i].property != AnimatedProperty(i)) return false;
    return kAnimatedProperties.size() == std::size_t(AnimatedProperty::Count);
}
static_assert(areAnimatedPropertiesSound(), "the table of animated properties follows the enumeration");
} // namespace detail

/// The only list of them; row i is that of property i.
constexpr std::span<const AnimatedPropertyInfo> animatedProperties() {
    return detail::kAnimatedProperties;
}
constexpr const AnimatedPropertyInfo& infoOf(AnimatedProperty property) {
    return detail::kAnimatedProperties[std::size_t(property)];
}

struct AnimationChannel {
    AnimatedProperty property = AnimatedProperty::Translation;
    int target = 0;     ///< into Rig::nodes, Rig::weights or Rig::numbers, as the property's owner says
    int sampler = 0;    ///< of the clip
    int factor = kNone; ///< another, of one number, which the value is multiplied by
};

struct Clip {
    std::string name;
    std::vector<AnimationSampler> samplers;
    std::vector<AnimationChannel> channels;
};

/// When the last key of a clip is.
double lengthSeconds(const Clip& clip);

// ---- What clips change ---------------------------------------------------------------------------------------------

/// A node that a clip moves, and where it stands by itself. parentFromNode is translation * rotation * scale.
struct RestNode {
    int node = 0;
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0}; ///< x, y, z, w of a quaternion that is not zero
    glm::dvec3 scale{1.0};
};

/// How far the morph targets of a node's meshes count by themselves.
struct RestWeights {
    int node = 0;
    std::vector<float> weights; ///< by target
};

/// A member of a light, a material, a texture's transform or a camera, and what it is by itself (takeRest()).
struct RestNumber {
    AnimatedProperty property = AnimatedProperty::LightColor;
    int element = kNone; ///< light, material or camera of the scene; kNone: it is gone
    glm::dvec4 number{0.0};
    TextureSlot slot = TextureSlot::Count; ///< of AnimatedOwner::Texture: of the material
};

// ---- Deformed meshes -----------------------------------------------------------------------------------------------

struct Skin {
    std::string name;
    std::vector<int> joints;               ///< nodes
    std::vector<glm::dmat4> jointFromBind; ///< by joint, affine: from the space in which the mesh was bound
};

/// What is added to a mesh's attributes, times the target's weight. Each is empty or has the mesh's length.
struct MorphTarget {
    std::vector<glm::vec3> positionsOS;
    std::vector<glm::vec3> normalsOS;
    std::vector<glm::vec3> tangentsOS;
    std::array<std::vector<glm::vec2>, 2> texCoords;
    std::vector<glm::vec4> colors;
};

/// A mesh before it is deformed.
struct Shape {
    Mesh rest;
    bool isFlat = false; ///< normals are those of the triangles, which share no vertices
    std::vector<MorphTarget> targets;
    std::size_t influences = 0;        ///< joints that a vertex follows: 0, 4 or 8
    std::vector<std::uint32_t> joints; ///< of the skin, `influences` a vertex
    std::vector<float> weights;        ///< parallel to joints, not negative
};

/// A mesh of the scene that is a shape deformed. An instance of its own draws it.
struct Deformed {
    int mesh = 0;        ///< of the scene, which poses overwrite
    int shape = 0;       ///< of the rig
    int node = 0;        ///< vertices that follow no joint keep its transform
    int standsAt = 0;    ///< the node that draws the mesh; with a skin one of its own, whose transform poses overwrite
    int skin = kNone;    ///< of the rig
    int weights = kNone; ///< of Rig::weights
};

/// A light or a camera that a node that may move carries along.
struct Carried {
    int element = 0; ///< into Scene::lights or Scene::cameras
    int node = 0;
};

/// Everything that moves or is deformed.
struct Rig {
    std::vector<Clip> clips;
    std::vector<int> playing; ///< clips; of two that change the same thing the later counts
    std::vector<RestNode> nodes;
    std::vector<RestWeights> weights;
    std::vector<RestNumber> numbers;
    std::vector<Skin> skins;
    std::vector<Shape> shapes;
    std::vector<Deformed> deformed;
    std::vector<Carried> lights, cameras;
};

} // namespace tessera::scenes
