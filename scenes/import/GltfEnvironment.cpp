#include "scenes/import/GltfSteps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <type_traits>

#include <glm/gtc/quaternion.hpp>
#include <tbb/parallel_for.h>

#include "base/Srgb.h"
#include "scenes/RadianceMap.h"
#include "scenes/import/MadeImages.h"
#include "scenes/import/PictureCodecs.h"

namespace tessera::scenes::gltf {
namespace {

using std::numbers::pi;

/// Relative tolerance over all coefficients: far above 8-bit quantisation, below the effect of a wrong scale or axis.
constexpr double kMostDifference = 0.05;

/// A cube face seen from the centre: its axis, and the directions of its image's right and lower edges.
struct Face {
    glm::dvec3 ahead, right, down;
};
/// "Each saved image must be flipped about its vertical axis" against OpenGL's faces, which are seen from outside.
/// Source: EXT_lights_image_based, "Prefiltered Specular Radiance Cubemaps"; OpenGL 4.5, table 8.19.
constexpr std::array<Face, 6> kCube{{
    {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
    {{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
    {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
    {{0, -1, 0}, {-1, 0, 0}, {0, 0, -1}},
    {{0, 0, 1}, {-1, 0, 0}, {0, -1, 0}},
    {{0, 0, -1}, {1, 0, 0}, {0, -1, 0}},
}};

/// Direction of a position on a face, not normalised: 1 along the face's axis.
glm::dvec3 directionOn(const Face& face, double x, double y, int side) {
    return face.ahead + (2.0 * x / side - 1.0) * face.right + (2.0 * y / side - 1.0) * face.down;
}

/// A cube map of six square Rgba32Float faces, stacked vertically.
class Cube {
public:
    explicit Cube(const Image& faces) : faces_(faces) {}

    int side() const { return faces_.width; }

    /// Interpolates bilinearly between four texel centres, also across edges.
    glm::dvec3 radiance(const glm::dvec3& direction) const {
        const std::size_t face = faceOf(direction);
        const glm::dvec2 place = placeOn(kCube[face], direction) - 0.5, corner = glm::floor(place);
        const glm::dvec2 share = place - corner;
        const int x = int(corner.x), y = int(corner.y);
        return glm::mix(glm::mix(near(face, x, y), near(face, x + 1, y), share.x),
                        glm::mix(near(face, x, y + 1), near(face, x + 1, y + 1), share.x), share.y);
    }

    glm::dvec3 texel(std::size_t face, int x, int y) const {
        const std::size_t row = face * std::size_t(side()) + std::size_t(y);
        return glm::dvec3(texelsOf<glm::vec4>(faces_)[row * std::size_t(side()) + std::size_t(x)]);
    }

private:
    static std::size_t faceOf(const glm::dvec3& direction) {
        const auto along = [&](const Face& face) { return glm::dot(face.ahead, direction); };
        return std::size_t(std::ranges::max_element(kCube, {}, along) - kCube.begin());
    }

    glm::dvec2 placeOn(const Face& face, const glm::dvec3& direction) const {
        const glm::dvec2 across(glm::dot(face.right, direction), glm::dot(face.down, direction));
        return (across / glm::dot(face.ahead, direction) * 0.5 + 0.5) * double(side());
    }

    /// A texel of a face; beyond an edge the adjacent texel of another face.
    glm::dvec3 near(std::size_t face, int x, int y) const {
        if (x >= 0 && y >= 0 && x < side() && y < side()) return texel(face, x, y);
        const glm::dvec3 direction = directionOn(kCube[face], x + 0.5, y + 0.5, side());
        const std::size_t other = faceOf(direction);
        const glm::ivec2 place(glm::floor(placeOn(kCube[other], direction)));
        return texel(other, std::clamp(place.x, 0, side() - 1), std::clamp(place.y, 0, side() - 1));
    }

    const Image& faces_;
};

/// Decodes texels to linear radiance: integers are sRGB divided by alpha (RGBD; alpha is 1 if the image has none),
/// floating point is linear.
template <typename Channel>
class FaceLight {
public:
    explicit FaceLight(const Image& picture) : stored_(texelsOf<Channel>(picture)) {
        for (std::size_t code = 0; std::is_integral_v<Channel> && code <= std::size_t(kOneOf<Channel>); ++code)
            linear_.push_back(linearFromSrgb(double(code) / kOneOf<Channel>));
    }

    glm::vec4 texel(std::size_t at) const {
        const Channel* const codes = &stored_[4 * at];
        if constexpr (!std::is_integral_v<Channel>) {
            return {codes[0], codes[1], codes[2], codes[3]};
        } else {
            const double share = double(codes[3]) / kOneOf<Channel>;
            return {glm::vec3(glm::dvec3(linear_[codes[0]], linear_[codes[1]], linear_[codes[2]]) / share), 1.0f};
        }
    }

private:
    std::span<const Channel> stored_;
    std::vector<double> linear_; ///< by code
};

/// Copies an image into a face, stretched to the cube's side if it is smaller.
void put(const Image& picture, std::size_t face, Image& cube) {
    withChannel(picture.format, [&]<typename Channel>(Channel) {
        const FaceLight<Channel> light(picture);
        const auto side = std::size_t(cube.width), width = std::size_t(picture.width),
                   height = std::size_t(picture.height);
        for (std::size_t y = 0; y < side; ++y)
            for (std::size_t x = 0; x < side; ++x)
                texelsOf<glm::vec4>(cube)[(face * side + y) * side + x] =
                    light.texel(y * height / side * width + x * width / side);
    });
}

/// EXT_lights_image_based.
struct ImageLight {
    std::string name;
    float intensity = 1.0f;
    glm::dvec4 rotation;                ///< quaternion x, y, z, w, of any length except 0
    std::vector<glm::dvec3> irradiance; ///< nine spherical harmonics coefficients, up to order 2
    std::vector<int> images;            ///< faces +X, -X, +Y, -Y, +Z, -Z of the unfiltered level
    int sideTexels = 0;                 ///< of these faces
};

ImageLight readImageLight(const Document& document, int index) {
    const tiny::Value& stored =
        elementsOf(valueAt(document.model.extensions, "EXT_lights_image_based/lights"))[std::size_t(index)];
    const auto fail = [&](const char* key, const std::string& what) {
        document.fail(fmt::format("/extensions/EXT_lights_image_based/lights/{}/{}", index, key), what);
    };
    ImageLight light;
    light.name = nameOr(stringOf(valueAt(&stored, "name")), "image-based light", index);
    light.intensity = float(numberOf(valueAt(&stored, "intensity"), 1.0));
    light.rotation = vectorOf(numbersOf(valueAt(&stored, "rotation")), glm::dvec4(0.0, 0.0, 0.0, 1.0));
    light.sideTexels = integerOf(valueAt(&stored, "specularImageSize"));
    if (glm::dot(light.rotation, light.rotation) == 0.0)
        fail("rotation", "is the zero quaternion, which is no rotation");
    for (const tiny::Value& color : elementsOf(valueAt(&stored, "irradianceCoefficients")))
        light.irradiance.push_back(vectorOf(numbersOf(&color), glm::dvec3(0.0)));
    constexpr std::size_t kCoefficients = 9;
    if (light.irradiance.size() != kCoefficients)
        fail("irradianceCoefficients",
             fmt::format("must hold {} colours, but holds {}", kCoefficients, light.irradiance.size()));
    const auto levels = elementsOf(valueAt(&stored, "specularImages"));
    if (levels.empty()) fail("specularImages", "is empty; the six faces of a cube are needed");
    for (const tiny::Value& level : levels)
        if (level.ArrayLen() != kCube.size())
            fail("specularImages", fmt::format("must hold {} faces of a cube in each element, but one holds {}",
                                               kCube.size(), level.ArrayLen()));
    for (const tiny::Value& face : elementsOf(&levels[0])) light.images.push_back(integerOf(&face));
    return light;
}

/// Reads a light's first level at the size of its largest face, since specularImageSize may be wrong.
Image readCube(Context& context, const ImageLight& light) {
    const Document& document = context.document;
    const std::string& name = light.name;
    constexpr const char* kInstead = "; its side of the environment is a checkerboard";
    const std::uint64_t mark = document.ledger.usedBytes() - context.buffers.heldBytes();
    const std::string who = document.file + ": the environment '" + name + "'";
    std::array<Image, kCube.size()> pictures;
    int side = 1;
    for (std::size_t face = 0; face < kCube.size(); ++face) {
        const int image = light.images[face];
        std::optional<Image> picture = readableImage(context, image, kInstead);
        // A single row of texels would allocate six squares of its length.
        if (picture && picture->width != picture->height) {
            context.repair(fmt::format("/images/{}", image), kInstead,
                           "has {}x{} texels, and is a face of an environment, which is square", picture->width,
                           picture->height);
            picture.reset();
        }
        if (picture && (picture->width != light.sideTexels || picture->height != light.sideTexels))
            context.warn("the environment '{}' has faces of other sizes than {}x{} texels, its "
                         "specularImageSize; all are stretched to the largest",
                         name, light.sideTexels, light.sideTexels);
        if (!picture) picture = standInPicture(document.ledger, who);
        side = std::max({side, picture->width, picture->height});
        pictures[face] = std::move(*picture);
    }
    Image cube;
    cube.name = name;
    cube.format = TexelFormat::Rgba32Float;
    cube.width = side;
    cube.height = int(kCube.size()) * side;
    const std::uint64_t bytes = std::uint64_t(cube.width) * std::uint64_t(cube.height) * sizeof(glm::vec4);
    document.ledger.charge(bytes, [&] { return who; });
    cube.texels.resize(bytes);
    for (std::size_t face = 0; face < kCube.size(); ++face) put(pictures[face], face, cube);
    document.ledger.settle(mark, bytes + context.buffers.heldBytes());
    return cube;
}

/// Real spherical harmonics up to order 2 of a unit direction. Source: Ramamoorthi and Hanrahan 2001, "An Efficient
/// Representation for Irradiance Environment Maps".
std::array<double, 9> harmonics(const glm::dvec3& n) {
    return {0.282095,
            0.488603 * n.y,
            0.488603 * n.z,
            0.488603 * n.x,
            1.092548 * n.x * n.y,
            1.092548 * n.y * n.z,
            0.315392 * (3.0 * n.z * n.z - 1.0),
            1.092548 * n.x * n.z,
            0.546274 * (n.x * n.x - n.y * n.y)};
}

std::array<glm::dvec3, 9> irradianceOf(const Cube& cube) {
    constexpr std::array<double, 9> kCosine{pi,       2 * pi / 3, 2 * pi / 3, 2 * pi / 3, pi / 4,
                                            pi / 4.0, pi / 4,     pi / 4,     pi / 4}; // transfer of a clamped cosine
    std::array<glm::dvec3, 9> sum{};
    double weights = 0.0;
    for (std::size_t face = 0; face < kCube.size(); ++face)
        for (int y = 0; y < cube.side(); ++y)
            for (int x = 0; x < cube.side(); ++x) {
                const glm::dvec3 direction = directionOn(kCube[face], x + 0.5, y + 0.5, cube.side());
                const double length = glm::length(direction), weight = 1.0 / (length * length * length);
                const std::array<double, 9> basis = harmonics(direction / length);
                weights += weight;
                for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += weight * basis[i] * cube.texel(face, x, y);
            }
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] *= kCosine[i] * 4.0 * pi / weights;
    return sum;
}

void noteIrradiance(Context& context, const ImageLight& light, const Cube& cube) {
    const std::array<glm::dvec3, 9> own = irradianceOf(cube);
    double difference = 0.0, whole = 0.0;
    for (std::size_t i = 0; i < own.size(); ++i) {
        const glm::dvec3 apart = light.irradiance[i] - own[i];
        difference += glm::dot(apart, apart);
        whole += glm::dot(own[i], own[i]);
    }
    if (!(difference > kMostDifference * kMostDifference * whole)) return;
    context.scene.notes.push_back(fmt::format(
        "{}: the irradianceCoefficients of the environment '{}' differ from the irradiance of its faces by {:.0f} % "
        "of that, and the faces count",
        context.document.file, light.name, whole > 0.0 ? 100.0 * std::sqrt(difference / whole) : 100.0));
}

/// Resamples a cube in latitude and longitude; each texel is the mean over its solid angle.
Image resampled(const Cube& cube, const glm::dmat3& cubeFromWorld, const std::string& name, int width) {
    // Samples per axis: no farther apart than texels in the corners of a cube, which are smallest.
    const int places = std::max(4, 2 * ((4 * cube.side() + width - 1) / width));
    Image map;
    map.name = name;
    map.format = TexelFormat::Rgba32Float;
    map.width = width;
    map.height = width / 2;
    map.texels.resize(std::size_t(map.width) * std::size_t(map.height) * sizeof(glm::vec4));
    tbb::parallel_for(0, map.height, [&](int y) {
        for (int x = 0; x < map.width; ++x) {
            glm::dvec3 sum(0.0);
            double weights = 0.0;
            for (int j = 0; j < places; ++j) {
                const double down = (y + (j + 0.5) / places) / map.height, weight = std::sin(pi * down);
                for (int i = 0; i < places; ++i) {
                    const double right = (x + (i + 0.5) / places) / map.width;
                    sum += weight * cube.radiance(cubeFromWorld * directionInMap({right, down}));
                    weights += weight;
                }
            }
            texelsOf<glm::vec4>(map)[std::size_t(y) * std::size_t(map.width) + std::size_t(x)] =
                glm::vec4(glm::vec3(sum / weights), 1.0f);
        }
    });
    return map;
}

} // namespace

void importEnvironment(Context& context) {
    const tiny::Scene* const scene = context.document.scene();
    if (scene == nullptr) return;
    const int index = integerOf(valueAt(scene->extensions, "EXT_lights_image_based/light"));
    if (index == kNone) return;
    const ImageLight light = readImageLight(context.document, index);
    const std::string& name = light.name;
    Image faces = readCube(context, light);
    std::vector<std::string> replaced;
    warnOfReplaced(fmt::format("the environment '{}'", faces.name), replaceNoLight(faces), replaced);
    for (const std::string& warning : replaced) context.warn(warning);
    const Cube cube(faces);
    noteIrradiance(context, light, cube);
    const int whole = 4 * cube.side(), width = std::min(whole, kMostMapWidth);
    if (width < whole) context.warn(averagedText(name, whole, whole / 2, width, width / 2));
    context.document.ledger.charge(std::uint64_t(width) * std::uint64_t(width / 2) * sizeof(glm::vec4),
                                   [&] { return context.document.file + ": the environment '" + name + "'"; });
    const glm::dvec4 turn = glm::normalize(light.rotation);
    const glm::dmat3 worldFromCube = glm::mat3_cast(glm::dquat(turn.w, turn.x, turn.y, turn.z));
    Environment environment;
    environment.source = std::filesystem::absolute(context.document.file).lexically_normal().string();
    environment.map = resampled(cube, glm::transpose(worldFromCube), name, width);
    environment.intensity = light.intensity;
    context.scene.environment = std::move(environment);
}

} // namespace tessera::scenes::gltf
