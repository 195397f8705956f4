#include "validation/reference/Sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "validation/reference/Lobes.h"

namespace tessera::reference {

namespace {

using std::numbers::pi;
constexpr int kParts = 8; ///< independent parts of the samples

} // namespace

Frame frameOf(const glm::dvec3& normal, const glm::dvec3& tangent) {
    const glm::dvec3 other = std::abs(normal.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 x = glm::normalize(tangent == glm::dvec3(0.0) ? glm::cross(other, normal) : tangent);
    return {x, glm::cross(normal, x), normal};
}

glm::dvec3 ByCosine::direction(const glm::dvec2& random) const {
    const double sine = std::sqrt(random.x), angle = 2.0 * pi * random.y;
    return frame_.out({sine * std::cos(angle), sine * std::sin(angle), std::sqrt(1.0 - random.x)});
}

double ByCosine::density(const glm::dvec3& direction) const {
    return std::max(glm::dot(frame_.z, direction), 0.0) / pi;
}

glm::dvec3 ByMicrofacets::direction(const glm::dvec2& random) const {
    const double slope = std::sqrt(random.x / (1.0 - random.x)), angle = 2.0 * pi * random.y;
    const glm::dvec3 half = frame_.out(
        glm::normalize(glm::dvec3(alpha_.x * slope * std::cos(angle), alpha_.y * slope * std::sin(angle), 1.0)));
    return glm::normalize(2.0 * glm::dot(half, toViewer_) * half - toViewer_);
}

double ByMicrofacets::density(const glm::dvec3& direction) const {
    const glm::dvec3 half = glm::normalize(direction + toViewer_), local = frame_.in(half);
    if (!(local.z > 0.0)) return 0.0;
    return distributionGgx(alpha_, local) * local.z / (4.0 * std::abs(glm::dot(half, direction)));
}

glm::dvec3 ByPower::direction(const glm::dvec2& random) const {
    const double cosine = std::pow(1.0 - random.x, 1.0 / (exponent_ + 1.0)), angle = 2.0 * pi * random.y;
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    const glm::dvec3 half = frame_.out({sine * std::cos(angle), sine * std::sin(angle), cosine});
    return glm::normalize(2.0 * glm::dot(half, toViewer_) * half - toViewer_);
}

double ByPower::density(const glm::dvec3& direction) const {
    const glm::dvec3 half = glm::normalize(direction + toViewer_);
    const double cosine = glm::dot(half, frame_.z);
    if (!(cosine > 0.0)) return 0.0;
    return (exponent_ + 1.0) / (2.0 * pi) * std::pow(cosine, exponent_) / (4.0 * std::abs(glm::dot(half, direction)));
}

std::vector<std::unique_ptr<Strategy>> strategiesOf(const SurfacePoint& point, const glm::dvec3& toViewer,
                                                    bool specular) {
    std::vector<std::unique_ptr<Strategy>> strategies;
    strategies.push_back(std::make_unique<ByCosine>(point.normal));
    if (!specular) return strategies;
    const scenes::MaterialModelInfo& model = scenes::infoOf(point.model);
    if (model.microsurface == scenes::Microsurface::Parameter)
        strategies.push_back(std::make_unique<ByPower>(point.roughness, point.normal, toViewer));
    else if (model.highlight != scenes::Highlight::None && point.reflectsLobe)
        strategies.push_back(std::make_unique<ByMicrofacets>(glm::dvec2(point.alpha, point.alphaAcross), point.normal,
                                                             point.tangent, toViewer));
    if (point.coat > 0.0 && point.reflectsCoatLobe)
        strategies.push_back(
            std::make_unique<ByMicrofacets>(glm::dvec2(point.coatAlpha), point.coatNormal, glm::dvec3(0.0), toViewer));
    return strategies;
}

Estimate sampled(std::span<const Strategy* const> strategies, int paths, std::uint32_t seed,
                 const std::function<glm::dvec3(const glm::dvec3& direction)>& light) {
    const auto side = int(std::ceil(std::sqrt(double(paths) / kParts)));
    const auto worth = [&](const Strategy& own, const glm::dvec3& direction) {
        const double ownDensity = own.density(direction);
        if (!(ownDensity > 0.0)) return glm::dvec3(0.0);
        const glm::dvec3 found = light(direction);
        if (found == glm::dvec3(0.0)) return glm::dvec3(0.0);
        double squares = 0.0;
        for (const Strategy* strategy : strategies) {
            const double density = strategy->density(direction);
            squares += density * density;
        }
        return found * (ownDensity / squares);
    };
    std::mt19937 generator(seed * 2654435761u + 12345u);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    glm::dvec3 sum(0.0), squares(0.0);
    for (int part = 0; part < kParts; ++part) {
        glm::dvec3 ofPart(0.0);
        for (int cell = 0; cell < side * side; ++cell)
            for (const Strategy* strategy : strategies) {
                const double x = uniform(generator), y = uniform(generator);
                const glm::dvec2 random = glm::dvec2(cell % side + x, cell / side + y) / double(side);
                ofPart += worth(*strategy, strategy->direction(random));
            }
        ofPart /= double(side * side);
        sum += ofPart;
        squares += ofPart * ofPart;
    }
    const glm::dvec3 mean = sum / double(kParts);
    return {mean, glm::max(squares / double(kParts) - mean * mean, glm::dvec3(0.0)) / (kParts - 1.0)};
}

} // namespace tessera::reference
