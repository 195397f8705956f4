#include "validation/reference/Render.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <tbb/parallel_for.h>

#include "validation/reference/AreaLights.h"
#include "validation/reference/Diffusion.h"
#include "validation/reference/HookAt.h"
#include "validation/reference/LightAt.h"
#include "validation/reference/NormalAt.h"
#include "validation/reference/Occlusion.h"
#include "validation/reference/Reflectance.h"
#include "validation/reference/SeenLights.h"
#include "validation/reference/Slots.h"
#include "validation/reference/Visibility.h"

namespace tessera::reference {

/// Not in the anonymous namespace: Probe, which other files see, holds one.
class Pixels {
public:
    Pixels(const scenes::Scene& scene, const Settings& settings)
        : scene_(scene), settings_(settings), rays_(settings.camera, settings.sizePixels),
          lights_(shiningLights(scene, settings, rays_.eyeWS())), seenLights_(lights_, rays_),
          objects_(scene, rays_, settings.subsurface, SeenLights::boxesRWS(lights_)),
          textures_(scene, settings.filtering), visibility_(objects_, rays_, textures_), surroundings_(scene, settings),
          occlusion_(scene, objects_), diffusion_(objects_, textures_, lights_, surroundings_, occlusion_, settings) {}

    void row(int row, Rendered& rendered) const {
        for (int column = 0; column < rendered.width; ++column)
            pixel(rays_.through(column, row), placeOf(column, row, rendered), rendered, nullptr);
    }

    /// The same where the scene's hook changes surfaces, `points` by column. While they are not known, pixels ask for
    /// them, and what else is found is forgotten.
    void hookedRow(int row, Rendered& rendered, std::span<HookPoints> points) const {
        for (int column = 0; column < rendered.width; ++column) {
            const std::size_t at = placeOf(column, row, rendered);
            HookPoints& own = points[std::size_t(column)];
            const bool isAsking = !own.areKnown();
            pixel(rays_.through(column, row), at, rendered, &own);
            if (!isAsking) continue;
            rendered.ids[at] = {};
            rendered.covered[at] = 0;
            rendered.alternatives[at].clear();
        }
    }

    Layers layers(const glm::dvec2& placePixels) const {
        const Ray ray = rays_.through(placePixels);
        Layers found;
        double depthMetres = std::numeric_limits<double>::infinity();
        const std::optional<Hit> nearest = visibility_.nearestOpaque(ray);
        if (nearest) {
            depthMetres = nearest->depthMetres;
            found.ids.object = 1 + nearest->object->number;
            found.ids.triangle = nearest->triangle;
        }
        for (const Hit& hit : visibility_.transparentBefore(ray, depthMetres)) {
            found.transparent.push_back({1 + hit.object->number, transparentId(hit.object->number, hit.triangle)});
            found.ids.transparent += found.transparent.back().id;
        }
        addOthers(ray, nearest, found);
        return found;
    }

private:
    static std::size_t placeOf(int column, int row, const Rendered& rendered) {
        return std::size_t(row) * std::size_t(rendered.width) + std::size_t(column);
    }

    static constexpr double kEndless = std::numeric_limits<double>::infinity();

    /// A pixel's centre and how far from it rounding to fp32 may move what is seen of a light, with room: most of it is
    /// 1e-7 of the picture's width.
    static constexpr double kMovedPixels = 1.0 / 64.0;
    static constexpr glm::dvec2 kAsidePixels[] = {{0.0, 0.0},
                                                  {-kMovedPixels, -kMovedPixels},
                                                  {kMovedPixels, -kMovedPixels},
                                                  {-kMovedPixels, kMovedPixels},
                                                  {kMovedPixels, kMovedPixels}};
    /// And ahead, in parts of what depth values stand for.
    static constexpr double kDepthRounding = 4e-6;

    /// Triangles in one place: their depths differ by no more than rounding to fp32 may move both.
    static bool areCoincident(const Hit& a, const Hit& b) {
        return std::abs(a.depthMetres - b.depthMetres) <= a.roundingMetres + b.roundingMetres;
    }

