#pragma once
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/image/FlatTest.h"
#include "tests/image/GlassTest.h"

/// Shared scenes and fixtures of tests of the refracted background of glass.
namespace tessera::test {

inline constexpr int kBehindPixels = 48;                          ///< side of an image, which spans 2 m
inline constexpr double kBehindPixelMetres = 2.0 / kBehindPixels; ///< orthographic
inline constexpr double kBehindWallMetres = 2.0;                  ///< behind z = 0
inline constexpr double kBehindTiltRadians = 0.5;                 ///< of the glass, about y: its left edge comes nearer

/// Two texels; linear filtering makes a ramp of 0 to 1 between their centres.
inline scenes::Image rampImage() {
    return floatImage(2, {{0.0f, 0.25f, 1.0f, 1.0f}, {1.0f, 0.75f, 0.0f, 1.0f}});
}

inline scenes::Image checkerImage() {
    return image8([](int x, int y) { return std::array<int, 4>{30 * x + 20, 30 * y + 20, (x + y) % 2 * 200, 255}; });
}

inline void placeQuad(scenes::Node& node, double z, double halfMetres, double tiltRadians = 0.0) {
    const double cosine = std::cos(tiltRadians), sine = std::sin(tiltRadians);
    glm::dmat4& placed = node.parentFromNode;
    placed = glm::dmat4(1.0);
    placed[0] = glm::dvec4(cosine, 0.0, -sine, 0.0) * halfMetres;
    placed[1] = glm::dvec4(0.0, 1.0, 0.0, 0.0) * halfMetres;
    placed[2] = {sine, 0.0, cosine, 0.0};
    placed[3] = {0.0, 0.0, z, 1.0};
}

/// An unlit wall that fills the image.
inline scenes::Scene wallScene(scenes::Image image, double halfMetres) {
    scenes::Scene scene = texturedScene(quadScene(unlit()), scenes::TextureSlot::BaseColor, std::move(image));
    makeOrthographic(scene.cameras[0], 1.0);
    scene.background = {0.125f, 0.375f, 0.625f};
    placeQuad(scene.nodes[0], -kBehindWallMetres, halfMetres);
    return scene;
}

inline scenes::Scene checkedWall() {
    return wallScene(checkerImage(), 1.5);
}

/// A wall whose colours are linear in x.
inline scenes::Scene rampWall() {
    scenes::Scene scene = wallScene(rampImage(), 4.0);
    scenes::Sampler& sampler = scene.materials[0].texture(scenes::TextureSlot::BaseColor).sampler;
    sampler.magnification = sampler.minification = scenes::Filter::Linear;
    return scene;
}

/// Covers the scene with a quad of glass that is wider than the image.
inline scenes::Scene coveredByGlass(scenes::Scene scene, const scenes::Material& glass, double tiltRadians = 0.0,
                                    double halfMetres = 4.0) {
    placeQuad(addNode(scene, glass), 0.0, halfMetres, tiltRadians);
    return scene;
}

/// Lateral offset of a ray through a slab with parallel faces, by Snell's law; `radians` is the angle of incidence.
inline double asideMetres(double thicknessMetres, double ior, double radians) {
    const double inside = std::asin(std::sin(radians) / ior);
    return thicknessMetres * std::sin(radians) * (1.0 - std::cos(radians) / (ior * std::cos(inside)));
}

/// Orthographic images of walls behind glass.
class GlassBehindTest : public GlassTest {
protected:
    static frame::FrameSettings seeing(frame::Refraction refraction, int samples = 1) {
        frame::FrameSettings settings = ofSide(kBehindPixels);
        settings.refraction = refraction;
        settings.samples = samples;
        settings.filter = frame::TextureFilter::Exact;
        return settings;
    }
    static glm::dvec3 at(const std::vector<float>& picture, int x, int y) {
        const float* const pixel = pixelAt(picture, kBehindPixels, x, y);
        return {pixel[0], pixel[1], pixel[2]};
    }
    static double metresOf(int pixel) { return (pixel + 0.5) * kBehindPixelMetres - 1.0; }
    /// Expects each pixel with a placeOf(x, y) to show that place of the ramp wall, in metres along x, within `pixels`
    /// pixels of the ramp plus `difference`. Returns the number of pixels compared.
    template <typename PlaceOf>
    static int expectPlaces(const std::vector<float>& shown, const std::vector<float>& plain, double pixels,
                            double difference, const PlaceOf& placeOf) {
        int judged = 0;
        for (int y = 0; y < kBehindPixels; ++y)
            for (int x = 0; x < kBehindPixels; ++x) {
                const std::optional<double> place = placeOf(x, y);
                if (!place) continue;
                ++judged;
                const glm::dvec3 step = glm::abs(at(plain, 1, y) - at(plain, 0, y));
                const glm::dvec3 off = glm::abs(at(shown, x, y) - evenlyAt(plain, *place, y));
                if (glm::all(glm::lessThanEqual(off, pixels * step + difference))) continue;
                ADD_FAILURE() << "off by " << off.x << ", " << off.y << ", " << off.z << " at " << x << ", " << y;
                return judged;
            }
        return judged;
    }
    /// Colour at x = `metres` in row y of an image whose colours are linear in x.
    static glm::dvec3 evenlyAt(const std::vector<float>& picture, double metres, int y) {
        const glm::dvec3 left = at(picture, 0, y), right = at(picture, kBehindPixels - 1, y);
        const double share = (metres - metresOf(0)) / (metresOf(kBehindPixels - 1) - metresOf(0));
        return left + share * (right - left);
    }
};

} // namespace tessera::test
