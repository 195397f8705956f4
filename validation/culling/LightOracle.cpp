#include "validation/culling/LightOracle.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "renderer/frame/MaterialFeatures.h"
#include "renderer/gpu/Context.h"
#include "scenes/AreaLight.h"
#include "validation/culling/PixelPositions.h"
#include "validation/culling/VisitedLights.h"

namespace tessera::validation {

namespace {

/// Where a light emits: its bounding ball, and the cone or half space that it shines into.
struct Shine {
    double surfaceMetres = 0.0; ///< radius of the ball around its position that holds its surface
    bool isCone = false;
    bool hasFront = false;       ///< a one-sided flat light: shines into the half space before it
    glm::dvec3 directionWS{0.0}; ///< along the cone's axis, or the normal of the shining side
    double cosOuter = -1.0;

    /// Whether a point lies in the cone or half space; true for other lights. `toLight` is of any length.
    bool reaches(const glm::dvec3& toLight) const {
        if (hasFront) return glm::dot(-toLight, directionWS) > 0.0;
        return !isCone || glm::dot(-toLight, directionWS) > cosOuter * glm::length(toLight);
    }
    /// Whether any point of the ball is in front of a surface. `normal` is unit, or 0: false.
    bool isInFront(const glm::dvec3& normal, const glm::dvec3& toLight) const {
        return glm::dot(normal, toLight) + surfaceMetres * glm::length(normal) > 0.0;
    }
};

/// A light of finite range, as plain numbers; lights that are off or black are left out.
struct TrueLight {
    int sceneLight = 0;
    Shine shine;
    glm::dvec3 positionWS{0.0};
    double squaredRange = scenes::kInfinity; ///< of falloff inverse_square
    bool fallsOffByABC = false;
    glm::dvec3 attenuation{0.0}; ///< A B C, times the tolerance
    double brightest = 0.0;      ///< largest channel of colour x intensity
    double dimSquared = 0.0;     ///< area light ended by the tolerance: squared range from its ball
    bool isDimmed = false;       ///< whether dimSquared applies
};

/// A light that reaches everywhere.
struct EndlessLight {
    int sceneLight = 0;
    Shine shine;
    glm::dvec4 placeWS{0.0}; ///< homogeneous: its position, or with w = 0 the direction to the light
};

struct TrueLights {
    std::vector<TrueLight> finite;
    std::vector<EndlessLight> everywhere;
};

/// Whether a light never ends: without a position; inverse square without a range; A B C without a tolerance or with A
/// alone; an area light with neither range nor tolerance.
bool reachesEverywhere(const scenes::Light& light, double rangeTolerance) {
    const scenes::LightTypeInfo& info = scenes::infoOf(light.type);
    if (!info.hasPosition()) return true;
    if (info.isArea) return std::isinf(light.rangeMetres) && rangeTolerance == 0.0;
    if (light.falloff == scenes::Falloff::InverseSquare) return std::isinf(light.rangeMetres);
    return rangeTolerance == 0.0 || (light.attenuation.y == 0.0f && light.attenuation.z == 0.0f);
}

TrueLights trueLights(const scenes::Scene& scene, const frame::FrameSettings& settings) {
    TrueLights lights;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const scenes::Light light = scenes::lightAtTime(scene.lights[i], settings.timeSeconds);
        if (!light.enabled || (settings.soloLight && *settings.soloLight != int(i))) continue;
        const bool isFlat = scenes::infoOf(light.type).isFlat;
        const glm::dvec3 most = isFlat ? glm::dvec3(light.texture.most()) : glm::dvec3(1.0);
        if (most * glm::dvec3(light.color) * double(light.intensity) == glm::dvec3(0.0)) continue;
        const scenes::LightReach reach = scenes::infoOf(light.type).reach;
        const bool isCone = reach == scenes::LightReach::Cone;
        if (isCone && !(light.outerConeRadians > 0.0f)) continue;
        const bool isArea = scenes::infoOf(light.type).isArea;
        if (isArea && !scenes::hasSurface(light)) continue;
        const Shine shine{scenes::surfaceReachMetres(light), isCone, isFlat && !light.isTwoSided, light.directionWS,
                          std::cos(double(light.outerConeRadians))};
        if (reachesEverywhere(light, settings.rangeTolerance)) {
            const bool isFar = reach == scenes::LightReach::Everywhere;
            lights.everywhere.push_back(
                {int(i), shine, isFar ? glm::dvec4(-light.directionWS, 0.0) : glm::dvec4(light.positionWS, 1.0)});
            continue;
        }
        TrueLight plain;
        plain.sceneLight = int(i);
        plain.shine = shine;
        plain.positionWS = light.positionWS;
        plain.fallsOffByABC = light.falloff == scenes::Falloff::Attenuation;
        if (plain.fallsOffByABC)
            plain.attenuation = glm::dvec3(light.attenuation) * settings.rangeTolerance;
        else
            plain.squaredRange = double(light.rangeMetres) * double(light.rangeMetres);
        const glm::dvec3 color = most * glm::dvec3(light.color) * double(light.intensity);
        // Colours are clamped to 1e30 (docs/numerics.md).
        plain.brightest = std::min(std::max({color.r, color.g, color.b}), 1e30);
        plain.isDimmed = isArea && std::isinf(light.rangeMetres);
        if (plain.isDimmed)
            plain.dimSquared = plain.brightest * scenes::largestSeenArea(light) / settings.rangeTolerance;
        lights.finite.push_back(plain);
    }
    return lights;
}

bool reaches(const TrueLight& light, const glm::dvec3& positionWS, double squaredDistance) {
    if (!light.shine.reaches(light.positionWS - positionWS)) return false;
    // Tests the falloff itself against the tolerance, not the radius solved from it.
    const double distance = std::sqrt(squaredDistance);
    if (light.isDimmed) {
        const double fromSurface = distance - light.shine.surfaceMetres;
        return !(fromSurface > 0.0) || fromSurface * fromSurface < light.dimSquared;
    }
    return light.fallsOffByABC ? light.brightest > light.attenuation.x + light.attenuation.y * distance +
                                                       light.attenuation.z * squaredDistance
                               : squaredDistance < light.squaredRange;
}

/// The counts of some rows of pixels.
struct RowCounts {
    LightOracleFigures figures;
    std::vector<std::uint64_t> pixelsByVisited; ///< how many pixels visit i lights
    CellLights cells;
};

/// Whether the lists may leave out lights behind the judged surfaces.
bool leavesOutBehind(const OracleInput& input) {
    return input.drawn.culling.normals != culling::NormalTest::Off && input.layer == SurfaceLayer::Opaque;
}

class Judge {
public:
    explicit Judge(const OracleInput& input)
        : input_(input), lights_(trueLights(input.scene, input.settings)), visited_(input.drawn),
          byNormals_(leavesOutBehind(input) && !frame::materialFeatures(input.scene).litFromBehind()),
          positions_(input.scene.cameras[std::size_t(input.settings.camera)], input.settings, input.drawn.depths) {}

