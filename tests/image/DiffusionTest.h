#pragma once
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <utility>

#include "scenes/builtin/DiffusionTruth.h"
#include "tests/image/ShadowTest.h"

/// Shared scenes and fixtures of subsurface diffusion tests.
namespace tessera::test {

/// An orthographic camera that looks straight down: x to the right, -z up.
inline scenes::Camera above(const glm::dvec3& middleWS, double halfHeightMetres) {
    scenes::Camera camera;
    camera.name = "above";
    camera.projection = scenes::Projection::Orthographic;
    camera.worldFromCamera = glm::dmat4({1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, -1.0, 0.0}, {0.0, 1.0, 0.0, 0.0},
                                        glm::dvec4(middleWS + glm::dvec3(0.0, 1.0, 0.0), 1.0));
    camera.halfHeightMetres = halfHeightMetres;
    camera.nearMetres = 0.01;
    camera.farMetres = 3.0;
    return camera;
}

struct TruthError {
    double l2 = 0.0;     ///< relative L2 error over all channels
    double energy = 0.0; ///< sum over the image, relative to the sum of the truth
};

/// Compares an image of `above(middle, halfHeight)` with the outgoing radiance truth(positionWS) at each pixel.
template <typename Truth>
TruthError errorOf(const Picture& picture, const scenes::Camera& camera, Truth truth) {
    double wrong = 0.0, whole = 0.0, found = 0.0, wanted = 0.0;
    const double metres = 2.0 * camera.halfHeightMetres / picture.height;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const glm::dvec2 place = metres * (glm::dvec2(x, picture.height - 1 - y) + 0.5 -
                                               0.5 * glm::dvec2(picture.width, picture.height));
            const glm::dvec3 right = truth(glm::dvec3(camera.worldFromCamera[3]) + glm::dvec3(place.x, -1.0, -place.y));
            for (int c = 0; c < 3; ++c) {
                const double own = picture.pixel(std::size_t(y) * std::size_t(picture.width) + std::size_t(x))[c];
                wrong += (own - right[c]) * (own - right[c]);
                whole += right[c] * right[c];
                found += own;
                wanted += right[c];
            }
        }
    return {std::sqrt(wrong / whole), found / wanted};
}

/// A sphere of six charts, each a cube face projected onto it; the charts do not touch in the texture.
inline scenes::Mesh sixCharts(double radiusMetres, int steps) {
    scenes::Mesh mesh;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const double sign = side % 2 == 0 ? 1.0 : -1.0;
        const auto first = std::uint32_t(mesh.positionsOS.size());
        for (int j = 0; j <= steps; ++j)
            for (int i = 0; i <= steps; ++i) {
                const double a = std::tan((2.0 * i / steps - 1.0) * std::numbers::pi / 4.0);
                const double b = std::tan((2.0 * j / steps - 1.0) * std::numbers::pi / 4.0);
                glm::dvec3 place;
                place[axis] = sign;
                place[(axis + 1) % 3] = sign * a;
                place[(axis + 2) % 3] = b;
                // Rounded, so that both sides of an edge give identical bits.
                const glm::dvec3 point = radiusMetres * place / std::sqrt(1.0 + (a * a + b * b));
                mesh.positionsOS.emplace_back(glm::vec3(point * 1048576.0 + 0.0) / 1048576.0f);
                mesh.normalsOS.emplace_back(glm::normalize(point));
                const glm::dvec2 corner(double(side % 3) / 3.0, double(side / 3) / 2.0);
                mesh.texCoords[0].emplace_back(corner + glm::dvec2(0.03 + 0.27 * i / steps, 0.04 + 0.4 * j / steps));
            }
        for (int j = 0; j < steps; ++j)
            for (int i = 0; i < steps; ++i) {
                const std::uint32_t a = first + std::uint32_t(j * (steps + 1) + i), b = a + 1;
                const std::uint32_t c = a + std::uint32_t(steps + 1), d = c + 1;
                mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
            }
    }
    // Merges edge vertices, which each adjacent chart computes.
    for (std::size_t i = 0; i < mesh.positionsOS.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (glm::distance(mesh.positionsOS[i], mesh.positionsOS[j]) < 1e-4f * float(radiusMetres))
                mesh.positionsOS[i] = mesh.positionsOS[j];
    return mesh;
}

/// The sphere with texture-space diffusion under one sun from +z.
inline scenes::Scene sphereScene(double radiusMetres, int steps) {
    scenes::Scene scene = ballUnderSun();
    scene.meshes = {sixCharts(radiusMetres, steps)};
    scene.nodes.resize(1);
    scene.nodes[0].parentFromNode = glm::dmat4(1.0);
    scene.nodes[0].instances = {{0, 0}};
    scenes::Material skin = lambert();
    skin.baseColor = glm::vec4(1.0f);
    skin.subsurface.method = scenes::SubsurfaceMethod::TextureSpaceDiffusion;
    scene.materials = {skin};
    scenes::Camera& camera = scene.cameras[0];
    camera.worldFromCamera = scenes::worldFromLookAt(glm::dvec3(0.9, 0.7, 1.0) * (4.0 * radiusMetres), glm::dvec3(0.0));
    makeOrthographic(camera, 1.05 * radiusMetres);
    camera.nearMetres = 0.01 * radiusMetres;
    camera.farMetres = 20.0 * radiusMetres;
    return scene;
}

