#include "renderer/frame/Diffusion.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/InUse.h"
#include "shaders/shared/diffusion.h"

namespace tessera::frame {

namespace {

constexpr int kMostGutterTexels = 64;
constexpr std::size_t kMostLevels = 32;

std::string nameOf(const scenes::Scene& scene, const scenes::Node& node, int mesh) {
    const std::string& name = scene.meshes[std::size_t(mesh)].name;
    if (!name.empty()) return fmt::format("mesh '{}'", name);
    if (!node.name.empty()) return fmt::format("the mesh of node '{}'", node.name);
    return fmt::format("mesh {}", mesh);
}

double meanOf(const glm::dvec3& weight) {
    return (weight.r + weight.g + weight.b) / 3.0;
}

} // namespace

std::vector<DiffusionObject> diffusionObjects(const scenes::Scene& scene, scenes::SubsurfaceRequest subsurface,
                                              std::span<const SurfaceBounds> bounds) {
    std::vector<DiffusionObject> objects;
    if (!scenes::anyDiffuses(scene, subsurface)) return objects;
    int number = 0;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node) {
        for (const scenes::MeshInstance& instance : scene.nodes[node].instances) {
            const int own = number++;
            if (!scenes::diffuses(scene, instance, subsurface)) continue;
            DiffusionObject& object = objects.emplace_back();
            object = {int(node),
                      instance.mesh,
                      instance.material,
                      own,
                      {},
                      0.0,
                      nameOf(scene, scene.nodes[node], instance.mesh)};
            const auto found = std::ranges::find(bounds, own, &SurfaceBounds::instance);
            if (found == bounds.end()) continue;
            object.boxWS = found->boxWS;
            object.sideMetres = found->textureSideMetres;
        }
    }
    return objects;
}

DiffusionKernel diffusionKernel(const scenes::Subsurface& subsurface, int mostGaussians, double texelMetres,
                                bool isHalved) {
    // Holds total variances here, not yet the increments of DiffusionKernel::levels.
    std::vector<DiffusionLevel> levels;
    const scenes::DiffusionProfile& profile = scenes::profileOf(subsurface);
    glm::dvec3 sum(0.0);
    for (const scenes::DiffusionGaussian& gaussian : profile) {
        const double metres = 1e-3 / double(subsurface.scaleMetres); // scene metres per millimetre
        levels.push_back({double(gaussian.varianceSquareMillimetres) * metres * metres, glm::dvec3(gaussian.weight)});
        sum += levels.back().weight;
    }
    for (DiffusionLevel& level : levels) level.weight /= sum;
    std::ranges::stable_sort(levels, {}, &DiffusionLevel::varianceSquareMetres);
    while (levels.size() > std::size_t(std::max(mostGaussians, 1))) {
        // Merges the two neighbours whose log widths change least.
        std::size_t best = 0;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
            const double a = meanOf(levels[i].weight), b = meanOf(levels[i + 1].weight);
            const double narrow = levels[i].varianceSquareMetres, wide = levels[i + 1].varianceSquareMetres;
            const double apart = narrow == wide ? 0.0 : std::log(wide / narrow);
            const double cost = a + b > 0.0 && apart > 0.0 ? a * b / (a + b) * apart * apart : 0.0;
            if (cost < least) {
                least = cost;
                best = i;
            }
        }
        DiffusionLevel& merged = levels[best];
        const DiffusionLevel& other = levels[best + 1];
        const double a = meanOf(merged.weight), b = meanOf(other.weight);
        if (a + b > 0.0)
            merged.varianceSquareMetres = (a * merged.varianceSquareMetres + b * other.varianceSquareMetres) / (a + b);
        merged.weight += other.weight;
        levels.erase(levels.begin() + std::ptrdiff_t(best) + 1);
    }
    const double shown = texelVariance(texelMetres, isHalved);
    // Where the widths grow by more than DIFFUSION_WIDENING, every texel is a tap. The factor 1/2 allows for twice
    // as many taps where texels are smaller.
    const double fineMetres = texelMetres * double(DIFFUSION_MOST_FINE_TAPS) / 2.0 / DIFFUSION_REACH;
    DiffusionKernel kernel;
    kernel.texelMetres = texelMetres;
    double before = shown;
    constexpr double kSmooth = DIFFUSION_WIDENING * DIFFUSION_WIDENING;
    const auto jumpsTo = [&](double variance) { return variance > kSmooth * before; };
    const auto add = [&](double variance, const glm::dvec3& weight) {
        kernel.levels.push_back({variance - before, weight, variance});
        before = variance;
    };
    for (const DiffusionLevel& level : levels) {
        if (level.varianceSquareMetres <= shown) {
            const double share = shown > 0.0 ? level.varianceSquareMetres / shown : 1.0;
            kernel.inPixels += (1.0 - share) * level.weight;
            kernel.inTexels += share * level.weight;
            continue;
        }
        const double variance = level.varianceSquareMetres;
        while (texelMetres > 0.0 && jumpsTo(variance) && variance - before > fineMetres * fineMetres &&
               kernel.levels.size() < kMostLevels)
            add(std::max(before + fineMetres * fineMetres, kSmooth * before), glm::dvec3(0.0));
        add(variance, level.weight);
    }
    return kernel;
}

