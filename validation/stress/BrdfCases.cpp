// Materials: reflected radiance of the product's shader on the GPU against the reference in double precision.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "renderer/frame/FeatureDefines.h"
#include "renderer/frame/Features.h"
#include "renderer/frame/MaterialFeatures.h"
#include "renderer/frame/PackedMaterial.h"
#include "renderer/gpu/Commands.h"
#include "shaders/shared/models.h"
#include "shaders/shared/slots.h"
#include "validation/reference/Reflectance.h"
#include "validation/stress/StressCase.h"
#include "validation/stress/StressDirections.h"
#include "validation/stress/StressModels.h"

namespace tessera::validation {

namespace {

/// Surfaces of one material per shader dispatch.
constexpr std::size_t kBatch = 16384;
/// Materials per model at full effort: 5 models x 128 x 16384 > 10^7 samples.
constexpr int kMaterials = 128;
constexpr double kTolerance = 3e-4;
constexpr const char* kReason =
    "fp32 rounds n, l, v and h by 6e-8 each, which a lobe multiplies by 2/alpha: 3e-4 at alpha 0.002. Weighted by what "
    "else loses digits: alpha/0.002, cos/0.001 near the horizon, |l+v|^2, 3e-4/5e-3 at a critical angle, and the "
    "azimuth of h where masking goes by it";

/// A batch for both sides: each surface is a triangle whose corners are one vertex.
struct Surfaces {
    scenes::Mesh mesh;
    std::vector<glm::dvec4> tangents; ///< by index
    std::vector<StressView> views;

