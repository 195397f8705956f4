#include "validation/reference/Diffusion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "validation/reference/AreaLights.h"
#include "validation/reference/Trees.h"

namespace tessera::reference {

namespace {

/// A Gaussian of a diffusion profile, in the scene's metres.
struct Term {
    double variance = 0.0;
    glm::dvec3 weight{0.0};
    double share = 0.0; ///< fraction of the points
};

/// The diffusion profile of a material.
struct Profile {
    std::vector<Term> terms;
    double widestMetres = 0.0;

    /// R at a squared distance: 1/m^2, by channel.
    glm::dvec3 at(double distance2) const {
        glm::dvec3 sum(0.0);
        for (const Term& term : terms) sum += term.weight * density(term, distance2);
        return sum;
    }
    static double density(const Term& term, double distance2) {
        return std::exp(-0.5 * distance2 / term.variance) / (2.0 * std::numbers::pi * term.variance);
    }
};

Profile profileInScene(const scenes::Subsurface& subsurface) {
    const double metres = 0.001 / double(subsurface.scaleMetres); // scene metres in a millimetre
    Profile profile;
    double sum = 0.0;
    for (const scenes::DiffusionGaussian& gaussian : scenes::profileOf(subsurface)) {
        const glm::dvec3 weight(gaussian.weight);
        // By the largest channel: a term that is faint in the mean may be all that one channel has.
        const double share = std::max({weight.x, weight.y, weight.z});
        profile.terms.push_back({double(gaussian.varianceSquareMillimetres) * metres * metres, weight, share});
        profile.widestMetres = std::max(profile.widestMetres, std::sqrt(profile.terms.back().variance));
        sum += share;
    }
    for (Term& term : profile.terms) term.share /= sum;
    return profile;
}

/// Radius of the sampled surroundings in standard deviations: beyond, a Gaussian has 4e-6 of its light.
constexpr double kReach = 5.0;

/// All crossings of a line with one object.
struct Line : RTCIntersectContext {
    Ray ray;
    double lengthMetres = 0.0;
    const Object* object = nullptr;
    std::vector<Hit>* hits = nullptr;
};

void keepCrossing(const RTCFilterFunctionNArguments* arguments) {
    auto& line = *static_cast<Line*>(arguments->context);
    const auto& object = *static_cast<const Object*>(arguments->geometryUserPtr);
    arguments->valid[0] = 0;
    if (&object != line.object) return;
    const std::optional<Hit> hit = hitOf(object, RTCHitN_primID(arguments->hit, arguments->N, 0), line.ray);
    if (hit && hit->depthMetres >= 0.0 && hit->depthMetres <= line.lengthMetres) line.hits->push_back(*hit);
}

/// The unit normal of the triangle's front.
glm::dvec3 frontOf(const Hit& hit) {
    glm::dvec3 corners[3];
    for (int i = 0; i < 3; ++i) corners[i] = hit.object->cornerRWS(hit.triangle, i);
    const glm::dvec3 across = hit.object->handedness * glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double area = glm::length(across);
    return area > 0.0 ? across / area : glm::dvec3(0.0);
}

double fraction(double value) {
    return value - std::floor(value);
}

glm::dvec3 powered(const glm::dvec3& color, double power) {
    return {std::pow(color.x, power), std::pow(color.y, power), std::pow(color.z, power)};
}

} // namespace

struct Diffusion::Surfaces {
    const Objects& objects;
    const Textures& textures;
    std::span<const ShiningLight> lights;
    const Surroundings& surroundings;
    const Occlusion& occlusion;
    Settings settings;
    Device device;
    Tree tree;

    /// Light that enters at a point: irradiance times the albedo to the power of preScatterShare.
    glm::dvec3 entering(const Hit& hit, const glm::dvec3& pointRWS) const {
        const SurfacePoint surface = surfaceAt(hit, textures);
        const glm::dvec3 front = frontOf(hit);
        glm::dvec3 sum(0.0);
        if (surroundings.lights()) sum += surface.openness * surroundings.irradiance(surface.normal);
        for (const ShiningLight& light : lights) {
            const Incident incident = incidentAt(light, pointRWS);
            const double cosine = glm::dot(surface.normal, incident.toLight);
            const glm::dvec3 irradiance = scenes::infoOf(light.light.type).isArea
                                              ? irradianceOf(light, pointRWS, surface.normal, settings)
                                              : std::max(cosine, 0.0) * incident.irradiance;
            if (irradiance != glm::dvec3(0.0)) {
                const double share =
                    light.castsShadow ? occlusion.of(light, hit, surface, pointRWS, front, settings).share : 1.0;
                sum += share * irradiance;
            }
            const bool isBehind = cosine < 0.0 && incident.irradiance != glm::dvec3(0.0);
            if (isBehind && light.castsShadow && surface.passes)
                sum -= cosine * occlusion.passageOf(light, hit, surface, pointRWS, false).share * incident.irradiance;
        }
        return sum * powered(surface.color, double(hit.object->material->subsurface.preScatterShare));
    }

