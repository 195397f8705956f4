#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/gpu/Buffer.h"
#include "scenes/Scene.h"

/// Pictures of area lights, prefiltered for lobes of any width (docs/area-lights.md#pictures).
namespace tessera::frame {

/// A picture within the outline of a light's surface; lights of the same two share it.
struct ShownPicture {
    scenes::LightTexture texture;
    scenes::LightType type = scenes::LightType::Rectangle;
    scenes::LightCorners corners; ///< of a polygon
    bool operator==(const ShownPicture&) const = default;
};

struct LightPictures {
    std::vector<ShownPicture> shown;
    std::vector<int> ofLight; ///< by Scene::lights: the number among `shown`, or -1; empty where no light has one

    int numberOf(std::size_t light) const { return ofLight.empty() ? -1 : ofLight[light]; }
};
LightPictures lightPictures(const scenes::Scene& scene);

/// LightShapeTexels::attenuation.w and SeenLightTexels::radiance.w (shaders/shared/light_pictures.h).
float packSides(bool isTwoSided, int picture);

struct PictureLevel {
    int width = 1, height = 1; ///< texels
    double deviation = 0.0;    ///< of its Gaussian, in parts of the picture's sides
};
/// By the size of level 0.
std::vector<PictureLevel> pictureLevels(int width, int height);

/// Of prefilteredPictures(). Throws InputError where shaders could not count the texels.
std::size_t lightPictureBytes(std::span<const ShownPicture> shown);

/// As shaders/shared/light_pictures.h says. A Gaussian is cut at three deviations and at the edge of the light's
/// surface, and divided by what is left of it, so that an even picture is the same number in all levels.
/// It is moved so that the mean place of what is left is the texel's, row by row and column by column.
std::vector<glm::vec4> prefilteredPictures(std::span<const ShownPicture> shown);

/// They on the GPU, made anew when others are asked for.
class LightPicturesGpu {
public:
    const gpu::Buffer& texels(const std::vector<ShownPicture>& shown);

private:
    std::vector<ShownPicture> shown_;
    std::unique_ptr<gpu::Buffer> texels_;
};

} // namespace tessera::frame
