#include "scenes/Exposure.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "base/Srgb.h"
#include "scenes/Illuminance.h"

namespace tessera::scenes {
namespace {

constexpr double kToleranceEV = 2.0;
constexpr double kMostStops = 120.0; ///< range of the option --exposure
constexpr double kBelow = 0.9;       ///< fraction of the visible area below an estimate
/// Work limit of an estimate: number of pairs of a surface sample and a light.
constexpr double kMostPairs = 5e5;

/// Approximate albedo of a dielectric's highlight, and of a sheen of colour 1.
constexpr double kOfHighlight = 0.04, kOfSheen = 0.3;

/// A channel of a texel, 0 to 1 for integer formats.
double channelOf(const Image& image, std::size_t at) {
    const auto read = [&]<typename T>(T) {
        T value;
        std::memcpy(&value, image.texels.data() + at * sizeof(T), sizeof(T));
        return value;
    };
    switch (image.format) {
    case TexelFormat::Rgba8Unorm:
        return double(read(std::uint8_t())) / 255.0;
    case TexelFormat::Rgba16Unorm:
        return double(read(std::uint16_t())) / 65535.0;
    case TexelFormat::Rgba32Float:
        break;
    }
    return double(read(float()));
}

/// Mean colour of a texture, from a few thousand of its texels.
glm::dvec3 meanColor(const Image& image, bool isSrgb) {
    constexpr std::size_t kMostTexels = 4096;
    const std::size_t count = std::size_t(image.width) * std::size_t(image.height);
    // An odd step, which does not stay in one column.
    const std::size_t step = count <= kMostTexels ? 1 : count / kMostTexels | 1;
    const bool isEncoded = isSrgb && image.format != TexelFormat::Rgba32Float;
    glm::dvec3 sum(0.0);
    double texels = 0.0;
    for (std::size_t texel = 0; texel < count; texel += step, texels += 1.0)
        for (int c = 0; c < 3; ++c) {
            const double value = channelOf(image, 4 * texel + std::size_t(c));
            sum[c] += isEncoded ? linearFromSrgb(value) : value;
        }
    return texels > 0.0 ? sum / texels : glm::dvec3(1.0);
}

/// The mean albedo and emitted luminance of a material.
struct Shown {
    double albedo = 0.0, emission = 0.0;
};

Shown shownOf(const Scene& scene, const Material& material, bool isMatte) {
    const auto mean = [&](TextureSlot slot) {
        const int image = material.texture(slot).image;
        return image == kNone ? glm::dvec3(1.0) : meanColor(scene.images[std::size_t(image)], infoOf(slot).isSrgb);
    };
    const MaterialModelInfo& model = infoOf(material.model);
    double color = luminanceOf(glm::dvec3(material.baseColor) * mean(TextureSlot::BaseColor));
    if (model.hasLayers && !isMatte) {
        const glm::dvec3 roughMetal = mean(TextureSlot::MetallicRoughness);
        const double metallic = double(material.metallic) * roughMetal.z;
        const double roughness = double(material.perceptualRoughness) * roughMetal.y;
        const double passes = double(material.transmission) * mean(TextureSlot::Transmission).x;
        color *= metallic * roughness * roughness + (1.0 - metallic) * (1.0 - passes);
    }
    Shown shown;
    shown.emission = luminanceOf(glm::dvec3(material.emissive) * mean(TextureSlot::Emissive));
    (model.isLit ? shown.albedo : shown.emission) += color;
    if (model.highlight != Highlight::None) shown.albedo += kOfHighlight;
    if (model.hasLayers) shown.albedo += kOfSheen * luminanceOf(material.sheenColor);
    return shown;
}

/// A camera's image: compares the image areas of small surfaces, in an arbitrary unit.
class Picture {
public:
    Picture(const Camera& camera, double aspect)
        : camera_(camera), cameraFromWorld_(glm::inverse(camera.worldFromCamera)), aspect_(aspect) {}