    void row(int row, RowCounts& counts) const {
        std::vector<int> visited;
        std::optional<VisitedCell> cell; // the cell of `visited`
        for (int column = 0; column < input_.settings.sizePixels.x; ++column) {
            const std::size_t pixel =
                std::size_t(row) * std::size_t(input_.settings.sizePixels.x) + std::size_t(column);
            if (!(input_.depth[pixel] > 0.0f)) continue;
            ++counts.figures.covered;
            if (!input_.isLit.empty() && input_.isLit[pixel] == 0) {
                if (counts.pixelsByVisited.empty()) counts.pixelsByVisited.resize(1);
                ++counts.pixelsByVisited[0];
                continue;
            }
            const VisitedCell own = visited_.cellAt(column, row, input_.depth[pixel], input_.layer);
            if (cell != own) {
                cell = own;
                visited_.at(own, visited);
                counts.cells.add(own, visited.size());
            }
            if (counts.pixelsByVisited.size() <= visited.size()) counts.pixelsByVisited.resize(visited.size() + 1);
            ++counts.pixelsByVisited[visited.size()];
            const bool hasNormal = !input_.normalWS.empty();
            const glm::dvec3 normal = hasNormal ? glm::dvec3(input_.normalWS[4 * pixel], input_.normalWS[4 * pixel + 1],
                                                             input_.normalWS[4 * pixel + 2])
                                                : glm::dvec3(0.0);
            judgePixel(positions_.positionWS(column, row, input_.depth[pixel]), normal, visited, {column, row},
                       counts.figures);
        }
    }

private:
    void judgePixel(const glm::dvec3& positionWS, const glm::dvec3& normal, const std::vector<int>& visited,
                    glm::ivec2 pixel, LightOracleFigures& figures) const {
        const bool isUnit = std::abs(glm::dot(normal, normal) - 1.0) < 1e-3; // a broken normal excuses no missing light
        auto next = visited.begin();
        for (const TrueLight& light : lights_.finite) {
            const glm::dvec3 toLight = light.positionWS - positionWS;
            const double squaredDistance = glm::dot(toLight, toLight);
            if (!reaches(light, positionWS, squaredDistance)) continue;
            ++figures.needed;
            const bool inFront = light.shine.isInFront(normal, toLight);
            if (inFront) ++figures.neededLit;
            if (byNormals_ && isUnit && !inFront) continue;
            next = std::lower_bound(next, visited.end(), light.sceneLight);
            if (next == visited.end() || *next != light.sceneLight) miss(light.sceneLight, pixel, figures);
        }
        std::uint64_t everywhere = 0;
        for (const EndlessLight& light : lights_.everywhere) {
            const glm::dvec3 toLight = glm::dvec3(light.placeWS) - light.placeWS.w * positionWS;
            if (light.shine.isInFront(normal, toLight) && light.shine.reaches(toLight)) ++figures.everywhereLit;
            if (std::binary_search(visited.begin(), visited.end(), light.sceneLight))
                ++everywhere;
            else
                miss(light.sceneLight, pixel, figures);
        }
        figures.everywhere += everywhere;
        figures.evaluated += visited.size() - everywhere;
    }

