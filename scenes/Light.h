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

/// Lights as plain data, their members as a table, and their types as a table. Everything that names a type or one of
/// its parameters follows the two: scene files, checks, fingerprints, the viewer, the shaders' defines, packing,
/// culling.
namespace tessera::scenes {

/// Bounds of a light's size, far beyond any sun: 80 degrees, whose tangent keeps its digits, and 1000 km.
inline constexpr double kMostAngularRadiusDegrees = 80.0;
inline constexpr double kMostAngularRadiusRadians = 1.3962635;
inline constexpr double kMostRadiusMetres = 1e6;

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// lightTypes() says what each of them has.
enum class LightType : std::uint8_t {
    Directional, ///< from far away, everywhere along its direction
    Point,       ///< from its position, alike in all directions
    Spot,        ///< from its position, into a cone around its direction
    Rectangle,   ///< from a rectangle around its position that faces its direction
    Disk,        ///< from a disk around its position that faces its direction
    Sphere,      ///< from a sphere around its position
    Tube,        ///< from a closed cylinder around its position, along its direction
    Polygon,     ///< from within an outline of straight edges through its position, which faces its direction
    Count
};

enum class Falloff : std::uint8_t {
    InverseSquare, ///< candela x clamp(1 - (d/range)^4, 0, 1)^2 / max(d^2, 1e-4 m^2)
    Attenuation    ///< colour / max(A + B d + C d^2, 1e-4)
};

/// The corners of an outline in the order of its edges, in metres from the light's position: x along Light::alongWS, y
/// across it, at right angles to both that and the light's direction. They lie within the light, since every light has
/// them. cornersProblem() (scenes/AreaLight.h) says what makes no outline.
struct LightCorners {
    static constexpr std::size_t kLeast = 3, kMost = 8;
    std::size_t count = 4;
    std::array<glm::vec2, kMost> metres{glm::vec2(-0.5f, -0.5f), glm::vec2(0.5f, -0.5f), glm::vec2(0.5f, 0.5f),
                                        glm::vec2(-0.5f, 0.5f)};

    std::span<const glm::vec2> all() const { return std::span(metres).first(std::min(count, kMost)); }
    /// False, and no change, where there are as many as there can be.
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
    bool castsShadow = false;          ///< casters hide it from surfaces (scenes/Shadows.h)
    float radiusMetres = 0.0f;         ///< with a position: of the disk that its shadows see (scenes/Shadows.h); Disk,
                                       ///< Sphere and Tube: of what shines
    float angularRadiusRadians = 0.0f; ///< without one: the same as seen from anywhere
    glm::vec3 color{1.0f};             ///< linear RGB
    float intensity = 1.0f;            ///< in the unit of its type; a plain factor with Falloff::Attenuation
    glm::dvec3 positionWS{0.0};
    glm::dvec3 directionWS{0.0, 0.0, -1.0}; ///< unit, the way the light travels
    Falloff falloff = Falloff::InverseSquare;
    float rangeMetres = kInfinity;           ///< InverseSquare: the light is exactly 0 from here on
    glm::vec3 attenuation{1.0f, 0.0f, 0.0f}; ///< A, B (1/m), C (1/m^2) of Falloff::Attenuation, >= 0, not all 0
    float innerConeRadians = 0.0f;           ///< Spot: half angle of full intensity
    float outerConeRadians = 0.7853981634f;  ///< Spot: half angle beyond which there is no light
    float widthMetres = 1.0f;                ///< Rectangle: along alongWS
    float heightMetres = 1.0f;               ///< Rectangle: across it
    float lengthMetres = 1.0f;               ///< Tube: along its direction
    LightCorners corners;                    ///< Polygon: of its outline
    glm::dvec3 alongWS{1.0, 0.0, 0.0};       ///< Rectangle and Polygon: unit, at right angles to directionWS
    bool isTwoSided = false;                 ///< what is flat: shines from the back too
    bool isSeen = true;                      ///< with an area: pictures show the surface
    LightTexture texture;                    ///< what is flat: factors of its radiance, all over its surface
    std::optional<LightAnimation> animation;
    std::optional<LightFlicker> flicker;
    std::vector<LightKeys> keyframes; ///< of anything but the position, each once
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

/// A parameter of a type beside position, direction and falloff.
struct LightParameter {
    enum class Kind : std::uint8_t {
        Number,
        Metres, ///< the viewer's slider goes as far as the scene is large
        Angle   ///< radians in its member, degrees in scene files and the viewer
    };
    Kind kind;
    const char* key;   ///< of scene files
    const char* label; ///< in the viewer
    float Light::*member;
    float least = 0.0f; ///< in scene files and of the viewer's slider; degrees of an angle
    float most = 1.0f;
    float Light::*within = nullptr; ///< another angle of the type, which this one is never wider than
};

/// Where a light can shine, which culling, light volumes and the culling oracle follow.
enum class LightReach : std::uint8_t {
    Everywhere, ///< it has no position
    Sphere,     ///< around its position, as far as its falloff reaches
    Cone        ///< the part of that sphere within outerConeRadians of its direction
};

struct LightTypeInfo {
    LightType type;
    std::string_view name; ///< of scene files; in capitals that of shaders: LIGHT_<NAME> is its number,
                           ///< HAS_<NAME>_LIGHTS 0 or 1
    const char* unit;      ///< of its intensity
    LightReach reach;
    bool hasDirection;
    std::span<const LightParameter> parameters{};
    /// It shines from a surface: intensity is its radiance, Light::falloff is InverseSquare, and Light::isSeen.
    bool isArea = false;
    /// An area with a front, towards its direction, and a back: Light::isTwoSided, and Light::texture.
    bool isFlat = false;

