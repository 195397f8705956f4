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

/// Light from everywhere, as the GPU has it (docs/environment.md).
namespace tessera::frame {

/// Whether a frame's surfaces are lit by the scene's environment. A light that is shown alone is alone.
bool isLitByEnvironment(const scenes::Scene& scene, const FrameSettings& settings);
/// Whether it is seen where nothing is drawn.
bool showsEnvironment(const scenes::Scene& scene, const FrameSettings& settings);

shared::EnvironmentConstants packEnvironment(const scenes::Environment& environment, const FrameSettings& settings,
                                             const CameraView& view);

/// A map's texels: RGB radiance; A the density in 1/sr with which makeEnvironmentSamples() samples
/// directions there, the same over the texel. Densities follow the average radiance of the texel, interpolated as it
/// is, so that no light is missed. `summed` receives the sum of all texels' parts up to each, from 0 to 1; empty: no
/// texel has any light.
LatitudeMap environmentTexels(const scenes::Image& picture, std::vector<double>& summed);

/// 2^ENVIRONMENT_SAMPLES_LOG2 samples of a map by those sums, each of ENVIRONMENT_SAMPLE_TEXELS.
std::vector<glm::vec4> makeEnvironmentSamples(const LatitudeMap& map, const std::vector<double>& summed);

/// The textures and the buffer of a map on the GPU.
struct EnvironmentShape {
    graph::TextureDesc map, filtered;
    std::size_t sampleBytes = 0;
    bool operator==(const EnvironmentShape&) const = default;
};
EnvironmentShape environmentShape(const scenes::Image& map);

/// An environment on the GPU. Each part is made when it is first asked for; that throws std::runtime_error when memory
/// runs out or the map is larger than the driver's textures.
class EnvironmentGpu {
public:
    /// The environment must outlive it. `filtered` may be null: it is made when it is asked for.
    explicit EnvironmentGpu(const scenes::Environment& environment,
                            std::shared_ptr<const FilteredEnvironment> filtered = {});
    const gpu::Texture& map();      ///< RGB radiance; A as environmentTexels(), once samples() has been asked for
    const gpu::Buffer& samples();   ///< as makeEnvironmentSamples()
    const gpu::Texture& filtered(); ///< as atlasOf()

private:
    const scenes::Environment& environment_;
    std::shared_ptr<const FilteredEnvironment> known_; ///< until it is on the GPU
    std::unique_ptr<gpu::Texture> map_, filtered_;
    std::unique_ptr<gpu::Buffer> samples_;
};

} // namespace tessera::frame
