#include "renderer/frame/DividedOctahedron.h"

#include <tbb/parallel_for.h>

namespace tessera::frame {

glm::dvec3 directionOf(const glm::dvec2& code) {
    glm::dvec3 n(code, 1.0 - std::abs(code.x) - std::abs(code.y));
    if (n.z < 0.0)
        n = {(1.0 - std::abs(code.y)) * (code.x >= 0.0 ? 1.0 : -1.0),
             (1.0 - std::abs(code.x)) * (code.y >= 0.0 ? 1.0 : -1.0), n.z};
    return glm::normalize(n);
}

glm::dvec2 DividedOctahedron::codeOfCorner(int x, int y, int side) {
    return glm::dvec2(2.0 * x, 2.0 * y) / double(side) - 1.0;
}

const glm::vec3& DividedOctahedron::at(int x, int y) const {
    return corners[std::size_t(y) * std::size_t(side + 1) + std::size_t(x)];
}

DividedOctahedron makeDivided(int side, const std::function<glm::dvec3(const glm::dvec3&)>& value,
                              const std::function<void()>& rowDone) {
    const auto pitch = std::size_t(side) + 1;
    DividedOctahedron result{side, std::vector<glm::vec3>(pitch * pitch)};
    tbb::parallel_for(0, side + 1, [&](int y) {
        for (int x = 0; x <= side; ++x)
            result.corners[std::size_t(y) * pitch + std::size_t(x)] =
                glm::vec3(value(directionOf(DividedOctahedron::codeOfCorner(x, y, side))));
        rowDone();
    });
    return result;
}

} // namespace tessera::frame