LevelReach levelReach(const DiffusionKernel& kernel, std::size_t level) {
    return {level == 0 ? 0.0 : kernel.levels[level - 1].totalSquareMetres, kernel.levels[level].totalSquareMetres};
}

int gutterTexels(const std::vector<DiffusionLevel>& levels, double texelMetres) {
    double widest = 0.0;
    for (const DiffusionLevel& level : levels) widest = std::max(widest, level.varianceSquareMetres);
    const double texels = texelMetres > 0.0 ? std::ceil(DIFFUSION_REACH * std::sqrt(widest) / texelMetres) : 1.0;
    return int(std::bit_ceil(unsigned(std::clamp(texels, 2.0, double(kMostGutterTexels)))));
}

int borderTexels(int gutter, int sideTexels) {
    return std::min(gutter, sideTexels / 16);
}

double texelMetresOf(double sideMetres, int sideTexels, int border) {
    return sideMetres / double(sideTexels - 2 * border);
}

DiffusionAtlas diffusionAtlas(std::size_t objects, int sideTexels) {
    DiffusionAtlas cells;
    cells.sideTexels = sideTexels;
    cells.columns = std::max(1, int(std::ceil(std::sqrt(double(objects)))));
    cells.rows = std::max(1, (int(objects) + cells.columns - 1) / cells.columns);
    return cells;
}

void requireUnwrapped(const scenes::Scene& scene, const DiffusionObject& object) {
    const std::string problem = unwrapProblem(scene.meshes[std::size_t(object.mesh)]);
    if (!problem.empty())
        throw InputError(
            fmt::format("{}: light cannot be diffused over {}: {}, or give its material another subsurface "
                        "method (--subsurface wrap)",
                        scene.name, object.name, problem));
}

const GpuUvAtlas& GpuUvAtlases::of(const DiffusionObject& object, int sideTexels, int gutter) {
    std::unique_ptr<GpuUvAtlas>& kept = atlases_[{object.instance, sideTexels, gutter}];
    if (kept) return *kept;
    requireUnwrapped(scene_, object);
    const scenes::Mesh& mesh = scene_.meshes[std::size_t(object.mesh)];
    const glm::dmat4 worldFromObject = scenes::worldFromNodes(scene_)[std::size_t(object.node)];
    const int border = borderTexels(gutter, sideTexels);
    const UvAtlas atlas = makeUvAtlas(mesh, worldFromObject, sideTexels, border, gutter);
    std::vector<glm::vec4> steps(atlas.texels.size(), glm::vec4(0.0f));
    std::vector<glm::vec2> continued(atlas.texels.size(), glm::vec2(0.0f));
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const UvTexel& texel = atlas.texels[i];
        if (texel.chart == 0) continue;
        const UvStep& step = atlas.steps[std::size_t(texel.triangle)];
        steps[i] = glm::vec4(glm::dvec3(step.uMetres, step.vMetres, step.shear),
                             texel.isCovered ? double(texel.chart) : -double(texel.chart));
        continued[i] = glm::vec2(texel.continued);
    }
    const auto texture = [&](const char* label, graph::Format format) {
        return gpu::Texture(label, graph::TextureDesc{format, sideTexels, sideTexels});
    };
    kept = std::make_unique<GpuUvAtlas>(GpuUvAtlas{border, texture("diffusion_steps", graph::Format::Rgba32Float),
                                                   texture("diffusion_continued", graph::Format::Rg32Float),
                                                   diffusionTiles(atlas, mesh, worldFromObject)});
    kept->steps.upload(0, steps);
    kept->continued.upload(0, continued);
    return *kept;
}

