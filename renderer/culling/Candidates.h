#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "shaders/shared/culling.h"

namespace tessera::culling {

/// Lights that may touch a part of the view, in ascending order, laid out for testing many at once.
class Candidates {
public:
    /// All of `lights` named in `indices`.
    void assign(std::span<const std::uint32_t> indices, std::span<const shared::CullLight> lights);

    /// Unmarks all; then marks those that touch any of the boxes.
    void mark(std::span<const shared::CellBox> boxes);

    /// Those marked, appended.
    void appendMarked(std::vector<std::uint32_t>& indices) const;
    void copyMarkedTo(Candidates& other) const;

private:
    void resize(std::size_t count);

    std::span<const shared::CullLight> lights_;
    std::vector<std::uint32_t> index_;
    std::vector<float> x_, y_, z_, squaredRadius_; ///< of spheres, culling space, metres
    std::vector<std::uint32_t> mark_; ///< 0 or 1; as wide as the spheres, so that loops over both vectorise
    bool haveSides_ = false;
};

} // namespace tessera::culling
