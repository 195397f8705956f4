#pragma once
#include <array>
#include <span>
#include <string_view>
#include <utility>

#include "scenes/Scene.h"

/// What .json scenes call the choices of Scene.h; reader and writer share these tables.
namespace tessera::scenes::scenejson {

template <typename Choice>
using Named = std::pair<std::string_view, Choice>;

inline constexpr std::array kWraps = {Named<Wrap>{"repeat", Wrap::Repeat},
                                      Named<Wrap>{"clamp_to_edge", Wrap::ClampToEdge},
                                      Named<Wrap>{"mirrored_repeat", Wrap::MirroredRepeat}};
/// The first two are those of magnification.
inline constexpr std::array kFilters = {Named<Filter>{"nearest", Filter::Nearest},
                                        Named<Filter>{"linear", Filter::Linear},
                                        Named<Filter>{"nearest_mipmap_nearest", Filter::NearestMipmapNearest},
                                        Named<Filter>{"linear_mipmap_nearest", Filter::LinearMipmapNearest},
                                        Named<Filter>{"nearest_mipmap_linear", Filter::NearestMipmapLinear},
                                        Named<Filter>{"linear_mipmap_linear", Filter::LinearMipmapLinear}};
inline constexpr auto kModels = [] {
    std::array<Named<MaterialModel>, kMaterialModelCount> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = {materialModels()[i].name, materialModels()[i].model};
    return names;
}();
/// The first two are those of isotropic microfacets.
inline constexpr std::array kMaskings = {Named<Masking>{"walter", Masking::Walter},
                                         Named<Masking>{"half_vector", Masking::HalfVector},
                                         Named<Masking>{"directional", Masking::Directional}};
inline constexpr std::array kAlphaModes = {Named<AlphaMode>{"opaque", AlphaMode::Opaque},
                                           Named<AlphaMode>{"mask", AlphaMode::Mask},
                                           Named<AlphaMode>{"blend", AlphaMode::Blend}};
inline constexpr std::array kNormalMapSpaces = {Named<NormalMapSpace>{"tangent", NormalMapSpace::Tangent},
                                                Named<NormalMapSpace>{"object", NormalMapSpace::Object}};
inline constexpr std::array kTangentMethods = {Named<TangentMethod>{"mikktspace", TangentMethod::MikkTSpace},
                                               Named<TangentMethod>{"lengyel", TangentMethod::Lengyel}};
inline constexpr auto kSubsurfaceMethodNames = [] {
    std::array<Named<SubsurfaceMethod>, kSubsurfaceMethods.size()> names;
    for (std::size_t i = 0; i < names.size(); ++i)
        names[i] = {kSubsurfaceMethods[i].name, kSubsurfaceMethods[i].method};
    return names;
}();
inline constexpr auto kLightTypes = [] {
    std::array<Named<LightType>, kLightTypeCount> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = {lightTypes()[i].name, lightTypes()[i].type};
    return names;
}();
inline constexpr std::array kFalloffs = {Named<Falloff>{"inverse_square", Falloff::InverseSquare},
                                         Named<Falloff>{"attenuation", Falloff::Attenuation}};
inline constexpr std::array kAnimations = {Named<LightAnimationKind>{"orbit", LightAnimationKind::Orbit},
                                           Named<LightAnimationKind>{"wobble", LightAnimationKind::Wobble},
                                           Named<LightAnimationKind>{"path", LightAnimationKind::Path},
                                           Named<LightAnimationKind>{"keyframes", LightAnimationKind::Keyframes}};
inline constexpr std::array kPathLines = {Named<PathLine>{"straight", PathLine::Straight},
                                          Named<PathLine>{"catmull_rom", PathLine::CatmullRom}};
inline constexpr std::array kInterpolations = {Named<Interpolation>{"linear", Interpolation::Linear},
                                               Named<Interpolation>{"step", Interpolation::Step},
                                               Named<Interpolation>{"cubic_spline", Interpolation::CubicSpline}};
inline constexpr std::array kKeyRepeats = {Named<KeyRepeat>{"once", KeyRepeat::Once},
                                           Named<KeyRepeat>{"loop", KeyRepeat::Loop},
                                           Named<KeyRepeat>{"ping_pong", KeyRepeat::PingPong}};
inline constexpr auto kKeyedMembers = [] {
    std::array<Named<LightKeyed>, std::size_t(LightKeyed::Count)> names;
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = {keyedMembers()[i].name, keyedMembers()[i].member};
    return names;
}();
inline constexpr std::array kProjections = {Named<Projection>{"perspective", Projection::Perspective},
                                            Named<Projection>{"orthographic", Projection::Orthographic}};

/// The table of a type of choice, found by overload.
inline std::span<const Named<Wrap>> choicesOf(Wrap) {
    return kWraps;
}
inline std::span<const Named<Filter>> choicesOf(Filter) {
    return kFilters;
}
inline std::span<const Named<MaterialModel>> choicesOf(MaterialModel) {
    return kModels;
}
inline std::span<const Named<Masking>> choicesOf(Masking) {
    return kMaskings;
}
inline std::span<const Named<AlphaMode>> choicesOf(AlphaMode) {
    return kAlphaModes;
}
inline std::span<const Named<NormalMapSpace>> choicesOf(NormalMapSpace) {
    return kNormalMapSpaces;
}
inline std::span<const Named<TangentMethod>> choicesOf(TangentMethod) {
    return kTangentMethods;
}
inline std::span<const Named<SubsurfaceMethod>> choicesOf(SubsurfaceMethod) {
    return kSubsurfaceMethodNames;
}
inline std::span<const Named<LightType>> choicesOf(LightType) {
    return kLightTypes;
}
inline std::span<const Named<Falloff>> choicesOf(Falloff) {
    return kFalloffs;
}
inline std::span<const Named<LightAnimationKind>> choicesOf(LightAnimationKind) {
    return kAnimations;
}
inline std::span<const Named<PathLine>> choicesOf(PathLine) {
    return kPathLines;
}
inline std::span<const Named<Interpolation>> choicesOf(Interpolation) {
    return kInterpolations;
}
inline std::span<const Named<KeyRepeat>> choicesOf(KeyRepeat) {
    return kKeyRepeats;
}
inline std::span<const Named<LightKeyed>> choicesOf(LightKeyed) {
    return kKeyedMembers;
}
inline std::span<const Named<Projection>> choicesOf(Projection) {
    return kProjections;
}

template <typename Choice>
std::string_view nameOf(Choice choice) {
    for (const auto& [name, known] : choicesOf(choice))
        if (known == choice) return name;
    return {};
}

} // namespace tessera::scenes::scenejson
