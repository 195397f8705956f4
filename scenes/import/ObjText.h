#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/LoadLedger.h"

namespace tessera::scenes::obj {

/// What a corner of a face refers to, counted from 0; kNone is absent.
struct Corner {
    int position = kNone;
    int texCoord = kNone;
    int normal = kNone;
};

struct Triangle {
    std::array<Corner, 3> corners;
    int material = kNone;             ///< in ObjFile::materials; kNone before the first usemtl
    std::uint32_t smoothingGroup = 0; ///< 0: in none
};

/// The part between two 'g' or 'o' statements.
struct Group {
    std::string name; ///< may be empty
    std::vector<Triangle> triangles;
};

/// What the statements of an OBJ file say.
struct ObjFile {
    std::vector<glm::vec3> positionsOS;
    std::vector<glm::vec3> colors;      ///< one a position; empty unless every position has one
    std::vector<glm::vec2> texCoords;   ///< v points up from the bottom-left corner
    std::vector<glm::vec3> normalsOS;   ///< of any length
    std::vector<Group> groups;          ///< those with triangles, of which there is one at least
    std::vector<std::string> libraries; ///< what mtllib says, as written
    std::vector<std::string> materials; ///< the names that usemtl gives, each once
    std::vector<std::string> warnings;
};

/// Reads an OBJ file and cuts its polygons into triangles. Throws InputError "file:line: ..." for a number that is none
/// or not finite, a face's index that is out of range, and "file: ..." when there is no face. Charges the ledger for
/// all that is made of the text, up to the scene.
ObjFile readObj(const std::filesystem::path& file, LoadLedger& ledger);

} // namespace tessera::scenes::obj
