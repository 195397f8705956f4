#pragma once
#include <concepts>
#include <type_traits>

#include "scenes/Scene.h"
#include "scenes/import/JsonReader.h"

/// The members of Scene.h's structs by name: "fields" of a light, a camera or a material may set each of them, for any
/// type or model. A visitor is called with a member's name and that member of each of the objects.
namespace tessera::scenes::scenejson {

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

/// Read the key "fields" of an object, where there is one. Throws InputError for unknown members and wrong types; what
/// is out of range checkScene() finds.
void readFields(JsonObject& object, Light& light);
void readFields(JsonObject& object, Camera& camera);
void readFields(JsonObject& object, Material& material);

} // namespace tessera::scenes::scenejson
