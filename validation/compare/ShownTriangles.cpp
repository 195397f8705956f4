#include "validation/compare/ShownTriangles.h"

#include <algorithm>
#include <array>
#include <map>
#include <span>

#include <tbb/parallel_for.h>

#include "validation/compare/ReferencePicture.h"

namespace tessera::validation {

namespace {

using reference::Ids;
using reference::Layers;

/// Rays per pixel: the centre, eight at a distance of kEdgeShiftPixels, and eight at a quarter of it, which hit slivers
/// thinner than kEdgeShiftPixels.
constexpr std::size_t kRays = 17;

/// An id read from a float image, which is exact below 2^24. Values that cannot be an id become ~0.
std::uint32_t drawnId(float id) {
    constexpr std::uint32_t kNoId = ~0u;
    return id >= 0.0f && id < 0x1p32f ? std::uint32_t(id) : kNoId;
}

Ids asDrawn(const Ids& ids) {
    return {drawnId(float(ids.object)), drawnId(float(ids.triangle)), drawnId(float(ids.transparent))};
}

Layers layersAt(const reference::Probe& probe, const glm::dvec2& placePixels) {
    Layers layers = probe.at(placePixels);
    layers.ids = asDrawn(layers.ids);
    for (Layers::Other& other : layers.others) other.ids = asDrawn(other.ids);
    return layers;
}

std::array<Layers, kRays> layersAround(const reference::Probe& probe, const glm::dvec2& centrePixels) {
    std::array<Layers, kRays> layers{layersAt(probe, centrePixels)};
    std::size_t next = 0;
    for (const double shift : {kEdgeShiftPixels, 0.25 * kEdgeShiftPixels})
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x)
                if (x != 0 || y != 0) layers[++next] = layersAt(probe, centrePixels + shift * glm::dvec2(x, y));
    return layers;
}

/// The ids of both images, rows from the top.
struct IdPictures {
    glm::ivec2 size;
    const std::vector<Ids>& shown; ///< by the GPU
    const std::vector<Ids>& truth;

    template <class Holds>
    bool anyNeighbour(const std::vector<Ids>& ids, std::size_t at, const Holds& holds) const {
        const int x = int(at) % size.x, y = int(at) / size.x;
        for (int row = std::max(y - 1, 0); row <= std::min(y + 1, size.y - 1); ++row) {
            for (int column = std::max(x - 1, 0); column <= std::min(x + 1, size.x - 1); ++column) {
                if ((row != y || column != x) &&
                    holds(ids[std::size_t(row) * std::size_t(size.x) + std::size_t(column)]))
                    return true;
            }
        }
        return false;
    }
};

bool isAmong(const Ids& shown, const std::vector<Layers::Other>& others) {
    return std::any_of(others.begin(), others.end(), [&](const Layers::Other& other) { return other.ids == shown; });
}

/// Whether the GPU shows another of several coincident triangles than the reference: such a pixel can be compared.
bool isCoincident(const Ids& shown, const Layers& centre) {
    return std::any_of(centre.others.begin(), centre.others.end(),
                       [&](const Layers::Other& other) { return other.isCoincident && other.ids == shown; });
}

bool isRounding(const IdPictures& pictures, std::size_t at, std::span<const Layers, kRays> rays) {
    const Ids& shown = pictures.shown[at];
    const Ids& truth = pictures.truth[at];
    const auto anyRay = [&](const auto& holds) {
        return std::any_of(rays.begin(), rays.end(), [&](const Layers& ray) { return holds(ray.ids); });
    };
    if (anyRay([&](const Ids& ids) { return ids == shown; })) return true;
    if (std::any_of(rays.begin(), rays.end(), [&](const Layers& ray) { return isAmong(shown, ray.others); }))
        return true;
    if (!anyRay([&](const Ids& ids) { return ids != truth; })) return false;
    const bool isAtEdge = pictures.anyNeighbour(pictures.shown, at, [&](const Ids& ids) { return ids != shown; });
    const bool isSwapped = pictures.anyNeighbour(pictures.shown, at, [&](const Ids& ids) {
        return ids.object == truth.object;
    }) && pictures.anyNeighbour(pictures.truth, at, [&](const Ids& ids) { return ids.object == shown.object; });
    const bool isObjectNear = anyRay([&](const Ids& ids) { return ids.object == shown.object; });
    const bool isTransparencyOpen = shown.transparent == truth.transparent ||
                                    anyRay([&](const Ids& ids) { return ids.transparent != truth.transparent; });
    return isAtEdge && (isSwapped || isObjectNear) && isTransparencyOpen;
}

/// An instance's place in the scene.
struct Instance {
    const scenes::Node* node;
    const scenes::Mesh* mesh;
    const scenes::Material* material;
};

std::vector<Instance> instancesOf(const scenes::Scene& scene) {
    std::vector<Instance> instances;
    for (const scenes::Node& node : scene.nodes) {
        for (const scenes::MeshInstance& instance : node.instances) {
            instances.push_back(
                {&node, &scene.meshes[std::size_t(instance.mesh)], &scene.materials[std::size_t(instance.material)]});
        }
    }
    return instances;
}

/// A loss at a pixel that rounding does not explain. Instances count from 1 here, 0 is unknown.
using Loss = std::pair<LostKind, std::uint32_t>;

/// The transparent instance whose absence alone explains the sum, else the first one on the ray.
std::uint32_t missingTransparent(const Layers& truth, std::uint32_t shownSum, LostKind& kind) {
    for (const Layers::Layer& layer : truth.transparent) {
        std::uint32_t without = 0;
        for (const Layers::Layer& other : truth.transparent)
            if (other.object != layer.object) without += other.id;
        if (without == shownSum) {
            kind = LostKind::Missing;
            return layer.object;
        }
    }
    return truth.transparent.empty() ? 0 : truth.transparent.front().object;
}

std::vector<Loss> lossesAt(const Ids& shown, const Layers& truth) {
    if (shown.object != truth.ids.object)
        return {truth.ids.object != 0 ? Loss{LostKind::Missing, truth.ids.object}
                                      : Loss{LostKind::Extra, shown.object}};
    if (shown.transparent == truth.ids.transparent) return {{LostKind::OtherTriangles, shown.object}};
    std::vector<Loss> losses;
    if (shown.transparent == 0) {
        for (const Layers::Layer& layer : truth.transparent) losses.emplace_back(LostKind::Missing, layer.object);
    } else {
        LostKind kind = LostKind::Transparent;
        const std::uint32_t object = missingTransparent(truth, shown.transparent, kind);
        losses.emplace_back(kind, object);
    }
    std::sort(losses.begin(), losses.end());
    losses.erase(std::unique(losses.begin(), losses.end()), losses.end()); // its front and its back
    return losses;
}

std::vector<Ids> drawnIds(engine::Renderer& renderer, const frame::FrameSettings& settings) {
    frame::FrameSettings view = settings;
    view.view = frame::DebugView::Ids;
    view.display = false;
    view.culling = {};
    view.lightOn.reset();
    const std::vector<float> drawn = renderer.render(engine::Technique::Forward, view).radiance;
    std::vector<Ids> ids(drawn.size() / 4);
    for (std::size_t i = 0; i < ids.size(); ++i)
        ids[i] = {drawnId(drawn[4 * i]), drawnId(drawn[4 * i + 1]), drawnId(drawn[4 * i + 2])};
    return ids;
}

} // namespace