    void crossings(const Object& object, const glm::dvec3& from, const glm::dvec3& along, double lengthMetres,
                   std::vector<Hit>& hits) const {
        Line line{};
        rtcInitIntersectContext(&line);
        line.ray.originRWS = from;
        line.ray.direction = along;
        line.lengthMetres = lengthMetres;
        line.object = &object;
        line.hits = &hits;
        hits.clear();
        RTCRayHit rayHit = rayFrom(glm::vec3(from - objects.anchor().centreRWS), glm::vec3(along));
        rayHit.ray.tfar = float(lengthMetres);
        rtcIntersect1(tree.get(), &line, &rayHit);
        std::ranges::sort(hits, {}, &Hit::depthMetres);
        // Merges crossings of triangles that share an edge; Embree may offer a candidate twice.
        const auto isSame = [&](const Hit& a, const Hit& b) {
            return std::abs(a.depthMetres - b.depthMetres) <= 1e-9 * lengthMetres;
        };
        hits.erase(std::unique(hits.begin(), hits.end(), isSame), hits.end());
    }
};

Diffusion::Diffusion(const Objects& objects, const Textures& textures, std::span<const ShiningLight> lights,
                     const Surroundings& surroundings, const Occlusion& occlusion, const Settings& settings)
    : surfaces_(new Surfaces{objects, textures, lights, surroundings, occlusion, settings, {}, {}}) {
    // The sum over many points needs fewer rays for each.
    surfaces_->settings.findsAlternatives = false;
    surfaces_->settings.shadowSamples = 0;
    surfaces_->settings.shadowRings = 2;
    surfaces_->settings.penumbraRings = 2;
    surfaces_->settings.areaTolerance = 1e-3;
    std::vector<const Object*> diffusing;
    for (const std::vector<Object>* list : {&objects.opaque(), &objects.transparent()})
        for (const Object& object : *list)
            if (infoOf(object.subsurface).diffuses) diffusing.push_back(&object);
    if (diffusing.empty()) return;
    surfaces_->device = makeDevice();
    surfaces_->tree = makeTree(surfaces_->device.get(), diffusing, objects.anchor().centreRWS, keepCrossing);
}

Diffusion::~Diffusion() = default;

Diffusion::Answer Diffusion::at(const Hit& hit, const glm::dvec3& pointRWS, std::uint32_t seed) const {
    const Profile profile = profileInScene(hit.object->material->subsurface);
    const glm::dvec3 front = frontOf(hit);
    const glm::dvec3 aside = glm::normalize(
        glm::cross(front, std::abs(front.x) < 0.5 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0)));
    const std::array<glm::dvec3, 3> axes{front, aside, glm::cross(front, aside)};
    constexpr std::array<double, 3> kShares{0.5, 0.25, 0.25};
    const auto pointsOf = [&](std::size_t axis, const Term& term) {
        return std::ceil(kShares[axis] * term.share * double(surfaces_->settings.diffusionPoints));
    };
    // Density of the sample points of all lines together on a surface, 1/m^2.
    const auto density = [&](const glm::dvec3& offset, const glm::dvec3& normal) {
        double sum = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double along = glm::dot(offset, axes[axis]);
            const double across2 = std::max(glm::dot(offset, offset) - along * along, 0.0);
            for (const Term& term : profile.terms)
                sum += pointsOf(axis, term) * Profile::density(term, across2) * std::abs(glm::dot(normal, axes[axis]));
        }
        return sum;
    };
    const double reachMetres = kReach * profile.widestMetres;
    // The fractional parts of multiples of two numbers fill a square evenly (Roberts 2018, "The Unreasonable
    // Effectiveness of Quasirandom Sequences"); each pixel shifts them.
    constexpr double kPlastic = 1.32471795724474602596;
    const glm::dvec2 moved(fraction(double(seed) * 0.5545497), fraction(double(seed) * 0.308517));
    Answer answer;
    glm::dvec3 lit(0.0);
    std::vector<Hit> hits;
    std::uint32_t number = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const glm::dvec3& x = axes[(axis + 1) % 3];
        const glm::dvec3& y = axes[(axis + 2) % 3];
        for (const Term& term : profile.terms) {
            const auto count = std::uint32_t(pointsOf(axis, term));
            for (std::uint32_t i = 0; i < count; ++i, ++number) {
                const double u = (double(i) + fraction(moved.x + double(axis) / 3.0)) / double(count);
                const double v = fraction(moved.y + double(number) / kPlastic);
                const double radius = std::sqrt(-2.0 * term.variance * std::log(1.0 - std::min(u, 1.0 - 1e-12)));
                const double angle = 2.0 * std::numbers::pi * v;
                if (radius > reachMetres) continue;
                const glm::dvec3 middle = pointRWS + radius * (std::cos(angle) * x + std::sin(angle) * y);
                surfaces_->crossings(*hit.object, middle - reachMetres * axes[axis], axes[axis], 2.0 * reachMetres,
                                     hits);
                for (const Hit& other : hits) {
                    const glm::dvec3 otherRWS = middle + (other.depthMetres - reachMetres) * axes[axis];
                    const glm::dvec3 offset = otherRWS - pointRWS;
                    const glm::dvec3 normal = frontOf(other);
                    const double points = density(offset, normal);
                    if (!(points > 0.0)) continue;
                    const glm::dvec3 weight = profile.at(glm::dot(offset, offset)) / points;
                    if (weight == glm::dvec3(0.0)) continue;
                    answer.whole += weight;
                    if (glm::dot(normal, front) < 0.0) answer.apart += (weight.x + weight.y + weight.z) / 3.0;
                    lit += weight * surfaces_->entering(other, otherRWS);
                }
            }
        }
    }
    for (int c = 0; c < 3; ++c) answer.light[c] = answer.whole[c] > 0.0 ? lit[c] / answer.whole[c] : 0.0;
    answer.apart /= std::max((answer.whole.x + answer.whole.y + answer.whole.z) / 3.0, 1e-300);
    return answer;
}

} // namespace tessera::reference
