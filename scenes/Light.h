#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/LightAnimation.h"
#include "scenes/LightTexture.h"
#include "scenes/Material.h"

/// Light data, with a table of its members and one of its types. All code that handles types or their parameters uses
/// these tables: scene files, checks, fingerprints, the viewer, the shaders' defines, packing, culling.
namespace tessera::scenes {

/// Maximum size of a light, far beyond any sun: 80 degrees, whose tangent is still accurate, and 1000 km.
inline constexpr double kMostAngularRadiusDegrees = 80.0;
inline constexpr double kMostAngularRadiusRadians = 1.3962635;
inline constexpr double kMostRadiusMetres = 1e6;

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// lightTypes() lists the properties of each type.
enum class LightType : std::uint8_t {
    Directional, ///< infinitely far away, along its direction
    Point,       ///< from its position, uniform in all directions
    Spot,        ///< from its position, into a cone around its direction
    Rectangle,   ///< from a rectangle centred at its position, facing its direction
    Disk,        ///< from a disk centred at its position, facing its direction
    Sphere,      ///< from a sphere centred at its position
    Tube,        ///< from a closed cylinder centred at its position, along its direction
    Polygon,     ///< from a polygon in the plane of its position, facing its direction
    Count
};

enum class Falloff : std::uint8_t {
    InverseSquare, ///< candela x clamp(1 - (d/range)^4, 0, 1)^2 / max(d^2, 1e-4 m^2)
    Attenuation    ///< colour / max(A + B d + C d^2, 1e-4)
};

/// Corners of a polygon's outline in the order of its edges, in metres from the light's position: x along
/// Light::alongWS, y perpendicular to both that and the light's direction. Stored inline, since every light has them.
/// cornersProblem() (scenes/AreaLight.h) validates them.
struct LightCorners {
    static constexpr std::size_t kLeast = 3, kMost = 8;
    std::size_t count = 4;
    std::array<glm::vec2, kMost> metres{glm::vec2(-0.5f, -0.5f), glm::vec2(0.5f, -0.5f), glm::vec2(0.5f, 0.5f),
                                        glm::vec2(-0.5f, 0.5f)};

