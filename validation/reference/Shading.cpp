#include "validation/reference/Shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "scenes/ClosedBodies.h"
#include "validation/reference/AreaLights.h"
#include "validation/reference/NormalAt.h"
#include "validation/reference/Reflectance.h"

namespace tessera::reference {

namespace {

/// The value of an Occlusion::Answer or Occlusion::Passage to shade with.
auto shareOf(const auto& answer, Shading::Shadows shadows) {
    return shadows == Shading::Shadows::Exact  ? answer.share
           : shadows == Shading::Shadows::Most ? answer.least
                                               : answer.most;
}

/// Refracts a ray at the far side, by angles to the normal, or reflects it totally. An index of 0 stands for infinity.
glm::dvec3 leavingDirection(const glm::dvec3& bent, const glm::dvec3& normal, double ior) {
    const glm::dvec3 outward = glm::dot(normal, bent) < 0.0 ? -normal : normal;
    const double angle = std::acos(std::clamp(glm::dot(outward, bent), -1.0, 1.0)), sine = std::sin(angle);
    const glm::dvec3 across = bent - std::cos(angle) * outward;
    if (glm::length(across) < 1e-12) return bent;
    if (ior == 0.0 || ior * sine > 1.0) return bent - 2.0 * std::cos(angle) * outward;
    const double leaving = std::asin(ior * sine);
    return std::cos(leaving) * outward + std::sin(leaving) * glm::normalize(across);
}

/// A ray that continues elsewhere, with the footprint that the pixel's ray has there.
Ray bentRay(const Ray& ray, double depthMetres, const glm::dvec3& originRWS, const glm::dvec3& direction) {
    return {originRWS,
            direction,
            ray.originDx + depthMetres * ray.directionDx,
            ray.originDy + depthMetres * ray.directionDy,
            ray.directionDx,
            ray.directionDy};
}

} // namespace

bool Shown::hasUndecidedShadows() const {
    const auto isOpen = [](const auto& answer) { return answer && answer->isUndecided; };
    return std::ranges::any_of(memos, [&](const SurfaceMemo& memo) {
        return std::ranges::any_of(memo.shadows, isOpen) || std::ranges::any_of(memo.passages, isOpen);
    });
}

Shading::Shading(const scenes::Scene& scene, const Settings& settings, const Sight& sight)
    : scene_(scene), settings_(settings), sight_(sight), lights_(sight.lights()), surroundings_(scene, settings),
      occlusion_(scene, sight.objects()),
      diffusion_(sight.objects(), sight.textures(), lights_, surroundings_, occlusion_, settings) {
    if (settings.farSide == FarSide::BackFacesOfClosed) {
        scenes::ClosedMeshes meshes;
        closedBodies_ = scenes::closedBodies(scene, meshes);
    }
}

/// Whether rays leave the entered body through the back faces of its mesh.
bool Shading::hasBackFaces(const Hit& entry) const {
    if (settings_.farSide != FarSide::BackFacesOfClosed) return settings_.farSide == FarSide::BackFaces;
    return closedBodies_[std::size_t(entry.object->material - scene_.materials.data())];
}

Shading::Lit Shading::shade(Shown& shown, const Nudge& nudge, Shadows shadows) const {
    const Seen& seen = shown.seen;
    const bool isEnvironmentSeen =
        shown.throughBodyPaths > 0 ? surroundings_.showsThroughBodies() : surroundings_.isSeen();
    Lit all{isEnvironmentSeen ? surroundings_.radianceOf(glm::normalize(shown.ray.direction))
                              : glm::dvec3(scene_.background)};
    if (seen.light) all.radiance = seen.light->factor * lights_[seen.light->light].color;
    if (seen.opaque) all = litSurface(shown, 0, nudge, shadows);
    for (std::size_t i = 0; i < seen.transparent.size(); ++i) {
        const Lit own = litSurface(shown, 1 + i, nudge, shadows);
        const glm::dvec3 before = 1.0 - own.opacity + own.opacity * own.passed;
        all.radianceMore = before * all.radianceMore + own.opacity * (own.radianceMore + own.passedMore * all.radiance);
        all.radiance = own.opacity * own.radiance + before * all.radiance;
        all.noise = all.noise.times(std::max({before.r, before.g, before.b})); // upper bound
        all.noise += own.noise.times(own.opacity);
        all.areaLights = all.areaLights.times(before);
        all.areaLights += own.areaLights.times(own.opacity);
    }
    return all;
}

SurfacePoint Shading::nudged(Hit hit, const Nudge& nudge, HookPoints* hookPoints) const {
    hit.nudge = nudge;
    const auto place = std::size_t(hit.object->material - scene_.materials.data());
    if (hookPoints == nullptr || !scene_.hook->changes(place)) return surfaceAt(hit, sight_.textures());
    return surfaceAt(hit, sight_.textures(), [&](SurfacePoint& point) { hookPoints->change(hit, point); });
}

/// One of the surfaces, numbered as in Shown::memos.
Shading::Lit Shading::litSurface(Shown& shown, std::size_t surface, const Nudge& nudge, Shadows shadows) const {
    const Hit& hit = surface == 0 ? *shown.seen.opaque : shown.seen.transparent[surface - 1];
    const SurfacePoint point = nudged(hit, nudge, shown.hookPoints);
    if (shown.hookPoints != nullptr && !shown.hookPoints->areKnown()) return {glm::dvec3(0.0), point.opacity};
    if (!scenes::infoOf(point.model).isLit) return {point.emission + point.color, point.opacity};
    if (shown.memos.size() <= surface) shown.memos.resize(surface + 1);
    SurfaceMemo& memo = shown.memos[surface];
    const glm::dvec3 positionRWS = shown.ray.at(hit.depthMetres);
    const bool isThroughBody = shown.throughBodyPaths > 0;
    const glm::dvec3 toViewer = isThroughBody ? hit.toViewer : sight_.rays().toViewer(positionRWS);
    Lit lit{emitted(point, toViewer), point.opacity};
    if (point.transmission > 0.0) addPassing(shown, hit, point, toViewer, memo, lit);
    if (surroundings_.lights()) {
        // Reused for nudges: the rounding that they stand for changes this light less than its sampling noise.
        if (!memo.surroundings)
            memo.surroundings = surroundings_.on(point, toViewer, settings_.specular, point.diffuses, shown.seed,
                                                 isThroughBody ? shown.throughBodyPaths : settings_.environmentPaths);
        lit.radiance += memo.surroundings->light;
    }
    for (std::size_t light = 0; light < lights_.size(); ++light) {
        const bool isArea = scenes::infoOf(lights_[light].light.type).isArea;
        const Estimate found = isArea ? areaLightOn(light, nudge, isThroughBody, point, positionRWS, toViewer, memo)
                                      : Estimate{lightOn(point, lights_[light], positionRWS, toViewer)};
        const glm::dvec3& unhidden = found.light;
        if (unhidden == glm::dvec3(0.0)) continue;
        const Occlusion::Answer answer = shadowOf(light, hit, point, positionRWS, toViewer, memo);
        const double share = shareOf(answer, shadows);
        lit.radiance += share * unhidden;
        lit.noise += answer.noise.times(unhidden.r + unhidden.g + unhidden.b);
        if (isArea) lit.areaLights += found.times(share);
    }
    if (point.diffuses) {
        if (!memo.diffused) memo.diffused = diffusion_.at(hit, positionRWS, shown.seed);
        lit.radiance +=
            memo.diffused->light * leaving(point, toViewer, double(hit.object->material->subsurface.preScatterShare));
    } else if (point.passes) {
        lit.radiance += passedOnBy(hit, point, positionRWS, toViewer, shadows, memo);
    }
    return lit;
}

/// Adds transmitted light. Bodies look along bent rays; with bodiesShowScene, rough sheets look around the viewer's
/// ray. Otherwise, or with neither surfaces nor an environment to show, the light comes from straight behind.
void Shading::addPassing(const Shown& shown, const Hit& hit, const SurfacePoint& point, const glm::dvec3& toViewer,
                         SurfaceMemo& memo, Lit& lit) const {
    const glm::dvec3 entering = passingIfNoneReflected(point, toViewer);
    const glm::dvec3 transmittance = transmittanceOf(point, toViewer), share = entering * transmittance;
    glm::dvec3 more(0.0);
    if (point.passingAlpha > kSmallestAlpha)
        more = entering * glm::max(settings_.leastRoughTransmittance - transmittance, 0.0);
    const bool showsScene = settings_.bodiesShowScene && (sight_.hasOpaque() || glassLeft(shown) > 0);
    const bool looksBehind = point.hasBody || (settings_.bodiesShowScene && point.passingAlpha > kSmallestAlpha);
    if (!looksBehind || (!showsScene && !surroundings_.showsThroughBodies())) {
        const glm::dvec3 left = leftByBody(point, glm::dvec3(point.bodyMetres));
        lit.passed = share * left;
        lit.passedMore = more * left;
        return;
    }
    if (!memo.throughBody) memo.throughBody = throughBody(point, shown, hit, toViewer, showsScene);
    glm::dvec3 wayMetres;
    for (int c = 0; c < 3; ++c) wayMetres[c] = memo.throughBody->wayMetres[c].value_or(point.bodyMetres);
    const glm::dvec3 met = leftByBody(point, wayMetres) * memo.throughBody->radiance;
    lit.radiance += share * met;
    lit.radianceMore = more * met;
}

BodyLight Shading::throughBody(const SurfacePoint& point, const Shown& shown, const Hit& entry,
                               const glm::dvec3& toViewer, bool showsScene) const {
    const Ray& ray = shown.ray;
    const double depthMetres = entry.depthMetres;
    const auto meetsAny = [&](const Ray& inside, double metres) {
        const Seen seen = sight_.ahead(inside);
        return (seen.opaque && seen.opaque->depthMetres <= metres) || (seen.light && seen.light->depthMetres <= metres);
    };
    const auto around = [&](std::span<const Scatter> ways) {
        if (showsScene) return sceneAround(shown, entry, ways);
        return surroundings_.through(ways, shown.seed, [](const glm::dvec3&, const glm::dvec3&) { return false; });
    };
    const bool isRough = point.passingAlpha > kSmallestAlpha;
    const glm::dvec3 normal = glm::dot(point.normal, toViewer) < 0.0 ? -point.normal : point.normal;
    const glm::dvec3 entryRWS = ray.at(depthMetres);
    /// The far end of a ray inside a body: its exit point, the direction there, and the far side.
    struct Leaving {
        glm::dvec3 originRWS, direction;
        std::optional<glm::dvec3> normal; ///< on the side of the ray
        std::optional<double> wayMetres;  ///< distance inside, up to a back face
    };
    const auto leavingOf = [&](const glm::dvec3& bent, double ior) {
        Leaving found{entryRWS, bent, {}, {}};
        if (!point.hasBody) {
            found.normal = normal;
            found.direction = -toViewer;
        } else if (settings_.farSide == FarSide::Parallel) {
            // By the angle inside; the product clamps its cosine to at least 1e-3.
            const double toFarSideMetres = point.bodyMetres / std::max(std::abs(glm::dot(bent, point.normal)), 1e-3);
            // Objects inside, or at the far side itself, are met there.
            const double upTo = toFarSideMetres * (1.0 + 1e-6);
            if (!showsScene || !meetsAny(bentRay(ray, depthMetres, entryRWS, bent), upTo)) {
                found.originRWS += toFarSideMetres * bent;
                found.direction = -toViewer;
                found.normal = normal;
            }
        } else if (hasBackFaces(entry)) {
            const Ray inside = bentRay(ray, depthMetres, entryRWS, bent);
            if (std::optional<Hit> leaving = sight_.farSideAhead(inside, *entry.object)) {
                leaving->toViewer = glm::dvec3(0.0); // no viewer: keeps its normal unbent
                const glm::dvec3 farNormal = normalAt(*leaving, sight_.textures());
                // Objects inside are met there, but not those that the far side rests on.
                if (showsScene && meetsAny(inside, leaving->depthMetres * (1.0 - 1e-6))) return found;
                found.wayMetres = leaving->depthMetres;
                found.originRWS = inside.at(leaving->depthMetres);
                found.direction = leavingDirection(bent, farNormal, ior);
                found.normal = glm::dot(farNormal, bent) < 0.0 ? farNormal : -farNormal;
                // A reflected ray continues inside, in all at least as far as the body is thick.
                if (glm::dot(*found.normal, found.direction) > 0.0)
                    found.wayMetres = std::max(
                        *found.wayMetres, point.bodyMetres / std::max(std::abs(glm::dot(bent, point.normal)), 1e-3));
            }
        }
        return found;
    };
    const auto along = [&](double ior, std::optional<double>& wayMetres) {
        const std::optional<glm::dvec3> bent = refracted(point, toViewer, ior);
        if (point.hasBody && !bent) return glm::dvec3(0.0);
        const Leaving middle = leavingOf(bent.value_or(-toViewer), ior);
        wayMetres = middle.wayMetres;
        std::vector<Scatter> ways;
        const Facets near(normal, point.passingAlpha, toViewer, ior, Facets::Send::Through);
        if (!isRough || !bent) {
            ways.push_back({middle.originRWS, middle.direction, {}, 1.0});
        } else if (ior == 0.0) { // by definition its near side alone scatters, around the exit direction
            ways.push_back(
                {middle.originRWS, middle.direction,
                 Facets(-middle.direction, point.passingAlpha, -middle.direction, ior, Facets::Send::Through), 1.0});
        } else if (!middle.normal) {
            ways.push_back({middle.originRWS, middle.direction, near, 1.0});
        } else {
            const bool isReflected = glm::dot(*middle.normal, middle.direction) > 0.0;
            constexpr int kSide = 6; // side of a square grid of microfacets of the near side
            std::mt19937 generator(shown.seed * 2654435761u + 99991u);
            std::uniform_real_distribution<double> uniform(0.0, 1.0);
            for (int i = 0; i < kSide * kSide; ++i) {
                const double x = uniform(generator), y = uniform(generator);
                const glm::dvec3 inside = near.direction({(i % kSide + x) / kSide, (double(i / kSide) + y) / kSide});
                const double density = near.density(inside);
                const double weight = density > 0.0 ? near.share(inside) / density : 0.0;
                if (!(weight > 0.0)) continue;
                const Leaving leaving = leavingOf(inside, ior);
                Scatter way{leaving.originRWS, leaving.normal ? leaving.direction : inside, {}, weight};
                if (leaving.normal)
                    way.facets = Facets(*leaving.normal, point.passingAlpha, -inside, 1.0 / ior,
                                        isReflected ? Facets::Send::Back : Facets::Send::Through);
                ways.push_back(way);
            }
            if (ways.empty()) ways.push_back({middle.originRWS, middle.direction, {}, 1.0});
            std::ranges::shuffle(ways, generator);
        }
        return around(ways);
    };
    const glm::dvec3 iors = iorsOf(point);
    BodyLight found;
    if (iors.r != iors.b) {
        for (int c = 0; c < 3; ++c) found.radiance[c] = along(iors[c], found.wayMetres[c])[c];
        return found;
    }
    found.radiance = along(iors.g, found.wayMetres[1]);
    found.wayMetres[0] = found.wayMetres[2] = found.wayMetres[1];
    return found;
}

/// What a bent ray meets. While further glass may be met, also the transparent surfaces in front, except the body's own
/// if no far side was found.
Seen Shading::aheadOf(const Shown& shown, const Hit& entry, const Ray& bent) const {
    if (glassLeft(shown) < 1) return sight_.ahead(bent);
    // The surface that a ray leaves is not met again.
    const double least = 1e-6 * std::max(entry.depthMetres, 1.0);
    Seen seen = sight_.aheadThroughGlass(bent, least);
    if (!hasBackFaces(entry))
        std::erase_if(seen.transparent, [&](const Hit& hit) { return hit.object == entry.object; });
    return seen;
}

/// Radiance of surfaces and lights along the paths. Where there are none, that of the environment that lights the
/// scene, else the background's.
glm::dvec3 Shading::sceneAround(const Shown& shown, const Hit& entry, std::span<const Scatter> ways) const {
    const auto aheadAlong = [&](const Ray& bent) { return aheadOf(shown, entry, bent); };
    const auto isAny = [](const Seen& seen) { return seen.opaque || seen.light || !seen.transparent.empty(); };
    const auto rayAlong = [&](const glm::dvec3& originRWS, const glm::dvec3& way) {
        return bentRay(shown.ray, entry.depthMetres, originRWS, way);
    };
    const bool hasEnvironment = surroundings_.showsThroughBodies();
    const bool isSpread = std::ranges::any_of(ways, [](const Scatter& way) { return way.facets.has_value(); });
    // Fewer rays behind a rough body: nested ones cost the product of their rays.
    const int mostPaths = shown.throughBodyPaths > 0 ? std::max(settings_.bodyPaths / 8, 4) : settings_.bodyPaths;
    const int paths = isSpread ? mostPaths : 1;
    std::mt19937 generator(shown.seed * 2654435761u + 54321u);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    glm::dvec3 surfaces(0.0);
    double weights = 0.0;
    const double turn = uniform(generator);
    std::vector<int> strata(static_cast<std::size_t>(paths)); // of slopes; angles are by the golden ratio
    std::iota(strata.begin(), strata.end(), 0);
    std::ranges::shuffle(strata, generator);
    for (int path = 0; path < paths; ++path) {
        const Scatter& from = ways[std::size_t(path) * ways.size() / std::size_t(paths)];
        glm::dvec3 way = from.direction;
        double weight = from.weight;
        if (from.facets) {
            const double angle = (path + 1) * std::numbers::phi + turn;
            const double slope = (strata[std::size_t(path)] + uniform(generator)) / paths;
            way = from.facets->direction({slope, angle - std::floor(angle)});
            const double density = from.facets->density(way);
            weight *= density > 0.0 ? from.facets->share(way) / density : 0.0;
        }
        if (!(weight > 0.0)) continue;
        weights += weight;
        const Ray bent = rayAlong(from.originRWS, way);
        Shown met{bent, aheadAlong(bent), shown.seed, nullptr, {}};
        if (!isAny(met.seen)) {
            if (!hasEnvironment) surfaces += weight * glm::dvec3(scene_.background);
            continue;
        }
        // A rough body averages many surfaces in a pixel, with fewer paths for each.
        met.throughBodyPaths = isSpread ? std::max(settings_.environmentPaths / paths, 16) : settings_.environmentPaths;
        met.glassLeft = glassLeft(shown) - 1;
        surfaces += weight * shade(met).radiance;
    }
    if (weights > 0.0) surfaces /= weights;
    if (!hasEnvironment) return surfaces;
    return surfaces + surroundings_.through(ways, shown.seed, [&](const glm::dvec3& originRWS, const glm::dvec3& way) {
        return isAny(aheadAlong(rayAlong(originRWS, way)));
    });
}

/// The transmitted light of all lights below the horizon.
glm::dvec3 Shading::passedOnBy(const Hit& hit, const SurfacePoint& point, const glm::dvec3& positionRWS,
                               const glm::dvec3& toViewer, Shadows shadows, SurfaceMemo& memo) const {
    glm::dvec3 radiance(0.0);
    for (std::size_t light = 0; light < lights_.size(); ++light) {
        const Incident incident = incidentAt(lights_[light], positionRWS);
        if (!lights_[light].castsShadow || incident.irradiance == glm::dvec3(0.0)) continue;
        const glm::dvec3 whole = passedOn(point, incident.toLight, toViewer) * incident.irradiance;
        if (whole == glm::dvec3(0.0)) continue;
        auto& known = memo.passages;
        known.resize(lights_.size());
        if (!known[light])
            known[light] = occlusion_.passageOf(lights_[light], hit, point, positionRWS, settings_.findsAlternatives);
        radiance += whole * shareOf(*known[light], shadows);
    }
    return radiance;
}

Occlusion::Answer Shading::shadowOf(std::size_t light, const Hit& hit, const SurfacePoint& point,
                                    const glm::dvec3& positionRWS, const glm::dvec3& toViewer,
                                    SurfaceMemo& memo) const {
    if (!lights_[light].castsShadow) return {};
    auto& known = memo.shadows;
    known.resize(lights_.size());
    if (!known[light]) known[light] = occlusion_.of(lights_[light], hit, point, positionRWS, toViewer, settings_);
    return *known[light];
}

/// Unshadowed radiance of one light towards the viewer. Where the surface diffuses light, only the specular part leaves
/// at the point itself.
glm::dvec3 Shading::lightOn(const SurfacePoint& point, const ShiningLight& light, const glm::dvec3& positionRWS,
                            const glm::dvec3& toViewer) const {
    const Incident incident = incidentAt(light, positionRWS);
    if (incident.irradiance == glm::dvec3(0.0)) return glm::dvec3(0.0);
    glm::dvec3 share = reflected(point, incident.toLight, toViewer, settings_.specular);
    if (point.diffuses) share -= reflected(point, incident.toLight, toViewer, false);
    return share * incident.irradiance;
}

/// The same for an area light.
Estimate Shading::areaLightOn(std::size_t light, const Nudge& nudge, bool isThroughBody, const SurfacePoint& point,
                              const glm::dvec3& positionRWS, const glm::dvec3& toViewer, SurfaceMemo& memo) const {
    // Changes by other texture values need less accuracy.
    constexpr double kNudgedTolerance = 1e-3;
    const bool isNudged = !(nudge == Nudge());
    Settings settings = settings_;
    if (isNudged || isThroughBody) settings.areaTolerance = std::max(settings.areaTolerance, kNudgedTolerance);
    const auto integral = [&] {
        return reflectedOf(lights_[light], point, positionRWS, toViewer, settings_.specular, point.diffuses, settings);
    };
    if (isNudged) return integral();
    auto& known = memo.areaLights;
    known.resize(lights_.size());
    if (!known[light]) known[light] = integral();
    return *known[light];
}

} // namespace tessera::reference
