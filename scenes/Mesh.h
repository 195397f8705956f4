#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace tessera::scenes {

/// Indexed triangles, counter-clockwise seen from the front. Positions and normals are always present and have the same
/// length; every other attribute is empty or has that length too.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positionsOS;
    std::vector<glm::vec3> normalsOS;  ///< unit length
    std::vector<glm::vec4> tangentsOS; ///< xyz unit length, w handedness (+1 or -1); empty: a renderer derives them
    std::array<std::vector<glm::vec2>, 2> texCoords; ///< origin at the image's top-left corner, v down
    std::vector<glm::vec4> colors;                   ///< linear, multiply baseColor
    std::vector<std::uint32_t> indices;              ///< three per triangle
};

} // namespace tessera::scenes
