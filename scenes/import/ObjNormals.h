#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>
#include <tiny_obj_loader.h>

namespace tessera::scenes::obj {

/// A normal for every corner of every triangle. Where the file gives none (or one of no length), it is the triangle's
/// own outside smoothing groups, and inside one the mean over the group's triangles at that position, weighted by their
/// angles there, so that it does not depend on how polygons were cut. Source: Thuermer & Wuethrich 1998, "Computing
/// Vertex Normals from Polygonal Facets".
class CornerNormals {
public:
    /// Both must outlive this object.
    CornerNormals(const tinyobj::attrib_t& attributes, const std::vector<tinyobj::shape_t>& shapes);

    /// Which normal a corner has: equal numbers are equal normals.
    std::size_t indexAt(const tinyobj::mesh_t& mesh, std::size_t triangle, std::size_t corner);

    /// Unit length; +Y where a triangle has no area.
    const glm::vec3& operator[](std::size_t index) const { return normals_[index]; }

    bool replacedZeroNormals() const { return replacedZeroNormals_; }

private:
    static std::uint64_t keyOf(int position, unsigned int group);
    glm::dvec3 positionOf(const tinyobj::index_t& index) const;
    bool isGiven(const tinyobj::index_t& index) const;
    std::array<glm::dvec3, 3> weightedNormals(const tinyobj::mesh_t& mesh, std::size_t triangle) const;
    void addSmoothNormals(const std::vector<tinyobj::shape_t>& shapes);

    const tinyobj::attrib_t& attributes_;
    std::vector<glm::vec3> normals_;                        ///< those of the file first
    std::unordered_map<std::uint64_t, std::size_t> smooth_; ///< by position and smoothing group
    const tinyobj::mesh_t* flatMesh_ = nullptr;             ///< the triangle the last normal was made for
    std::size_t flatTriangle_ = 0;
    bool replacedZeroNormals_ = false;
};

} // namespace tessera::scenes::obj