/// Sets the first mesh's texture coordinates to `fromXZ` times (x, z) relative to the step's edge, plus 0.5.
inline void mapTexture(scenes::Scene& scene, const glm::dmat2& fromXZ) {
    scenes::Mesh& mesh = scene.meshes[0];
    for (std::size_t i = 0; i < mesh.positionsOS.size(); ++i) {
        const glm::dvec2 place(double(mesh.positionsOS[i].x) - scenes::builtin::kTruthEdgeX,
                               double(mesh.positionsOS[i].z));
        mesh.texCoords[0][i] = glm::vec2(fromXZ * place + 0.5);
    }
}

/// The irradiance step of the scene diffusion_truth, viewed from above; the image is 4/1024 m high.
inline scenes::Scene stepScene() {
    scenes::Scene scene = scenes::loadScene("diffusion_truth");
    scene.cameras = {above({scenes::builtin::kTruthEdgeX, 0.0, 0.0}, 2.0 / 1024.0)};
    return scene;
}
inline frame::FrameSettings stepSettings(int sideTexels) {
    return withDiffusion(ofSize(896, 8), sideTexels);
}
/// Closed-form outgoing radiance at a point of the step scene.
inline glm::dvec3 stepAt(const glm::dvec3& placeWS) {
    return scenes::builtin::diffusedStep(placeWS.x - scenes::builtin::kTruthEdgeX);
}

class DiffusionTest : public ShadowTest {
protected:
    static Picture pictureOf(engine::Renderer& renderer, const frame::FrameSettings& settings) {
        return engine::toPicture(renderer.render(engine::Technique::Deferred, settings));
    }
    Picture pictureOf(const scenes::Scene& scene, const frame::FrameSettings& settings,
                      shader::SourceTree shaders = shader::SourceTree()) {
        engine::Renderer renderer(context(), scene, std::move(shaders));
        return pictureOf(renderer, settings);
    }

    /// Error of the step scene, optionally with another texture mapping.
    TruthError stepError(int side, const std::function<void(scenes::Scene&)>& change = {},
                         shader::SourceTree shaders = shader::SourceTree()) {
        scenes::Scene scene = stepScene();
        if (change) change(scene);
        return errorOf(pictureOf(scene, stepSettings(side), std::move(shaders)), scene.cameras[0], stepAt);
    }
    /// L2 error of the step in an atlas of 256 texels, for a profile of two Gaussians with these standard deviations in
    /// texels. The narrow one carries a twentieth of the light.
    double stepErrorOf(double narrowTexels, double wideTexels, shader::SourceTree shaders = shader::SourceTree(),
                       const glm::dmat2& textureFromXZ = glm::dmat2(1.0)) {
        scenes::Scene scene = stepScene();
        mapTexture(scene, textureFromXZ);
        constexpr int kTexels = 256;
        constexpr double kNarrowShare = 0.05;
        for (scenes::Material& material : scene.materials) {
            const auto variance = [&](double texels) {
                return float(std::pow(1e3 * double(material.subsurface.scaleMetres) * texels / kTexels, 2));
            };
            material.subsurface.profile = {{variance(narrowTexels), glm::vec3(float(kNarrowShare))},
                                           {variance(wideTexels), glm::vec3(float(1.0 - kNarrowShare))}};
        }

        const auto truth = [&](const glm::dvec3& placeWS) {
            const auto step = [&](double texels) {
                return 0.5 *
                       std::erfc((scenes::builtin::kTruthEdgeX - placeWS.x) * kTexels / (std::numbers::sqrt2 * texels));
            };
            return glm::dvec3(kNarrowShare * step(narrowTexels) + (1.0 - kNarrowShare) * step(wideTexels));
        };
        return errorOf(pictureOf(scene, stepSettings(kTexels), std::move(shaders)), scene.cameras[0], truth).l2;
    }
    /// L2 error of the mean along the step's edge, over 96/1024 m: averages out the edge's positions within texels.
    double meanStepError(engine::Renderer& renderer, scenes::Scene& scene, frame::FrameSettings settings) {
        scene.cameras = {above({scenes::builtin::kTruthEdgeX, 0.0, 0.0}, 48.0 / 1024.0)};
        settings.sizePixels = {448, 96};
        const Picture picture = pictureOf(renderer, settings);
        double wrong = 0.0, whole = 0.0;
        for (int x = 0; x < picture.width; ++x) {
            const glm::dvec3 right = scenes::builtin::diffusedStep((x + 0.5 - 0.5 * picture.width) / 1024.0);
            for (int c = 0; c < 3; ++c) {
                double mean = 0.0;
                for (int y = 0; y < picture.height; ++y)
                    mean += double(picture.pixel(std::size_t(y * picture.width + x))[c]) / picture.height;
                wrong += (mean - right[c]) * (mean - right[c]);
                whole += right[c] * right[c];
            }
        }
        return std::sqrt(wrong / whole);
    }
    TruthError dotError(int side, shader::SourceTree shaders = shader::SourceTree()) {
        scenes::Scene scene = scenes::loadScene("diffusion_truth");
        scene.cameras = {above(scenes::builtin::kTruthDotWS, 0.25)};
        const frame::FrameSettings settings = withDiffusion(ofSize(128, 128), side);
        return errorOf(pictureOf(scene, settings, std::move(shaders)), scene.cameras[0], [](const glm::dvec3& placeWS) {
            return scenes::builtin::diffusedDot(glm::distance(placeWS, scenes::builtin::kTruthDotWS));
        });
    }
};

/// Comparisons with closed forms and the reference renderer.
class DiffusionTruth : public DiffusionTest {};
using DiffusionTruthSlow = DiffusionTruth;

} // namespace tessera::test
