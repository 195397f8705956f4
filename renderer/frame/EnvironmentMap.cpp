#include "renderer/frame/EnvironmentMap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "base/Error.h"
#include "renderer/frame/ComputedCache.h"
#include "renderer/frame/VanDerCorput.h"
#include "renderer/gpu/Context.h"

namespace tessera::frame {

namespace {

constexpr std::size_t kSamples = std::size_t{1} << ENVIRONMENT_SAMPLES_LOG2;

/// The second dimension of the sequence of Sobol. Source: Sobol 1967, "On the distribution of points in a cube and the
/// approximate evaluation of integrals".
double sobol(std::uint32_t index) {
    std::uint32_t result = 0;
    for (std::uint32_t direction = 1u << 31; index != 0; index >>= 1, direction ^= direction >> 1)
        if ((index & 1u) != 0) result ^= direction;
    return double(result) * 0x1p-32;
}

} // namespace

bool isLitByEnvironment(const scenes::Scene& scene, const FrameSettings& settings) {
    return scene.environment && settings.environment.light != EnvironmentLight::Off && !settings.soloLight &&
           scene.environment->intensity * settings.environment.intensity > 0.0f;
}

bool showsEnvironment(const scenes::Scene& scene, const FrameSettings& settings) {
    return scene.environment && settings.environment.backdrop != Backdrop::Off && showsLitPicture(settings.view);
}

shared::EnvironmentConstants packEnvironment(const scenes::Environment& environment, const FrameSettings& settings,
                                             const CameraView& view) {
    const double turn =
        glm::radians(double(environment.rotationDegrees) + double(settings.environment.rotationDegrees));
    // A map rotated counter-clockwise is looked up with the inverse rotation.
    const glm::dmat4 mapFromWorld = glm::rotate(glm::dmat4(1.0), -turn, glm::dvec3(0.0, 1.0, 0.0));
    shared::EnvironmentConstants constants;
    constants.mapFromLS = glm::mat4(mapFromWorld * glm::dmat4(glm::transpose(view.lsFromWorld)));
    // Clamped to finite values: a black map times infinity would be NaN.
    const double intensity = std::min(double(environment.intensity) * double(settings.environment.intensity),
                                      double(std::numeric_limits<float>::max()));
    constants.light = glm::vec4(float(intensity), float(filteredHalvingsOf(environment.map)), 0.0f, 0.0f);
    return constants;
}

LatitudeMap environmentTexels(const scenes::Image& picture, std::vector<double>& summed) {
    LatitudeMap map = latitudeMapOf(picture);
    summed.resize(map.texels.size());
    double sum = 0.0;
    std::vector<double> averages(map.texels.size());
    for (int y = 0; y < map.height; ++y) {
        const double solidAngle = map.solidAngle(y);
        for (int x = 0; x < map.width; ++x) {
            // The mean of bilinearly interpolated radiance over a texel weights rows and columns by 1/8, 6/8, 1/8.
            double average = 0.0;
            for (int j = -1; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i) {
                    const glm::vec4& texel = map.at(x + i, y + j);
                    const double weight = (i == 0 ? 0.75 : 0.125) * (j == 0 ? 0.75 : 0.125);
                    average += weight * (double(texel.r) + double(texel.g) + double(texel.b));
                }
            const std::size_t at = std::size_t(y) * std::size_t(map.width) + std::size_t(x);
            averages[at] = average;
            summed[at] = sum += average * solidAngle;
        }
    }
    if (!(sum > 0.0)) summed.clear();
    for (double& part : summed) part /= sum;
    for (std::size_t i = 0; i < averages.size(); ++i) map.texels[i].a = sum > 0.0 ? float(averages[i] / sum) : 0.0f;
    return map;
}

std::vector<glm::vec4> makeEnvironmentSamples(const LatitudeMap& map, const std::vector<double>& summed) {
    std::vector<glm::vec4> samples;
    samples.reserve(kSamples * ENVIRONMENT_SAMPLE_TEXELS);
    if (summed.empty()) return std::vector<glm::vec4>(kSamples * ENVIRONMENT_SAMPLE_TEXELS, glm::vec4(0.0f));
    for (std::uint32_t i = 0; i < kSamples; ++i) {
        const double u = vanDerCorput(i), v = sobol(i);
        const auto found = std::min(std::upper_bound(summed.begin(), summed.end(), u), summed.end() - 1);
        const std::size_t at = std::size_t(found - summed.begin());
        const double before = at == 0 ? 0.0 : summed[at - 1], part = *found - before;
        const int x = int(at % std::size_t(map.width)), y = int(at / std::size_t(map.width));
        // Within the texel: the rest of u to the right, v by solid angle downwards.
        const double right = part > 0.0 ? std::clamp((u - before) / part, 0.0, 1.0) : 0.5;
        const double cosine = std::lerp(map.cosineOfRow(y), map.cosineOfRow(y + 1), v);
        const glm::dvec3 direction = scenes::directionInMap(
            {(x + right) / map.width, std::acos(std::clamp(cosine, -1.0, 1.0)) / std::numbers::pi});
        samples.emplace_back(glm::vec3(direction), map.texels[at].a);
        samples.emplace_back(glm::vec3(map.radiance(direction)), 0.0f);
    }
    return samples;
}

EnvironmentShape environmentShape(const scenes::Image& map) {
    const glm::ivec2 atlas = atlasTexels(filteredHalvingsOf(map));
    EnvironmentShape shape;
    shape.map = {graph::Format::Rgba32Float, map.width, map.height};
    shape.filtered = {graph::Format::Rgba32Float, atlas.x, atlas.y};
    shape.sampleBytes = kSamples * ENVIRONMENT_SAMPLE_TEXELS * sizeof(glm::vec4);
    return shape;
}

EnvironmentGpu::EnvironmentGpu(const scenes::Environment& environment,
                               std::shared_ptr<const FilteredEnvironment> filtered)
    : environment_(environment), known_(std::move(filtered)) {
    const int most = gpu::Context::current()->capabilities().maxTextureSize; // checked before the slow filtering
    const scenes::Image& map = environment.map;
    if (std::max(map.width, map.height) > most)
        throw InputError(
            fmt::format("environment '{}' has {}x{} texels; this driver's textures have at most {} a side, so "
                        "make it smaller",
                        map.name, map.width, map.height, most));
}

const gpu::Texture& EnvironmentGpu::map() {
    if (map_) return *map_;
    auto map = std::make_unique<gpu::Texture>("environment_map", environmentShape(environment_.map).map);
    map->upload(0, environment_.map.texels);
    map_ = std::move(map);
    return *map_;
}

const gpu::Buffer& EnvironmentGpu::samples() {
    if (samples_) return *samples_;
    std::vector<double> summed;
    const LatitudeMap texels = environmentTexels(environment_.map, summed);
    auto samples =
        std::make_unique<gpu::Buffer>(gpu::Buffer::of("environment_samples", makeEnvironmentSamples(texels, summed)));
    map();
    map_->upload(0, texels.texels); // with the densities, which only the samples need
    samples_ = std::move(samples);
    return *samples_;
}

const gpu::Texture& EnvironmentGpu::filtered() {
    if (filtered_) return *filtered_;
    auto filtered = std::make_unique<gpu::Texture>("environment_filtered", environmentShape(environment_.map).filtered);
    filtered->upload(0, atlasOf(known_ ? *known_ : cachedEnvironment(environment_.map, cacheFolder())));
    filtered_ = std::move(filtered);
    known_.reset();
    return *filtered_;
}

} // namespace tessera::frame
