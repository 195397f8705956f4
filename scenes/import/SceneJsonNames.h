#pragma once
#include <array>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "scenes/Scene.h"

/// What .json scenes call the choices of Scene.h; reader and writer share these tables.
namespace tessera::scenes::scenejson {

template <typename Choice>
using Named = std::pair<std::string_view, Choice>;

/// The names of a table of descriptions, of which `choice` is described.
template <std::size_t kCount, typename Info, typename Choice>
constexpr std::array<Named<Choice>, kCount> namesOf(std::span<const Info> infos, Choice Info::*choice) {
    std::array<Named<Choice>, kCount> names;
    for (std::size_t i = 0; i < kCount; ++i) names[i] = {infos[i].name, infos[i].*choice};
    return names;
}

inline constexpr Named<Wrap> kWraps[] = {
    {"repeat", Wrap::Repeat}, {"clamp_to_edge", Wrap::ClampToEdge}, {"mirrored_repeat", Wrap::MirroredRepeat}};
/// The first two are those of magnification.
inline constexpr Named<Filter> kFilters[] = {{"nearest", Filter::Nearest},
                                             {"linear", Filter::Linear},
                                             {"nearest_mipmap_nearest", Filter::NearestMipmapNearest},
                                             {"linear_mipmap_nearest", Filter::LinearMipmapNearest},
                                             {"nearest_mipmap_linear", Filter::NearestMipmapLinear},
                                             {"linear_mipmap_linear", Filter::LinearMipmapLinear}};
inline constexpr auto kModels = namesOf<kMaterialModelCount>(materialModels(), &MaterialModelInfo::model);
/// The first two are those of isotropic microfacets.
inline constexpr Named<Masking> kMaskings[] = {
    {"walter", Masking::Walter}, {"half_vector", Masking::HalfVector}, {"directional", Masking::Directional}};
inline constexpr Named<AlphaMode> kAlphaModes[] = {
    {"opaque", AlphaMode::Opaque}, {"mask", AlphaMode::Mask}, {"blend", AlphaMode::Blend}};
inline constexpr Named<NormalMapSpace> kNormalMapSpaces[] = {{"tangent", NormalMapSpace::Tangent},
                                                             {"object", NormalMapSpace::Object}};
inline constexpr Named<TangentMethod> kTangentMethods[] = {{"mikktspace", TangentMethod::MikkTSpace},
                                                           {"lengyel", TangentMethod::Lengyel}};
inline constexpr auto kSubsurfaceMethodNames =
    namesOf<kSubsurfaceMethods.size()>(subsurfaceMethods(), &SubsurfaceMethodInfo::method);
inline constexpr auto kLightTypes = namesOf<kLightTypeCount>(lightTypes(), &LightTypeInfo::type);
inline constexpr Named<Falloff> kFalloffs[] = {{"inverse_square", Falloff::InverseSquare},
                                               {"attenuation", Falloff::Attenuation}};
inline constexpr Named<LightAnimationKind> kAnimations[] = {{"orbit", LightAnimationKind::Orbit},
                                                            {"wobble", LightAnimationKind::Wobble},
                                                            {"path", LightAnimationKind::Path},
                                                            {"keyframes", LightAnimationKind::Keyframes}};
inline constexpr Named<PathLine> kPathLines[] = {{"straight", PathLine::Straight},
                                                 {"catmull_rom", PathLine::CatmullRom}};
inline constexpr Named<Interpolation> kInterpolations[] = {
    {"linear", Interpolation::Linear}, {"step", Interpolation::Step}, {"cubic_spline", Interpolation::CubicSpline}};
inline constexpr Named<KeyRepeat> kKeyRepeats[] = {
    {"once", KeyRepeat::Once}, {"loop", KeyRepeat::Loop}, {"ping_pong", KeyRepeat::PingPong}};
inline constexpr auto kKeyedMembers = namesOf<std::size_t(LightKeyed::Count)>(keyedMembers(), &LightKeyedInfo::member);
inline constexpr Named<Projection> kProjections[] = {{"perspective", Projection::Perspective},
                                                     {"orthographic", Projection::Orthographic}};

namespace namedetail {
template <typename... Choices>
using Tables = std::tuple<std::span<const Named<Choices>>...>;
inline constexpr Tables<Wrap, Filter, MaterialModel, Masking, AlphaMode, NormalMapSpace, TangentMethod,
                        SubsurfaceMethod, LightType, Falloff, LightAnimationKind, PathLine, Interpolation, KeyRepeat,
                        LightKeyed, Projection>
    kTables{kWraps,          kFilters,         kModels,         kMaskings,
            kAlphaModes,     kNormalMapSpaces, kTangentMethods, kSubsurfaceMethodNames,
            kLightTypes,     kFalloffs,        kAnimations,     kPathLines,
            kInterpolations, kKeyRepeats,      kKeyedMembers,   kProjections};
} // namespace namedetail

/// The table of a type of choice.
template <typename Choice>
constexpr std::span<const Named<Choice>> choicesOf(Choice) {
    return std::get<std::span<const Named<Choice>>>(namedetail::kTables);
}

template <typename Choice>
std::string_view nameOf(Choice choice) {
    for (const auto& [name, known] : choicesOf(choice))
        if (known == choice) return name;
    return {};
}

} // namespace tessera::scenes::scenejson
