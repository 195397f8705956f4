#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

/// A scene as plain data, as its author wrote it: nothing here is packed for a GPU and nothing is derived that a
/// renderer could derive (tangents, culling radii, cone scales). World space is right-handed, Y up, metres; colours are
/// linear unless a texture slot says otherwise. Indices are -1 where something is absent.
namespace tessera::scenes {

inline constexpr int kNone = -1;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

// ---- Images and textures -------------------------------------------------------------------------------------------

enum class TexelFormat : std::uint8_t { Rgba8Unorm, Rgba16Unorm, Rgba32Float };

/// Decoded picture: 4 channels, rows from the top, texels as stored in the file (no transfer function applied).
struct Image {
    std::string name;
    TexelFormat format = TexelFormat::Rgba8Unorm;
    int width = 0;  ///< texels
    int height = 0; ///< texels
    std::vector<std::byte> texels;
};

/// Bytes of one texel of `format`.
std::size_t texelBytes(TexelFormat format);

enum class Wrap : std::uint8_t { Repeat, ClampToEdge, MirroredRepeat };
enum class Filter : std::uint8_t {
    Nearest,
    Linear,
    NearestMipmapNearest,
    LinearMipmapNearest,
    NearestMipmapLinear,
    LinearMipmapLinear
};

struct Sampler {
    Filter magnification = Filter::Linear;
    Filter minification = Filter::LinearMipmapLinear;
    Wrap wrapU = Wrap::Repeat;
    Wrap wrapV = Wrap::Repeat;
    bool operator==(const Sampler&) const = default;
};

/// Applied to a texture coordinate as offset + rotation(scale * uv), after KHR_texture_transform (v points down, the
/// origin is the picture's top-left corner, a positive angle turns the coordinates counter-clockwise in that
/// convention).
struct TextureTransform {
    glm::vec2 offset{0.0f};
    glm::vec2 scale{1.0f};
    float rotationRadians = 0.0f;
    bool operator==(const TextureTransform&) const = default;
};

/// A texture as a material uses it; `image` is kNone when the slot is empty, and then the factor alone counts.
struct TextureUse {
    int image = kNone;
    Sampler sampler;
    int texCoordSet = 0; ///< 0 or 1
    TextureTransform transform;
    bool operator==(const TextureUse&) const = default;
};

/// Where a material may carry a texture. Every value is factor x texel; the channels used and the transfer function:
enum class TextureSlot : std::uint8_t {
    BaseColor,          ///< RGB base colour, k_d or the unlit colour (sRGB); A opacity
    Normal,             ///< RGB normal, tangent or object space (linear)
    MetallicRoughness,  ///< G roughness (perceptual for metallic_roughness, alpha or alpha_x for the microfacet models,
                        ///< the exponent for blinn_phong), B metalness (linear)
    Emissive,           ///< RGB (sRGB)
    SpecularFactor,     ///< A strength of the dielectric specular lobe (linear)
    SpecularColor,      ///< RGB k_s, or the tint of the dielectric F0 (sRGB)
    Ior,                ///< R index of refraction (linear)
    Anisotropy,         ///< RG direction in tangent space as 2 x texel - 1, B strength (metallic_roughness);
                        ///< R alpha_y (microfacet_anisotropic) (linear)
    Clearcoat,          ///< R share of the coat (linear)
    ClearcoatRoughness, ///< G perceptual roughness of the coat (linear)
    ClearcoatNormal,    ///< RGB normal of the coat, tangent space (linear)
    SheenColor,         ///< RGB (sRGB)
    SheenRoughness,     ///< A perceptual roughness of the sheen (linear)
    Count
};
inline constexpr std::size_t kTextureSlotCount = static_cast<std::size_t>(TextureSlot::Count);

// ---- Materials -----------------------------------------------------------------------------------------------------

/// The models of the shading specification.
enum class MaterialModel : std::uint8_t {
    SingleColor,           ///< the colour itself, unlit
    Lambert,               ///< k_d max(0, n.l), no 1/pi
    BlinnPhong,            ///< k_d max(0, n.l) + k_s (n.h)^p
    Microfacet,            ///< k_d plus k_s F D G / 4, exact dielectric Fresnel
    MicrofacetAnisotropic, ///< the same with alpha_x along the tangent and alpha_y along the bitangent
    MetallicRoughness      ///< glTF 2.0 appendix B
};

/// How the microfacet models let microfacets hide each other.
enum class Masking : std::uint8_t {
    Walter,      ///< by the angle to the normal; alpha along the microfacet normal where anisotropic (Walter 2007)
    Directional, ///< microfacet_anisotropic: alpha along the direction itself (Heitz 2014)
    HalfVector   ///< by the angle to the half vector; gains energy
};

enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };
enum class NormalMapSpace : std::uint8_t { Tangent, Object };

