#pragma once
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/ImportWishes.h"
#include "scenes/import/ObjLines.h"
#include "scenes/import/Repairs.h"

namespace tessera::scenes::obj {

/// The colours behind positions (v x y z r g b). Blender, three.js and MeshLab write them in sRGB, other programs in
/// bytes.
class VertexColours {
public:
    /// Reads the colour of the position that a 'v' statement defines.
    void read(const Line& line, std::size_t position);

    /// Linear, one a position, white where there is none; empty unless a used position has one.
    std::vector<glm::vec3> take(const std::string& file, ObjColours encoding, const std::vector<bool>& isUsed,
                                Repairs& repairs);

private:
    std::vector<glm::vec3> colours_; ///< as written; kMissing where there is none
    std::string flaw_;               ///< the first of a colour
    int flawLine_ = 0, largeLine_ = 0;
};

} // namespace tessera::scenes::obj