    void miss(int light, glm::ivec2 pixel, LightOracleFigures& figures) const {
        ++figures.falseNegatives;
        if (!figures.firstMissing) figures.firstMissing = {pixel.x, input_.settings.sizePixels.y - 1 - pixel.y, light};
    }

    const OracleInput& input_;
    TrueLights lights_;
    VisitedLights visited_;
    bool byNormals_; ///< lights behind a surface need not be visited
    PixelPositions positions_;
};

void add(RowCounts& sum, const RowCounts& rows) {
    sum.figures.covered += rows.figures.covered;
    sum.figures.needed += rows.figures.needed;
    sum.figures.neededLit += rows.figures.neededLit;
    sum.figures.evaluated += rows.figures.evaluated;
    sum.figures.everywhere += rows.figures.everywhere;
    sum.figures.everywhereLit += rows.figures.everywhereLit;
    sum.figures.falseNegatives += rows.figures.falseNegatives;
    if (!sum.figures.firstMissing) sum.figures.firstMissing = rows.figures.firstMissing;
    if (sum.pixelsByVisited.size() < rows.pixelsByVisited.size())
        sum.pixelsByVisited.resize(rows.pixelsByVisited.size());
    sum.cells.add(rows.cells);
    for (std::size_t i = 0; i < rows.pixelsByVisited.size(); ++i) sum.pixelsByVisited[i] += rows.pixelsByVisited[i];
}

/// 99th percentile (nearest rank) of the lights visited by a covered pixel.
std::uint64_t p99Of(const std::vector<std::uint64_t>& pixelsByVisited, std::uint64_t covered) {
    const std::uint64_t rank = (covered * 99 + 99) / 100;
    std::uint64_t seen = 0;
    for (std::size_t i = 0; i < pixelsByVisited.size(); ++i) {
        seen += pixelsByVisited[i];
        if (seen >= rank) return i;
    }
    return 0;
}

std::optional<double> ratio(std::uint64_t a, std::uint64_t b) {
    if (b == 0) return {};
    return double(a) / double(b);
}

/// Flips rows from top-down to bottom-up.
std::vector<float> flippedRows(const std::vector<float>& rgba, int width, int height) {
    std::vector<float> flipped(rgba.size());
    const auto pitch = std::ptrdiff_t(width) * 4;
    for (int row = 0; row < height; ++row)
        std::copy_n(rgba.begin() + row * pitch, pitch, flipped.begin() + (height - 1 - row) * pitch);
    return flipped;
}

/// Renders a debug view of the opaque surfaces alone; RGBA, rows from the bottom.
std::vector<float> opaquePicture(scenes::Scene scene, const frame::FrameSettings& settings, frame::DebugView view,
                                 engine::Technique technique) {
    // Masks out transparent surfaces. Removing them would change the scene's bounds, and so depths and edges.
    for (scenes::Material& material : scene.materials) {
        if (!scenes::isTransparent(material)) continue;
        material.transmission = 0.0f;
        material.alphaMode = scenes::AlphaMode::Mask;
        material.alphaCutoff = 2.0f;
    }
    frame::FrameSettings viewed = settings;
    viewed.view = view;
    viewed.culling = {};
    viewed.lightOn.reset();
    viewed.soloLight.reset();
    engine::Renderer renderer(*gpu::Context::current(), scene);
    const engine::RenderedFrame frame = renderer.render(technique, viewed);
    return flippedRows(frame.radiance, frame.width, frame.height);
}

/// 1 where the visible opaque surface is lit; empty if no material is unlit, so that all are.
std::vector<std::uint8_t> litPixels(const scenes::Scene& scene, const frame::FrameSettings& settings) {
    if (!frame::materialFeatures(scene)[scenes::MaterialModel::SingleColor]) return {};
    scenes::Scene lit = scene;
    lit.lights.assign(1, {});
    lit.lights[0].type = scenes::LightType::Directional;
    const std::vector<float> counts =
        opaquePicture(std::move(lit), settings, frame::DebugView::Lights, engine::Technique::Forward);
    std::vector<std::uint8_t> isLit(counts.size() / 4);
    for (std::size_t i = 0; i < isLit.size(); ++i) isLit[i] = counts[4 * i] > 0.0f ? 1 : 0;
    return isLit;
}

} // namespace

