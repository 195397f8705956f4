#include "validation/reference/AreaLights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <functional>

#include "validation/reference/LightSurface.h"
#include "validation/reference/Reflectance.h"
#include "validation/reference/SeenArea.h"

namespace tessera::reference {

namespace {

/// Largest rotation of a lobe within a square, in radians.
constexpr double kTurnRadians = 0.8;
/// Largest distance of a square's corners from its middle, in texels of the light's image.
constexpr double kMostTexels = 1.5;

/// Half vectors, stretched so that a lobe of any width is about a radian wide.
class Stretch {
public:
    /// Microfacets stretched to a hemisphere (Heitz 2018, "Sampling the GGX Distribution of Visible Normals").
    Stretch(const Frame& frame, const glm::dvec2& alpha, const glm::dvec3& toViewer)
        : frame_(frame), alpha_(alpha), toViewer_(toViewer) {}
    /// Sheen fibres: the lobe depends only on the elevation of half vectors over the surface.
    Stretch(const glm::dvec3& normal, double height, const glm::dvec3& toViewer)
        : frame_(frameOf(normal)), height_(height), toViewer_(toViewer) {}

    glm::dvec3 of(const glm::dvec3& direction) const {
        const glm::dvec3 half = frame_.in(direction + toViewer_);
        const glm::dvec3 stretched = height_ > 0.0 ? glm::dvec3(height_ * glm::length(glm::dvec2(half)), 0.0, half.z)
                                                   : glm::dvec3(half.x / alpha_.x, half.y / alpha_.y, half.z);
        const double length = glm::length(stretched);
        return length > 0.0 ? stretched / length : glm::dvec3(0.0, 0.0, -1.0);
    }

private:
    Frame frame_;
    glm::dvec2 alpha_{1.0};
    double height_ = 0.0;
    glm::dvec3 toViewer_;
};

std::vector<Stretch> stretchesOf(const SurfacePoint& point, const glm::dvec3& toViewer, bool specular) {
    std::vector<Stretch> stretches;
    if (!specular) return stretches;
    const scenes::MaterialModelInfo& model = scenes::infoOf(point.model);
    if (model.microsurface == scenes::Microsurface::Parameter) // GGX of about the same width
        stretches.emplace_back(frameOf(point.normal), glm::dvec2(std::sqrt(2.0 / (point.roughness + 2.0))), toViewer);
    else if (model.highlight != scenes::Highlight::None)
        stretches.emplace_back(frameOf(point.normal, point.tangent), glm::dvec2(point.alpha, point.alphaAcross),
                               toViewer);
    if (point.coat > 0.0) stretches.emplace_back(frameOf(point.coatNormal), glm::dvec2(point.coatAlpha), toViewer);
    // sin^(1/alpha) is about exp(-cos^2 / (2 alpha)).
    if (point.sheenColor != glm::dvec3(0.0))
        stretches.emplace_back(point.normal, std::sqrt(point.sheenAlpha), toViewer);
    return stretches;
}

using Integrand = std::function<glm::dvec3(const glm::dvec3& direction)>;

/// Gauss-Kronrod points on -1..1: Kronrod's weights for all seven, Gauss's weights for three of them.
struct Rule {
    static constexpr int kPoints = 7;
    static constexpr std::array<double, kPoints> place{
        -0.960491268708020283423507092629080, -0.774596669241483377035853079956480,
        -0.434243749346802558002071502844628, 0.0,
        0.434243749346802558002071502844628,  0.774596669241483377035853079956480,
        0.960491268708020283423507092629080};
    static constexpr std::array<double, kPoints> kronrod{
        0.104656226026467265193823857192073, 0.268488089868333440728569280666710, 0.401397414775962222905051818618432,
        0.450916538658474142345110087045571, 0.401397414775962222905051818618432, 0.268488089868333440728569280666710,
        0.104656226026467265193823857192073};
    static constexpr std::array<double, kPoints> gauss{0.0, 5.0 / 9.0, 0.0, 8.0 / 9.0, 0.0, 5.0 / 9.0, 0.0};
};

class Cubature {
public:
    Cubature(const SeenArea& area, const LightSurface& surface, const std::vector<Stretch>& stretches,
             const Integrand& integrand, const Settings& settings)
        : area_(area), surface_(surface), stretches_(stretches), integrand_(integrand), settings_(settings) {}

    Estimate integral() const {
        std::vector<Square> heap;
        glm::dvec3 sum(0.0), differences(0.0);
        const auto keep = [&](const Square& square, double sign) {
            sum += sign * square.sum;
            differences += sign * square.difference;
        };
        const auto isWorse = [](const Square& a, const Square& b) { return a.worst() < b.worst(); };
        for (Square& square : firstSquares()) {
            measure(square);
            keep(square, 1.0);
            heap.push_back(square);
        }
        std::make_heap(heap.begin(), heap.end(), isWorse);
        const auto isRight = [&] { return greatest(differences) <= settings_.areaTolerance * greatest(glm::abs(sum)); };
        while (!isRight() && int(heap.size()) + 3 <= settings_.areaSquares) {
            std::pop_heap(heap.begin(), heap.end(), isWorse);
            const Square whole = heap.back();
            heap.pop_back();
            keep(whole, -1.0);
            for (Square& quarter : quartersOf(whole)) {
                measure(quarter);
                keep(quarter, 1.0);
                heap.push_back(quarter);
                std::push_heap(heap.begin(), heap.end(), isWorse);
            }
        }
        // Sums from scratch: running sums of differences keep the rounding of their largest terms.
        sum = differences = glm::dvec3(0.0);
        for (const Square& square : heap) keep(square, 1.0);
        return {sum, differences * differences};
    }

private:
    struct Square {
        std::size_t patch = 0;
        glm::dvec2 corner, size;
        glm::dvec3 sum{0.0}, difference{0.0};
        double worst() const { return greatest(difference); }
        glm::dvec2 at(double x, double y) const { return corner + glm::dvec2(x, y) * size; }
    };
    static double greatest(const glm::dvec3& color) { return std::max({color.r, color.g, color.b}); }