ShownTriangles shownTriangles(engine::Renderer& renderer, const frame::FrameSettings& settings,
                              const std::vector<Ids>& ids) {
    const std::vector<Ids> shown = drawnIds(renderer, settings);
    std::vector<Ids> truth(ids.size());
    std::transform(ids.begin(), ids.end(), truth.begin(), asDrawn);
    const IdPictures pictures{settings.sizePixels, shown, truth};
    const std::vector<Instance> instances = instancesOf(renderer.scene());
    ShownTriangles result;
    result.excluded.resize(ids.size());
    std::vector<std::size_t> open; // pixels to explain
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (shown[i] != truth[i]) open.push_back(i);
    }
    if (open.empty()) return result;

    const reference::Probe probe(renderer.scene(), referenceSettings(renderer.scene(), settings));
    std::vector<std::vector<Loss>> losses(open.size());
    tbb::parallel_for(std::size_t(0), open.size(), [&](std::size_t k) {
        const std::size_t at = open[k], width = std::size_t(pictures.size.x);
        const auto rays = layersAround(probe, {double(at % width) + 0.5, double(at / width) + 0.5});
        if (isCoincident(shown[at], rays.front())) return;
        if (isRounding(pictures, at, rays))
            result.excluded[at] = 1;
        else
            losses[k] = lossesAt(shown[at], rays.front());
    });
    std::map<Loss, LostGeometry> lost;
    for (std::size_t k = 0; k < open.size(); ++k) {
        for (const Loss& loss : losses[k]) {
            LostGeometry& entry = lost[loss];
            if (entry.pixels++ > 0) continue;
            entry.kind = loss.first;
            entry.x = int(open[k]) % pictures.size.x;
            entry.y = int(open[k]) / pictures.size.x;
            if (loss.second == 0 || loss.second > instances.size()) continue; // no instance of the scene
            entry.instance = loss.second - 1;
            entry.node = instances[*entry.instance].node->name;
            entry.mesh = instances[*entry.instance].mesh->name;
        }
    }
    for (auto& [loss, entry] : lost) result.lost.push_back(std::move(entry));
    std::stable_sort(result.lost.begin(), result.lost.end(),
                     [](const LostGeometry& a, const LostGeometry& b) { return a.pixels > b.pixels; });
    return result;
}

} // namespace tessera::validation