    /// The surfaces that may be the nearest: up to the first that has no hole there within its texture's leeway.
    std::vector<Hit> candidates(const Ray& ray) const {
        std::vector<Hit> found;
        std::optional<Hit> solid;
        for (const Hit& hit : visibility_.opaqueBefore(ray, std::numeric_limits<double>::infinity())) {
            if (solid && !areCoincident(hit, *solid)) {
                if (hit.depthMetres > solid->depthMetres + solid->roundingMetres + objects_.roundingMetres()) break;
                continue;
            }
            const auto [least, most] = opacitiesOf(hit);
            if (most < double(hit.object->material->alphaCutoff)) continue;
            found.push_back(hit);
            if (!solid && least >= double(hit.object->material->alphaCutoff)) solid = hit;
        }
        return found;
    }

    /// From the least to the most that the leeway allows; beyond every cutoff where nothing is cut.
    std::pair<double, double> opacitiesOf(Hit hit) const {
        constexpr double kSolid = std::numeric_limits<double>::infinity();
        if (hit.object->material->alphaMode != scenes::AlphaMode::Mask) return {kSolid, kSolid};
        const double own = opacityAt(hit, textures_);
        std::pair<double, double> range{own, own};
        if (!reference::isUndecided(hit, textures_)) return range;
        for (const Nudge& nudge : nudges()) {
            hit.nudge = nudge;
            const double other = opacityAt(hit, textures_);
            range = {std::min(range.first, other), std::max(range.second, other)};
        }
        return range;
    }

    void addOthers(const Ray& ray, const std::optional<Hit>& nearest, Layers& found) const {
        for (const Hit& hit : candidates(ray)) {
            Layers::Other other{{1 + hit.object->number, hit.triangle, 0}, nearest && areCoincident(hit, *nearest)};
            for (const Hit& before : visibility_.transparentBefore(ray, hit.depthMetres))
                other.ids.transparent += transparentId(before.object->number, before.triangle);
            if (other.ids != found.ids) found.others.push_back(other);
        }
    }

    void pixel(const Ray& ray, std::size_t at, Rendered& rendered, HookPoints* hookPoints) const {
        Seen seen;
        seen.hookPoints = hookPoints;
        seen.opaque = visibility_.nearestOpaque(ray);
        double depthMetres = kEndless;
        if (seen.opaque) {
            depthMetres = seen.opaque->depthMetres;
            rendered.ids[at].object = 1 + seen.opaque->object->number;
            rendered.ids[at].triangle = seen.opaque->triangle;
            rendered.covered[at] = 1;
        }
        seen.transparent = visibility_.transparentBefore(ray, depthMetres);
        seen.seed = std::uint32_t(at);
        for (const Hit& hit : seen.transparent) {
            rendered.ids[at].transparent += transparentId(hit.object->number, hit.triangle);
            if (surfaceAt(hit, textures_).opacity > 0.0) rendered.covered[at] = 1;
        }
        const Seen surfaces = seen;
        if (const std::optional<SeenLights::Met> met = seenLights_.before(ray, depthMetres)) {
            seen = behind(surfaces, met, met->depthMetres);
            rendered.covered[at] = 1;
        }
        const Lit lit = litBy(ray, seen, Nudge());
        const glm::dvec3 radiance = lit.radiance;
        rendered.radiance[at] = radiance;
        rendered.areaLights[at] = lit.areaLights;
        if (seen.opaque && !seen.spread.empty() && seen.spread[0]) rendered.spread[at] = *seen.spread[0];
        if (seen.opaque && !seen.surroundings.empty()) rendered.surroundings[at] = *seen.surroundings[0];
        if (!settings_.leeway) return;
        std::vector<Span>& alternatives = rendered.alternatives[at];
        rendered.undecidedShadows[at] = seen.hasUndecidedShadows() ? 1 : 0;
        addLeeway(ray, seen, radiance, alternatives);
        const glm::dvec2 placePixels(double(at % std::size_t(rendered.width)) + 0.5,
                                     double(at / std::size_t(rendered.width)) + 0.5);
        for (const Seen& other : otherLights(placePixels, surfaces, seen)) {
            const glm::dvec3 otherRadiance = radianceOf(ray, other, Nudge());
            alternatives.push_back({otherRadiance, otherRadiance});
            addLeeway(ray, other, otherRadiance, alternatives);
            addShadowLeeway(ray, other, otherRadiance, alternatives);
        }
        const bool isNoiseAlone = alternatives.empty() && rendered.undecidedShadows[at] == 0;
        addShadowLeeway(ray, seen, radiance, alternatives);
        for (const Hit& hit : coincidentWith(ray, seen)) {
            Seen other{hit, {}, seen.transparent, {}};
            other.hookPoints = seen.hookPoints;
            const glm::dvec3 otherRadiance = radianceOf(ray, other, Nudge());
            alternatives.push_back({otherRadiance, otherRadiance});
            addLeeway(ray, other, otherRadiance, alternatives);
            addShadowLeeway(ray, other, otherRadiance, alternatives);
        }
        if (isNoiseAlone && alternatives.size() == 1) rendered.shadowNoise[at] = lit.noise;
    }

