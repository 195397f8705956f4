#include "scenes/import/GltfSchema.h"

#include <charconv>

#include "scenes/import/GltfModel.h"

namespace tessera::scenes::gltf {
namespace {

/// The properties that the importer reads. A line without indent begins an object; after its name follows the stand-in
/// for a flawed one, if that needs members. The indented lines list its properties: path of keys, flag and type. Flags:
/// "!" required in the object above, "?key=value" required if that key has this text, "+" optional, but a flaw in it
/// invalidates the object. Types: text, label (a text, empty if it is no text), flag, object (whose content is not
/// read), number, int (32 bits), size (up to 2^53), index (into an array), choice (of texts), code (one of several
/// integers), and objects. Array suffixes, innermost first: [3] three elements, [] any number, [~] flawed ones removed,
/// [?] flawed ones replaced by stand-ins, {} an object with any keys. After a colon: least..most, >least, %divisor, the
/// array of an index, or the choices. Source: glTF 2.0 specification, section 5, and the extensions' schemas.
constexpr std::string_view kProperties = R"(
Document
 asset/version text; asset/generator text; extensionsUsed text[~]; extensionsRequired text[~]
 extensions/KHR_lights_punctual/lights Light[]; extensions/EXT_lights_image_based/lights ImageLight[]
 extensions/KHR_materials_variants/variants Variant[]; scene index:scenes; scenes Scene[]; nodes Node[]; meshes Mesh[]
 accessors Accessor[]; bufferViews BufferView[]; buffers Buffer[]; images Image[]; textures Texture[]
 samplers Sampler[]; materials Material[]; cameras Camera[]; skins Skin[]; animations Animation[~]
Variant {"name": ""}
 name! text
Scene
 name label; nodes index[~]:nodes
 extensions/EXT_lights_image_based/light! index:extensions/EXT_lights_image_based/lights
Node
 name label; children index[~]:nodes; mesh index:meshes; camera index:cameras; skin index:skins; weights number[]
 matrix number[16]; translation number[3]; rotation number[4]; scale number[3]
 extensions/KHR_lights_punctual/light! index:extensions/KHR_lights_punctual/lights
 extensions/KHR_node_visibility/visible flag
 extensions/EXT_mesh_gpu_instancing/attributes! index{}:accessors
Mesh
 name label; primitives! Primitive[~]; weights number[]
Primitive
 attributes! index{}:accessors; indices+ index:accessors; material index:materials; mode int:0..6
 targets index{}[]:accessors; extensions/KHR_materials_variants/mappings VariantMapping[~]
 extensions/KHR_draco_mesh_compression+ Draco
Draco
 bufferView! index:bufferViews; attributes! int{}:0..
VariantMapping
 material! index:materials; variants! index[~]:extensions/KHR_materials_variants/variants
Accessor {"componentType": 5126, "count": 1, "type": "SCALAR"}
 name label; bufferView+ index:bufferViews; byteOffset+ size:0..; componentType! code:5120|5121|5122|5123|5125|5126
 count! size:1..; type! choice:SCALAR|VEC2|VEC3|VEC4|MAT2|MAT3|MAT4; normalized flag; sparse+ Sparse
Sparse
 count! int:0..; indices! object; indices/bufferView! index:bufferViews; indices/byteOffset int:0..
 indices/componentType! code:5121|5123|5125; values! object; values/bufferView! index:bufferViews
 values/byteOffset int:0..
Buffer {"byteLength": 1}
 byteLength size:1..; uri+ text
BufferView {"buffer": 0, "byteLength": 1}
 buffer! index:buffers; byteOffset+ size:0..; byteLength! size:1..; byteStride+ size:4..252%4
 extensions/EXT_meshopt_compression+ Meshopt
Meshopt
 buffer! index:buffers; byteOffset+ size:0..; byteLength! size:1..; byteStride! size:1..256; count! size:1..
 mode! choice:ATTRIBUTES|TRIANGLES|INDICES; filter choice:NONE|OCTAHEDRAL|QUATERNION|EXPONENTIAL
Image
 name label; uri text; bufferView index:bufferViews; mimeType text
Texture
 name label; source index:images; extensions/EXT_texture_webp/source! index:images; sampler index:samplers
Sampler
 magFilter code:9728|9729; minFilter code:9728|9729|9984|9985|9986|9987
 wrapS code:33071|33648|10497; wrapT code:33071|33648|10497
TextureInfo
 index! index:textures; texCoord int:0..; extensions/KHR_texture_transform TextureTransform
TextureTransform
 offset number[2]; scale number[2]; rotation number; texCoord int:0..
Material
 name label; pbrMetallicRoughness MetallicRoughness; normalTexture TextureInfo; normalTexture/scale number
 occlusionTexture TextureInfo; occlusionTexture/strength number:0..1; alphaMode choice:OPAQUE|MASK|BLEND
 alphaCutoff number:0..; doubleSided flag; emissiveTexture TextureInfo; emissiveFactor number[3]:0..1e30
 extensions MaterialExtensions
MetallicRoughness
 baseColorFactor number[4]:0..1e6; metallicFactor number:0..1; roughnessFactor number:0..1
 baseColorTexture TextureInfo; metallicRoughnessTexture TextureInfo
MaterialExtensions
 KHR_materials_unlit object; KHR_materials_pbrSpecularGlossiness SpecularGlossiness
 KHR_materials_emissive_strength/emissiveStrength number:0..1e30; KHR_materials_ior/ior number:0..1e6
 KHR_materials_specular Specular; KHR_materials_anisotropy Anisotropy; KHR_materials_clearcoat Clearcoat
 KHR_materials_sheen Sheen; KHR_materials_iridescence Iridescence; KHR_materials_transmission Transmission
 KHR_materials_volume Volume; KHR_materials_dispersion/dispersion number:0..
SpecularGlossiness
 diffuseFactor number[4]:0..1; specularFactor number[3]:0..1; glossinessFactor number:0..1
 diffuseTexture TextureInfo; specularGlossinessTexture TextureInfo
Specular
 specularFactor number:0..1; specularColorFactor number[3]:0..1e6
 specularTexture TextureInfo; specularColorTexture TextureInfo
Anisotropy
 anisotropyStrength number:0..1; anisotropyRotation number; anisotropyTexture TextureInfo
Clearcoat
 clearcoatFactor number:0..1; clearcoatRoughnessFactor number:0..1; clearcoatTexture TextureInfo
 clearcoatRoughnessTexture TextureInfo; clearcoatNormalTexture TextureInfo; clearcoatNormalTexture/scale number
Sheen
 sheenColorFactor number[3]:0..1; sheenRoughnessFactor number:0..1
 sheenColorTexture TextureInfo; sheenRoughnessTexture TextureInfo
Iridescence
 iridescenceFactor number:0..1; iridescenceIor number:1..1e6; iridescenceThicknessMinimum number:0..
 iridescenceThicknessMaximum number:0..; iridescenceTexture TextureInfo; iridescenceThicknessTexture TextureInfo
Transmission
 transmissionFactor number:0..1; transmissionTexture TextureInfo
Volume
 thicknessFactor number:0..; attenuationColor number[3]:0..1; attenuationDistance number:>0
 thicknessTexture TextureInfo
Camera {"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}
 name label; type! choice:perspective|orthographic
 perspective?type=perspective Perspective; orthographic?type=orthographic Orthographic
Perspective
 yfov! number; znear! number; zfar number:>0
Orthographic
 xmag! number; ymag! number; znear! number; zfar! number
Light {"type": "point"}
 name label; type! choice:directional|point|spot; color number[3]:0..; intensity number:0..; range number:0..
 spot?type=spot Spot
Spot
 innerConeAngle number:0..; outerConeAngle number:0..
ImageLight {"type": "point"}
 name label; intensity number:0..; rotation number[4]; irradianceCoefficients! number[3][]
 specularImages! index[][]:images; specularImageSize! int:1..
Skin {"joints": []}
 name label; inverseBindMatrices+ index:accessors; skeleton index:nodes; joints! index[]:nodes
Animation
 name label; samplers! AnimationSampler[?]; channels! AnimationChannel[~]
AnimationSampler {"input": -1, "output": -1}
 input! index:accessors; output! index:accessors; interpolation+ choice:LINEAR|STEP|CUBICSPLINE
AnimationChannel
 sampler! int:0..; target! Target
Target
 path! text; node index:nodes; extensions/KHR_animation_pointer/pointer text
)";

std::string_view cut(std::string_view& text, std::string_view separators) {
    const std::string_view first = text.substr(0, text.find_first_of(separators));
    text.remove_prefix(first.size());
    return first;
}

void readNumber(std::string_view text, auto& number) {
    std::from_chars(text.data(), text.data() + text.size(), number);
}

/// Peak memory of tinygltf per array element: all arrays but `nodes` (GltfModel.cpp) grow. Others become values.
const std::map<std::string_view, std::uint64_t>& elementBytes() {
    static const std::map<std::string_view, std::uint64_t> kBytes{
        {"Document", 0},
        {"Scene", kGrowth * sizeof(tiny::Scene)},
        {"Node", sizeof(tiny::Node)},
        {"Mesh", kGrowth * sizeof(tiny::Mesh)},
        {"Primitive", kGrowth * sizeof(tiny::Primitive)},
        {"Accessor", kGrowth * sizeof(tiny::Accessor)},
        {"BufferView", kGrowth * sizeof(tiny::BufferView)},
        {"Buffer", kGrowth * sizeof(tiny::Buffer)},
        {"Image", sizeof(tiny::Image)},
        {"Texture", kGrowth * sizeof(tiny::Texture)},
        {"Sampler", kGrowth * sizeof(tiny::Sampler)},
        {"Material", kGrowth * sizeof(tiny::Material) + sizeof(StoredMaterial)},
        {"Camera", kGrowth * sizeof(tiny::Camera)},
        {"Skin", kGrowth * sizeof(tiny::Skin)},
        {"Animation", kGrowth * sizeof(tiny::Animation)},
        {"AnimationSampler", kGrowth * sizeof(tiny::AnimationSampler)},
        {"AnimationChannel", kGrowth * sizeof(tiny::AnimationChannel)},
    };
    return kBytes;
}

} // namespace

std::vector<std::string_view> split(std::string_view text, std::string_view separator) {
    std::vector<std::string_view> parts{cut(text, separator)};
    while (!text.empty()) {
        text.remove_prefix(1);
        parts.push_back(cut(text, separator));
    }
    return parts;
}

Schema::Schema() {
    for (const auto& [name, bytes] : elementBytes())
        objects_[name] = {bytes + kHeapBlockBytes, false, {}, Json::object()};
    objects_["Light"].bytes += kGrowth * sizeof(tiny::Light); // beside its value
    Struct* object = nullptr;
    for (std::string_view line : split(kProperties, "\n"))
        if (line.empty() || line.front() != ' ') {
            object = &objects_[cut(line, " ")];
            if (!line.empty()) object->standIn = Json::parse(line);
        } else
            for (const std::string_view property : split(line.substr(1), ";"))
                object->properties.push_back(propertyOf(property));
}

Property Schema::propertyOf(std::string_view text) {
    Property property;
    text.remove_prefix(text.find_first_not_of(' '));
    property.path = cut(text, "!?+ ");
    property.keys = split(property.path, "/");
    property.isRequired = text.front() == '!';
    property.isExtension = property.keys.front() == "extensions";
    property.isWhole = text.front() == '+' || (text.front() != ' ' && !property.isExtension);
    const std::string_view condition = cut(text, " ");
    if (condition.starts_with('?')) {
        const std::size_t equals = condition.find('=');
        property.conditionKey = condition.substr(1, equals - 1);
        property.condition = condition.substr(equals + 1);
    }
    property.type = typeOf(text.substr(1));
    return property;
}

Type Schema::typeOf(std::string_view text) {
    constexpr std::string_view kKinds[] = {"text", "label", "flag",  "object", "number",
                                           "int",  "size",  "index", "choice", "code"}; // in the order of Kind
    Type type;
    const std::string_view name = cut(text, "[{:");
    type.kind = Kind(std::ranges::find(kKinds, name) - std::begin(kKinds));
    if (type.kind == Kind::Struct) type.object = &objects_[name];
    while (!text.empty() && text.front() != ':') {
        const std::size_t end = text.find_first_of("]}") + 1;
        type.arrays.push_back(text.front() == '{' ? "{}" : text.substr(1, end - 2));
        text.remove_prefix(end);
    }
    if (type.kind == Kind::Int || type.kind == Kind::Index) type.most = kMaxInt;
    if (type.kind == Kind::Size) type.most = kMaxInteger;
    if (text.empty()) return type;
    text.remove_prefix(1);
    if (type.kind == Kind::Index) {
        type.least = 0.0;
        type.array = text;
        countedArrays_.push_back(text);
    } else if (type.kind == Kind::Choice || type.kind == Kind::Code) {
        type.choices = split(text, "|");
    } else {
        type.isMoreThanLeast = text.front() == '>';
        if (type.isMoreThanLeast) text.remove_prefix(1);
        readNumber(text, type.least);
        if (const std::size_t dots = text.find(".."); dots != text.npos) readNumber(text.substr(dots + 2), type.most);
        if (const std::size_t by = text.find('%'); by != text.npos) readNumber(text.substr(by + 1), type.divisor);
    }
    return type;
}

const Schema& schema() {
    static const Schema made;
    return made;
}

} // namespace tessera::scenes::gltf
