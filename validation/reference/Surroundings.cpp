#include "validation/reference/Surroundings.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "scenes/InUse.h"
#include "validation/reference/Lobes.h"
#include "validation/reference/Microfacet.h"
#include "validation/reference/Reflectance.h"

namespace tessera::reference {

namespace {

using std::numbers::pi;
constexpr int kIrradianceRows = 60, kIrradianceColumns = 120;

} // namespace

Surroundings::Surroundings(const scenes::Scene& scene, const Settings& settings) : paths_(settings.environmentPaths) {
    if (!scene.environment) return;
    map_ = &scene.environment->map;
    intensity_ = double(scene.environment->intensity) * settings.environmentIntensity;
    turnRadians_ = glm::radians(double(scene.environment->rotationDegrees) + settings.environmentRotationDegrees);
    isSeen_ = settings.environmentIsSeen;
    compensates_ = settings.environmentCompensates;
    showsThroughBodies_ = lights_ = settings.environmentLights && !settings.soloLight && intensity_ > 0.0;
    if (!lights_) return;
    makeDensities();
    if (scenes::anyDiffuses(scene, settings.subsurface)) makeIrradiances();
}

glm::dvec3 Surroundings::texel(int column, int row) const {
    column = (column + map_->width) % map_->width;
    row = std::clamp(row, 0, map_->height - 1);
    glm::vec4 stored;
    const std::size_t at = std::size_t(row) * std::size_t(map_->width) + std::size_t(column);
    std::memcpy(&stored, map_->texels.data() + at * sizeof(stored), sizeof(stored));
    return glm::dvec3(glm::vec3(stored));
}

glm::dvec2 Surroundings::placeOf(const glm::dvec3& direction) const {
    // Azimuths grow to the right of -Z; the map is rotated the other way round.
    const double azimuth = std::atan2(direction.x, -direction.z) + turnRadians_;
    const double turns = azimuth / (2.0 * pi) + 0.5;
    const double elevation = std::asin(std::clamp(direction.y, -1.0, 1.0));
    return {(turns - std::floor(turns)) * map_->width, (0.5 - elevation / pi) * map_->height};
}

glm::dvec3 Surroundings::radianceOf(const glm::dvec3& direction) const {
    const glm::dvec2 place = placeOf(direction);
    glm::dvec3 sum(0.0);
    const int column = int(std::floor(place.x - 0.5)), row = int(std::floor(place.y - 0.5));
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const double away = std::abs(place.x - (column + i + 0.5)), below = std::abs(place.y - (row + j + 0.5));
            sum += (1.0 - away) * (1.0 - below) * texel(column + i, row + j);
        }
    return intensity_ * sum;
}

void Surroundings::makeDensities() {
    const std::size_t width = std::size_t(map_->width), height = std::size_t(map_->height);
    densities_.resize(width * height);
    columnsSummed_.resize(width * height);
    rowsSummed_.resize(height);
    double all = 0.0;
    for (std::size_t row = 0; row < height; ++row) {
        const double top = 0.5 * pi - pi * double(row) / double(height);
        const double solidAngle = 2.0 * pi / double(width) * (std::sin(top) - std::sin(top - pi / double(height)));
        double ofRow = 0.0;
        for (std::size_t column = 0; column < width; ++column) {
            // The brightest texel around it: interpolation spreads light to dark neighbours.
            double brightest = 0.0;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) {
                    const glm::dvec3 color = texel(int(column) + i, int(row) + j);
                    brightest = std::max(brightest, std::max({color.r, color.g, color.b}));
                }
            densities_[row * width + column] = brightest;
            columnsSummed_[row * width + column] = ofRow += brightest * solidAngle;
        }
        rowsSummed_[row] = all += ofRow;
        if (ofRow > 0.0)
            for (std::size_t column = 0; column < width; ++column) columnsSummed_[row * width + column] /= ofRow;
    }
    if (!(all > 0.0)) {
        lights_ = false;
        return;
    }
    for (double& density : densities_) density /= all;
    for (double& row : rowsSummed_) row /= all;
}

glm::dvec3 Surroundings::ofMap(const glm::dvec2& random) const {
    const auto choose = [](const double* begin, const double* end, double& u) {
        const double* const found = std::min(std::upper_bound(begin, end, u), end - 1);
        const double before = found == begin ? 0.0 : found[-1];
        u = std::clamp((u - before) / std::max(*found - before, 1e-300), 0.0, 1.0);
        return found - begin;
    };
    double v = random.y, u = random.x;
    const auto row = choose(rowsSummed_.data(), rowsSummed_.data() + rowsSummed_.size(), v);
    const double* const columns = columnsSummed_.data() + row * map_->width;
    const auto column = choose(columns, columns + map_->width, u);
    const double top = 0.5 * pi - pi * double(row) / map_->height;
    const double sine = std::lerp(std::sin(top), std::sin(top - pi / map_->height), v);
    const double azimuth = 2.0 * pi * ((double(column) + u) / map_->width - 0.5) - turnRadians_;
    const double level = std::sqrt(std::max(1.0 - sine * sine, 0.0));
    return {level * std::sin(azimuth), sine, -level * std::cos(azimuth)};
}

