#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/import/ObjText.h"

namespace tessera::scenes::obj {

/// A normal for every corner of every triangle. Where the file gives none (or one of no length), it is the triangle's
/// own outside smoothing groups, and inside one the mean over the group's triangles at that position, weighted by their
/// angles there, so that it does not depend on how polygons were cut. Source: Thuermer & Wuethrich 1998, "Computing
/// Vertex Normals from Polygonal Facets".
class CornerNormals {
public:
    /// `obj` must outlive this object.
    explicit CornerNormals(const ObjFile& obj);

    /// Which normal a corner of one of the file's triangles has: equal numbers are equal normals.
    std::size_t indexAt(const Triangle& triangle, std::size_t corner);

    /// Unit length; +Y where a triangle has no area.
    const glm::vec3& operator[](std::size_t index) const { return normals_[index]; }

    bool replacedZeroNormals() const { return replacedZeroNormals_; }

private:
    static std::uint64_t keyOf(int position, std::uint32_t smoothingGroup);
    bool isGiven(const Corner& corner) const;
    std::array<glm::dvec3, 3> weightedNormals(const Triangle& triangle) const;
    void addSmoothNormals();

    const ObjFile& obj_;
    std::vector<glm::vec3> normals_;                        ///< those of the file first
    std::unordered_map<std::uint64_t, std::size_t> smooth_; ///< by position and smoothing group
    const Triangle* flatTriangle_ = nullptr;                ///< that the last normal was made for
    bool replacedZeroNormals_ = false;
};

} // namespace tessera::scenes::obj