    /// What a pixel shows.
    struct Seen {
        std::optional<Hit> opaque;            ///< nothing where a light hides it
        std::optional<SeenLights::Met> light; ///< before everything opaque
        std::vector<Hit> transparent;         ///< in the order in which they are blended
        /// By surface, the opaque one first, and by light: what Occlusion said, once it was asked.
        mutable std::vector<std::vector<std::optional<Occlusion::Answer>>> shadows{};
        mutable std::vector<std::vector<std::optional<Occlusion::Passage>>> passages{}; ///< the same
        mutable std::vector<std::optional<Diffusion::Answer>> spread{};                 ///< the same, by surface
        mutable std::vector<std::optional<Estimate>> surroundings{};                    ///< the same
        mutable std::vector<std::vector<std::optional<Estimate>>> areaLights{}; ///< by light too, nothing hidden
        mutable std::vector<std::optional<glm::dvec3>> throughBodies{};         ///< as surroundings
        std::uint32_t seed = 0;                                                 ///< of Diffusion and Surroundings
        /// Of the environment, where it is seen along a ray that a body bent; 0: by the camera.
        int throughBodyPaths = 0;
        HookPoints* hookPoints = nullptr; ///< null where no hook changes surfaces

        bool hasUndecidedShadows() const {
            for (const auto& ofSurface : shadows)
                for (const std::optional<Occlusion::Answer>& answer : ofSurface)
                    if (answer && answer->isUndecided) return true;
            for (const auto& ofSurface : passages)
                for (const std::optional<Occlusion::Passage>& passage : ofSurface)
                    if (passage && passage->isUndecided) return true;
            return false;
        }
    };

    /// Surfaces with a light before the opaque one; of the transparent ones stay those not behind `depthMetres`.
    static Seen behind(const Seen& surfaces, const std::optional<SeenLights::Met>& light, double depthMetres) {
        Seen seen = surfaces;
        seen.light = light;
        if (light) seen.opaque.reset();
        std::erase_if(seen.transparent, [&](const Hit& hit) { return hit.depthMetres > depthMetres; });
        return seen;
    }

    /// What else may be seen of lights at a pixel, where rounding decides: near an outline, or near another surface.
    std::vector<Seen> otherLights(const glm::dvec2& placePixels, const Seen& surfaces, const Seen& own) const {
        std::vector<Seen> others;
        const auto isKnown = [](const Seen& a, const Seen& b) {
            return a.light.has_value() == b.light.has_value() && (!a.light || a.light->light == b.light->light) &&
                   a.transparent.size() == b.transparent.size();
        };
        const Anchor& anchor = objects_.anchor();
        for (const glm::dvec2& aside : kAsidePixels) {
            const Ray ray = rays_.through(placePixels + aside);
            if (!own.light && !seenLights_.before(ray, kEndless)) continue;
            const std::optional<Hit> opaque = surfaces.opaque ? visibility_.nearestOpaque(ray) : std::nullopt;
            const double depthMetres = opaque ? opaque->depthMetres : kEndless;
            for (const double side : {-1.0, 1.0}) {
                const auto moved = [&](double metres) {
                    if (std::isinf(metres)) return metres;
                    const double reach =
                        anchor.radiusMetres > 0.0 ? anchor.radiusMetres + anchor.otherOriginMetres : metres;
                    return metres + side * (objects_.roundingMetres() + kDepthRounding * reach);
                };
                const std::optional<SeenLights::Met> met = seenLights_.before(ray, moved(depthMetres));
                const Seen other = behind(surfaces, met, met ? moved(met->depthMetres) : kEndless);
                const auto isSame = [&](const Seen& known) { return isKnown(known, other); };
                if (!isSame(own) && std::ranges::none_of(others, isSame)) others.push_back(other);
            }
        }
        return others;
    }

