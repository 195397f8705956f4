#pragma once
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

/// Cuts a polygon of n >= 3 corners into n - 2 triangles of its orientation by clipping ears, the one with the shortest
/// cut first, so that a convex quad gets its shorter diagonal. Where a polygon that crosses itself or has no area has
/// no ear left, a corner is clipped all the same. Raises `steps` by how often a corner is looked at; once they exceed
/// `mostSteps` the rest is a fan. Source: Meisters 1975, "Polygons have ears"; corners are found by a grid.
std::vector<std::array<std::size_t, 3>> cutPolygon(std::span<const glm::dvec3> corners, std::uint64_t& steps,
                                                   std::uint64_t mostSteps);

/// The attributes of a face's corner, counted from 0; kNone is absent.
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
    /// Points, and segments of lines, two corners each, by their glTF mode (kPoints, kLines) and material.
    std::map<std::pair<int, int>, std::vector<Corner>> thin;
};

/// The elements of an OBJ file that can be drawn, and all that they refer to.
struct ObjFile {
    std::vector<glm::dvec3> positions;  ///< finite where an element uses them; far from 0 where the file is
    glm::dvec3 origin{0.0};             ///< of the drawn positions, which are near it; 0 where they are near 0
    std::vector<glm::vec3> colors;      ///< linear, one a position; may be empty
    std::vector<glm::vec2> texCoords;   ///< v points up from the bottom-left corner
    std::vector<glm::vec3> normalsOS;   ///< of any length but 0 where an element uses them
    std::vector<Group> groups;          ///< those with elements; at least one
    std::vector<std::string> libraries; ///< texts behind mtllib, as written
    std::vector<std::string> materials; ///< texts behind usemtl, each once
    std::vector<std::string> warnings;
};

/// Reads an OBJ file and cuts its polygons into triangles. Elements that cannot be drawn are left out, and attributes
/// that cannot be used are replaced, with a repair. Throws InputError "file:line: ..." where nothing can be drawn.
/// Charges the ledger for all that is made of the text, up to the scene.
ObjFile readObj(const std::filesystem::path& file, LoadLedger& ledger, Repairs& repairs);

} // namespace tessera::scenes::obj
