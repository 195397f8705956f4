#pragma once
#include <cstdint>
#include <vector>

namespace tessera::reference {

/// The triangles visible at a pixel.
struct Ids {
    std::uint32_t object = 0;      ///< 1 + the opaque surface's mesh instance in document order; 0 without one
    std::uint32_t triangle = 0;    ///< of its mesh
    std::uint32_t transparent = 0; ///< sum of transparentId() over the surfaces in front
    bool operator==(const Ids&) const = default;
};

/// The same, with the instances of the transparent surfaces.
struct Layers {
    struct Layer {
        std::uint32_t object = 0; ///< as Ids::object
        std::uint32_t id = 0;     ///< transparentId(), the surface's part of Ids::transparent
    };
    /// Triangles that may be visible there instead.
    struct Other {
        Ids ids;
        /// It lies where the opaque surface does, so that the drawing order decides. Otherwise a mask decides, whose
        /// texture may have a hole there within the lookup's tolerance.
        bool isCoincident = false;
    };
    Ids ids;
    std::vector<Layer> transparent; ///< in the order in which they are blended
    std::vector<Other> others;
};

/// A hash below 2^16, so that sums of 256 of them are exact in single precision. Two sets of triangles have the same
/// sum with probability 1/65,536.
inline std::uint32_t transparentId(std::uint32_t objectNumber, std::uint32_t triangle) {
    // Two rounds of a multiplicative hash; both factors are odd, so that no bit of either number is lost.
    const std::uint32_t mixed = (objectNumber + 1u) * 0x9E3779B1u + triangle * 0x85EBCA6Bu;
    return (mixed ^ (mixed >> 15)) * 0xC2B2AE35u >> 16;
}

} // namespace tessera::reference
