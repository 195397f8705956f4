#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "engine/Rendering.h"
#include "scenes/Load.h"
#include "scenes/LookAt.h"
#include "scenes/Shadows.h"
#include "scenes/builtin/Shapes.h"
#include "tests/support/GlContext.h"
#include "tests/support/Sweep.h"
#include "tests/support/TestScenes.h"
#include "validation/compare/ReferencePicture.h"

/// Shared by image tests: settings, scene parts, and images of the engine and the reference renderer.
namespace tessera::test {

inline constexpr scenes::ShadowRequest kAllLightsCast{scenes::ShadowRequest::Kind::All};

inline frame::FrameSettings ofSize(const glm::ivec2& sizePixels) {
    frame::FrameSettings settings;
    settings.sizePixels = sizePixels;
    return settings;
}
inline frame::FrameSettings ofSize(int width, int height) {
    return ofSize(glm::ivec2(width, height));
}
/// Settings with the texture filter of the reference.
inline frame::FrameSettings exactOfSize(int width, int height) {
    frame::FrameSettings settings = ofSize(width, height);
    settings.filter = frame::TextureFilter::Exact;
    return settings;
}

inline frame::FrameSettings withView(frame::FrameSettings settings, frame::DebugView view) {
    settings.view = view;
    return settings;
}
/// Sets the samples per pixel.
inline frame::FrameSettings withSamples(frame::FrameSettings settings, int samples) {
    settings.samples = samples;
    return settings;
}
/// Enables the shadows of all lights.
inline frame::FrameSettings withShadows(frame::FrameSettings settings,
                                        frame::ShadowFilter filter = frame::ShadowFilter::Traced) {
    settings.shadows = kAllLightsCast;
    settings.shadowFilter = filter;
    return settings;
}
inline frame::FrameSettings withoutShadows(frame::FrameSettings settings) {
    settings.shadows = {scenes::ShadowRequest::Kind::None};
    return settings;
}
/// Sets the side of the diffusion atlas in texels.
inline frame::FrameSettings withDiffusion(frame::FrameSettings settings,
                                          int sideTexels = coarseDiffusion().sideTexels) {
    settings.diffusion.sideTexels = sideTexels;
    return settings;
}

inline scenes::Material materialOf(scenes::MaterialModel model, const glm::vec4& baseColor = glm::vec4(1.0f)) {
    scenes::Material material;
    material.model = model;
    material.baseColor = baseColor;
    return material;
}
inline scenes::Material lambert(const glm::vec4& baseColor = glm::vec4(1.0f)) {
    return materialOf(scenes::MaterialModel::Lambert, baseColor);
}
inline scenes::Material unlit(const glm::vec4& baseColor = glm::vec4(1.0f)) {
    return materialOf(scenes::MaterialModel::SingleColor, baseColor);
}
inline scenes::Material twoSided(scenes::Material material) {
    material.doubleSided = true;
    return material;
}
inline scenes::Material metalOf(double perceptualRoughness) {
    scenes::Material metal;
    metal.perceptualRoughness = float(perceptualRoughness);
    return metal;
}

/// A dielectric without diffuse reflection.
inline scenes::Material blackDielectric(double perceptualRoughness = 1.0) {
    scenes::Material material = metalOf(perceptualRoughness);
    material.baseColor = {0.0f, 0.0f, 0.0f, 1.0f};
    material.metallic = 0.0f;
    return material;
}

/// A directional light; `directionWS` may have any length.
inline scenes::Light sunLight(const glm::dvec3& directionWS, float intensity = 1.0f) {
    scenes::Light sun = pointLight({}, intensity);
    sun.name = "sun";
    sun.type = scenes::LightType::Directional;
    sun.directionWS = glm::normalize(directionWS);
    return sun;
}

inline void makeOrthographic(scenes::Camera& camera, double halfHeightMetres) {
    camera.projection = scenes::Projection::Orthographic;
    camera.halfHeightMetres = halfHeightMetres;
}

/// The unit direction at this cosine to +z, towards +x.
inline glm::dvec3 atCosine(double cosine) {
    return {std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
}
/// Sets an orthographic camera that looks at the origin from 2 m, at this cosine to +z.
inline void lookAtCosine(scenes::Camera& camera, double cosView, double halfHeightMetres) {
    makeOrthographic(camera, halfHeightMetres);
    const double sine = std::sqrt(1.0 - cosView * cosView);
    camera.worldFromCamera = glm::dmat4(1.0);
    camera.worldFromCamera[0] = {cosView, 0.0, -sine, 0.0};
    camera.worldFromCamera[2] = {sine, 0.0, cosView, 0.0};
    camera.worldFromCamera[3] = {2.0 * sine, 0.0, 2.0 * cosView, 1.0};
}

/// The built-in scene `lattice` with this number of lights.
inline scenes::Scene latticeOf(int lights) {
    scenes::LoadOptions options;
    options.lights = lights;
    return scenes::loadScene("lattice", options);
}

/// Adds a node with the first mesh and a new material.
inline scenes::Node& addNode(scenes::Scene& scene, const scenes::Material& material,
                             const glm::dmat4& worldFromNode = glm::dmat4(1.0)) {
    scene.materials.push_back(material);
    scenes::Node node;
    node.parentFromNode = worldFromNode;
    node.instances = {{0, int(scene.materials.size()) - 1}};
    return scene.nodes.emplace_back(std::move(node));
}

/// The reference image by definition alone: no tolerance for rounding or noise.
template <typename SceneOrRenderer>
validation::ReferencePicture strictReference(SceneOrRenderer& of, const frame::FrameSettings& settings) {
    return validation::referencePicture(
        of, settings, [] {}, validation::Alternatives::None);
}
template <typename SceneOrRenderer>
std::vector<float> strictRadiance(SceneOrRenderer& of, const frame::FrameSettings& settings) {
    return strictReference(of, settings).picture.rgba;
}

/// RGBA of pixel (x, y), row 0 on top.
inline const float* pixelAt(const std::vector<float>& radiance, int width, int x, int y) {
    return &radiance[4 * (std::size_t(y) * std::size_t(width) + std::size_t(x))];
}

/// Bilinear interpolation at `place`; at(x, y) returns the values at integer coordinates.
template <typename At>
double interpolated(const glm::dvec2& place, const At& at) {
    const glm::dvec2 corner = glm::floor(place), share = place - corner;
    const int x = int(corner.x), y = int(corner.y);
    return std::lerp(std::lerp(at(x, y), at(x + 1, y), share.x), std::lerp(at(x, y + 1), at(x + 1, y + 1), share.x),
                     share.y);
}

/// Returns all values of a preprocessor definition in the programs of a frame.
inline std::vector<std::string> definedValues(const scenes::Scene& scene, std::string_view definition,
                                              engine::Technique technique = engine::Technique::Deferred,
                                              const frame::FrameSettings& settings = {}) {
    std::vector<std::string> values;
    for (const shader::ProgramDesc& program : engine::framePrograms(scene, technique, settings))
        for (const auto& [name, value] : program.defines)
            if (name == definition) values.push_back(value);
    return values;
}

/// Renders each image with a new renderer.
class ImageTest : public GlTest {
protected:
    engine::RenderedFrame frameOf(const scenes::Scene& scene, const frame::FrameSettings& settings,
                                  engine::Technique technique = engine::Technique::Deferred,
                                  const shader::SourceTree& shaders = {}) {
        return engine::Renderer(context(), scene, shaders).render(technique, settings);
    }
    std::vector<float> drawn(const scenes::Scene& scene, const frame::FrameSettings& settings,
                             engine::Technique technique = engine::Technique::Deferred,
                             const shader::SourceTree& shaders = {}) {
        return frameOf(scene, settings, technique, shaders).radiance;
    }
    Picture picture(const scenes::Scene& scene, const frame::FrameSettings& settings,
                    engine::Technique technique = engine::Technique::Deferred) {
        return engine::toPicture(frameOf(scene, settings, technique));
    }
};

} // namespace tessera::test
