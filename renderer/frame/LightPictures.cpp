#include "renderer/frame/LightPictures.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/AreaLight.h"
#include "shaders/shared/light_pictures.h"

namespace tessera::frame {

namespace {

constexpr double kCutDeviations = 3.0;
/// Texels per standard deviation of a level's Gaussian, so that interpolation between texels loses little.
constexpr double kTexelsADeviation = 2.0;
/// Least texels per side: positions beyond the outermost texel centres are clamped to them.
constexpr int kLeastTexels = 16;
/// Shaders compute texel indices in floats.
constexpr std::size_t kMostPictureTexels = std::size_t(1) << 24;

/// Texels weighted by coverage: rgb times the fraction of the texel within the outline, and that fraction.
struct Masked {
    int width = 0, height = 0;
    std::vector<glm::dvec4> texels;
    const glm::dvec4& at(int x, int y) const { return texels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

static_assert(scenes::kFlatTypeCount == 3, "a new shape needs a case in isWithinOutline()");

/// `place` is a position in the image, x and y in -1..1, y upwards; corners use the same units.
bool isWithinOutline(const ShownPicture& shown, const std::vector<glm::dvec2>& corners, const glm::dvec2& place) {
    if (shown.type == scenes::LightType::Rectangle) return true;
    if (shown.type == scenes::LightType::Disk) return glm::dot(place, place) <= 1.0;
    bool isWithin = false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        if ((a.y > place.y) != (b.y > place.y) && place.x < a.x + (b.x - a.x) * (place.y - a.y) / (b.y - a.y))
            isWithin = !isWithin;
    }
    return isWithin;
}

std::vector<glm::dvec2> cornersInPicture(const ShownPicture& shown) {
    std::vector<glm::dvec2> corners(shown.corners.all().begin(), shown.corners.all().end());
    double reach = 1e-18;
    for (const glm::dvec2& corner : corners) reach = std::max(reach, glm::length(corner));
    for (glm::dvec2& corner : corners) corner /= reach;
    return corners;
}

/// Variances of the positions within the outline, in its units.
glm::dvec2 variancesOf(const ShownPicture& shown) {
    if (shown.type == scenes::LightType::Rectangle) return glm::dvec2(1.0 / 3.0);
    if (shown.type == scenes::LightType::Disk) return glm::dvec2(0.25);
    // Sums over signed triangles from the origin.
    const std::vector<glm::dvec2> corners = cornersInPicture(shown);
    double all = 0.0;
    glm::dvec2 sum(0.0), squares(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        const double twice = a.x * b.y - a.y * b.x;
        all += twice;
        sum += twice * (a + b) / 3.0;
        squares += twice * (a * a + a * b + b * b) / 6.0;
    }
    return all == 0.0 ? glm::dvec2(0.0) : squares / all - sum * sum / (all * all);
}

Masked maskedTexels(const ShownPicture& shown) {
    const scenes::Image& map = shown.texture->map;
    const std::vector<glm::dvec2> corners = cornersInPicture(shown);
    Masked masked{map.width, map.height, {}};
    masked.texels.reserve(std::size_t(map.width) * std::size_t(map.height));
    double all = 0.0;
    constexpr int kSteps = 4; // samples per side of a texel
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            int within = 0;
            for (int i = 0; i < kSteps * kSteps; ++i) {
                const glm::dvec2 share =
                    (glm::dvec2(x, y) + (glm::dvec2(i % kSteps, i / kSteps) + 0.5) / double(kSteps)) /
                    glm::dvec2(map.width, map.height);
                if (isWithinOutline(shown, corners, {2.0 * share.x - 1.0, 1.0 - 2.0 * share.y})) ++within;
            }
            const double weight = double(within) / double(kSteps * kSteps);
            all += weight;
            glm::vec4 texel;
            const std::size_t at = std::size_t(y) * std::size_t(map.width) + std::size_t(x);
            std::memcpy(&texel, map.texels.data() + at * sizeof texel, sizeof texel);
            masked.texels.emplace_back(weight * glm::dvec3(texel), weight);
        }
    if (all > 0.0) return masked;
    // The outline is too thin for any sample: the whole image counts.
    for (std::size_t at = 0; at < masked.texels.size(); ++at) {
        glm::vec4 texel;
        std::memcpy(&texel, map.texels.data() + at * sizeof texel, sizeof texel);
        masked.texels[at] = glm::dvec4(glm::dvec3(texel), 1.0);
    }
    return masked;
}

/// Weights of a row's texels, from `first` on: a truncated Gaussian.
struct RowWeights {
    int first = 0;
    std::vector<double> weights;
    double mean = 0.0; ///< weighted mean position, as a fraction of the row
};

/// Weights of a Gaussian around `middle`, which may lie outside the row. `shares` are the weights of the row's texels.
RowWeights weightsAround(double middle, double deviation, const std::vector<double>& shares) {
    const auto count = double(shares.size());
    // Truncates relative to the row's texel nearest to `middle`, whose weight is 1.
    const double nearest = std::clamp(middle, 0.5 / count, 1.0 - 0.5 / count) - middle;
    const double reach = std::hypot(nearest, kCutDeviations * deviation);
    const auto texelAt = [&](double place) { return int(std::clamp(std::floor(place * count), 0.0, count - 1.0)); };
    RowWeights row;
    row.first = texelAt(middle - reach);
    double sum = 0.0, moment = 0.0;
    for (int x = row.first; x <= texelAt(middle + reach); ++x) {
        const double away = (x + 0.5) / count - middle;
        const double weight = std::exp(0.5 * (nearest * nearest - away * away) / (deviation * deviation));
        row.weights.push_back(weight);
        sum += shares[std::size_t(x)] * weight;
        moment += shares[std::size_t(x)] * weight * (x + 0.5) / count;
    }
    row.mean = sum > 0.0 ? moment / sum : middle;
    return row;
}

/// Weights of the Gaussian shifted until its truncated mean lies at `mean`, or as near as possible.
RowWeights weightsOfMean(double mean, double deviation, const std::vector<double>& shares) {
    RowWeights row = weightsAround(mean, deviation, shares);
    constexpr double kNear = 1e-9;
    if (std::abs(row.mean - mean) < kNear) return row;
    constexpr int kHalvings = 40;
    const double farthest = 1.0 + 60.0 * deviation * deviation;
    double least = mean - farthest, most = mean + farthest;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (least + most);
        row = weightsAround(middle, deviation, shares);
        (row.mean < mean ? least : most) = middle;
    }
    return row;
}

/// Coverage by the outline, summed per column and per row.
struct Shares {
    std::vector<double> ofColumns, ofRows;
};
Shares sharesOf(const Masked& masked) {
    Shares shares{std::vector<double>(std::size_t(masked.width)), std::vector<double>(std::size_t(masked.height))};
    for (int y = 0; y < masked.height; ++y)
        for (int x = 0; x < masked.width; ++x) {
            shares.ofColumns[std::size_t(x)] += masked.at(x, y).w;
            shares.ofRows[std::size_t(y)] += masked.at(x, y).w;
        }
    return shares;
}

/// Filters rows to `count` texels and transposes the result; applied twice, it filters both axes.
Masked filteredAndTurned(const Masked& from, int count, double deviation, const std::vector<double>& shares) {
    Masked to{from.height, count, std::vector<glm::dvec4>(std::size_t(from.height) * std::size_t(count))};
    for (int i = 0; i < count; ++i) {
        const RowWeights row = weightsOfMean((i + 0.5) / double(count), deviation, shares);
        for (int y = 0; y < from.height; ++y) {
            glm::dvec4 sum(0.0);
            for (std::size_t x = 0; x < row.weights.size(); ++x) sum += row.weights[x] * from.at(row.first + int(x), y);
            to.texels[std::size_t(i) * std::size_t(to.width) + std::size_t(y)] = sum;
        }
    }
    return to;
}

glm::vec3 unmasked(const glm::dvec4& texel, const glm::vec3& otherwise) {
    return texel.w > 1e-12 ? glm::vec3(glm::dvec3(texel) / texel.w) : otherwise;
}

void addPicture(const ShownPicture& shown, std::size_t number, std::vector<glm::vec4>& texels) {
    const scenes::Image& map = shown.texture->map;
    const Masked masked = maskedTexels(shown);
    glm::dvec4 sum(0.0);
    for (const glm::dvec4& texel : masked.texels) sum += texel;
    const glm::vec3 mean = unmasked(sum, glm::vec3(0.0f));
    const std::vector<PictureLevel> levels = pictureLevels(map.width, map.height);
    const Shares shares = sharesOf(masked);
    const std::size_t header = number * LIGHT_PICTURE_HEADER_TEXELS;
    texels[header] = glm::vec4(mean, float(std::max(map.width, map.height)));
    texels[header + LIGHT_PICTURE_VARIANCES] = glm::vec4(glm::vec2(variancesOf(shown)), 0.0f, 0.0f);
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const PictureLevel& level = levels[i];
        texels[header + LIGHT_PICTURE_FIRST_LEVEL + i] =
            glm::vec4(float(texels.size()), float(level.width), float(level.height), float(levels.size()));
        if (i == 0) {
            const std::size_t begin = texels.size();
            texels.resize(begin + masked.texels.size());
            std::memcpy(texels.data() + begin, map.texels.data(), map.texels.size());
            continue;
        }
        const Masked filtered =
            filteredAndTurned(filteredAndTurned(masked, level.width, level.deviation, shares.ofColumns), level.height,
                              level.deviation, shares.ofRows);
        for (const glm::dvec4& texel : filtered.texels) texels.emplace_back(unmasked(texel, mean), 1.0f);
    }
}

} // namespace

