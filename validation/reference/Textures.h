#pragma once
#include <optional>
#include <vector>

#include "validation/reference/Pyramid.h"
#include "validation/reference/Settings.h"

namespace tessera::reference {

/// The textures of the drawn materials, ready for lookups.
class Textures {
public:
    /// For materials without textures.
    Textures() = default;
    /// The scene must outlive the object.
    Textures(const scenes::Scene& scene, Filtering filtering);

    Filtering filtering() const { return filtering_; }
    /// `image` must be used by some material in a slot with this transfer function.
    const Pyramid& pyramid(int image, Transfer transfer) const {
        return *pyramids_[2 * std::size_t(image) + std::size_t(transfer)];
    }

private:
    Filtering filtering_ = Filtering::Exact;
    std::vector<std::optional<Pyramid>> pyramids_; ///< two per image, by transfer function
};

} // namespace tessera::reference
