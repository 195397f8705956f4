#pragma once
#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Image.h"

/// Image-based lighting: a radiance map of all directions around a scene, infinitely distant (docs/environment.md).
namespace tessera::scenes {

class LoadLedger;

/// Maximum of a map's radiance times its intensity: the same limit as for lights, far below the fp32 maximum.
inline constexpr float kMostRadiance = 1e30f;

/// Maximum size of a map; larger ones are averaged when loaded. This size takes 512 MiB of GPU memory, and its texels
/// are finer than the pixels of an image of 1280 columns with a field of view of 56 degrees.
inline constexpr int kMostMapWidth = 8192, kMostMapHeight = 4096;

/// A radiance map in latitude and longitude. Lookups are bilinear between texel centres, wrap around at the left and
/// right edge and clamp to the first and last row.
struct Environment {
    std::string source;           ///< "builtin:studio", or the absolute path of its file: an image or a glTF model
    Image map;                    ///< Rgba32Float, RGB 0 to kMostRadiance
    float intensity = 1.0f;       ///< >= 0, multiplies the radiance, up to kMostRadiance
    float rotationDegrees = 0.0f; ///< about +Y, counter-clockwise seen from above
};

/// Rotation and intensity that a view applies to an environment.
struct EnvironmentView {
    float rotationDegrees = 0.0f; ///< added to the environment's own
    float intensity = 1.0f;       ///< multiplies the environment's own
    bool operator==(const EnvironmentView&) const = default;
};
/// Keys of the settings of EnvironmentView, which a scene's options (SceneOptions) may request too.
inline constexpr std::array<std::string_view, 2> kEnvironmentViewKeys{"environmentRotation", "environmentIntensity"};

/// An environment's own rotation and intensity.
inline EnvironmentView ownViewOf(const Environment& environment) {
    return {environment.rotationDegrees, environment.intensity};
}
/// Bakes a view into an environment's own values, so that a neutral view displays the result the same.
EnvironmentView asSeen(const EnvironmentView& own, const EnvironmentView& view);

/// Map coordinates of a unit direction in an unrotated map: x from the left, y from the top, both 0..1. The middle
/// looks along -Z, the top is +Y.
glm::dvec2 placeInMap(const glm::dvec3& direction);
glm::dvec3 directionInMap(const glm::dvec2& place);

struct BuiltinEnvironment {
    std::string_view name;
    std::string_view purpose; ///< one line: what it is for
    Image (*makeMap)(
        const std::function<void(double)>& progress); ///< progress callback, see LoadLedger::reportEnvironment()
};
std::span<const BuiltinEnvironment> builtinEnvironments();

/// Warning for a map with more texels than are kept.
std::string averagedText(const std::string& name, int width, int height, int keptWidth, int keptHeight);

/// Loads a map from "builtin:NAME", an image file, or a glTF model with an image-based light, including its intensity.
/// Invalid numbers are replaced and maps above kMostMapWidth x kMostMapHeight texels averaged, both with a warning.
/// Throws InputError that names the file and its fault, or the nearest names.
Environment loadEnvironment(const std::string& source, LoadLedger& ledger, std::vector<std::string>& warnings);

} // namespace tessera::scenes