LightPictures lightPictures(const scenes::Scene& scene) {
    LightPictures pictures;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const scenes::Light& light = scene.lights[i];
        if (!light.texture || !scenes::infoOf(light.type).isFlat) continue;
        ShownPicture shown{light.texture, light.type, {}};
        if (scenes::infoOf(light.type).hasCorners()) shown.corners = light.corners;
        if (pictures.ofLight.empty()) pictures.ofLight.assign(scene.lights.size(), -1);
        const auto known = std::ranges::find(pictures.shown, shown);
        pictures.ofLight[i] = int(known - pictures.shown.begin());
        if (known == pictures.shown.end()) pictures.shown.push_back(std::move(shown));
    }
    return pictures;
}

float packSides(bool isTwoSided, int picture) {
    return float((isTwoSided ? 1 : 0) + 2 * (picture + 1));
}

std::vector<PictureLevel> pictureLevels(int width, int height) {
    const double longest = std::max(width, height);
    std::vector<PictureLevel> levels{{width, height, 0.0}};
    for (double deviation = 1.0 / longest; levels.size() < LIGHT_PICTURE_MOST_LEVELS; deviation *= 2.0) {
        const auto texels = [&](int most) {
            return std::max(kLeastTexels, std::min(most, int(std::ceil(kTexelsADeviation / deviation))));
        };
        levels.push_back({texels(width), texels(height), deviation});
        if (deviation >= 1.0) break;
    }
    return levels;
}