std::optional<double> LightOracleFigures::tightness() const {
    return ratio(evaluated, needed);
}

std::optional<double> LightOracleFigures::litTightness() const {
    return ratio(evaluated, neededLit);
}

LightOracleFigures judgeLights(const OracleInput& input) {
    if (leavesOutBehind(input) && input.normalWS.empty())
        throw std::invalid_argument("lists without the lights behind surfaces are judged by normals");
    const Judge judge(input);
    RowCounts sum;
    std::mutex mutex;
    tbb::parallel_for(tbb::blocked_range<int>(0, input.settings.sizePixels.y),
                      [&](const tbb::blocked_range<int>& rows) {
                          RowCounts counts;
                          for (int row = rows.begin(); row < rows.end(); ++row) judge.row(row, counts);
                          const std::scoped_lock lock(mutex);
                          add(sum, counts);
                      });
    sum.figures.evaluatedP99 = p99Of(sum.pixelsByVisited, sum.figures.covered);
    sum.figures.evaluatedMax = sum.pixelsByVisited.empty() ? 0 : sum.pixelsByVisited.size() - 1;
    sum.figures.occupied = sum.cells.figures();
    sum.figures.entries = input.drawn.lists.entries.size();
    sum.figures.cells = input.drawn.lists.cells.size();
    sum.figures.listBytes = input.drawn.lists.bytes();
    return sum.figures;
}

LightOracleFigures judgeLights(engine::Renderer& renderer, engine::Technique technique,
                               const frame::FrameSettings& settings) {
    renderer.draw(technique, settings);
    const engine::DrawnLists drawn = renderer.downloadLists();
    const std::vector<float> depth = renderer.downloadDepth();
    const std::vector<float> normalWS =
        opaquePicture(renderer.scene(), settings, frame::DebugView::Normal, engine::Technique::Deferred);
    const std::vector<std::uint8_t> lit = litPixels(renderer.scene(), settings);
    return judgeLights({renderer.scene(), settings, drawn, depth, normalWS, SurfaceLayer::Opaque, lit});
}

} // namespace tessera::validation
