#include "validation/reference/Render.h"

#include <algorithm>
#include <span>

#include <tbb/parallel_for.h>

#include "validation/reference/Shading.h"
#include "validation/reference/Slots.h"

namespace tessera::reference {

namespace {

/// Renders the pixels of an image one by one, with the alternatives that the definition allows each.
class Pixels {
public:
    Pixels(const scenes::Scene& scene, const Settings& settings)
        : settings_(settings), sight_(scene, settings), shading_(scene, settings, sight_) {}

    void row(int row, Rendered& rendered) const {
        for (int column = 0; column < rendered.width; ++column)
            pixel(sight_.rays().through(column, row), placeOf(column, row, rendered), rendered, nullptr);
    }

    /// The same where the scene's hook changes surfaces, `points` by column. While they are unknown, pixels only
    /// collect them, and all other results are discarded.
    void hookedRow(int row, Rendered& rendered, std::span<HookPoints> points) const {
        for (int column = 0; column < rendered.width; ++column) {
            const std::size_t at = placeOf(column, row, rendered);
            HookPoints& own = points[std::size_t(column)];
            const bool isPending = !own.areKnown();
            pixel(sight_.rays().through(column, row), at, rendered, &own);
            if (!isPending) continue;
            rendered.ids[at] = {};
            rendered.covered[at] = 0;
            rendered.alternatives[at].clear();
        }
    }

private:
    static std::size_t placeOf(int column, int row, const Rendered& rendered) {
        return std::size_t(row) * std::size_t(rendered.width) + std::size_t(column);
    }

    void pixel(const Ray& ray, std::size_t at, Rendered& rendered, HookPoints* hookPoints) const {
        const Seen surfaces = sight_.surfacesOf(ray);
        if (surfaces.opaque) {
            rendered.ids[at].object = 1 + surfaces.opaque->object->number;
            rendered.ids[at].triangle = surfaces.opaque->triangle;
            rendered.covered[at] = 1;
        }
        for (const Hit& hit : surfaces.transparent) {
            rendered.ids[at].transparent += transparentId(hit.object->number, hit.triangle);
            if (surfaceAt(hit, sight_.textures()).opacity > 0.0) rendered.covered[at] = 1;
        }
        Shown shown{ray, sight_.withLight(ray, surfaces), std::uint32_t(at), hookPoints, {}};
        if (shown.seen.light) rendered.covered[at] = 1;
        const Shading::Lit lit = shading_.shade(shown);
        rendered.radiance[at] = lit.radiance;
        rendered.areaLights[at] = lit.areaLights;
        for (int c = 0; c < 3; ++c)
            if (lit.radianceMore[c] > 0.0)
                rendered.errorWeights[at][c] = float(lit.radiance[c] / (lit.radiance[c] + lit.radianceMore[c]));
        if (shown.seen.opaque && !shown.memos.empty()) {
            const SurfaceMemo& memo = shown.memos[0];
            if (memo.diffused) rendered.diffused[at] = *memo.diffused;
            if (memo.surroundings) rendered.surroundings[at] = *memo.surroundings;
        }
        if (!settings_.findsAlternatives) return;
        std::vector<Span>& alternatives = rendered.alternatives[at];
        rendered.undecidedShadows[at] = shown.hasUndecidedShadows() ? 1 : 0;
        addTextureAlternatives(shown, lit.radiance, alternatives);
        const glm::dvec2 placePixels(double(at % std::size_t(rendered.width)) + 0.5,
                                     double(at / std::size_t(rendered.width)) + 0.5);
        for (const Seen& other : sight_.otherLights(placePixels, surfaces, shown.seen))
            addOther({ray, other, shown.seed, hookPoints, {}}, alternatives);
        const bool isNoiseAlone = alternatives.empty() && rendered.undecidedShadows[at] == 0;
        addShadowAlternatives(shown, lit.radiance, alternatives);
        for (const Hit& hit : sight_.coincidentWith(ray, shown.seen))
            addOther({ray, {hit, {}, shown.seen.transparent}, 0, hookPoints, {}}, alternatives);
        if (isNoiseAlone && alternatives.size() == 1) rendered.shadowNoise[at] = lit.noise;
    }

    /// Adds an alternative of a whole pixel, with its tolerances.
    void addOther(Shown other, std::vector<Span>& alternatives) const {
        const glm::dvec3 radiance = shading_.shade(other).radiance;
        alternatives.push_back({radiance, radiance});
        addTextureAlternatives(other, radiance, alternatives);
        addShadowAlternatives(other, radiance, alternatives);
    }

    /// Adds what these surfaces may show besides: the ends of each tolerance, and by hardware all between them.
    void addTextureAlternatives(Shown& shown, const glm::dvec3& radiance, std::vector<Span>& alternatives) const {
        if (!sight_.isUndecided(shown.seen)) return;
        Span span{radiance, radiance};
        for (const Nudge& nudge : nudges()) {
            const glm::dvec3 other = shading_.shade(shown, nudge).radiance;
            span = {glm::min(span.least, other), glm::max(span.most, other)};
            if (settings_.filtering == Filtering::Exact) alternatives.push_back({other, other});
        }
        if (settings_.filtering == Filtering::Hardware) alternatives.push_back(span);
    }

    /// Adds what the surfaces may show where rounding decides whether a light is hidden: anything from all such lights
    /// hidden to none of them.
    void addShadowAlternatives(Shown& shown, const glm::dvec3& radiance, std::vector<Span>& alternatives) const {
        const Span span{shading_.shade(shown, {}, Shading::Shadows::Most).radiance,
                        shading_.shade(shown, {}, Shading::Shadows::Least).radiance};
        if (span.least == radiance && span.most == radiance) return;
        alternatives.push_back({glm::min(span.least, radiance), glm::max(span.most, radiance)});
    }

    const Settings& settings_;
    Sight sight_;
    Shading shading_;
};

/// Renders a few rows at once, which bounds the memory of their points.
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
        std::vector<scenes::HookPoint> allRequested;
        for (const HookPoints& own : points)
            allRequested.insert(allRequested.end(), own.requested().begin(), own.requested().end());
        const std::vector<scenes::HookedSurface> known = runHook(allRequested);
        std::size_t from = 0;
        for (HookPoints& own : points) {
            const std::size_t count = own.requested().size();
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
    rendered.diffused.resize(pixels);
    rendered.surroundings.resize(pixels);
    rendered.areaLights.resize(pixels);
    rendered.errorWeights.assign(pixels, glm::vec3(1.0f));
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

struct Probe::Look {
    Settings settings;
    Sight sight;
    Look(const scenes::Scene& scene, const Settings& requested) : settings(requested), sight(scene, settings) {}
};

Probe::Probe(const scenes::Scene& scene, const Settings& settings) : look_(new Look(scene, settings)) {}
Probe::~Probe() = default;

Layers Probe::at(const glm::dvec2& placePixels) const {
    return look_->sight.layersOf(look_->sight.rays().through(placePixels));
}

} // namespace tessera::reference
