#pragma once
#include <concepts>
#include <tuple>
#include <type_traits>

#include "scenes/import/JsonReader.h"

/// Names of Scene.h's enumerators in .json scenes; reader and writer share these tables.
namespace tessera::scenes::scenejson {

template <typename Choice>
using Named = std::pair<std::string_view, Choice>;

/// The names in a table of descriptions, each with the value of member `choice`.
template <std::size_t kCount, typename Info, typename Choice>
constexpr std::array<Named<Choice>, kCount> namesOf(std::span<const Info> infos, Choice Info::*choice) {
    std::array<Named<Choice>, kCount> names;
    for (std::size_t i = 0; i < kCount; ++i) names[i] = {infos[i].name, infos[i].*choice};
    return names;
}

inline constexpr Named<Wrap> kWraps[] = {
    {"repeat", Wrap::Repeat}, {"clamp_to_edge", Wrap::ClampToEdge}, {"mirrored_repeat", Wrap::MirroredRepeat}};
/// The first two are valid for magnification.
inline constexpr Named<Filter> kFilters[] = {{"nearest", Filter::Nearest},
                                             {"linear", Filter::Linear},
                                             {"nearest_mipmap_nearest", Filter::NearestMipmapNearest},
                                             {"linear_mipmap_nearest", Filter::LinearMipmapNearest},
                                             {"nearest_mipmap_linear", Filter::NearestMipmapLinear},
                                             {"linear_mipmap_linear", Filter::LinearMipmapLinear}};
inline constexpr auto kModels = namesOf<kMaterialModelCount>(materialModels(), &MaterialModelInfo::model);
/// The first two are valid for isotropic microfacets.
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

/// The name table of an enumeration.
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

// ---- Members -------------------------------------------------------------------------------------------------------
// Members of Scene.h's structs by name: "fields" of a light, a camera or a material may set each of them, for any type
// or model. The visitor receives a member's name and that member of each object.

template <typename Element, typename Struct>
concept Is = std::same_as<std::remove_const_t<Element>, Struct>;

void visitMembers(auto&& visit, Is<LightKeys> auto&... keys) {
    visit("of", keys.of...);
    visit("timesSeconds", keys.timesSeconds...);
    visit("values", keys.values...);
    visit("interpolation", keys.interpolation...);
    visit("repeat", keys.repeat...);
    visit("inTangents", keys.inTangents...);
    visit("outTangents", keys.outTangents...);
}

void visitMembers(auto&& visit, Is<LightAnimation> auto&... animation) {
    visit("kind", animation.kind...);
    visit("periodSeconds", animation.periodSeconds...);
    visit("phase", animation.phase...);
    visit("centerWS", animation.centerWS...);
    visit("axisWS", animation.axisWS...);
    visit("amplitudeMetres", animation.amplitudeMetres...);
    visit("pointsWS", animation.pointsWS...);
    visit("line", animation.line...);
    visit("isOpen", animation.isOpen...);
    visit("looksAhead", animation.looksAhead...);
    visit("keys", animation.keys...);
}

void visitMembers(auto&& visit, Is<LightFlicker> auto&... flicker) {
    visit("amplitude", flicker.amplitude...);
    visit("frequencyHz", flicker.frequencyHz...);
    visit("seed", flicker.seed...);
}

void visitMembers(auto&& visit, Is<Light> auto&... light) {
    visitFields(kLightFields, [&](const auto& field) { visit(field.name, light.*field.member...); });
}

void visitMembers(auto&& visit, Is<Camera> auto&... camera) {
    visit("name", camera.name...);
    visit("projection", camera.projection...);
    visit("worldFromCamera", camera.worldFromCamera...);
    visit("fovYRadians", camera.fovYRadians...);
    visit("halfHeightMetres", camera.halfHeightMetres...);
    visit("nearMetres", camera.nearMetres...);
    visit("farMetres", camera.farMetres...);
}

void visitMembers(auto&& visit, Is<DiffusionGaussian> auto&... gaussian) {
    visit("varianceSquareMillimetres", gaussian.varianceSquareMillimetres...);
    visit("weight", gaussian.weight...);
}

void visitMembers(auto&& visit, Is<Subsurface> auto&... subsurface) {
    visitFields(kSubsurfaceFields, [&](const auto& field) { visit(field.name, subsurface.*field.member...); });
}

void visitMembers(auto&& visit, Is<TextureUse> auto&... use) {
    visit("image", use.image...);
    visit("magnification", use.sampler.magnification...);
    visit("minification", use.sampler.minification...);
    visit("wrapU", use.sampler.wrapU...);
    visit("wrapV", use.sampler.wrapV...);
    visit("texCoordSet", use.texCoordSet...);
    visit("offset", use.transform.offset...);
    visit("scale", use.transform.scale...);
    visit("rotationRadians", use.transform.rotationRadians...);
}

/// "baseColorTexture" and so on, by slot.
inline constexpr const char* kTextureFields[kTextureSlotCount] = {"baseColorTexture",
                                                                  "normalTexture",
                                                                  "metallicRoughnessTexture",
                                                                  "emissiveTexture",
                                                                  "specularFactorTexture",
                                                                  "specularColorTexture",
                                                                  "iorTexture",
                                                                  "anisotropyTexture",
                                                                  "clearcoatTexture",
                                                                  "clearcoatRoughnessTexture",
                                                                  "clearcoatNormalTexture",
                                                                  "sheenColorTexture",
                                                                  "sheenRoughnessTexture",
                                                                  "occlusionTexture",
                                                                  "transmissionTexture",
                                                                  "thicknessTexture",
                                                                  "iridescenceTexture",
                                                                  "iridescenceThicknessTexture"};

void visitMembers(auto&& visit, Is<Material> auto&... material) {
    visitFields(kMaterialFields, [&](const auto& field) { visit(field.name, material.*field.member...); });
    for (std::size_t slot = 0; slot < kTextureSlotCount; ++slot)
        visit(kTextureFields[slot], material.textures[slot]...);
}

/// Read the key "fields" of an object, if there is one. Throw InputError for unknown members and wrong types;
/// checkScene() finds values out of range.
void readFields(JsonObject& object, Light& light);
void readFields(JsonObject& object, Camera& camera);
void readFields(JsonObject& object, Material& material);

} // namespace tessera::scenes::scenejson