    static std::array<Square, 4> quartersOf(const Square& whole) {
        std::array<Square, 4> quarters;
        for (int i = 0; i < 4; ++i)
            quarters[std::size_t(i)] = {whole.patch, whole.at(0.5 * (i % 2), 0.5 * (i / 2)), 0.5 * whole.size};
        return quarters;
    }

    /// Quarters squares until they are small enough for every lobe and the image, with at most half of the squares.
    std::vector<Square> firstSquares() const {
        std::deque<Square> open;
        for (std::size_t patch = 0; patch < area_.patchCount(); ++patch) {
            const int count = area_.isRound(patch) ? 4 : 1;
            for (int i = 0; i < count; ++i) open.push_back({patch, {0.0, double(i) / count}, {1.0, 1.0 / count}});
        }
        std::vector<Square> small;
        while (!open.empty()) {
            const Square square = open.front();
            open.pop_front();
            if (int(open.size() + small.size()) < settings_.areaSquares / 2 &&
                (turnsMuch(square) || holdsManyTexels(square)))
                for (const Square& quarter : quartersOf(square)) open.push_back(quarter);
            else
                small.push_back(square);
        }
        return small;
    }

    bool turnsMuch(const Square& square) const {
        const double most = 2.0 * std::sin(0.5 * kTurnRadians);
        for (const Stretch& stretch : stretches_) {
            const glm::dvec3 middle = stretch.of(area_.at(square.patch, square.at(0.5, 0.5)).direction);
            for (const double x : {0.0, 0.5, 1.0})
                for (const double y : {0.0, 0.5, 1.0})
                    if (glm::distance(stretch.of(area_.at(square.patch, square.at(x, y)).direction), middle) > most)
                        return true;
        }
        return false;
    }

    /// Whether a square covers many texels of the light's image: it might miss details smaller than itself.
    bool holdsManyTexels(const Square& square) const {
        if (surface_.isEven()) return false;
        const auto texelsAt = [&](double x, double y) {
            return surface_.texelsAt(area_.at(square.patch, square.at(x, y)).direction);
        };
        const glm::dvec2 middle = texelsAt(0.5, 0.5);
        for (const double x : {0.0, 1.0})
            for (const double y : {0.0, 1.0})
                if (glm::distance(texelsAt(x, y), middle) > kMostTexels) return true;
        return false;
    }

    void measure(Square& square) const {
        glm::dvec3 fine(0.0), coarse(0.0);
        for (std::size_t i = 0; i < Rule::kPoints; ++i)
            for (std::size_t j = 0; j < Rule::kPoints; ++j) {
                const SeenArea::Place place =
                    area_.at(square.patch, square.at(0.5 + 0.5 * Rule::place[i], 0.5 + 0.5 * Rule::place[j]));
                if (!(place.solidAngle > 0.0)) continue;
                glm::dvec3 found = place.solidAngle * integrand_(place.direction);
                if (!surface_.isEven()) found *= surface_.factorAt(place.direction);
                fine += Rule::kronrod[i] * Rule::kronrod[j] * found;
                coarse += Rule::gauss[i] * Rule::gauss[j] * found;
            }
        const double share = 0.25 * square.size.x * square.size.y;
        square.sum = share * fine;
        square.difference = share * glm::abs(fine - coarse);
    }

    const SeenArea& area_;
    const LightSurface& surface_;
    const std::vector<Stretch>& stretches_;
    const Integrand& integrand_;
    const Settings& settings_;
};

/// Integrates over the directions in which the light is visible, times its radiance and range window.
Estimate integralOver(const ShiningLight& shining, const glm::dvec3& positionRWS, const glm::dvec3& normal,
                      const std::vector<Stretch>& stretches, const Integrand& integrand, const Settings& settings) {
    const double window = rangeWindow(glm::distance(shining.positionRWS, positionRWS), shining.rangeMetres);
    if (window == 0.0) return {};
    const SeenArea area(shining, positionRWS, normal);
    const LightSurface surface(shining, shining.positionRWS - positionRWS);
    const Estimate share = Cubature(area, surface, stretches, integrand, settings).integral();
    const glm::dvec3 radiance = window * shining.color;
    return {radiance * share.light, radiance * radiance * share.variance};
}

} // namespace

Estimate reflectedOf(const ShiningLight& light, const SurfacePoint& point, const glm::dvec3& positionRWS,
                     const glm::dvec3& toViewer, bool specular, bool onlyLobes, const Settings& settings) {
    return integralOver(
        light, positionRWS, point.normal, stretchesOf(point, toViewer, specular),
        [&](const glm::dvec3& direction) {
            glm::dvec3 share = reflected(point, direction, toViewer, specular);
            if (onlyLobes) share -= reflected(point, direction, toViewer, false);
            return share;
        },
        settings);
}

glm::dvec3 irradianceOf(const ShiningLight& light, const glm::dvec3& positionRWS, const glm::dvec3& normal,
                        const Settings& settings) {
    return integralOver(
               light, positionRWS, normal, {},
               [&](const glm::dvec3& direction) { return glm::dvec3(std::max(glm::dot(normal, direction), 0.0)); },
               settings)
        .light;
}

} // namespace tessera::reference