    /// A position, and with it a falloff, perhaps a range, and perhaps an animation.
    constexpr bool hasPosition() const { return reach != LightReach::Everywhere; }
    /// Light::widthMetres along Light::alongWS and Light::heightMetres across it, in place of a radius.
    constexpr bool hasSides() const { return type == LightType::Rectangle; }
    /// Light::corners in place of sides and radius.
    constexpr bool hasCorners() const { return type == LightType::Polygon; }
    /// Light::alongWS says how it is turned about its direction.
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

/// The types that shine from a surface, and those of them that are flat. What treats each shape in its own way asserts
/// the number, so that no new shape is taken for another one.
inline constexpr auto kAreaTypeCount = std::ranges::count(detail::kLightTypes, true, &LightTypeInfo::isArea);
inline constexpr auto kFlatTypeCount = std::ranges::count(detail::kLightTypes, true, &LightTypeInfo::isFlat);

/// The only list of types; row i is that of type i.
constexpr std::span<const LightTypeInfo> lightTypes() {
    return detail::kLightTypes;
}
constexpr const LightTypeInfo& infoOf(LightType type) {
    return detail::kLightTypes[std::size_t(type)];
}

/// What every type has beside the parameters of its row, but those with sides or corners: what makes its shadows soft,
/// and of an area light how far its surface reaches.
constexpr const LightParameter* sizeParameter(const LightTypeInfo& type) {
    if (type.isTurned()) return nullptr;
    return type.hasPosition() ? &detail::kRadius : &detail::kAngularRadius;
}

// ---- Keyframes -----------------------------------------------------------------------------------------------------

struct LightKeyedInfo {
    LightKeyed member;
    std::string_view name;  ///< in a light's "keyframes" of scene files
    std::string_view label; ///< for people
    std::variant<glm::dvec3 Light::*, glm::vec3 Light::*, float Light::*> at; ///< its field's bounds hold between keys
    /// Linear keys are joined along great circles, at constant speed, and values are unit vectors.
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

/// The only list of them; row i is that of member i. The position's keyframes are those of LightAnimation, all others
/// stand in Light::keyframes.
constexpr std::span<const LightKeyedInfo> keyedMembers() {
    return detail::kKeyedMembers;
}
constexpr const LightKeyedInfo& infoOf(LightKeyed member) {
    return detail::kKeyedMembers[std::size_t(member)];
}

} // namespace tessera::scenes
