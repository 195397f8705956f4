#include "validation/reference/Sight.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/reference/MaterialAt.h"
#include "validation/reference/Slots.h"

namespace tessera::reference {

namespace {

constexpr double kUnboundedMetres = std::numeric_limits<double>::infinity();

/// A pixel's centre, and offsets beyond the movement of a visible light by fp32 rounding, whose main part is 1e-7 of
/// the image's width.
constexpr double kMovedPixels = 1.0 / 64.0;
constexpr glm::dvec2 kAsidePixels[] = {{0.0, 0.0},
                                       {-kMovedPixels, -kMovedPixels},
                                       {kMovedPixels, -kMovedPixels},
                                       {-kMovedPixels, kMovedPixels},
                                       {kMovedPixels, kMovedPixels}};
/// The same in depth, relative to the depths that depth values stand for.
constexpr double kDepthRounding = 4e-6;

/// Coincident triangles: their depths differ by no more than rounding to fp32 may move both.
bool areCoincident(const Hit& a, const Hit& b) {
    return std::abs(a.depthMetres - b.depthMetres) <= a.roundingMetres + b.roundingMetres;
}

/// Surfaces with a light in front of the opaque one; drops transparent surfaces behind `depthMetres`.
Seen behind(const Seen& surfaces, const std::optional<SeenLights::Met>& light, double depthMetres) {
    Seen seen = surfaces;
    seen.light = light;
    if (light) seen.opaque.reset();
    std::erase_if(seen.transparent, [&](const Hit& hit) { return hit.depthMetres > depthMetres; });
    return seen;
}

} // namespace

Sight::Sight(const scenes::Scene& scene, const Settings& settings)
    : rays_(settings.camera, settings.sizePixels), lights_(shiningLights(scene, settings, rays_.eyeWS())),
      seenLights_(lights_, rays_), objects_(scene, rays_, settings.subsurface, SeenLights::boxesRWS(lights_)),
      textures_(scene, settings.filtering), visibility_(objects_, rays_, textures_) {}

Seen Sight::surfacesOf(const Ray& ray) const {
    Seen seen;
    seen.opaque = visibility_.nearestOpaque(ray);
    seen.transparent = visibility_.transparentBefore(ray, seen.opaque ? seen.opaque->depthMetres : kUnboundedMetres);
    return seen;
}

Seen Sight::withLight(const Ray& ray, const Seen& surfaces) const {
    const std::optional<SeenLights::Met> met =
        seenLights_.before(ray, surfaces.opaque ? surfaces.opaque->depthMetres : kUnboundedMetres);
    return met ? behind(surfaces, met, met->depthMetres) : surfaces;
}

Seen Sight::ahead(const Ray& ray) const {
    Seen seen;
    seen.opaque = visibility_.nearestOpaqueAhead(ray);
    seen.light = seenLights_.ahead(ray, seen.opaque ? seen.opaque->depthMetres : kUnboundedMetres);
    if (seen.light) seen.opaque.reset();
    return seen;
}

Seen Sight::aheadThroughGlass(const Ray& ray, double fromMetres) const {
    Seen seen = ahead(ray);
    const double end = seen.opaque  ? seen.opaque->depthMetres
                       : seen.light ? seen.light->depthMetres
                                    : std::numeric_limits<double>::infinity();
    seen.transparent = visibility_.transparentAhead(ray, fromMetres, end);
    return seen;
}

Layers Sight::layersOf(const Ray& ray) const {
    const Seen seen = surfacesOf(ray);
    Layers found;
    const std::optional<Hit>& nearest = seen.opaque;
    if (nearest) {
        found.ids.object = 1 + nearest->object->number;
        found.ids.triangle = nearest->triangle;
    }
    for (const Hit& hit : seen.transparent) {
        found.transparent.push_back({1 + hit.object->number, transparentId(hit.object->number, hit.triangle)});
        found.ids.transparent += found.transparent.back().id;
    }
    addOthers(ray, nearest, found);
    return found;
}

/// Surfaces that may be the nearest, up to the first without a hole there within its texture's tolerance.
std::vector<Hit> Sight::candidates(const Ray& ray) const {
    std::vector<Hit> found;
    std::optional<Hit> solid;
    for (const Hit& hit : visibility_.opaqueBefore(ray, kUnboundedMetres)) {
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

/// The range of opacities within the texture's tolerance; infinite where no mask cuts.
std::pair<double, double> Sight::opacitiesOf(Hit hit) const {
    if (hit.object->material->alphaMode != scenes::AlphaMode::Mask) return {kUnboundedMetres, kUnboundedMetres};
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

void Sight::addOthers(const Ray& ray, const std::optional<Hit>& nearest, Layers& found) const {
    for (const Hit& hit : candidates(ray)) {
        Layers::Other other{{1 + hit.object->number, hit.triangle, 0}, nearest && areCoincident(hit, *nearest)};
        for (const Hit& before : visibility_.transparentBefore(ray, hit.depthMetres))
            other.ids.transparent += transparentId(before.object->number, before.triangle);
        if (other.ids != found.ids) found.others.push_back(other);
    }
}

std::vector<Seen> Sight::otherLights(const glm::dvec2& placePixels, const Seen& surfaces, const Seen& own) const {
    std::vector<Seen> others;
    const auto isKnown = [](const Seen& a, const Seen& b) {
        return a.light.has_value() == b.light.has_value() && (!a.light || a.light->light == b.light->light) &&
               a.transparent.size() == b.transparent.size();
    };
    const Anchor& anchor = objects_.anchor();
    for (const glm::dvec2& aside : kAsidePixels) {
        const Ray ray = rays_.through(placePixels + aside);
        if (!own.light && !seenLights_.before(ray, kUnboundedMetres)) continue;
        const std::optional<Hit> opaque = surfaces.opaque ? visibility_.nearestOpaque(ray) : std::nullopt;
        const double depthMetres = opaque ? opaque->depthMetres : kUnboundedMetres;
        for (const double side : {-1.0, 1.0}) {
            const auto moved = [&](double metres) {
                if (std::isinf(metres)) return metres;
                const double reach =
                    anchor.radiusMetres > 0.0 ? anchor.radiusMetres + anchor.otherOriginMetres : metres;
                return metres + side * (objects_.roundingMetres() + kDepthRounding * reach);
            };
            const std::optional<SeenLights::Met> met = seenLights_.before(ray, moved(depthMetres));
            const Seen other = behind(surfaces, met, met ? moved(met->depthMetres) : kUnboundedMetres);
            const auto isSame = [&](const Seen& known) { return isKnown(known, other); };
            if (!isSame(own) && std::ranges::none_of(others, isSame)) others.push_back(other);
        }
    }
    return others;
}

std::vector<Hit> Sight::coincidentWith(const Ray& ray, const Seen& seen) const {
    std::vector<Hit> others;
    if (!seen.opaque) return others;
    const Hit& nearest = *seen.opaque;
    const double toleranceMetres = nearest.roundingMetres + objects_.roundingMetres();
    for (const Hit& hit : visibility_.opaqueBefore(ray, nearest.depthMetres + toleranceMetres)) {
        const bool isOther = hit.object != nearest.object || hit.triangle != nearest.triangle;
        if (isOther && areCoincident(hit, nearest) &&
            opacitiesOf(hit).second >= double(hit.object->material->alphaCutoff))
            others.push_back(hit);
    }
    return others;
}

bool Sight::isUndecided(const Seen& seen) const {
    const auto open = [this](const Hit& hit) { return reference::isUndecided(hit, textures_); };
    return (seen.opaque && open(*seen.opaque)) || std::any_of(seen.transparent.begin(), seen.transparent.end(), open);
}

} // namespace tessera::reference
