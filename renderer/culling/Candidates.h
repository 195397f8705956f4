#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "shaders/shared/culling.h"

namespace tessera::culling {

/// Candidate lights of a part of the view, in ascending order, stored as arrays so that tests vectorise.
class Candidates {
public:
    /// Sets the candidates to lights[i] for each i in `indices`.
    void assign(std::span<const std::uint32_t> indices, std::span<const shared::CullLight> lights);

    /// Clears all marks, then marks the candidates that touch any of the boxes.
    void mark(std::span<const shared::CellBox> boxes);

    /// Appends the indices of marked candidates.
    void appendMarked(std::vector<std::uint32_t>& indices) const;
    void copyMarkedTo(Candidates& other) const;

private:
    void resize(std::size_t count);

    std::span<const shared::CullLight> lights_;
    std::vector<std::uint32_t> index_;
    std::vector<float> x_, y_, z_, squaredRadius_; ///< bounding spheres in culling space, metres
    std::vector<std::uint32_t> mark_; ///< 0 or 1; 32 bits wide like the spheres, so that loops over both vectorise
    bool haveSides_ = false;
};

} // namespace tessera::culling