    /// `areaWS` is the surface's area times its unit normal. 0 outside the image or if seen from the back.
    double shareOf(const glm::dvec3& placeWS, const glm::dvec3& areaWS, bool isTwoSided) const {
        const glm::dvec3 place(cameraFromWorld_ * glm::dvec4(placeWS, 1.0));
        const bool isParallel = camera_.projection == Projection::Orthographic;
        const double ahead = -place.z,
                     half = isParallel ? camera_.halfHeightMetres : ahead * std::tan(0.5 * camera_.fovYRadians);
        if (!(ahead > camera_.nearMetres) || ahead > camera_.farMetres) return 0.0;
        if (std::abs(place.y) > half || std::abs(place.x) > half * aspect_) return 0.0;
        const glm::dvec3 toEyeWS =
            isParallel ? glm::dvec3(camera_.worldFromCamera[2]) : glm::dvec3(camera_.worldFromCamera[3]) - placeWS;
        const double square = glm::dot(toEyeWS, toEyeWS), facing = glm::dot(areaWS, toEyeWS) / std::sqrt(square);
        const double seen = isTwoSided ? std::abs(facing) : std::max(facing, 0.0);
        return isParallel ? seen : seen / square;
    }

private:
    const Camera& camera_;
    glm::dmat4 cameraFromWorld_;
    double aspect_;
};

double illuminanceOn(const std::vector<const Light*>& lights, const glm::dvec3& placeWS, const glm::dvec3& normalWS,
                     bool isTwoSided) {
    double sum = 0.0;
    for (const Light* const light : lights) {
        const glm::dvec3 wayWS = infoOf(light->type).hasPosition() ? light->positionWS - placeWS : -light->directionWS;
        const double length = glm::length(wayWS), facing = length > 0.0 ? glm::dot(normalWS, wayWS) / length : 1.0;
        const double cosine = isTwoSided ? std::abs(facing) : std::max(facing, 0.0);
        if (cosine > 0.0) sum += cosine * illuminanceAt(*light, placeWS);
    }
    return sum;
}

} // namespace

std::optional<double> estimatedLuminance(const Scene& scene, const Camera& camera, double aspect, bool areMatte) {
    std::vector<const Light*> lights;
    for (const Light& light : scene.lights)
        if (light.enabled) lights.push_back(&light);
    double triangles = 0.0;
    for (const Node& node : scene.nodes)
        for (const MeshInstance& instance : node.instances)
            triangles += double(scene.meshes[std::size_t(instance.mesh)].indices.size() / 3);
    // Samples of a triangle: its middle and three points halfway to its corners.
    constexpr int kPlaces = 4;
    const double pairs = kPlaces * triangles * double(std::max(lights.size(), std::size_t(1)));
    const auto step = std::size_t(std::max(std::ceil(pairs / kMostPairs), 1.0));

    std::vector<std::optional<Shown>> shown(scene.materials.size());
    const Picture picture(camera, aspect);
    const std::vector<glm::dmat4> worldFromNode = worldFromNodes(scene);
    std::vector<std::pair<double, double>> seen; // luminances and their image areas
    double shares = 0.0;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n)
        for (const MeshInstance& instance : scene.nodes[n].instances) {
            const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
            const Material& material = scene.materials[std::size_t(instance.material)];
            std::optional<Shown>& own = shown[std::size_t(instance.material)];
            if (!own) own = shownOf(scene, material, areMatte);
            for (std::size_t first = 0; first + 2 < mesh.indices.size(); first += 3 * step) {
                glm::dvec3 corners[3];
                for (std::size_t i = 0; i < 3; ++i)
                    corners[i] = glm::dvec3(worldFromNode[n] *
                                            glm::dvec4(glm::dvec3(mesh.positionsOS[mesh.indices[first + i]]), 1.0));
                const glm::dvec3 middleWS = (corners[0] + corners[1] + corners[2]) / 3.0;
                const glm::dvec3 areaWS = 0.5 * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
                const double area = glm::length(areaWS);
                if (!(area > 0.0) || !(area < std::numeric_limits<double>::infinity())) continue;
                for (int place = 0; place < kPlaces; ++place) {
                    const glm::dvec3 placeWS = place == 0 ? middleWS : 0.5 * (middleWS + corners[place - 1]);
                    const double share = picture.shareOf(placeWS, areaWS, material.doubleSided);
                    if (!(share > 0.0)) continue;
                    const double lux =
                        own->albedo > 0.0 ? illuminanceOn(lights, placeWS, areaWS / area, material.doubleSided) : 0.0;
                    seen.emplace_back(own->emission + own->albedo * lux / std::numbers::pi, share);
                    shares += share;
                }
            }
        }
    std::ranges::sort(seen);
    double below = 0.0;
    for (const auto& [luminance, share] : seen)
        if ((below += share) >= kBelow * shares) return luminance;
    return {};
}

int fittingExposureEV(double luminance) {
    if (!(luminance > 0.0) || !std::isfinite(luminance)) return 0;
    const double stops = std::log2(kBrightLuminance / luminance);
    return std::abs(stops) <= kToleranceEV ? 0 : int(std::lround(std::clamp(stops, -kMostStops, kMostStops)));
}

} // namespace tessera::scenes
