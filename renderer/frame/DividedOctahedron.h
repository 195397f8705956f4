#pragma once
#include <cmath>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

/// Values of all directions on the square of an unfolded octahedron.
namespace tessera::frame {

/// Unit directions on that square, both coordinates -1..1 (encodeOctahedral() of shaders/lib/maths/octahedral.glsl).
glm::dvec3 directionOf(const glm::dvec2& code);
/// Of directions of any length; inline, since filters look hundreds up for a texel.
inline glm::vec2 codeOf(const glm::vec3& direction) {
    const glm::vec3 size = glm::abs(direction);
    const glm::vec2 p = glm::vec2(direction) / (size.x + size.y + size.z);
    if (!(direction.z < 0.0f)) return p;
    return {std::copysign(1.0f - std::abs(p.y), p.x), std::copysign(1.0f - std::abs(p.x), p.y)};
}

/// Values of all directions at the corners of such a square's side x side cells: side is even, so that the octahedron's
/// edges run along corners. A direction on an outer edge is there twice, at mirrored places of it, and -z four times.
struct DividedOctahedron {
    int side = 0;
    std::vector<glm::vec3> corners; ///< row after row, side + 1 each

    static glm::dvec2 codeOfCorner(int x, int y, int side);
    const glm::vec3& at(int x, int y) const;
};

/// `value` of the unit direction of each corner, on all cores; `rowDone` is called from any thread.
DividedOctahedron makeDivided(
    int side, const std::function<glm::dvec3(const glm::dvec3&)>& value, const std::function<void()>& rowDone = [] {});

} // namespace tessera::frame
