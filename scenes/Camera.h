#pragma once
#include <cstdint>
#include <limits>
#include <string>

#include <glm/glm.hpp>

/// Cameras as plain data.
namespace tessera::scenes {

// Beyond these, squares of distances or depths exceed the range of fp32, and techniques would disagree.
inline constexpr double kNearestPlaneMetres = 1e-9; ///< minimum near plane of a perspective camera
inline constexpr double kFarthestMetres = 1e15;     ///< maximum of world coordinates, near planes and half heights

enum class Projection : std::uint8_t { Perspective, Orthographic };

struct Camera {
    std::string name;
    Projection projection = Projection::Perspective;
    glm::dmat4 worldFromCamera{1.0}; ///< rigid; the camera looks along -Z, Y up
    double fovYRadians = 0.7853981633974483;
    double halfHeightMetres = 1.0;                              ///< Orthographic
    double nearMetres = 0.1;                                    ///< > 0 (Perspective), may be 0 (Orthographic)
    double farMetres = std::numeric_limits<double>::infinity(); ///< nothing beyond is drawn
    bool operator==(const Camera&) const = default;
};

} // namespace tessera::scenes
