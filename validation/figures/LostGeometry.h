#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace tessera::validation {

enum class LostKind : std::uint8_t {
    Missing,        ///< the reference shows the instance, the GPU does not
    Extra,          ///< the GPU shows the instance, the reference nothing opaque
    OtherTriangles, ///< both show it, by different triangles
    Transparent     ///< transparent surfaces differ, and no single missing instance explains it
};

/// Geometry that differs between the GPU and the reference by more than rounding.
struct LostGeometry {
    LostKind kind = LostKind::Missing;
    std::optional<std::uint32_t> instance; ///< mesh instance in document order, from 0; none: unknown surfaces
    std::string node, mesh;                ///< the instance's names in the scene, empty where it has none
    std::size_t pixels = 0;
    int x = 0, y = 0; ///< one of the pixels, from the left and from the top

    bool isOfSame(const LostGeometry& other) const { return kind == other.kind && instance == other.instance; }
};

/// One sentence: "instance 12 (node 'coat', mesh 'ball') is missing from 103 pixels, such as 80,45".
std::string lostText(const LostGeometry& lost);
/// "missing", "extra", "other triangles", "transparent".
const char* lostName(LostKind kind);

} // namespace tessera::validation
