#pragma once
#include "scenes/ImportOptions.h"
#include "scenes/import/ObjLines.h"
#include "scenes/import/Repairs.h"

namespace tessera::scenes::obj {

/// Vertex colours after positions (v x y z r g b). Blender, three.js and MeshLab write them in sRGB, other programs in
/// bytes.
class VertexColours {
public:
    /// Reads the colour of the position that a 'v' statement defines.
    void read(const Line& line, std::size_t position);

    /// Linear colours, one per position, white if missing; empty unless a used position has one.
    std::vector<glm::vec3> take(const std::string& file, ObjColours encoding, const std::vector<bool>& isUsed,
                                Repairs& repairs);

private:
    std::vector<glm::vec3> colours_; ///< as written; kMissing if there is none
    std::string flaw_;               ///< the first flaw of a colour
    int flawLine_ = 0, largeLine_ = 0;
};

/// Triangulates a polygon of n >= 3 corners into n - 2 triangles of its orientation by ear clipping, shortest cut
/// first, so that a convex quad gets its shorter diagonal. If a polygon that crosses itself or has no area has no ear
/// left, a corner is clipped all the same. Adds the number of visited corners to `steps`; beyond `mostSteps` the rest
/// becomes a fan. Source: Meisters 1975, "Polygons have ears"; a grid finds the corners in a triangle.
std::vector<std::array<std::size_t, 3>> cutPolygon(std::span<const glm::dvec3> corners, std::uint64_t& steps,
                                                   std::uint64_t mostSteps);

/// The attribute indices of a corner, from 0; kNone is absent.
struct Corner {
    int position = kNone;
    int texCoord = kNone;
    int normal = kNone;
};

struct Triangle {
    std::array<Corner, 3> corners;
    int material = kNone;             ///< in ObjFile::materials; kNone before the first usemtl
    std::uint32_t smoothingGroup = 0; ///< 0: none
};

/// The elements between two 'g' or 'o' statements.
struct Group {
    std::string name; ///< may be empty
    std::vector<Triangle> triangles;
    /// Points, and line segments of two corners each, by glTF mode (kPoints, kLines) and material.
    std::map<std::pair<int, int>, std::vector<Corner>> thin;
};

/// The drawable elements of an OBJ file, and the data they refer to.
struct ObjFile {
    std::vector<glm::dvec3> positions;  ///< absolute; finite if used by an element
    glm::dvec3 origin{0.0};             ///< a point near the drawn positions; 0 if they are near 0
    std::vector<glm::vec3> colors;      ///< linear, one per position; may be empty
    std::vector<glm::vec2> texCoords;   ///< v points up from the bottom-left corner
    std::vector<glm::vec3> normalsOS;   ///< of any length, not 0 if used by an element
    std::vector<Group> groups;          ///< those with elements; at least one
    std::vector<std::string> libraries; ///< texts after mtllib, as written
    std::vector<std::string> materials; ///< texts after usemtl, each once
    std::vector<std::string> warnings;
};

/// Reads an OBJ file and triangulates its polygons. Elements that cannot be drawn are left out, and invalid attributes
/// are replaced, with a repair. Throws InputError "file:line: ..." if nothing can be drawn. Charges the ledger for all
/// results of the text, up to the scene.
ObjFile readObj(const std::filesystem::path& file, LoadLedger& ledger, Repairs& repairs);

} // namespace tessera::scenes::obj