    std::span<const glm::vec2> all() const { return std::span(metres).first(std::min(count, kMost)); }
    /// Returns false, without a change, if there are kMost corners already.
    bool add(const glm::vec2& cornerMetres) {
        if (count >= kMost) return false;
        metres[count++] = cornerMetres;
        return true;
    }
    bool operator==(const LightCorners& other) const {
        return count == other.count && std::ranges::equal(all(), other.all());
    }
};

struct Light {
    std::string name;
    LightType type = LightType::Point;
    bool enabled = true;
    bool castsShadow = false;  ///< shadow casters block it (scenes/Shadows.h)
    float radiusMetres = 0.0f; ///< with a position: of the disk that softens its shadows (scenes/Shadows.h); Disk,
                               ///< Sphere and Tube: of the emitting surface
    float angularRadiusRadians = 0.0f; ///< without a position: angular radius of that disk
    glm::vec3 color{1.0f};             ///< linear RGB
    float intensity = 1.0f;            ///< in the unit of its type; a unitless factor with Falloff::Attenuation
    glm::dvec3 positionWS{0.0};
    glm::dvec3 directionWS{0.0, 0.0, -1.0}; ///< unit, the way the light travels
    Falloff falloff = Falloff::InverseSquare;
    float rangeMetres = kInfinity;           ///< InverseSquare: the light is exactly 0 from here on
    glm::vec3 attenuation{1.0f, 0.0f, 0.0f}; ///< A, B (1/m), C (1/m^2) of Falloff::Attenuation, >= 0, not all 0
    float innerConeRadians = 0.0f;           ///< Spot: half angle of full intensity
    float outerConeRadians = 0.7853981634f;  ///< Spot: half angle beyond which there is no light
    float widthMetres = 1.0f;                ///< Rectangle: along alongWS
    float heightMetres = 1.0f;               ///< Rectangle: perpendicular to alongWS
    float lengthMetres = 1.0f;               ///< Tube: along its direction
    LightCorners corners;                    ///< Polygon: outline
    glm::dvec3 alongWS{1.0, 0.0, 0.0};       ///< Rectangle and Polygon: unit, perpendicular to directionWS
    bool isTwoSided = false;                 ///< flat types: shines from the back too
    bool isSeen = true;                      ///< area types: the surface itself is visible
    LightTexture texture;                    ///< flat types: factors of the radiance over the surface
    std::optional<LightAnimation> animation;
    std::optional<LightFlicker> flicker;
    std::vector<LightKeys> keyframes; ///< of members other than the position, each at most once
    bool operator==(const Light&) const = default;
};

// ---- Members -------------------------------------------------------------------------------------------------------

/// All members, in order.
inline constexpr std::tuple kLightFields{
    Field{"name", &Light::name},
    Field{"type", &Light::type},
    Field{"enabled", &Light::enabled},
    Field{"castsShadow", &Light::castsShadow},
    Field{"radiusMetres", &Light::radiusMetres, "the radius", 0.0, kMostRadiusMetres, " m"},
    Field{"angularRadiusRadians", &Light::angularRadiusRadians, "the angular radius", 0.0, kMostAngularRadiusRadians,
          " radians"},
    Field{"color", &Light::color, "the colour", 0.0, kAnyNumber},
    Field{"intensity", &Light::intensity, "the intensity", 0.0, kAnyNumber},
    Field{"positionWS", &Light::positionWS},
    Field{"directionWS", &Light::directionWS},
    Field{"falloff", &Light::falloff},
    Field{"rangeMetres", &Light::rangeMetres},
    Field{"attenuation", &Light::attenuation, "the attenuation coefficients A, B, C", 0.0, kAnyNumber},
    Field{"innerConeRadians", &Light::innerConeRadians, "the half angle of the inner cone", 0.0,
          std::numbers::pi_v<float>, " radians"},
    Field{"outerConeRadians", &Light::outerConeRadians, "the half angle of the outer cone", 0.0,
          std::numbers::pi_v<float>, " radians"},
    Field{"widthMetres", &Light::widthMetres, "the width", 0.0, kMostRadiusMetres, " m"},
    Field{"heightMetres", &Light::heightMetres, "the height", 0.0, kMostRadiusMetres, " m"},
    Field{"lengthMetres", &Light::lengthMetres, "the length", 0.0, kMostRadiusMetres, " m"},
    Field{"corners", &Light::corners},
    Field{"alongWS", &Light::alongWS},
    Field{"isTwoSided", &Light::isTwoSided},
    Field{"isSeen", &Light::isSeen},
    Field{"texture", &Light::texture},
    Field{"animation", &Light::animation},
    Field{"flicker", &Light::flicker},
    Field{"keyframes", &Light::keyframes},
};
static_assert(std::tuple_size_v<decltype(kLightFields)> == detail::memberCount<Light>(),
              "kLightFields lacks a member of Light");

// ---- Types ---------------------------------------------------------------------------------------------------------

/// A parameter of a type besides position, direction and falloff.
struct LightParameter {
    enum class Kind : std::uint8_t {
        Number,
        Metres, ///< the range of the viewer's slider is the size of the scene
        Angle   ///< radians in the member, degrees in scene files and the viewer
    };
    Kind kind;
    const char* key;   ///< of scene files
    const char* label; ///< in the viewer
    float Light::*member;
    float least = 0.0f; ///< bound in scene files and of the viewer's slider; degrees for angles
    float most = 1.0f;
    float Light::*within = nullptr; ///< another angle of the type: upper bound of this one
};

/// Extent of a light, used by culling, light volumes and the culling oracle.
enum class LightReach : std::uint8_t {
    Everywhere, ///< no position, no bounds
    Sphere,     ///< around its position, with the range of its falloff
    Cone        ///< the part of that sphere within outerConeRadians of its direction
};

struct LightTypeInfo {
    LightType type;
    std::string_view name; ///< in scene files; in capitals in shaders: LIGHT_<NAME> is its index,
                           ///< HAS_<NAME>_LIGHTS 0 or 1
    const char* unit;      ///< of its intensity
    LightReach reach;
    bool hasDirection;
    std::span<const LightParameter> parameters{};
    /// It emits from a surface: intensity is radiance, Light::falloff is InverseSquare, and Light::isSeen applies.
    bool isArea = false;
    /// A flat area with a front, facing its direction, and a back: Light::isTwoSided and Light::texture apply.
    bool isFlat = false;