double Surroundings::mapDensity(const glm::dvec3& direction) const {
    const glm::dvec2 place = placeOf(direction);
    const int column = std::clamp(int(place.x), 0, map_->width - 1),
              row = std::clamp(int(place.y), 0, map_->height - 1);
    return densities_[std::size_t(row) * std::size_t(map_->width) + std::size_t(column)];
}

namespace {

/// Energy compensation: the BRDF of light that a rough lobe scatters more than once, equal in all directions.
/// Integrates the lobe itself, once as it is and once of a metal that absorbs nothing.
glm::dvec3 bouncesOf(const SurfacePoint& point, const glm::dvec3& toViewer) {
    if (scenes::infoOf(point.model).microsurface != scenes::Microsurface::MetallicRoughness || !point.reflectsLobe ||
        !(glm::dot(point.normal, toViewer) > 0.0))
        return glm::dvec3(0.0);
    if (point.tangent != glm::dvec3(0.0) && point.alpha != point.alphaAcross) return glm::dvec3(0.0); // by definition
    SurfacePoint bare = point, white;
    bare.coat = 0.0;
    bare.sheenColor = glm::dvec3(0.0);
    white = bare;
    white.color = glm::dvec3(1.0);
    white.metallic = 1.0;
    white.film = 0.0;
    const ByMicrofacets lobe(glm::dvec2(point.alpha, point.alphaAcross), point.normal, point.tangent, toViewer);
    constexpr int kSide = 48;
    glm::dvec3 once(0.0), whole(0.0);
    for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) {
            const glm::dvec3 direction = lobe.direction({(i + 0.5) / kSide, (j + 0.5) / kSide});
            const double density = lobe.density(direction) * kSide * kSide;
            if (!(density > 0.0)) continue;
            once +=
                (reflected(bare, direction, toViewer, true) - reflected(bare, direction, toViewer, false)) / density;
            whole += reflected(white, direction, toViewer, true) / density;
        }
    const ReflectanceRange range = reflectanceRange(point, glm::dot(point.normal, toViewer));
    const double lost = std::max(1.0 - whole.r, 0.0);
    glm::dvec3 bounces(0.0);
    for (int c = 0; c < 3; ++c) {
        const double straight = range.straight[c];
        const double mean =
            std::min(straight + (range.grazing - straight) / 21.0, 1.0); // cosine-weighted mean of Schlick's factor
        bounces[c] = once[c] * mean * lost / (1.0 - mean * lost) / pi;
    }
    const double sheen = std::max({point.sheenColor.x, point.sheenColor.y, point.sheenColor.z});
    const double cosView = glm::dot(point.normal, toViewer);
    bounces *= std::max(1.0 - sheen * (sheen > 0.0 ? sheenAlbedo(point.sheenAlpha, cosView) : 0.0), 0.0);
    if (point.coat > 0.0)
        bounces *= 1.0 - point.coat * fresnelSchlick(0.04, 1.0, std::abs(glm::dot(point.coatNormal, toViewer)));
    return bounces;
}

} // namespace

class Surroundings::ByMap : public Strategy {
public:
    explicit ByMap(const Surroundings& of) : of_(of) {}
    glm::dvec3 direction(const glm::dvec2& random) const override { return of_.ofMap(random); }
    double density(const glm::dvec3& direction) const override { return of_.mapDensity(direction); }

private:
    const Surroundings& of_;
};

Estimate Surroundings::on(const SurfacePoint& point, const glm::dvec3& toViewer, bool specular, bool onlyLobes,
                          std::uint32_t seed, int paths) const {
    const ByMap map(*this);
    const SurfacePoint rest = withoutMirrors(point);
    const std::vector<std::unique_ptr<Strategy>> ofSurface = strategiesOf(rest, toViewer, specular);
    std::vector<const Strategy*> strategies{&map};
    for (const auto& strategy : ofSurface) strategies.push_back(strategy.get());
    const glm::dvec3 bounces = compensates_ && specular ? bouncesOf(rest, toViewer) : glm::dvec3(0.0);
    Estimate all = sampled(strategies, paths, seed, [&](const glm::dvec3& direction) {
        glm::dvec3 share = reflected(rest, direction, toViewer, specular);
        if (onlyLobes) share -= reflected(rest, direction, toViewer, false);
        share += bounces * std::max(glm::dot(point.normal, direction), 0.0);
        return share == glm::dvec3(0.0) ? share : share * radianceOf(direction);
    });
    if (specular)
        for (const Mirror& mirror : mirrorsOf(point, toViewer))
            all.light += mirror.share * radianceOf(mirror.direction);
    return all.times(point.openness);
}