    std::vector<Hit> coincidentWith(const Ray& ray, const Seen& seen) const {
        std::vector<Hit> others;
        if (!seen.opaque) return others;
        const Hit& nearest = *seen.opaque;
        const double leewayMetres = nearest.roundingMetres + objects_.roundingMetres();
        for (const Hit& hit : visibility_.opaqueBefore(ray, nearest.depthMetres + leewayMetres)) {
            const bool isOther = hit.object != nearest.object || hit.triangle != nearest.triangle;
            if (isOther && areCoincident(hit, nearest) &&
                opacitiesOf(hit).second >= double(hit.object->material->alphaCutoff))
                others.push_back(hit);
        }
        return others;
    }

    bool isUndecided(const Seen& seen) const {
        const auto open = [this](const Hit& hit) { return reference::isUndecided(hit, textures_); };
        return (seen.opaque && open(*seen.opaque)) ||
               std::any_of(seen.transparent.begin(), seen.transparent.end(), open);
    }

    /// What surfaces with this radiance may show besides: the ends of each leeway, and by hardware all between them.
    void addLeeway(const Ray& ray, const Seen& seen, const glm::dvec3& radiance,
                   std::vector<Span>& alternatives) const {
        if (!isUndecided(seen)) return;
        Span span{radiance, radiance};
        for (const Nudge& nudge : nudges()) {
            const glm::dvec3 other = radianceOf(ray, seen, nudge);
            span = {glm::min(span.least, other), glm::max(span.most, other)};
            if (settings_.filtering == Filtering::Exact) alternatives.push_back({other, other});
        }
        if (settings_.filtering == Filtering::Hardware) alternatives.push_back(span);
    }

    /// What the surfaces may show where rounding decides whether a light is hidden: anything from all such lights
    /// hidden to none of them.
    void addShadowLeeway(const Ray& ray, const Seen& seen, const glm::dvec3& radiance,
                         std::vector<Span>& alternatives) const {
        const Span span{radianceOf(ray, seen, Nudge(), Shadows::Most), radianceOf(ray, seen, Nudge(), Shadows::Least)};
        if (span.least == radiance && span.most == radiance) return;
        alternatives.push_back({glm::min(span.least, radiance), glm::max(span.most, radiance)});
    }

    /// The ends of every leeway: all surfaces of a pixel go the same way, as they share the ray.
    static const std::vector<Nudge>& nudges() {
        static const std::vector<Nudge> all = [] {
            const glm::ivec2 corners[] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
            std::vector<Nudge> ends;
            for (const int level : {-1, 0, 1}) {
                for (const glm::ivec2& corner : corners) ends.push_back({corner, level, {}});
            }
            for (const int level : {-1, 0, 1}) {
                for (const glm::ivec2& corner : corners) ends.push_back({{}, level, corner});
            }
            for (const int level : {-1, 1}) ends.push_back({{}, level, {}});
            return ends;
        }();
        return all;
    }

    /// What is shown of shadows: the definition's, or where rounding decides all or none of them.
    enum class Shadows { Exact, Most, Least };

    struct Lit {
        glm::dvec3 radiance{0.0};
        double opacity = 1.0;
        glm::dvec3 passed{0.0};   ///< what it shows, where it covers, of the radiance behind it, by channel
        Noise noise = {};         ///< as Rendered::shadowNoise
        Estimate areaLights = {}; ///< as Rendered::areaLights
    };

