#pragma once
#include <array>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/Image.h"

/// Light from everywhere: a picture of all directions around a scene, infinitely distant (docs/environment.md).
namespace tessera::scenes {

class LoadLedger;

/// Of a map times its intensity: as bright as lights are taken, and far from the end of fp32.
inline constexpr float kMostRadiance = 1e30f;

/// Columns and rows of a map: those of a larger one are averaged when it is loaded. So many texels are 512 MiB of the
/// GPU, and finer than the pixels of a picture of 1280 columns through a lens of 56 degrees.
inline constexpr int kMostMapWidth = 8192, kMostMapHeight = 4096;

/// The radiance of a direction is interpolated bilinearly between the centres of four texels, across the left and right
/// edge alike; beyond the first and last row it is that row's.
struct Environment {
    std::string source;           ///< "builtin:studio", or the absolute path of its file: a picture or a glTF model
    Image map;                    ///< Rgba32Float, RGB 0 to kMostRadiance, in latitude and longitude
    float intensity = 1.0f;       ///< >= 0, multiplies the radiance, up to kMostRadiance
    float rotationDegrees = 0.0f; ///< about +Y, counter-clockwise seen from above
};

/// How a view turns and brightens an environment.
struct EnvironmentView {
    float rotationDegrees = 0.0f; ///< added to the environment's own
    float intensity = 1.0f;       ///< multiplies the environment's own
    bool operator==(const EnvironmentView&) const = default;
};
/// The settings that say so, which are wishes of a scene (SceneOptions) too.
inline constexpr std::array<std::string_view, 2> kEnvironmentViewKeys{"environmentRotation", "environmentIntensity"};

/// An environment's own numbers.
inline EnvironmentView ownViewOf(const Environment& environment) {
    return {environment.rotationDegrees, environment.intensity};
}
/// What an environment's own numbers must be for a view that changes nothing to show it as this view does.
EnvironmentView asSeen(const EnvironmentView& own, const EnvironmentView& view);

/// Where a map holds a unit direction before it is turned: x from the left, y from the top, both 0..1. The middle looks
/// along -Z, the top is +Y.
glm::dvec2 placeInMap(const glm::dvec3& direction);
glm::dvec3 directionInMap(const glm::dvec2& place);

struct BuiltinEnvironment {
    std::string_view name;
    std::string_view purpose;                                  ///< one line: what it is for
    Image (*makeMap)(const std::function<void(double)>& told); ///< `told` as LoadLedger::tellEnvironment() takes it
};
std::span<const BuiltinEnvironment> builtinEnvironments();

/// What is said of a map of more texels than are kept.
std::string averagedText(const std::string& name, int width, int height, int keptWidth, int keptHeight);

/// A map from "builtin:NAME", a picture file, or a glTF model with an image-based light, whose intensity comes with it.
/// Numbers that are no light are replaced, and a map of more than kMostMapWidth x kMostMapHeight texels is averaged to
/// that; `warnings` tells both. Throws InputError that names the file and its fault, or the nearest names.
Environment loadEnvironment(const std::string& source, LoadLedger& ledger, std::vector<std::string>& warnings);

} // namespace tessera::scenes