/// How tangents are derived for meshes that bring none.
enum class TangentMethod : std::uint8_t {
    MikkTSpace, ///< as bakers do and glTF recommends: weighted by angle, split where the texture is mirrored
    Lengyel     ///< summed over each vertex's triangles, as course notes teach it (Lengyel 2001)
};

struct Material {
    std::string name;
    MaterialModel model = MaterialModel::MetallicRoughness;
    glm::vec4 baseColor{1.0f};         ///< base colour, k_d or the colour itself, linear; w is opacity
    glm::vec3 emissive{0.0f};          ///< radiance, linear, emissive strength multiplied in
    float metallic = 1.0f;             ///< 0..1, metallic_roughness only
    float perceptualRoughness = 1.0f;  ///< 0..1, metallic_roughness only; alpha is its square
    float alpha = 0.5f;                ///< GGX alpha of microfacet, alpha_x of microfacet_anisotropic, used as it is
    float alphaY = 0.5f;               ///< GGX alpha along the bitangent, microfacet_anisotropic only
    Masking masking = Masking::Walter; ///< microfacet models only
    float exponent = 32.0f;            ///< p of blinn_phong
    float ior = 1.5f;                  ///< index of refraction n2/n1
    float specularFactor = 1.0f;       ///< strength of the dielectric specular lobe (KHR_materials_specular)
    glm::vec3 specularColor{1.0f};     ///< k_s, or the tint of the dielectric F0 (KHR_materials_specular)
    /// KHR_materials_anisotropy, _clearcoat and _sheen, metallic_roughness only.
    float anisotropyStrength = 0.0f;           ///< 0..1
    float anisotropyRotationRadians = 0.0f;    ///< counter-clockwise from the tangent
    float clearcoat = 0.0f;                    ///< 0..1, share of the coat
    float clearcoatPerceptualRoughness = 0.0f; ///< 0..1
    float clearcoatNormalScale = 1.0f;
    glm::vec3 sheenColor{0.0f};            ///< 0..1
    float sheenPerceptualRoughness = 0.0f; ///< 0..1
    float normalScale = 1.0f;              ///< scales x and y of a tangent-space normal texel
    NormalMapSpace normalMapSpace = NormalMapSpace::Tangent;
    TangentMethod tangents = TangentMethod::MikkTSpace;
    AlphaMode alphaMode = AlphaMode::Opaque;
    float alphaCutoff = 0.5f; ///< Mask: a fragment stays when opacity >= cutoff
    bool doubleSided = false;
    std::array<TextureUse, kTextureSlotCount> textures;

    TextureUse& texture(TextureSlot slot) { return textures[static_cast<std::size_t>(slot)]; }
    const TextureUse& texture(TextureSlot slot) const { return textures[static_cast<std::size_t>(slot)]; }
    bool operator==(const Material&) const = default;
};

// ---- Geometry ------------------------------------------------------------------------------------------------------

struct Box3 {
    glm::dvec3 min{std::numeric_limits<double>::infinity()};
    glm::dvec3 max{-std::numeric_limits<double>::infinity()};
    bool empty() const { return min.x > max.x; }
    void extend(const glm::dvec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
};

/// Indexed triangles, counter-clockwise seen from the front. Positions and normals are always there and of one length;
/// every other attribute is either empty or of that length too.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positionsOS;
    std::vector<glm::vec3> normalsOS;  ///< unit length
    std::vector<glm::vec4> tangentsOS; ///< xyz unit length, w handedness (+1 or -1); empty: a renderer derives them
    std::array<std::vector<glm::vec2>, 2> texCoords; ///< origin at the picture's top-left corner, v down
    std::vector<glm::vec4> colors;                   ///< linear, multiply baseColor
    std::vector<std::uint32_t> indices;              ///< three a triangle
};

/// A mesh drawn with a material, at a node.
struct MeshInstance {
    int mesh = kNone;
    int material = kNone;
};

/// Transform hierarchy; a parent always stands before its children.
struct Node {
    std::string name;
    int parent = kNone;
    glm::dmat4 parentFromNode{1.0};
    std::vector<MeshInstance> instances;
};

// ---- Lights --------------------------------------------------------------------------------------------------------

enum class LightType : std::uint8_t { Directional, Point, Spot };
enum class Falloff : std::uint8_t {
    InverseSquare, ///< candela x clamp(1 - (d/range)^4, 0, 1)^2 / max(d^2, 1e-4 m^2)
    Attenuation    ///< colour / max(A + B d + C d^2, 1e-4)
};