    Lit litBy(const Ray& ray, const Seen& seen, const Nudge& nudge, Shadows shadows = Shadows::Exact) const {
        Lit all{surroundings_.isSeen() ? surroundings_.radianceOf(glm::normalize(ray.direction))
                                       : glm::dvec3(scene_.background)};
        if (seen.light) all.radiance = seen.light->factor * lights_[seen.light->light].color;
        if (seen.opaque) all = litSurface(seen, 0, nudge, ray, shadows);
        for (std::size_t i = 0; i < seen.transparent.size(); ++i) {
            const Lit own = litSurface(seen, 1 + i, nudge, ray, shadows);
            const glm::dvec3 before = 1.0 - own.opacity + own.opacity * own.passed;
            all.radiance = own.opacity * own.radiance + before * all.radiance;
            all.noise = all.noise.times(std::max({before.r, before.g, before.b})); // at most
            all.noise += own.noise.times(own.opacity);
            all.areaLights = all.areaLights.times(before);
            all.areaLights += own.areaLights.times(own.opacity);
        }
        return all;
    }
    glm::dvec3 radianceOf(const Ray& ray, const Seen& seen, const Nudge& nudge,
                          Shadows shadows = Shadows::Exact) const {
        return litBy(ray, seen, nudge, shadows).radiance;
    }

    SurfacePoint nudged(Hit hit, const Nudge& nudge, HookPoints* hookPoints) const {
        hit.nudge = nudge;
        const auto place = std::size_t(hit.object->material - scene_.materials.data());
        if (hookPoints == nullptr || !scene_.hook->changes(place)) return surfaceAt(hit, textures_);
        return surfaceAt(hit, textures_, [&](SurfacePoint& point) { hookPoints->change(hit, point); });
    }

    /// One of the surfaces, numbered as in Seen::shadows.
    Lit litSurface(const Seen& seen, std::size_t surface, const Nudge& nudge, const Ray& ray, Shadows shadows) const {
        const Hit& hit = surface == 0 ? *seen.opaque : seen.transparent[surface - 1];
        const SurfacePoint point = nudged(hit, nudge, seen.hookPoints);
        if (seen.hookPoints != nullptr && !seen.hookPoints->areKnown()) return {glm::dvec3(0.0), point.opacity};
        if (!scenes::infoOf(point.model).isLit) return {point.emission + point.color, point.opacity};
        const glm::dvec3 positionRWS = ray.at(hit.depthMetres);
        const glm::dvec3 toViewer = seen.throughBodyPaths > 0 ? hit.toViewer : rays_.toViewer(positionRWS);
        Lit lit{emitted(point, toViewer), point.opacity};
        if (point.transmission > 0.0) addPassing(seen, surface, point, ray, hit, toViewer, lit);
        if (surroundings_.lights()) {
            if (seen.surroundings.size() <= surface) seen.surroundings.resize(surface + 1);
            // The rounding that a nudge stands for changes this light less than its samples do.
            if (!seen.surroundings[surface])
                seen.surroundings[surface] =
                    surroundings_.on(point, toViewer, settings_.specular, point.spreads, seen.seed,
                                     seen.throughBodyPaths > 0 ? seen.throughBodyPaths : settings_.environmentPaths);
            lit.radiance += seen.surroundings[surface]->light;
        }
        for (std::size_t light = 0; light < lights_.size(); ++light) {
            const bool isArea = scenes::infoOf(lights_[light].light.type).isArea;
            const Estimate found = isArea ? areaLightOn(seen, surface, nudge, point, light, positionRWS, toViewer)
                                          : Estimate{lightOn(point, lights_[light], positionRWS, toViewer)};
            const glm::dvec3& unhidden = found.light;
            if (unhidden == glm::dvec3(0.0)) continue;
            const Occlusion::Answer answer = shadowOf(seen, surface, hit, point, positionRWS, toViewer, light);
            const double share = shadows == Shadows::Exact  ? answer.share
                                 : shadows == Shadows::Most ? answer.least
                                                            : answer.most;
            lit.radiance += share * unhidden;
            lit.noise += answer.noise.times(unhidden.r + unhidden.g + unhidden.b);
            if (isArea) lit.areaLights += found.times(share);
        }
        if (point.spreads) {
            if (seen.spread.size() <= surface) seen.spread.resize(surface + 1);
            if (!seen.spread[surface]) seen.spread[surface] = diffusion_.at(hit, positionRWS, seen.seed);
            lit.radiance += seen.spread[surface]->light *
                            leaving(point, toViewer, double(hit.object->material->subsurface.preScatterShare));
        } else if (point.passes) {
            lit.radiance += passedOnBy(seen, surface, hit, point, positionRWS, toViewer, shadows);
        }
        return lit;
    }

