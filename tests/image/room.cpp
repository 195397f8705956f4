#include "scenes/builtin/Room.h"

#include "tests/image/ImageTest.h"

namespace tessera {
namespace {

namespace room = scenes::builtin;
using namespace test;

class Room : public ImageTest {};

/// The ray through a point of the image, in pixels from its top-left corner.
glm::dvec3 rayWS(const scenes::Camera& camera, glm::ivec2 size, double x, double y) {
    const double tangent = std::tan(0.5 * camera.fovYRadians);
    const glm::dvec3 rayVS((2.0 * x / size.x - 1.0) * tangent * size.x / size.y, (1.0 - 2.0 * y / size.y) * tangent,
                           -1.0);
    return glm::dmat3(camera.worldFromCamera) * rayVS;
}

/// The surface at the pixel's centre; none if another one lies within a pixel of it.
std::optional<room::RoomPoint> insideOneSurface(const scenes::Camera& camera, glm::ivec2 size, int x, int y) {
    const glm::dvec3 eyeWS(camera.worldFromCamera[3]);
    const auto center = room::roomPointAlong(eyeWS, rayWS(camera, size, x + 0.5, y + 0.5));
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const auto near = room::roomPointAlong(eyeWS, rayWS(camera, size, x + 0.5 + dx, y + 0.5 + dy));
            if (!center || !near || near->material != center->material) return std::nullopt;
            if (glm::dot(near->normalWS, center->normalWS) < 0.999) return std::nullopt;
        }
    return center;
}

TEST_F(Room, everyPixelIsTheClosedFormWithEveryTechnique) {
    const scenes::Scene scene = scenes::loadScene("room");
    engine::Renderer renderer(context(), scene);
    frame::FrameSettings settings = ofSize(320, 181);
    for (settings.camera = 0; settings.camera < int(scene.cameras.size()); ++settings.camera) {
        const scenes::Camera& camera = scene.cameras[std::size_t(settings.camera)];
        std::vector<std::optional<room::RoomPoint>> points; // of each pixel, for all techniques
        for (int y = 0; y < settings.sizePixels.y; ++y)
            for (int x = 0; x < settings.sizePixels.x; ++x)
                points.push_back(insideOneSurface(camera, settings.sizePixels, x, y));
        for (const engine::TechniqueInfo& technique : engine::techniqueTable()) {
            SCOPED_TRACE(fmt::format("{} {}", camera.name, technique.name));
            const Picture picture = engine::toPicture(renderer.render(technique.technique, settings));
            std::size_t checked = 0;
            std::size_t dark = 0;
            double worst = 0.0;
            for (int y = 0; y < picture.height; ++y)
                for (int x = 0; x < picture.width; ++x) {
                    const auto& seen = points[std::size_t(y) * std::size_t(picture.width) + std::size_t(x)];
                    if (!seen) continue;
                    const glm::dvec3 truth = room::roomRadiance(seen->positionWS, seen->normalWS, seen->material);
                    const float* pixel = picture.pixel(std::size_t(y) * std::size_t(picture.width) + std::size_t(x));
                    for (int c = 0; c < 3; ++c) {
                        // Faces turned away from the lamp are exactly black.
                        if (truth[c] == 0.0) {
                            EXPECT_EQ(pixel[c], 0.0f) << x << "," << y;
                        } else {
                            worst = std::max(worst, std::abs(pixel[c] - truth[c]) / truth[c]);
                        }
                    }
                    dark += truth == glm::dvec3(0.0);
                    ++checked;
                }
            // The required limit. Positions come from a stored fp32 depth, about 1e-6 of the distance, and falloff
            // squares them.
            EXPECT_LE(worst, 1e-4);
            EXPECT_GT(checked, picture.pixelCount() * 8 / 10) << "too few pixels lie clear of edges";
            fmt::print("room {:<7} {:<16} {} pixels, {} of them unlit, worst relative error {:.2g}\n", camera.name,
                       technique.name, checked, dark, worst);
        }
    }
}

} // namespace
} // namespace tessera
