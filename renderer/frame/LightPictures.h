#pragma once
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/gpu/Buffer.h"
#include "scenes/Scene.h"

/// Textures of area lights, prefiltered for lobes of any width (docs/area-lights.md#pictures).
namespace tessera::frame {

/// A texture within the outline of a light's surface; lights with the same texture and outline share it.
struct ShownPicture {
    scenes::LightTexture texture;
    scenes::LightType type = scenes::LightType::Rectangle;
    scenes::LightCorners corners; ///< of a polygon
    bool operator==(const ShownPicture&) const = default;
};

struct LightPictures {
    std::vector<ShownPicture> shown;
    std::vector<int> ofLight; ///< by Scene::lights: index into `shown`, or -1; empty without textured lights

    int numberOf(std::size_t light) const { return ofLight.empty() ? -1 : ofLight[light]; }
};
LightPictures lightPictures(const scenes::Scene& scene);

/// Packs LightShapeTexels::attenuation.w and SeenLightTexels::radiance.w (shaders/shared/light_pictures.h).
float packSides(bool isTwoSided, int picture);

struct PictureLevel {
    int width = 1, height = 1; ///< texels
    double deviation = 0.0;    ///< of its Gaussian, in fractions of the image's sides
};
/// The levels of an image; width and height are those of level 0.
std::vector<PictureLevel> pictureLevels(int width, int height);

/// Bytes of prefilteredPictures(). Throws InputError if shaders cannot index that many texels.
std::size_t lightPictureBytes(std::span<const ShownPicture> shown);

/// Texels in the layout of shaders/shared/light_pictures.h. Gaussians are truncated at three deviations and at the
/// light's outline, and normalised, so that a uniform image stays the same in all levels. They are shifted, by row and
/// by column, so that their mean position is the texel's.
std::vector<glm::vec4> prefilteredPictures(std::span<const ShownPicture> shown);

/// prefilteredPictures() on the GPU, rebuilt for a new list.
class LightPicturesGpu {
public:
    const gpu::Buffer& texels(const std::vector<ShownPicture>& shown);

private:
    std::vector<ShownPicture> shown_;
    std::unique_ptr<gpu::Buffer> texels_;
};

} // namespace tessera::frame
