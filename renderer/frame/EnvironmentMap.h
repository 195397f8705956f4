#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/frame/CameraView.h"
#include "renderer/frame/EnvironmentFilter.h"
#include "renderer/frame/FrameSettings.h"
#include "renderer/frame/LatitudeMap.h"
#include "renderer/gpu/Buffer.h"
#include "renderer/gpu/Sampler.h"
#include "renderer/gpu/Texture.h"
#include "scenes/Environment.h"
#include "shaders/shared/environment.h"

/// Environment lighting on the GPU: the map, its prefiltered levels and its importance samples (docs/environment.md).
namespace tessera::frame {

/// Whether a frame's surfaces are lit by the scene's environment. A solo light excludes it.
bool isLitByEnvironment(const scenes::Scene& scene, const FrameSettings& settings);
/// Whether the environment is displayed where nothing is drawn.
bool showsEnvironment(const scenes::Scene& scene, const FrameSettings& settings);

shared::EnvironmentConstants packEnvironment(const scenes::Environment& environment, const FrameSettings& settings,
                                             const CameraView& view);

/// A map's texels: RGB radiance; A the density in 1/sr with which makeEnvironmentSamples() samples directions, constant
/// over the texel. Densities are proportional to the texel's mean interpolated radiance, so that no light is missed.
/// `summed` receives the cumulative distribution over the texels, up to 1; empty if the map is black.
LatitudeMap environmentTexels(const scenes::Image& picture, std::vector<double>& summed);

/// 2^ENVIRONMENT_SAMPLES_LOG2 importance samples by that distribution, of ENVIRONMENT_SAMPLE_TEXELS texels each.
std::vector<glm::vec4> makeEnvironmentSamples(const LatitudeMap& map, const std::vector<double>& summed);

/// Sizes and formats of a map's textures and buffer on the GPU.
struct EnvironmentShape {
    graph::TextureDesc map, filtered;
    std::size_t sampleBytes = 0;
    bool operator==(const EnvironmentShape&) const = default;
};
EnvironmentShape environmentShape(const scenes::Image& map);

/// An environment on the GPU. Each part is created on first use, which throws std::runtime_error when memory runs out.
class EnvironmentGpu {
public:
    /// The environment must outlive it. `filtered` may be null: filtered() then computes it. Throws InputError if the
    /// map is larger than the driver's textures.
    explicit EnvironmentGpu(const scenes::Environment& environment,
                            std::shared_ptr<const FilteredEnvironment> filtered = {});
    const gpu::Texture& map();      ///< RGB radiance; A as environmentTexels(), after a call of samples()
    const gpu::Buffer& samples();   ///< as makeEnvironmentSamples()
    const gpu::Texture& filtered(); ///< as atlasOf()

private:
    const scenes::Environment& environment_;
    std::shared_ptr<const FilteredEnvironment> known_; ///< until it is uploaded
    std::unique_ptr<gpu::Texture> map_, filtered_;
    std::unique_ptr<gpu::Buffer> samples_;
};

} // namespace tessera::frame