    /// What shows through: by a body what it bends rays to, where that is asked for or an environment lights, else what
    /// lies straight behind.
    void addPassing(const Seen& seen, std::size_t surface, const SurfacePoint& point, const Ray& ray, const Hit& hit,
                    const glm::dvec3& toViewer, Lit& lit) const {
        const glm::dvec3 share = transmitted(point, toViewer);
        const bool showsScene = settings_.bodiesShowScene && !objects_.opaque().empty();
        if (!point.hasBody || (!showsScene && !surroundings_.showsThroughBodies())) {
            lit.passed = share;
            return;
        }
        if (seen.throughBodies.size() <= surface) seen.throughBodies.resize(surface + 1);
        std::optional<glm::dvec3>& light = seen.throughBodies[surface];
        if (!light) light = throughBody(point, ray, hit, toViewer, showsScene, seen.seed);
        lit.radiance += share * *light;
    }

    glm::dvec3 throughBody(const SurfacePoint& point, const Ray& ray, const Hit& entry, const glm::dvec3& toViewer,
                           bool showsScene, std::uint32_t seed) const {
        const double depthMetres = entry.depthMetres;
        const auto along = [&](double ior) {
            const std::optional<glm::dvec3> bent = refracted(point, toViewer, ior);
            if (!bent) return glm::dvec3(0.0);
            glm::dvec3 originRWS = ray.at(depthMetres), direction = *bent;
            if (settings_.farSide == FarSide::Parallel) {
                // By the angle inside. The product holds its cosine to 1e-3.
                originRWS += point.bodyMetres / std::max(std::abs(glm::dot(*bent, point.normal)), 1e-3) * *bent;
                direction = -toViewer;
            }
            if (settings_.farSide == FarSide::BackFaces) {
                const Ray inside = bentRay(ray, depthMetres, originRWS, *bent);
                if (std::optional<Hit> leaving = visibility_.farSideAhead(inside, *entry.object)) {
                    leaving->toViewer = glm::dvec3(0.0); // who sees its back
                    originRWS = inside.at(leaving->depthMetres);
                    direction = leavingDirection(*bent, normalAt(*leaving, textures_), ior);
                }
            }
            if (!showsScene) return surroundings_.around(direction, point.passingAlpha, seed);
            return sceneAround(ray, depthMetres, originRWS, direction, point.passingAlpha, seed);
        };
        const glm::dvec3 iors = iorsOf(point);
        if (iors.r == iors.b) return along(iors.g);
        return {along(iors.r).r, along(iors.g).g, along(iors.b).b};
    }

    /// By angles to the normal; what is reflected there leaves unbent. An index of 0 is one without bound.
    static glm::dvec3 leavingDirection(const glm::dvec3& bent, const glm::dvec3& normal, double ior) {
        const glm::dvec3 outward = glm::dot(normal, bent) < 0.0 ? -normal : normal;
        const double angle = std::acos(std::clamp(glm::dot(outward, bent), -1.0, 1.0)), sine = std::sin(angle);
        const glm::dvec3 across = bent - std::cos(angle) * outward;
        if (glm::length(across) < 1e-12) return bent;
        if (ior == 0.0 || ior * sine > 1.0) return bent - 2.0 * std::cos(angle) * outward;
        const double leaving = std::asin(ior * sine);
        return std::cos(leaving) * outward + std::sin(leaving) * glm::normalize(across);
    }

    /// A ray that goes on elsewhere, with the footprint that the pixel's own has by then.
    static Ray bentRay(const Ray& ray, double depthMetres, const glm::dvec3& originRWS, const glm::dvec3& direction) {
        return {originRWS,
                direction,
                ray.originDx + depthMetres * ray.directionDx,
                ray.originDy + depthMetres * ray.directionDy,
                ray.directionDx,
                ray.directionDy};
    }