    /// Whether it has a position, and thus a falloff, optionally a range and an animation.
    constexpr bool hasPosition() const { return reach != LightReach::Everywhere; }
    /// Whether Light::widthMetres along Light::alongWS and Light::heightMetres across it replace the radius.
    constexpr bool hasSides() const { return type == LightType::Rectangle; }
    /// Whether Light::corners replace sides and radius.
    constexpr bool hasCorners() const { return type == LightType::Polygon; }
    /// Whether Light::alongWS sets the rotation about its direction.
    constexpr bool isTurned() const { return hasSides() || hasCorners(); }
    /// Whether shaders read LightShapeTexels for this type (shaders/shared/light.h).
    constexpr bool hasShape() const { return (hasPosition() && hasDirection) || !parameters.empty() || isArea; }
};

namespace detail {
inline constexpr LightParameter kCones[] = {
    {LightParameter::Kind::Angle, "innerDegrees", "Inner cone", &Light::innerConeRadians, 0.0f, 90.0f,
     &Light::outerConeRadians},
    // 90 degrees is KHR_lights_punctual's limit.
    {LightParameter::Kind::Angle, "outerDegrees", "Outer cone", &Light::outerConeRadians, 0.0f, 90.0f}};

inline constexpr LightParameter kSides[] = {
    {LightParameter::Kind::Metres, "width", "Width", &Light::widthMetres, 0.0f, float(kMostRadiusMetres)},
    {LightParameter::Kind::Metres, "height", "Height", &Light::heightMetres, 0.0f, float(kMostRadiusMetres)}};
inline constexpr LightParameter kLength[] = {
    {LightParameter::Kind::Metres, "length", "Length", &Light::lengthMetres, 0.0f, float(kMostRadiusMetres)}};

inline constexpr LightParameter kRadius{LightParameter::Kind::Metres, "radius", "Radius",
                                        &Light::radiusMetres,         0.0f,     float(kMostRadiusMetres)};
inline constexpr LightParameter kAngularRadius{
    LightParameter::Kind::Angle,     "angularRadiusDegrees", "Angular radius", &Light::angularRadiusRadians, 0.0f,
    float(kMostAngularRadiusDegrees)};

inline constexpr std::array kLightTypes{
    LightTypeInfo{LightType::Directional, "directional", "lx", LightReach::Everywhere, true},
    LightTypeInfo{LightType::Point, "point", "cd", LightReach::Sphere, false},
    LightTypeInfo{LightType::Spot, "spot", "cd", LightReach::Cone, true, kCones},
    LightTypeInfo{LightType::Rectangle, "rectangle", "cd/m\xc2\xb2", LightReach::Sphere, true, kSides, true, true},
    LightTypeInfo{LightType::Disk, "disk", "cd/m\xc2\xb2", LightReach::Sphere, true, {}, true, true},
    LightTypeInfo{LightType::Sphere, "sphere", "cd/m\xc2\xb2", LightReach::Sphere, false, {}, true},
    LightTypeInfo{LightType::Tube, "tube", "cd/m\xc2\xb2", LightReach::Sphere, true, kLength, true},
    LightTypeInfo{LightType::Polygon, "polygon", "cd/m\xc2\xb2", LightReach::Sphere, true, {}, true, true},
};
consteval bool areLightTypesSound() {
    for (std::size_t i = 0; i < kLightTypes.size(); ++i) {
        const LightTypeInfo& info = kLightTypes[i];
        if (info.type != LightType(i)) return false;
        if (info.reach == LightReach::Cone && !info.hasDirection) return false;
    }
    return kLightTypes.size() == std::size_t(LightType::Count);
}
static_assert(areLightTypesSound(), "the table of light types follows the enumeration, and a cone has a direction");
} // namespace detail

inline constexpr std::size_t kLightTypeCount = detail::kLightTypes.size();

/// Numbers of the types that emit from a surface, and of the flat ones among them. Code with a case for each shape
/// asserts them, so that no new shape is mistaken for another one.
inline constexpr auto kAreaTypeCount = std::ranges::count(detail::kLightTypes, true, &LightTypeInfo::isArea);
inline constexpr auto kFlatTypeCount = std::ranges::count(detail::kLightTypes, true, &LightTypeInfo::isFlat);

/// The single table of light types, indexed by LightType.
constexpr std::span<const LightTypeInfo> lightTypes() {
    return detail::kLightTypes;
}
constexpr const LightTypeInfo& infoOf(LightType type) {
    return detail::kLightTypes[std::size_t(type)];
}

/// The radius or angular radius of types without sides or corners; else null. It softens shadows and, for area lights,
/// is the size of the surface.
constexpr const LightParameter* sizeParameter(const LightTypeInfo& type) {
    if (type.isTurned()) return nullptr;
    return type.hasPosition() ? &detail::kRadius : &detail::kAngularRadius;
}

// ---- Keyframes -----------------------------------------------------------------------------------------------------

struct LightKeyedInfo {
    LightKeyed member;
    std::string_view name;  ///< in a light's "keyframes" of scene files
    std::string_view label; ///< for users
    std::variant<glm::dvec3 Light::*, glm::vec3 Light::*, float Light::*> at; ///< clamped to its field's bounds
    /// Values are unit vectors; linear keys are interpolated along great circles at constant speed.
    bool isOnSphere = false;