glm::dvec3 Surroundings::through(std::span<const Scatter> ways, std::uint32_t seed, const IsHidden& isHidden) const {
    const ByMap map(*this);
    const int paths = std::max(paths_ / int(ways.size()), 8);
    glm::dvec3 light(0.0);
    double whole = 0.0;
    for (std::size_t i = 0; i < ways.size(); ++i) {
        const Scatter& way = ways[i];
        if (!way.facets) {
            whole += way.weight;
            if (!isHidden(way.originRWS, way.direction)) light += way.weight * radianceOf(way.direction);
            continue;
        }
        const double all = way.facets->whole();
        if (!(all > 0.0)) continue;
        whole += way.weight * all;
        if (!lights_) continue;
        const Strategy* const strategies[] = {&map, &*way.facets};
        const Estimate found = sampled(strategies, paths, seed + std::uint32_t(i), [&](const glm::dvec3& from) {
            const double share = way.facets->share(from);
            return share > 0.0 && !isHidden(way.originRWS, from) ? share * radianceOf(from) : glm::dvec3(0.0);
        });
        light += way.weight * found.light;
    }
    return whole > 0.0 ? light / whole : glm::dvec3(0.0);
}

void Surroundings::makeIrradiances() {
    // Each block of the map counts as one directional light: blocks are far finer than irradiance changes.
    constexpr int kBlocksAcross = 256;
    const int step = std::max(1, map_->width / kBlocksAcross);
    struct Part {
        glm::dvec3 direction, light;
    };
    std::vector<Part> parts;
    for (int row = 0; row < map_->height; row += step)
        for (int column = 0; column < map_->width; column += step) {
            Part part{glm::dvec3(0.0), glm::dvec3(0.0)};
            for (int j = row; j < std::min(row + step, map_->height); ++j) {
                const double top = 0.5 * pi - pi * j / map_->height, bottom = top - pi / map_->height;
                const double solidAngle = 2.0 * pi / map_->width * (std::sin(top) - std::sin(bottom));
                for (int i = column; i < std::min(column + step, map_->width); ++i) {
                    const glm::dvec3 light = intensity_ * solidAngle * texel(i, j);
                    const double azimuth = 2.0 * pi * ((i + 0.5) / map_->width - 0.5) - turnRadians_;
                    const double sine = std::sin(0.5 * (top + bottom)), level = std::cos(0.5 * (top + bottom));
                    part.light += light;
                    // Weighted by brightness; black texels count a little, so that there is a direction.
                    part.direction += (light.r + light.g + light.b + 1e-30) *
                                      glm::dvec3(level * std::sin(azimuth), sine, -level * std::cos(azimuth));
                }
            }
            if (part.light == glm::dvec3(0.0)) continue;
            part.direction = glm::normalize(part.direction);
            parts.push_back(part);
        }
    for (int row = 0; row <= kIrradianceRows; ++row)
        for (int column = 0; column < kIrradianceColumns; ++column) {
            const double polar = pi * row / kIrradianceRows, azimuth = 2.0 * pi * column / kIrradianceColumns;
            const glm::dvec3 normal(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                                    std::sin(polar) * std::sin(azimuth));
            glm::dvec3 sum(0.0);
            for (const Part& part : parts) sum += std::max(glm::dot(normal, part.direction), 0.0) * part.light;
            irradiances_.push_back(sum);
        }
}

glm::dvec3 Surroundings::irradiance(const glm::dvec3& normal) const {
    const double down = std::acos(std::clamp(normal.y, -1.0, 1.0)) / pi * kIrradianceRows;
    const double turns = std::atan2(normal.z, normal.x) / (2.0 * pi);
    const double along = (turns - std::floor(turns)) * kIrradianceColumns;
    const int row = std::min(int(down), kIrradianceRows - 1), column = int(along) % kIrradianceColumns;
    const auto at = [&](int j, int i) {
        return irradiances_[std::size_t(row + j) * kIrradianceColumns + std::size_t((column + i) % kIrradianceColumns)];
    };
    const double below = down - row, right = along - std::floor(along);
    return glm::mix(glm::mix(at(0, 0), at(0, 1), right), glm::mix(at(1, 0), at(1, 1), right), below);
}

} // namespace tessera::reference
