#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/Scene.h"
#include "scenes/import/GltfReader.h"

/// The objects of a glTF document as far as the importer uses them, checked (GltfReader.h). Members are named after the
/// properties, or after what of a scene they become; read() is the table of the properties. Indices are kNone where the
/// document has none.
namespace tessera::scenes::gltf::model {

struct Scene {
    std::vector<int> nodes;
    int imageLight = kNone; ///< EXT_lights_image_based

    void read(Object& object);
};

struct Node {
    std::string name;
    std::vector<int> children;
    int mesh = kNone;
    int skin = kNone;
    std::vector<float> weights; ///< of the mesh's morph targets; empty: those of the mesh
    std::optional<std::map<std::string, int>> instanceAttributes; ///< accessors; EXT_mesh_gpu_instancing
    int camera = kNone;
    int light = kNone;
    std::optional<glm::dmat4> matrix; ///< instead of the three below
    glm::dvec3 translation{0.0};
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0}; ///< x, y, z, w of a quaternion
    glm::dvec3 scale{1.0};

    void read(Object& object);
};

/// Of KHR_materials_variants: the material of a primitive in some of the document's variants.
struct VariantMapping {
    int material = kNone;
    std::vector<int> variants;

    void read(Object& object);
};

/// KHR_draco_mesh_compression.
struct Draco {
    int bufferView = kNone;
    std::map<std::string, int> attributes; ///< identifiers in the stream

    void read(Object& object);
};

struct Primitive {
    std::map<std::string, int> attributes; ///< accessors
    int indices = kNone;
    int material = kNone;
    int mode = 4;
    std::vector<std::map<std::string, int>> targets; ///< accessors by attribute
    std::vector<VariantMapping> variantMappings;
    std::optional<Draco> draco; ///< what holds the indices, and the attributes that it names

    void read(Object& object);
};

struct Mesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<float> weights; ///< of morph targets; empty: all 0

    void read(Object& object);
};

enum class ComponentType : std::uint8_t { Byte, UnsignedByte, Short, UnsignedShort, UnsignedInt, Float };

struct Sparse {
    std::size_t count = 0;
    int indicesView = kNone;
    std::size_t indicesOffset = 0;
    ComponentType indexType{};
    int valuesView = kNone;
    std::size_t valuesOffset = 0;

    void read(Object& object);
};

struct Accessor {
    int bufferView = kNone;
    std::size_t byteOffset = 0;
    ComponentType componentType{};
    std::size_t count = 0;
    int components = 0; ///< of an element; 16: a 4x4 matrix, 0: another one
    bool normalized = false;
    std::optional<Sparse> sparse;

    void read(Object& object);
};

struct Buffer {
    std::size_t byteLength = 0;
    std::optional<std::string> uri;

    void read(Object& object);
};

/// A range of a buffer.
struct Slice {
    int buffer = kNone;
    std::size_t byteOffset = 0;
    std::size_t byteLength = 0;

    void read(Object& object);
};

/// EXT_meshopt_compression.
struct Meshopt {
    Slice encoded;
    std::size_t count = 0;
    std::size_t byteStride = 0;
    std::string_view mode;            ///< ATTRIBUTES, TRIANGLES or INDICES
    std::string_view filter = "NONE"; ///< or OCTAHEDRAL, QUATERNION, EXPONENTIAL

    void read(Object& object);
};

struct BufferView {
    Slice bytes;
    std::size_t byteStride = 0; ///< 0: the elements follow one another
    std::optional<Meshopt> meshopt;

    void read(Object& object);
};

struct Image {
    std::string name;
    std::string uri;
    int bufferView = kNone;

    void read(Object& object);
};

struct Texture {
    int source = kNone;
    int webp = kNone; ///< the image to be preferred; EXT_texture_webp
    int sampler = kNone;

    void read(Object& object);
};

struct Sampler : scenes::Sampler {
    void read(Object& object);
};

/// A use of a texture, with KHR_texture_transform.
struct TextureInfo {
    int texture = kNone;
    int texCoordSet = 0;
    TextureTransform transform;

    void read(Object& object);
};

