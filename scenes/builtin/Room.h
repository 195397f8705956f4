#pragma once
#include <array>
#include <optional>

#include <glm/glm.hpp>

/// Reference values of the built-in scene `room`: a closed room and one lamp, with known radiance at every point.
namespace tessera::scenes::builtin {

enum class RoomMaterial {
    Floor,     ///< lambert
    Ceiling,   ///< metallic_roughness, specularFactor 0
    LeftWall,  ///< lambert, red
    RightWall, ///< lambert, green
    FarWall,   ///< metallic_roughness, specularFactor 0
    NearWall,  ///< lambert
    Sign,      ///< single_color, on the far wall
    Panel,     ///< lambert and emissive, on the right wall
    Lantern,   ///< metallic_roughness, specularFactor 0, and emissive, on the left wall
    Plinth,    ///< lambert, a turned box on the floor
    Count
};
inline constexpr std::size_t kRoomMaterialCount = static_cast<std::size_t>(RoomMaterial::Count);

struct RoomFinish {
    const char* name;
    glm::vec3 color;    ///< k_d of lambert, albedo of metallic_roughness, or the colour itself
    glm::vec3 emissive; ///< radiance
    bool perSteradian;  ///< whether the model divides the colour by pi
};
/// By RoomMaterial. The numbers are exact in fp32, so that a GPU gets the same values.
extern const std::array<RoomFinish, kRoomMaterialCount> kRoomFinishes;

inline constexpr glm::dvec3 kRoomLampWS{0.0, 1.5, 0.0};
inline constexpr double kRoomLampCandela = 1.5; ///< white, of infinite range

/// Radiance leaving `positionWS` in every direction: k_d I cos / d^2 (lambert) or rho I cos / (pi d^2)
/// (metallic_roughness without specular lobe), cos >= 0, plus the emission; the colour itself for single_color.
glm::dvec3 roomRadiance(const glm::dvec3& positionWS, const glm::dvec3& normalWS, RoomMaterial material);

struct RoomPoint {
    glm::dvec3 positionWS;
    glm::dvec3 normalWS; ///< unit, into the room
    RoomMaterial material;
};
/// The first hit of a ray from inside the room; none only if it starts outside.
std::optional<RoomPoint> roomPointAlong(const glm::dvec3& originWS, const glm::dvec3& directionWS);

} // namespace tessera::scenes::builtin
