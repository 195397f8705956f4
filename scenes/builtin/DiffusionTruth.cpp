#include "scenes/builtin/DiffusionTruth.h"

#include <cmath>
#include <numbers>

#include "scenes/builtin/Author.h"
#include "scenes/builtin/Builtin.h"
#include "scenes/builtin/Shapes.h"

namespace tessera::scenes::builtin {
namespace {

constexpr double kPlatesY = 4.0;

/// Visits the Gaussians of the profile `skin`, in the scene's metres; their weights sum to 1.
template <typename Visit>
void forEachGaussian(Visit visit) {
    const DiffusionProfile& profile = namedProfiles()[0].profile;
    glm::dvec3 sum(0.0);
    for (const DiffusionGaussian& gaussian : profile) sum += glm::dvec3(gaussian.weight);
    for (const DiffusionGaussian& gaussian : profile) {
        const double sigma = 1e-3 * std::sqrt(double(gaussian.varianceSquareMillimetres)) / kTruthScaleMetres;
        visit(sigma, glm::dvec3(gaussian.weight) / sum);
    }
}

/// A square with a round hole in its middle, facing up, with enough corners for an area exact to 2e-5.
Mesh plateWithHole(const glm::dvec3& middleWS, double halfSide, double radius) {
    constexpr int kCorners = 512;
    const double outgrown = radius * (1.0 + std::pow(std::numbers::pi / kCorners, 2.0) / 3.0);
    Mesh mesh;
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kCorners;
        const glm::dvec3 ray(std::cos(angle), 0.0, std::sin(angle));
        const double toSide = halfSide / std::max(std::abs(ray.x), std::abs(ray.z));
        mesh.positionsOS.emplace_back(middleWS + outgrown * ray);
        mesh.positionsOS.emplace_back(middleWS + toSide * ray);
        const auto inner = std::uint32_t(2 * i), outer = inner + 1;
        const auto nextInner = std::uint32_t(2 * ((i + 1) % kCorners)), nextOuter = nextInner + 1;
        mesh.indices.insert(mesh.indices.end(), {inner, nextInner, outer, outer, nextInner, nextOuter});
    }
    mesh.normalsOS.assign(mesh.positionsOS.size(), glm::vec3(0.0f, 1.0f, 0.0f));
    mesh.texCoords[0].assign(mesh.positionsOS.size(), glm::vec2(0.0f));
    return mesh;
}

} // namespace

glm::dvec3 diffusedStep(double beyondMetres) {
    glm::dvec3 share(0.0);
    forEachGaussian([&](double sigma, const glm::dvec3& weight) {
        share += weight * (0.5 * std::erfc(-beyondMetres / (std::numbers::sqrt2 * sigma)));
    });
    return share;
}

glm::dvec3 diffusedDot(double distanceMetres) {
    // Integrates over the dot's chords perpendicular to the line to its middle: a Gaussian along the line times an
    // error function across it.
    constexpr int kChords = 128;
    glm::dvec3 share(0.0);
    forEachGaussian([&](double sigma, const glm::dvec3& weight) {
        double sum = 0.0;
        for (int i = 0; i < kChords; ++i) {
            // Uniform in angle, so that chords are dense where their length changes fast.
            const double angle = std::numbers::pi * (i + 0.5) / kChords;
            const double along = kTruthDotRadiusMetres * std::cos(angle);
            const double half = kTruthDotRadiusMetres * std::sin(angle);
            const double away = (distanceMetres - along) / sigma;
            sum += half * std::exp(-0.5 * away * away) / (sigma * std::sqrt(2.0 * std::numbers::pi)) *
                   std::erf(half / (std::numbers::sqrt2 * sigma));
        }
        share += weight * (sum * std::numbers::pi / kChords);
    });
    return share;
}

Scene makeDiffusionTruth(const LoadOptions& options, LoadLedger&) {
    Scene scene;
    scene.name = "diffusion_truth";
    scene.background = {0.02f, 0.022f, 0.028f};
    Material skin = lambert("skin", glm::vec3(1.0f));
    skin.subsurface.method = SubsurfaceMethod::TextureSpaceDiffusion;
    skin.subsurface.scaleMetres = float(kTruthScaleMetres);
    skin.castsShadow = false;
    const int diffusing = addMaterial(scene, skin);
    Material dark = lambert("plate", glm::vec3(0.1f));
    dark.doubleSided = true;
    const int plate = addMaterial(scene, dark);
    for (const double x : {kTruthEdgeX, kTruthDotWS.x}) {
        Mesh square;
        appendQuad(square, {x - 0.5, 0.0, 0.5}, {x + 0.5, 0.0, 0.5}, {x + 0.5, 0.0, -0.5}, {x - 0.5, 0.0, -0.5});
        const char* const name = x < 0.0 ? "half lit" : "dot";
        addNode(scene, name, glm::dmat4(1.0), {{addMesh(scene, name, std::move(square)), diffusing}});
    }
    // The same edge without subsurface scattering.
    Mesh strip;
    appendQuad(strip, {kTruthEdgeX - 0.5, 0.0, 0.72}, {kTruthEdgeX + 0.5, 0.0, 0.72}, {kTruthEdgeX + 0.5, 0.0, 0.56},
               {kTruthEdgeX - 0.5, 0.0, 0.56});
    addNode(scene, "half lit, without", glm::dmat4(1.0),
            {{addMesh(scene, "half lit, without", std::move(strip)),
              addMaterial(scene, lambert("paper", glm::vec3(0.9f)))}});
    // Above the camera's view.
    Mesh half;
    appendQuad(half, {kTruthEdgeX - 1.0, kPlatesY, 1.0}, {kTruthEdgeX, kPlatesY, 1.0}, {kTruthEdgeX, kPlatesY, -1.0},
               {kTruthEdgeX - 1.0, kPlatesY, -1.0});
    addNode(scene, "plate", glm::dmat4(1.0), {{addMesh(scene, "plate", std::move(half)), plate}});
    addNode(scene, "plate with a hole", glm::dmat4(1.0),
            {{addMesh(scene, "plate with a hole",
                      plateWithHole(kTruthDotWS + glm::dvec3(0.0, kPlatesY, 0.0), 0.55, kTruthDotRadiusMetres)),
              plate}});
    addDirectionalLight(scene, "sun", {0.0, -1.0, 0.0}, glm::vec3(1.0f), 1.0f);
    scene.lights.back().castsShadow = true;
    keepFirstLights(scene, options);
    addCamera(scene, "above", {0.0, 1.6, 0.9}, {0.0, 0.0, 0.06}, 44.0);
    return scene;
}

} // namespace tessera::scenes::builtin