/// The places at which a material uses a texture, in the order in which images are imported.
struct TexturePlace {
    std::string_view path;
    TextureSlot slot;
};
inline constexpr TexturePlace kTexturePlaces[] = {
    {"pbrMetallicRoughness/baseColorTexture", TextureSlot::BaseColor},
    {"pbrMetallicRoughness/metallicRoughnessTexture", TextureSlot::MetallicRoughness},
    {"normalTexture", TextureSlot::Normal},
    {"emissiveTexture", TextureSlot::Emissive},
    {"occlusionTexture", TextureSlot::Occlusion},
    {"extensions/KHR_materials_specular/specularTexture", TextureSlot::SpecularFactor},
    {"extensions/KHR_materials_specular/specularColorTexture", TextureSlot::SpecularColor},
    {"extensions/KHR_materials_anisotropy/anisotropyTexture", TextureSlot::Anisotropy},
    {"extensions/KHR_materials_clearcoat/clearcoatTexture", TextureSlot::Clearcoat},
    {"extensions/KHR_materials_clearcoat/clearcoatRoughnessTexture", TextureSlot::ClearcoatRoughness},
    {"extensions/KHR_materials_clearcoat/clearcoatNormalTexture", TextureSlot::ClearcoatNormal},
    {"extensions/KHR_materials_sheen/sheenColorTexture", TextureSlot::SheenColor},
    {"extensions/KHR_materials_sheen/sheenRoughnessTexture", TextureSlot::SheenRoughness},
    {"extensions/KHR_materials_transmission/transmissionTexture", TextureSlot::Transmission},
    {"extensions/KHR_materials_volume/thicknessTexture", TextureSlot::Thickness},
    {"extensions/KHR_materials_iridescence/iridescenceTexture", TextureSlot::Iridescence},
    {"extensions/KHR_materials_iridescence/iridescenceThicknessTexture", TextureSlot::IridescenceThickness},
};

/// KHR_materials_pbrSpecularGlossiness, which takes the place of pbrMetallicRoughness.
struct SpecularGlossiness {
    glm::vec4 diffuse{1.0f};
    glm::vec3 specular{1.0f};
    float glossiness = 1.0f;
    TextureInfo diffuseTexture;
    TextureInfo specularGlossinessTexture; ///< RGB specular (sRGB), A glossiness (linear)

    void read(Object& object);
};

/// Source: glTF 2.0 section 3.9; KHR_materials_unlit, _emissive_strength, _ior, _specular, _anisotropy, _clearcoat,
/// _sheen, _iridescence, _transmission, _volume, _dispersion.
struct Material {
    scenes::Material surface;                                    ///< but its textures and index of refraction
    std::array<TextureInfo, std::size(kTexturePlaces)> textures; ///< as kTexturePlaces
    double ior = 1.5;
    glm::vec3 emissiveFactor{0.0f};
    float emissiveStrength = 1.0f; ///< in surface.emissive, as emissiveFactor is
    std::optional<SpecularGlossiness> specularGlossiness;

    void read(Object& object);
};

struct Camera {
    std::string name;
    Projection projection{};
    struct Perspective {
        double yfov = 0.0, znear = 0.0, zfar = std::numeric_limits<double>::infinity();
    } perspective;
    struct Orthographic {
        double xmag = 0.0, ymag = 0.0, znear = 0.0, zfar = 0.0;
    } orthographic;

    void read(Object& object);
};

/// KHR_lights_punctual.
struct Light {
    std::string name;
    LightType type{};
    glm::vec3 color{1.0f};
    float intensity = 1.0f;
    std::optional<float> range;
    double innerConeAngle = 0.0;
    double outerConeAngle = 0.7853981634; // pi/4
    double wattsPerUnit = 1.0;            ///< in `intensity` already, not in clips (GltfLightUnits.h)

    void read(Object& object);
};

/// EXT_lights_image_based.
struct ImageLight {
    std::string name;
    float intensity = 1.0f;
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0}; ///< x, y, z, w of a quaternion, of any length but 0
    std::vector<glm::dvec3> irradiance;      ///< by spherical harmonics up to order 2: nine
    std::vector<std::vector<int>> images;    ///< of six faces each: +X, -X, +Y, -Y, +Z, -Z; the first is not filtered
    int sideTexels = 0;                      ///< of the faces of the first

    void read(Object& object);
};

struct Skin {
    std::string name;
    int inverseBindMatrices = kNone; ///< an accessor; none: identities
    std::vector<int> joints;

    void read(Object& object);
};

struct AnimationSampler {
    int input = kNone, output = kNone; ///< accessors
    Interpolation interpolation = Interpolation::Linear;

    void read(Object& object);
};

struct AnimationChannel {
    int sampler = kNone;
    int node = kNone; ///< that the path starts from
    std::string path;
    std::string pointer; ///< KHR_animation_pointer, instead of both

    void read(Object& object);
};

struct Animation {
    std::string name;
    std::vector<AnimationSampler> samplers;
    std::vector<AnimationChannel> channels;

    void read(Object& object);
};

/// Of KHR_materials_variants.
struct Variant {
    std::string name;

    void read(Object& object);
};

struct Model {
    std::string generator; ///< the program that wrote it
    std::vector<std::string> extensionsUsed;
    std::vector<std::string> extensionsRequired;
    int scene = 0; ///< the default one
    std::vector<Scene> scenes;
    std::vector<Node> nodes;
    std::vector<Mesh> meshes;
    std::vector<Accessor> accessors;
    std::vector<BufferView> bufferViews;
    std::vector<Buffer> buffers;
    std::vector<Image> images;
    std::vector<Texture> textures;
    std::vector<Sampler> samplers;
    std::vector<Material> materials;
    std::vector<Camera> cameras;
    std::vector<Light> lights;
    std::vector<ImageLight> imageLights;
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    std::vector<Variant> variants;

    void read(Object& object);
};

} // namespace tessera::scenes::gltf::model