    /// Opaque surfaces and lights around a direction, and what is seen between them: the environment that lights the
    /// scene, else the background.
    glm::dvec3 sceneAround(const Ray& ray, double depthMetres, const glm::dvec3& originRWS, const glm::dvec3& direction,
                           double alpha, std::uint32_t seed) const {
        const auto meetsAny = [&](const glm::dvec3& way) {
            const Ray bent = bentRay(ray, depthMetres, originRWS, way);
            return visibility_.nearestOpaqueAhead(bent) || seenLights_.ahead(bent, kEndless);
        };
        const bool hasEnvironment = surroundings_.showsThroughBodies();
        const glm::dvec3 surfaces =
            Surroundings::meanAround(direction, alpha, seed, settings_.bodyPaths, [&](const glm::dvec3& way) {
                const Ray bent = bentRay(ray, depthMetres, originRWS, way);
                const std::optional<Hit> hit = visibility_.nearestOpaqueAhead(bent);
                if (const auto met = seenLights_.ahead(bent, hit ? hit->depthMetres : kEndless))
                    return met->factor * lights_[met->light].color;
                if (!hit) return hasEnvironment ? glm::dvec3(0.0) : glm::dvec3(scene_.background);
                Seen seen{hit, {}, {}};
                seen.seed = seed;
                // A rough body shows many surfaces in a pixel.
                seen.throughBodyPaths = alpha <= kSmallestAlpha
                                            ? settings_.environmentPaths
                                            : std::max(settings_.environmentPaths / settings_.bodyPaths, 16);
                return litSurface(seen, 0, Nudge(), bent, Shadows::Exact).radiance;
            });
        if (!hasEnvironment) return surfaces;
        return surfaces + surroundings_.around(direction, alpha, seed, meetsAny);
    }

    /// What all lights below the horizon give.
    glm::dvec3 passedOnBy(const Seen& seen, std::size_t surface, const Hit& hit, const SurfacePoint& point,
                          const glm::dvec3& positionRWS, const glm::dvec3& toViewer, Shadows shadows) const {
        glm::dvec3 radiance(0.0);
        for (std::size_t light = 0; light < lights_.size(); ++light) {
            const Incident incident = incidentAt(lights_[light], positionRWS);
            if (!lights_[light].castsShadow || incident.irradiance == glm::dvec3(0.0)) continue;
            const glm::dvec3 whole = passedOn(point, incident.toLight, toViewer) * incident.irradiance;
            if (whole == glm::dvec3(0.0)) continue;
            if (seen.passages.size() <= surface) seen.passages.resize(surface + 1);
            auto& known = seen.passages[surface];
            known.resize(lights_.size());
            if (!known[light])
                known[light] = occlusion_.passageOf(lights_[light], hit, point, positionRWS, settings_.leeway);
            const Occlusion::Passage& passage = *known[light];
            radiance += whole * (shadows == Shadows::Exact  ? passage.share
                                 : shadows == Shadows::Most ? passage.least
                                                            : passage.most);
        }
        return radiance;
    }

    Occlusion::Answer shadowOf(const Seen& seen, std::size_t surface, const Hit& hit, const SurfacePoint& point,
                               const glm::dvec3& positionRWS, const glm::dvec3& toViewer, std::size_t light) const {
        if (!lights_[light].castsShadow) return {};
        if (seen.shadows.size() <= surface) seen.shadows.resize(surface + 1);
        std::vector<std::optional<Occlusion::Answer>>& known = seen.shadows[surface];
        known.resize(lights_.size());
        if (!known[light]) known[light] = occlusion_.of(lights_[light], hit, point, positionRWS, toViewer, settings_);
        return *known[light];
    }

    /// What one light gives to a point that nothing hides from it: radiance towards the viewer. Of light that spreads
    /// only the highlight leaves where it is met.
    glm::dvec3 lightOn(const SurfacePoint& point, const ShiningLight& light, const glm::dvec3& positionRWS,
                       const glm::dvec3& toViewer) const {
        const Incident incident = incidentAt(light, positionRWS);
        if (incident.irradiance == glm::dvec3(0.0)) return glm::dvec3(0.0);
        glm::dvec3 share = reflected(point, incident.toLight, toViewer, settings_.specular);
        if (point.spreads) share -= reflected(point, incident.toLight, toViewer, false);
        return share * incident.irradiance;
    }

