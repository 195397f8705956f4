#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include <glm/glm.hpp>

#include "base/EnumTable.h"
#include "scenes/Fields.h"

/// Subsurface scattering as a property of materials: tables of its members and methods, and named profiles
/// (docs/skin.md).
namespace tessera::scenes {

enum class SubsurfaceMethod : std::uint8_t { None, Wrap, DepthMap, TextureSpaceDiffusion, Count };

struct SubsurfaceMethodInfo {
    SubsurfaceMethod method;
    std::string_view name; ///< of scene files and options
    std::string_view summary;
    bool wraps = false;    ///< lights below the horizon illuminate the surface
    bool passes = false;   ///< light from behind is transmitted through the body
    bool diffuses = false; ///< irradiance is diffused over the surface
};
inline constexpr std::array kSubsurfaceMethods{
    SubsurfaceMethodInfo{SubsurfaceMethod::None, "none", "light leaves where it enters"},
    SubsurfaceMethodInfo{
        .method = SubsurfaceMethod::Wrap, .name = "wrap", .summary = "light reaches round the horizon", .wraps = true},
    SubsurfaceMethodInfo{.method = SubsurfaceMethod::DepthMap,
                         .name = "depth_map",
                         .summary = "light from behind passes through thin parts",
                         .passes = true},
    // Transmitted light is diffused over the far side too.
    SubsurfaceMethodInfo{.method = SubsurfaceMethod::TextureSpaceDiffusion,
                         .name = "texture_space_diffusion",
                         .summary = "light diffuses over the surface",
                         .passes = true,
                         .diffuses = true},
};
static_assert(isInOrder(kSubsurfaceMethods, &SubsurfaceMethodInfo::method, std::size_t(SubsurfaceMethod::Count)));
constexpr std::span<const SubsurfaceMethodInfo> subsurfaceMethods() {
    return kSubsurfaceMethods;
}
constexpr const SubsurfaceMethodInfo& infoOf(SubsurfaceMethod method) {
    return kSubsurfaceMethods[std::size_t(method)];
}

/// Overrides the method of all materials that have one; none: each keeps its own.
using SubsurfaceRequest = std::optional<SubsurfaceMethod>;

/// One term of a diffusion profile: weight exp(-r^2 / (2 v)) / (2 pi v) at the distance r.
struct DiffusionGaussian {
    float varianceSquareMillimetres = 1.0f;
    glm::vec3 weight{1.0f}; ///< by channel; the weights of a profile sum to 1 in each
    bool operator==(const DiffusionGaussian&) const = default;
};
using DiffusionProfile = std::vector<DiffusionGaussian>;
inline constexpr std::size_t kMostGaussians = 8;
/// Tolerance of the weights' sum: published weights have three digits.
inline constexpr double kProfileSumTolerance = 2e-3;

struct NamedProfile {
    std::string_view name; ///< of scene files
    DiffusionProfile profile;
};
/// All named profiles, `skin` first.
std::span<const NamedProfile> namedProfiles();

struct Subsurface {
    SubsurfaceMethod method = SubsurfaceMethod::None;
    float scaleMetres = 1.0f;              ///< real metres per metre of the scene
    float wrap = 0.5f;                     ///< 0..1: negative cosine at which wrapped light ends, if the tint is 1
    glm::vec3 wrapTint{1.0f, 0.4f, 0.25f}; ///< 0..1, by channel
    /// Radius, in the scene's metres, that lifts shadow rays of wrapped light off the surface; 0: half the smallest
    /// side of the geometry with the material.
    float bodyRadiusMetres = 0.0f;
    /// Absorption of transmitted light, by channel. The default is neither measured nor published: an ear of 3 mm
    /// transmits a third of red light, 4 % of green and 0.3 % of blue.
    glm::vec3 absorptionPerMillimetre{0.35f, 1.1f, 1.9f};
    float preScatterShare = 0.5f; ///< 0..1: exponent of the albedo before diffusion; the rest is applied after
    DiffusionProfile profile;     ///< none: `skin`, which scenes with many materials need not store for each
    bool operator==(const Subsurface&) const = default;
};

/// The profile of a subsurface: its own, or `skin` if it has none.
const DiffusionProfile& profileOf(const Subsurface& subsurface);

// A millionth of a metre to a thousand kilometres: beyond any model.
inline constexpr double kLeastScaleMetres = 1e-6, kMostScaleMetres = 1e6;
inline constexpr double kMostBodyRadiusMetres = 1e6; // shadow rays start up to about this far off the surface
inline constexpr double kMostAbsorption = 1e6;
inline constexpr double kMostVariance = 1e12; // a kilometre wide

/// All members, in order.
inline constexpr std::tuple kSubsurfaceFields{
    Field{"method", &Subsurface::method},
    Field{"scaleMetres", &Subsurface::scaleMetres, "the scale of its subsurface", kLeastScaleMetres, kMostScaleMetres},
    Field{"wrap", &Subsurface::wrap, "the wrap of its subsurface", 0.0, 1.0},
    Field{"wrapTint", &Subsurface::wrapTint, "the tint of its subsurface's wrap", 0.0, 1.0},
    Field{"bodyRadiusMetres", &Subsurface::bodyRadiusMetres, "the body's radius of its subsurface", 0.0,
          kMostBodyRadiusMetres},
    Field{"absorptionPerMillimetre", &Subsurface::absorptionPerMillimetre, "the absorption of its subsurface", 0.0,
          kMostAbsorption},
    Field{"preScatterShare", &Subsurface::preScatterShare, "the share of albedo before its subsurface", 0.0, 1.0},
    Field{"profile", &Subsurface::profile},
};
static_assert(std::tuple_size_v<decltype(kSubsurfaceFields)> == detail::memberCount<Subsurface>(),
              "kSubsurfaceFields lacks a member of Subsurface");

/// Describes a profile's fault with the remedy; empty if there is none.
std::string profileProblem(const DiffusionProfile& profile);

} // namespace tessera::scenes
