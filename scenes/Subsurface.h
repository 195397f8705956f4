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

/// Light that enters a surface and leaves it elsewhere: a property of materials, its members as a table, its methods as
/// a table, and the profiles that have names (docs/skin.md).
namespace tessera::scenes {

enum class SubsurfaceMethod : std::uint8_t { None, Wrap, DepthMap, TextureSpaceDiffusion, Count };

struct SubsurfaceMethodInfo {
    SubsurfaceMethod method;
    std::string_view name; ///< of scene files and options
    std::string_view summary;
    bool wraps = false;   ///< lights below the horizon reach the surface
    bool passes = false;  ///< light from behind passes through the body
    bool spreads = false; ///< light leaves the surface beside where it enters
};
inline constexpr std::array kSubsurfaceMethods{
    SubsurfaceMethodInfo{SubsurfaceMethod::None, "none", "light leaves where it enters"},
    SubsurfaceMethodInfo{
        .method = SubsurfaceMethod::Wrap, .name = "wrap", .summary = "light reaches round the horizon", .wraps = true},
    SubsurfaceMethodInfo{.method = SubsurfaceMethod::DepthMap,
                         .name = "depth_map",
                         .summary = "light from behind passes through thin parts",
                         .passes = true},
    // Light that passes through spreads over the other side too.
    SubsurfaceMethodInfo{.method = SubsurfaceMethod::TextureSpaceDiffusion,
                         .name = "texture_space_diffusion",
                         .summary = "light spreads over the surface",
                         .passes = true,
                         .spreads = true},
};
static_assert(isInOrder(kSubsurfaceMethods, &SubsurfaceMethodInfo::method, std::size_t(SubsurfaceMethod::Count)));
constexpr std::span<const SubsurfaceMethodInfo> subsurfaceMethods() {
    return kSubsurfaceMethods;
}
constexpr const SubsurfaceMethodInfo& infoOf(SubsurfaceMethod method) {
    return kSubsurfaceMethods[std::size_t(method)];
}

/// Which method surfaces take: that of their materials, or this one where those have any.
using SubsurfaceRequest = std::optional<SubsurfaceMethod>;

/// One term of a diffusion profile: weight exp(-r^2 / (2 v)) / (2 pi v) at the distance r.
struct DiffusionGaussian {
    float varianceSquareMillimetres = 1.0f;
    glm::vec3 weight{1.0f}; ///< by channel; those of a profile sum to 1 in each
    bool operator==(const DiffusionGaussian&) const = default;
};
using DiffusionProfile = std::vector<DiffusionGaussian>;
inline constexpr std::size_t kMostGaussians = 8;
/// How far sums of weights may be from 1: published weights have three digits.
inline constexpr double kProfileSumTolerance = 2e-3;

struct NamedProfile {
    std::string_view name; ///< of scene files
    DiffusionProfile profile;
};
/// `skin` first.
std::span<const NamedProfile> namedProfiles();

struct Subsurface {
    SubsurfaceMethod method = SubsurfaceMethod::None;
    float scaleMetres = 1.0f;              ///< metres of the real thing that a metre of the scene stands for
    float wrap = 0.5f;                     ///< 0..1: minus the cosine at which wrapped light ends, where the tint is 1
    glm::vec3 wrapTint{1.0f, 0.4f, 0.25f}; ///< 0..1, by channel
    /// Of the body that wrapped light goes round, in the scene's metres; 0: half the smallest side of what has the
    /// material.
    float bodyRadiusMetres = 0.0f;
    /// Of light that passes through, by channel. The default is neither measured nor published: an ear of 3 mm passes a
    /// third of red light, 4 % of green and 0.3 % of blue.
    glm::vec3 absorptionPerMillimetre{0.35f, 1.1f, 1.9f};
    float preScatterShare = 0.5f; ///< 0..1: the power of the albedo before light spreads; the rest is after
    DiffusionProfile profile;     ///< none: `skin`, which scenes with many materials need not hold for each
    bool operator==(const Subsurface&) const = default;
};

/// Its own, or `skin`.
const DiffusionProfile& profileOf(const Subsurface& subsurface);

// A millionth of a metre to a thousand kilometres: beyond any model.
inline constexpr double kLeastScaleMetres = 1e-6, kMostScaleMetres = 1e6;
inline constexpr double kMostBodyRadiusMetres = 1e6; // shadow rays begin up to about so far off the surface
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

/// What is wrong with a profile that is given, and what to do; empty: nothing.
std::string profileProblem(const DiffusionProfile& profile);

} // namespace tessera::scenes