std::size_t lightPictureBytes(std::span<const ShownPicture> shown) {
    std::size_t texels = shown.size() * LIGHT_PICTURE_HEADER_TEXELS;
    for (const ShownPicture& picture : shown)
        for (const PictureLevel& level : pictureLevels(picture.texture->map.width, picture.texture->map.height))
            texels += std::size_t(level.width) * std::size_t(level.height);
    if (texels > kMostPictureTexels)
        throw InputError(fmt::format("the textures of lights have {} texels with their filtered levels, and {} can be "
                                     "read; give smaller ones",
                                     texels, kMostPictureTexels));
    return texels * sizeof(glm::vec4);
}

std::vector<glm::vec4> prefilteredPictures(std::span<const ShownPicture> shown) {
    std::vector<glm::vec4> texels;
    texels.reserve(lightPictureBytes(shown) / sizeof(glm::vec4));
    texels.resize(shown.size() * LIGHT_PICTURE_HEADER_TEXELS);
    for (std::size_t i = 0; i < shown.size(); ++i) addPicture(shown[i], i, texels);
    return texels;
}

const gpu::Buffer& LightPicturesGpu::texels(const std::vector<ShownPicture>& shown) {
    if (texels_ && shown == shown_) return *texels_;
    texels_ = std::make_unique<gpu::Buffer>(gpu::Buffer::of("light_pictures", prefilteredPictures(shown)));
    shown_ = shown;
    return *texels_;
}

} // namespace tessera::frame
