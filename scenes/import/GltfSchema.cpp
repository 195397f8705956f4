#include "scenes/import/GltfSchema.h"

namespace tessera::scenes::gltf {
namespace {

constexpr double kMaxInt = std::numeric_limits<int>::max();

constexpr Rule integer(std::string_view path, double min = 0, double max = kMaxInteger) {
    return {path, Kind::Integer, min, max};
}
constexpr Rule number(std::string_view path, double min = -kAny, double max = kAny) {
    return {path, Kind::Number, min, max};
}
constexpr Rule numbers(std::string_view path, std::size_t length, double min = -kAny) {
    return {path, Kind::Numbers, min, kAny, {}, length};
}
constexpr Rule string(std::string_view path) {
    return {path, Kind::String};
}
constexpr Rule boolean(std::string_view path) {
    return {path, Kind::Boolean};
}
constexpr Rule object(std::string_view path) {
    return {path, Kind::Object};
}
constexpr Rule array(std::string_view path) {
    return {path, Kind::Array};
}
constexpr Rule index(std::string_view path, std::string_view into) {
    return {path, Kind::Index, 0, kMaxInt, into};
}
constexpr Rule choice(std::string_view path, std::string_view values) {
    return {path, Kind::Choice, -kAny, kAny, values};
}
constexpr Rule integerChoice(std::string_view path, std::string_view values) {
    return {path, Kind::IntegerChoice, -kAny, kAny, values};
}

// Source of names, ranges and defaults: glTF 2.0 specification, section 5, and the extensions' README schemas.
constexpr Rule kRules[] = {
    object("!asset"),
    string("!asset/version"),
    string("asset/minVersion"),
    string("extensionsUsed/*"),
    string("extensionsRequired/*"),
    object("extensions"),

    index("scene", "scenes"),
    object("scenes/*"),
    string("scenes/*/name"),
    index("scenes/*/nodes/*", "nodes"),

    object("nodes/*"),
    string("nodes/*/name"),
    index("nodes/*/children/*", "nodes"),
    index("nodes/*/mesh", "meshes"),
    index("nodes/*/camera", "cameras"),
    index("nodes/*/skin", "skins"),
    numbers("nodes/*/matrix", 16),
    numbers("nodes/*/translation", 3),
    numbers("nodes/*/rotation", 4),
    numbers("nodes/*/scale", 3),
    object("nodes/*/extensions"),
    object("nodes/*/extensions/KHR_lights_punctual"),
    index("!nodes/*/extensions/KHR_lights_punctual/light", "extensions/KHR_lights_punctual/lights"),

    object("meshes/*"),
    string("meshes/*/name"),
    array("!meshes/*/primitives"),
    object("meshes/*/primitives/*"),
    object("!meshes/*/primitives/*/attributes"),
    index("meshes/*/primitives/*/attributes/@", "accessors"),
    index("meshes/*/primitives/*/indices", "accessors"),
    index("meshes/*/primitives/*/material", "materials"),
    integer("meshes/*/primitives/*/mode", 0, 6),
    array("meshes/*/primitives/*/targets"),
    object("meshes/*/primitives/*/extensions"),

    object("accessors/*"),
    string("accessors/*/name"),
    index("accessors/*/bufferView", "bufferViews"),
    integer("accessors/*/byteOffset"),
    integerChoice("!accessors/*/componentType", "5120|5121|5122|5123|5125|5126"),
    integer("!accessors/*/count", 1),
    choice("!accessors/*/type", "SCALAR|VEC2|VEC3|VEC4|MAT2|MAT3|MAT4"),
    boolean("accessors/*/normalized"),
    object("accessors/*/sparse"),
    integer("!accessors/*/sparse/count", 1, kMaxInt),
    object("!accessors/*/sparse/indices"),
    index("!accessors/*/sparse/indices/bufferView", "bufferViews"),
    integer("accessors/*/sparse/indices/byteOffset", 0, kMaxInt),
    integerChoice("!accessors/*/sparse/indices/componentType", "5121|5123|5125"),
    object("!accessors/*/sparse/values"),
    index("!accessors/*/sparse/values/bufferView", "bufferViews"),
    integer("accessors/*/sparse/values/byteOffset", 0, kMaxInt),

    object("bufferViews/*"),
    index("!bufferViews/*/buffer", "buffers"),
    integer("bufferViews/*/byteOffset"),
    integer("!bufferViews/*/byteLength", 1),
    integer("bufferViews/*/byteStride", 4, 252),
    object("bufferViews/*/extensions"),
    object("bufferViews/*/extensions/EXT_meshopt_compression"),
    index("!bufferViews/*/extensions/EXT_meshopt_compression/buffer", "buffers"),
    integer("bufferViews/*/extensions/EXT_meshopt_compression/byteOffset"),
    integer("!bufferViews/*/extensions/EXT_meshopt_compression/byteLength", 1),
    integer("!bufferViews/*/extensions/EXT_meshopt_compression/byteStride", 1, 256),
    integer("!bufferViews/*/extensions/EXT_meshopt_compression/count", 1),
    choice("!bufferViews/*/extensions/EXT_meshopt_compression/mode", "ATTRIBUTES|TRIANGLES|INDICES"),
    choice("bufferViews/*/extensions/EXT_meshopt_compression/filter", "NONE|OCTAHEDRAL|QUATERNION|EXPONENTIAL"),

    object("buffers/*"),
    integer("!buffers/*/byteLength", 1),
    string("buffers/*/uri"),

    object("images/*"),
    string("images/*/name"),
    string("images/*/uri"),
    index("images/*/bufferView", "bufferViews"),
    string("images/*/mimeType"),
    object("textures/*"),
    string("textures/*/name"),
    index("textures/*/source", "images"),
    index("textures/*/sampler", "samplers"),
    object("samplers/*"),
    integerChoice("samplers/*/magFilter", "9728|9729"),
    integerChoice("samplers/*/minFilter", "9728|9729|9984|9985|9986|9987"),
    integerChoice("samplers/*/wrapS", "33071|33648|10497"),
    integerChoice("samplers/*/wrapT", "33071|33648|10497"),

    object("materials/*"),
    string("materials/*/name"),
    object("materials/*/pbrMetallicRoughness"),
    numbers("materials/*/pbrMetallicRoughness/baseColorFactor", 4, 0),
    number("materials/*/pbrMetallicRoughness/metallicFactor", 0, 1),
    number("materials/*/pbrMetallicRoughness/roughnessFactor", 0, 1),
    number("materials/*/normalTexture/scale"),
    number("materials/*/occlusionTexture/strength"),
    numbers("materials/*/emissiveFactor", 3, 0),
    choice("materials/*/alphaMode", "OPAQUE|MASK|BLEND"),
    number("materials/*/alphaCutoff", 0),
    boolean("materials/*/doubleSided"),
    object("materials/*/extensions"),
    object("materials/*/extensions/KHR_materials_unlit"),
    object("materials/*/extensions/KHR_materials_emissive_strength"),
    number("materials/*/extensions/KHR_materials_emissive_strength/emissiveStrength", 0),
    object("materials/*/extensions/KHR_materials_ior"),
    number("materials/*/extensions/KHR_materials_ior/ior", 0),
    object("materials/*/extensions/KHR_materials_specular"),
    number("materials/*/extensions/KHR_materials_specular/specularFactor", 0, 1),
    numbers("materials/*/extensions/KHR_materials_specular/specularColorFactor", 3, 0),
    object("materials/*/extensions/KHR_materials_anisotropy"),
    number("materials/*/extensions/KHR_materials_anisotropy/anisotropyStrength", 0, 1),
    number("materials/*/extensions/KHR_materials_anisotropy/anisotropyRotation"),
    object("materials/*/extensions/KHR_materials_clearcoat"),
    number("materials/*/extensions/KHR_materials_clearcoat/clearcoatFactor", 0, 1),
    number("materials/*/extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", 0, 1),
    number("materials/*/extensions/KHR_materials_clearcoat/clearcoatNormalTexture/scale"),
    object("materials/*/extensions/KHR_materials_sheen"),
    {"materials/*/extensions/KHR_materials_sheen/sheenColorFactor", Kind::Numbers, 0, 1, {}, 3},
    number("materials/*/extensions/KHR_materials_sheen/sheenRoughnessFactor", 0, 1),

    object("cameras/*"),
    string("cameras/*/name"),
    choice("!cameras/*/type", "perspective|orthographic"),
    number("!cameras/*/perspective/yfov"),
    number("!cameras/*/perspective/znear"),
    number("cameras/*/perspective/zfar"),
    number("!cameras/*/orthographic/xmag"),
    number("!cameras/*/orthographic/ymag"),
    number("!cameras/*/orthographic/znear"),
    number("!cameras/*/orthographic/zfar"),

    object("extensions/KHR_lights_punctual"),
    array("!extensions/KHR_lights_punctual/lights"),
    object("extensions/KHR_lights_punctual/lights/*"),
    string("extensions/KHR_lights_punctual/lights/*/name"),
    choice("!extensions/KHR_lights_punctual/lights/*/type", "directional|point|spot"),
    numbers("extensions/KHR_lights_punctual/lights/*/color", 3, 0),
    number("extensions/KHR_lights_punctual/lights/*/intensity", 0),
    number("extensions/KHR_lights_punctual/lights/*/range", 0),
    object("extensions/KHR_lights_punctual/lights/*/spot"),
    number("extensions/KHR_lights_punctual/lights/*/spot/innerConeAngle", 0),
    number("extensions/KHR_lights_punctual/lights/*/spot/outerConeAngle", 0),

    object("skins/*"),
    object("animations/*"),
};

/// The places a texture is used at; each must look like a textureInfo.
constexpr std::string_view kTextureInfos[] = {
    "materials/*/pbrMetallicRoughness/baseColorTexture",
    "materials/*/pbrMetallicRoughness/metallicRoughnessTexture",
    "materials/*/normalTexture",
    "materials/*/occlusionTexture",
    "materials/*/emissiveTexture",
    "materials/*/extensions/KHR_materials_specular/specularTexture",
    "materials/*/extensions/KHR_materials_specular/specularColorTexture",
    "materials/*/extensions/KHR_materials_anisotropy/anisotropyTexture",
    "materials/*/extensions/KHR_materials_clearcoat/clearcoatTexture",
    "materials/*/extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture",
    "materials/*/extensions/KHR_materials_clearcoat/clearcoatNormalTexture",
    "materials/*/extensions/KHR_materials_sheen/sheenColorTexture",
    "materials/*/extensions/KHR_materials_sheen/sheenRoughnessTexture",
};
constexpr Rule kTextureInfoRules[] = {
    index("!index", "textures"),
    integer("texCoord", 0, kMaxInt),
    object("extensions"),
    object("extensions/KHR_texture_transform"),
    numbers("extensions/KHR_texture_transform/offset", 2),
    numbers("extensions/KHR_texture_transform/scale", 2),
    number("extensions/KHR_texture_transform/rotation"),
    integer("extensions/KHR_texture_transform/texCoord", 0, kMaxInt),
};

} // namespace

std::span<const Rule> documentRules() {
    return kRules;
}

std::span<const std::string_view> textureInfoPlaces() {
    return kTextureInfos;
}

std::span<const Rule> textureInfoRules() {
    return kTextureInfoRules;
}

} // namespace tessera::scenes::gltf