    void add(const StressView& view) {
        const auto vertex = std::uint32_t(views.size());
        views.push_back(view);
        mesh.positionsOS.emplace_back(0.0f);
        mesh.normalsOS.push_back(view.normal);
        mesh.tangentsOS.emplace_back(view.tangent, 1.0f);
        tangents.insert(tangents.end(), 3, glm::dvec4(mesh.tangentsOS.back()));
        mesh.indices.insert(mesh.indices.end(), 3, vertex);
    }
    std::vector<glm::vec4> inputs() const {
        std::vector<glm::vec4> all;
        all.reserve(4 * views.size());
        for (const StressView& view : views) {
            all.insert(all.end(), {glm::vec4(view.normal, 0.0f), glm::vec4(view.tangent, 1.0f),
                                   glm::vec4(view.toLight, 0.0f), glm::vec4(view.toViewer, 0.0f)});
        }
        return all;
    }
};

/// The error weight of masking by the alpha along the projection of h (Walter), which depends on the azimuth of h.
/// Rounding turns the azimuth more the closer h is to n, and visibility changes with it by twice the ratio of the
/// alphas. Negative: undecided.
double azimuthWeight(const scenes::Material& material, const reference::Directions& directions) {
    if (scenes::infoOf(material.model).anisotropy != scenes::Anisotropy::Alphas ||
        material.masking != scenes::Masking::Walter)
        return 1.0;
    constexpr double kRounding = 1.2e-7; // of a sum of two unit vectors
    const double x = std::max(double(material.alpha), double(ALPHA_MIN));
    const double y = std::max(double(material.alphaY), double(ALPHA_MIN));
    const double apart = glm::length(directions.toLight + directions.toViewer);
    const double across = glm::length(glm::cross(directions.normal, directions.half));
    const double change = 2.0 * std::max(x / y, y / x) * kRounding / std::max(apart * across, 1e-300);
    if (x == y) return 1.0;
    return change > 0.1 ? -1.0 : std::min(1.0, kTolerance / change);
}

/// The weight of a relative error: the fraction of fp32 precision that the directions leave. Negative where the sign of
/// a rounding error decides the result.
double weightOf(const scenes::Material& material, double sharpness, const reference::Directions& directions) {
    constexpr double kUndecided = 3e-7; // five roundings of a unit vector's dot product
    const double cosLight = std::abs(directions.cosLight), cosView = std::abs(directions.cosView);
    const double apart = glm::length(directions.toLight + directions.toViewer);
    if (cosLight < kUndecided || cosView < kUndecided || apart < 1e-5) return -1.0;
    double weight = std::min(1.0, sharpness / 0.002) * std::min(1.0, cosLight / 1e-3) * std::min(1.0, cosView / 1e-3);
    // Models without a highlight use no half vector, so they are accurate at l = -v, too.
    if (scenes::infoOf(material.model).highlight != scenes::Highlight::None) weight *= std::min(1.0, apart * apart);
    const double azimuth = azimuthWeight(material, directions);
    if (azimuth < 0.0) return -1.0;
    weight *= azimuth;
    const double ior = double(material.ior), cosine = directions.cosIncidence;
    if (ior < 1.0 && std::abs(ior * ior - 1.0 + cosine * cosine) < 1e-4) weight *= kTolerance / 5e-3;
    return weight;
}

/// The weighted error of one surface, unless it is undecided.
struct Compared {
    double rel = 0.0;
    bool undecided = false;
};

Compared compared(const glm::vec4& shown, const reference::SurfacePoint& point, const StressView& view,
                  const scenes::Material& material, double sharpness) {
    const glm::dvec3 toLight = glm::normalize(glm::dvec3(view.toLight));
    const glm::dvec3 toViewer = glm::normalize(glm::dvec3(view.toViewer));
    const double weight = weightOf(material, sharpness, reference::Directions(point.normal, toLight, toViewer));
    if (weight < 0.0) return {0.0, true};
    const glm::dvec3 truth = reference::reflected(point, toLight, toViewer, true);
    // Errors are relative to the surface's brightest channel, so a residue of 1e-9 in a channel with k_d near 0 does
    // not matter. Losses below the smallest normal number, 1.2e-38, count 1e-4 at most.
    const double brightest = std::max({truth.r, truth.g, truth.b, 1.2e-34});
    const glm::dvec3 difference = glm::abs(glm::dvec3(shown) - truth);
    return {weight * std::max({difference.r, difference.g, difference.b}) / brightest, false};
}

/// The product's shader defines for a scene with a material of the model.
shader::Defines definesOf(scenes::MaterialModel model) {
    scenes::Scene scene;
    scenes::Material material;
    material.model = model;
    material.specularFactor = 0.5f; // unlike the default, so that the frame's shaders read every parameter
    material.specularColor = glm::vec3(0.5f);
    material.ior = 1.25f;
    material.masking = scenes::Masking::Directional;
    material.anisotropyStrength = material.clearcoat = 0.5f;
    material.sheenColor = glm::vec3(0.5f);
    scene.materials = {material};
    scene.meshes.resize(1);
    scene.meshes[0].indices = {0, 0, 0}; // a mesh without triangles would have no features
    scene.nodes.resize(1);
    scene.nodes[0].instances = {{0, 0}};
    shader::Defines defines = frame::featureDefines(frame::materialFeatures(scene));
    defines.emplace_back("LIGHT_CURSOR", "LIGHT_CURSOR_NONE");
    return defines;
}

class Reflection {
public:
    Reflection(StressBench& bench, const StressModel& model)
        : bench_(bench), model_(model), defines_(definesOf(model.model)),
          constants_("stress material", sizeof(shared::MaterialConstants), gpu::BufferUse::Dynamic) {}

    void measure(const scenes::Material& material, const StressDirection& direction, std::size_t count,
                 StressRandom& random, StressFigures& figures) {
        const double sharpness = model_.sharpness(material);
        Surfaces surfaces;
        for (std::size_t i = 0; i < count; ++i) surfaces.add(stressView(direction, sharpness, random));
        constants_.uploadValue(frame::packMaterial(material));
        gpu::bindUniformBuffer(UNIFORM_MATERIAL, constants_);
        const std::vector<glm::vec4> out = bench_.run("stress/reflect.comp", defines_, surfaces.inputs(), count, 1);
        compare(material, sharpness, direction, surfaces, out, figures);
    }

private:
    void compare(const scenes::Material& material, double sharpness, const StressDirection& direction,
                 const Surfaces& surfaces, const std::vector<glm::vec4>& out, StressFigures& figures) const {
        reference::Object object;
        object.mesh = &surfaces.mesh;
        object.material = &material;
        object.tangentsOS = &surfaces.tangents;
        std::vector<Compared> results(out.size());
        tbb::parallel_for(std::size_t(0), out.size(), [&](std::size_t i) {
            reference::Hit hit;
            hit.object = &object;
            hit.triangle = std::uint32_t(i);
            hit.weights = glm::dvec3(1.0, 0.0, 0.0); // all corners are one vertex
            results[i] = compared(out[i], reference::surfaceAt(hit, {}), surfaces.views[i], material, sharpness);
        });
        for (std::size_t i = 0; i < out.size(); ++i) {
            figures.count({&out[i].x, 3});
            figures.undecided += results[i].undecided;
            figures.error(results[i].rel, [&] { return describe(material, direction, surfaces.views[i]); });
        }
    }