    constexpr std::size_t width() const { return std::holds_alternative<float Light::*>(at) ? 1 : 3; }
    /// Whether lights of the type have the member.
    constexpr bool isOf(const LightTypeInfo& type) const {
        return member == LightKeyed::Position    ? type.hasPosition()
               : member == LightKeyed::Direction ? type.hasDirection
                                                 : true;
    }
};

namespace detail {
inline constexpr std::array kKeyedMembers{
    LightKeyedInfo{LightKeyed::Position, "position", "position", &Light::positionWS},
    LightKeyedInfo{LightKeyed::Direction, "direction", "direction", &Light::directionWS, true},
    LightKeyedInfo{LightKeyed::Color, "color", "colour", &Light::color},
    LightKeyedInfo{LightKeyed::Intensity, "intensity", "intensity", &Light::intensity},
};
consteval bool areKeyedMembersSound() {
    for (std::size_t i = 0; i < kKeyedMembers.size(); ++i)
        if (kKeyedMembers[i].member != LightKeyed(i)) return false;
    return kKeyedMembers.size() == std::size_t(LightKeyed::Count);
}
static_assert(areKeyedMembersSound(), "the table of members with keyframes follows the enumeration");
} // namespace detail

/// The single table of members with keyframes, indexed by LightKeyed. The position's keyframes are stored in
/// LightAnimation, all others in Light::keyframes.
constexpr std::span<const LightKeyedInfo> keyedMembers() {
    return detail::kKeyedMembers;
}
constexpr const LightKeyedInfo& infoOf(LightKeyed member) {
    return detail::kKeyedMembers[std::size_t(member)];
}

} // namespace tessera::scenes