void DiffusionMemory::begin(std::size_t cells, bool holdsAtlas) {
    cells_.resize(cells);
    if (holdsAtlas) return;
    for (Cell& cell : cells_) cell.stored = cell.blank = {};
}

namespace {

TileSet without(TileSet tiles, bool isKnown, const TileSet& known) {
    if (isKnown && known.side() == tiles.side()) tiles.remove(known);
    return tiles;
}

void addTo(TileSet& known, const TileSet& more) {
    if (known.side() == more.side())
        known.add(more);
    else if (!more.isEmpty())
        known = more;
}

} // namespace

TileSet DiffusionMemory::missing(std::size_t cell, std::uint64_t key, const TileSet& tiles) const {
    return without(tiles, cells_[cell].key == key, cells_[cell].stored);
}

TileSet DiffusionMemory::unlit(std::size_t cell, std::uint64_t key, const TileSet& tiles) const {
    return without(tiles, cells_[cell].key == key, cells_[cell].lit);
}

void DiffusionMemory::hold(std::size_t cell, std::uint64_t key, const TileSet& lit, const TileSet& diffused) {
    Cell& own = cells_[cell];
    if (own.key != key) own = {key, {}, {}, {}};
    addTo(own.lit, lit);
    addTo(own.stored, diffused);
}

void DiffusionMemory::holdBlank(std::size_t cell, std::uint64_t key, const TileSet& blank) {
    hold(cell, key, {}, {});
    addTo(cells_[cell].blank, blank);
}

TileSet DiffusionMemory::unwritten(std::size_t cell, std::uint64_t key, int side) const {
    const Cell& own = cells_[cell];
    const bool isKnown = own.key == key;
    return without(without(TileSet(side, true), isKnown, own.stored), isKnown, own.blank);
}

bool DiffusionMemory::isIdle(std::size_t cell, std::uint64_t key, const TileSet& tiles) const {
    if (missing(cell, key, tiles).isEmpty()) return true;
    return tilesLeft_ == std::size_t(0) && unwritten(cell, key, tiles.side()).isEmpty();
}

DiffusionWork DiffusionMemory::next(std::size_t cell, std::uint64_t key, const std::vector<DiffusionTile>& atlas,
                                    const std::vector<double>& variances, const TileSet& tiles) {
    const TileSet lacking = missing(cell, key, tiles);
    DiffusionWork work =
        diffusionWork(atlas, variances, tilesLeft_ ? lacking.first(kDiffusedTiles * *tilesLeft_) : lacking);
    work.light = unlit(cell, key, work.light);
    if (!tilesLeft_) return work;
    const TileSet light = work.light.first(*tilesLeft_);
    *tilesLeft_ -= light.count();
    if (light == work.light) {
        *tilesLeft_ -= std::min(*tilesLeft_, (work.store.count() + kDiffusedTiles - 1) / kDiffusedTiles);
    } else { // diffusion waits until all its irradiance is lit
        const TileSet none(tiles.side());
        work = {light, std::vector<DiffusionWork::Level>(variances.size(), {none, none, none}), none};
    }
    work.blank = unwritten(cell, key, tiles.side());
    work.blank.remove(work.store);
    return work;
}

} // namespace tessera::frame