enum class LightAnimationKind : std::uint8_t {
    Orbit,    ///< circles `axis` through `center` once in `periodSeconds`
    Wobble,   ///< position + amplitude * sin(2 pi (t / period + phase)), each axis
    Path,     ///< runs along the closed polyline `points` at constant speed once in `periodSeconds`
    Keyframes ///< linear between (times, points), clamped at the ends
};

/// Moves a light's position (point, spot) as a closed function of time, so that any time can be asked for directly.
struct LightAnimation {
    LightAnimationKind kind = LightAnimationKind::Orbit;
    double periodSeconds = 1.0;
    double phase = 0.0; ///< share of the period, 0..1
    glm::dvec3 centerWS{0.0};
    glm::dvec3 axisWS{0.0, 1.0, 0.0};
    glm::dvec3 amplitudeMetres{0.0};
    std::vector<double> timesSeconds;
    std::vector<glm::dvec3> pointsWS;
    bool operator==(const LightAnimation&) const = default;
};

struct Light {
    std::string name;
    LightType type = LightType::Point;
    bool enabled = true;
    glm::vec3 color{1.0f};  ///< linear RGB
    float intensity = 1.0f; ///< candela (point, spot) or lux (directional); a plain factor with Falloff::Attenuation
    glm::dvec3 positionWS{0.0};
    glm::dvec3 directionWS{0.0, 0.0, -1.0}; ///< unit, the way the light travels
    Falloff falloff = Falloff::InverseSquare;
    float rangeMetres = kInfinity;           ///< InverseSquare: the light is exactly 0 from here on
    glm::vec3 attenuation{1.0f, 0.0f, 0.0f}; ///< A, B (1/m), C (1/m^2) of Falloff::Attenuation, >= 0, not all 0
    float innerConeRadians = 0.0f;           ///< Spot: half angle of full intensity
    float outerConeRadians = 0.7853981634f;  ///< Spot: half angle beyond which there is no light
    std::optional<LightAnimation> animation;
    bool operator==(const Light&) const = default;
};

/// The light as it is at `timeSeconds`: its animation applied to its position.
Light lightAtTime(const Light& light, double timeSeconds);

// ---- Cameras, options, scene ---------------------------------------------------------------------------------------

enum class Projection : std::uint8_t { Perspective, Orthographic };

struct Camera {
    std::string name;
    Projection projection = Projection::Perspective;
    glm::dmat4 worldFromCamera{1.0}; ///< rigid; the camera looks along -Z, Y up
    double fovYRadians = 0.7853981633974483;
    double halfHeightMetres = 1.0;                              ///< Orthographic
    double nearMetres = 0.1;                                    ///< > 0 (Perspective), may be 0 (Orthographic)
    double farMetres = std::numeric_limits<double>::infinity(); ///< nothing beyond is drawn
    bool operator==(const Camera&) const = default;
};

/// The value that a scene asks for of a setting, as its file has it.
using Wish = std::variant<bool, double, std::string, std::vector<double>>;

/// What a scene asks for where the user does not say otherwise.
struct SceneOptions {
    std::optional<std::string> camera;
    std::optional<bool> defaultLight;                ///< false: where there is no light, none is supplied
    std::map<std::string, Wish, std::less<>> wishes; ///< by the settings' keys, which whoever draws the scene knows
    bool operator==(const SceneOptions&) const = default;
};

struct Scene {
    std::string name;
    std::vector<Image> images;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Node> nodes;
    std::vector<Light> lights; ///< in document order: glTF depth first, then those of the .json
    std::vector<Camera> cameras;
    glm::vec3 background{0.0f}; ///< radiance where nothing is drawn, linear
    SceneOptions options;
    bool hasDefaultLight = false;      ///< its only light is addDefaultLight()'s, which follows the view that is drawn
    std::vector<std::string> warnings; ///< what the importer left out, each naming the feature
};

/// The camera that a name chooses, else a number counted from 0: an included file may bring a camera of a name that is
/// there already. None where there is no such camera.
std::optional<std::size_t> cameraCalled(const Scene& scene, std::string_view nameOrNumber);

/// World-from-node of every node, in double precision.
std::vector<glm::dmat4> worldFromNodes(const Scene& scene);

/// World bounds of everything drawn; empty() when nothing is.
Box3 worldBounds(const Scene& scene);

/// Triangles drawn, instances counted each.
std::size_t triangleCount(const Scene& scene);

/// Throws InputError unless every index is in range, every attribute has its mesh's length and every number is finite
/// (a light's infinite range and a camera's infinite far plane excepted). The text names the scene and the element.
void checkScene(const Scene& scene);

} // namespace tessera::scenes