    /// The same of an area light.
    Estimate areaLightOn(const Seen& seen, std::size_t surface, const Nudge& nudge, const SurfacePoint& point,
                         std::size_t light, const glm::dvec3& positionRWS, const glm::dvec3& toViewer) const {
        // What other values of a texture change need not be known better.
        constexpr double kNudgedTolerance = 1e-3;
        const bool isNudged = !(nudge == Nudge());
        Settings settings = settings_;
        if (isNudged || seen.throughBodyPaths > 0)
            settings.areaTolerance = std::max(settings.areaTolerance, kNudgedTolerance);
        const auto integral = [&] {
            return reflectedOf(lights_[light], point, positionRWS, toViewer, settings_.specular, point.spreads,
                               settings);
        };
        if (isNudged) return integral();
        if (seen.areaLights.size() <= surface) seen.areaLights.resize(surface + 1);
        std::vector<std::optional<Estimate>>& known = seen.areaLights[surface];
        known.resize(lights_.size());
        if (!known[light]) known[light] = integral();
        return *known[light];
    }

    const scenes::Scene& scene_;
    const Settings& settings_;
    CameraRays rays_;
    std::vector<ShiningLight> lights_;
    SeenLights seenLights_;
    Objects objects_;
    Textures textures_;
    Visibility visibility_;
    Surroundings surroundings_;
    Occlusion occlusion_;
    Diffusion diffusion_;
};

std::uint32_t transparentId(std::uint32_t objectNumber, std::uint32_t triangle) {
    // Two rounds of a multiplicative hash; both factors are odd, so that no bit of either number is lost.
    const std::uint32_t mixed = (objectNumber + 1u) * 0x9E3779B1u + triangle * 0x85EBCA6Bu;
    return (mixed ^ (mixed >> 15)) * 0xC2B2AE35u >> 16;
}

namespace {

/// A few rows at once, which bounds the memory that their points take.
void renderHooked(const Pixels& picture, const RunHook& runHook, Rendered& rendered,
                  const std::function<void()>& rowDone) {
    constexpr int kRowsAtOnce = 32;
    const auto width = std::size_t(rendered.width);
    for (int first = 0; first < rendered.height; first += kRowsAtOnce) {
        const int end = std::min(first + kRowsAtOnce, rendered.height);
        std::vector<HookPoints> points(std::size_t(end - first) * width);
        const auto draw = [&](int row) {
            picture.hookedRow(row, rendered, std::span(points).subspan(std::size_t(row - first) * width, width));
        };
        tbb::parallel_for(first, end, draw);
        std::vector<scenes::HookPoint> asked;
        for (const HookPoints& own : points) asked.insert(asked.end(), own.asked().begin(), own.asked().end());
        const std::vector<scenes::HookedSurface> known = runHook(asked);
        std::size_t from = 0;
        for (HookPoints& own : points) {
            const std::size_t count = own.asked().size();
            own.know(std::span(known).subspan(from, count));
            from += count;
        }
        tbb::parallel_for(first, end, [&](int row) {
            draw(row);
            rowDone();
        });
    }
}

} // namespace

Rendered render(const scenes::Scene& scene, const Settings& settings, const std::function<void()>& rowDone) {
    Rendered rendered;
    rendered.width = settings.sizePixels.x;
    rendered.height = settings.sizePixels.y;
    const std::size_t pixels = std::size_t(rendered.width) * std::size_t(rendered.height);
    rendered.radiance.resize(pixels);
    rendered.covered.resize(pixels);
    rendered.ids.resize(pixels);
    rendered.alternatives.resize(pixels);
    rendered.undecidedShadows.resize(pixels);
    rendered.shadowNoise.resize(pixels);
    rendered.spread.resize(pixels);
    rendered.surroundings.resize(pixels);
    rendered.areaLights.resize(pixels);
    const Pixels picture(scene, settings);
    if (settings.runHook) {
        renderHooked(picture, settings.runHook, rendered, rowDone);
        return rendered;
    }
    tbb::parallel_for(0, rendered.height, [&](int row) {
        picture.row(row, rendered);
        rowDone();
    });
    return rendered;
}

struct Probe::Seen {
    Settings settings;
    Pixels pixels;
    Seen(const scenes::Scene& scene, const Settings& asked) : settings(asked), pixels(scene, settings) {}
};

Probe::Probe(const scenes::Scene& scene, const Settings& settings) : seen_(new Seen(scene, settings)) {}
Probe::~Probe() = default;

Layers Probe::at(const glm::dvec2& placePixels) const {
    return seen_->pixels.layers(placePixels);
}

} // namespace tessera::reference
