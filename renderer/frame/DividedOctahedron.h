#pragma once
#include <cmath>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

/// Octahedral maps: functions of direction on the square of an unfolded octahedron.
namespace tessera::frame {

/// Unit direction of a point on that square, both coordinates -1..1 (octahedral.glsl's encodeOctahedral() inverts it).
glm::dvec3 directionOf(const glm::dvec2& code);
/// The inverse, for directions of any length. Inline, since filters call it hundreds of times per texel.
inline glm::vec2 codeOf(const glm::vec3& direction) {
    const glm::vec3 size = glm::abs(direction);
    const glm::vec2 p = glm::vec2(direction) / (size.x + size.y + size.z);
    if (!(direction.z < 0.0f)) return p;
    return {std::copysign(1.0f - std::abs(p.y), p.x), std::copysign(1.0f - std::abs(p.x), p.y)};
}

/// An octahedral map sampled at the corners of side x side cells. `side` is even, so that the octahedron's edges run
/// through corners. Directions on an outer edge are stored twice, mirrored along it, and -z four times.
struct DividedOctahedron {
    int side = 0;
    std::vector<glm::vec3> corners; ///< row after row, side + 1 each

    static glm::dvec2 codeOfCorner(int x, int y, int side);
    const glm::vec3& at(int x, int y) const;
};

/// Evaluates `value` at each corner's unit direction, in parallel; `rowDone` is called from any thread.
DividedOctahedron makeDivided(
    int side, const std::function<glm::dvec3(const glm::dvec3&)>& value, const std::function<void()>& rowDone = [] {});

} // namespace tessera::frame