    std::string describe(const scenes::Material& material, const StressDirection& direction,
                         const StressView& view) const {
        const auto dot = [](const glm::vec3& a, const glm::vec3& b) { return glm::dot(glm::dvec3(a), glm::dvec3(b)); };
        return fmt::format("{}, {}: alpha {:.3g}, ior {:.4g}, n.l {:.3g}, n.v {:.3g}, l.v {:.6g}",
                           scenes::infoOf(model_.model).name, direction.name, model_.sharpness(material), material.ior,
                           dot(view.normal, view.toLight), dot(view.normal, view.toViewer),
                           dot(view.toLight, view.toViewer));
    }

    StressBench& bench_;
    const StressModel& model_;
    shader::Defines defines_;
    gpu::Buffer constants_;
};

scenes::Material materialOf(const StressModel& model, StressRandom& random) {
    scenes::Material material;
    material.model = model.model;
    model.randomise(material, random);
    return material;
}

/// Random materials of a model under every placement of light and viewer; every second batch uses random directions.
void sweepModel(StressBench& bench, const StressModel& model, StressFigures& figures) {
    StressRandom random(20240 + std::uint64_t(model.model));
    Reflection reflection(bench, model);
    const bool full = bench.effort() == StressEffort::Full;
    const int materials = full ? kMaterials : kMaterials / 4;
    const auto directions = stressDirections();
    for (int i = 0; i < materials; ++i) {
        const auto& direction = directions[i % 2 == 0 ? 0 : std::size_t(i / 2) % directions.size()];
        reflection.measure(materialOf(model, random), direction, full ? kBatch : kBatch / 16, random, figures);
        bench.progress(double(i + 1) / materials);
    }
}

/// One placement of light and viewer with random materials of every model.
void sweepDirection(StressBench& bench, const StressDirection& direction, StressFigures& figures) {
    StressRandom random(777);
    const int materials = bench.effort() == StressEffort::Full ? 64 : 16;
    for (const StressModel& model : stressModels()) {
        Reflection reflection(bench, model);
        for (int i = 0; i < materials; ++i)
            reflection.measure(materialOf(model, random), direction, kBatch / 16, random, figures);
    }
}

/// Roughness from 0 in steps of 1e-4 to 0.03, where models clamp alpha to its minimum, then in steps of 0.01 to 1.
void sweepRoughness(StressBench& bench, const StressModel& model, StressFigures& figures) {
    StressRandom random(31);
    Reflection reflection(bench, model);
    const auto directions = stressDirections();
    for (int step = 0; step <= 397; ++step) {
        if (bench.effort() == StressEffort::Quick && step % 5 != 0) continue;
        scenes::Material material = materialOf(model, random);
        model.setRoughness(material, step <= 300 ? 1e-4 * step : 0.03 + 0.01 * (step - 300));
        for (std::size_t way = 0; way < 2; ++way) reflection.measure(material, directions[way], 512, random, figures);
        bench.progress(step / 397.0);
    }
}

} // namespace

void addBrdfCases(std::vector<StressCase>& cases) {
    for (const StressModel& model : stressModels()) {
        cases.push_back({fmt::format("brdf/{}", scenes::infoOf(model.model).name),
                         "random materials, lights and viewers are the reference's, finite and never negative",
                         StressBound::WorstRel, kTolerance, kReason,
                         [&model](StressBench& bench, StressFigures& figures) { sweepModel(bench, model, figures); }});
    }
    for (const StressDirection& direction : stressDirections()) {
        cases.push_back(
            {fmt::format("directions/{}", direction.name), direction.holds, StressBound::WorstRel, kTolerance, kReason,
             [&direction](StressBench& bench, StressFigures& figures) { sweepDirection(bench, direction, figures); }});
    }
    for (const StressModel& model : stressModels()) {
        if (!model.setRoughness) continue;
        cases.push_back(
            {fmt::format("roughness/{}", scenes::infoOf(model.model).name),
             "roughness from 0 in steps of 1e-4, then to 1", StressBound::WorstRel, kTolerance, kReason,
             [&model](StressBench& bench, StressFigures& figures) { sweepRoughness(bench, model, figures); }});
    }
}

} // namespace tessera::validation
