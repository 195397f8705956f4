#pragma once
#include <cstdint>
#include <string>

#include "renderer/gpu/Id.h"
#include "scenes/Texture.h"

namespace tessera::gpu {

/// Whether a filter reads single texels of a mip level.
bool usesNearest(scenes::Filter filter);

/// A sampler object: filtering and wrapping of a texture.
class Sampler {
public:
    /// `maxAnisotropy` is clamped to the driver's limit; 1 is isotropic.
    Sampler(std::string label, const scenes::Sampler& sampler, float maxAnisotropy = 1.0f);
    /// Bilinear between the texels of level 0, edges clamped.
    static Sampler linearClamp();
    ~Sampler();
    Sampler(Sampler&&) noexcept = default;
    Sampler& operator=(Sampler&&) noexcept = default;

    std::uint32_t id() const { return id_.value(); }

private:
    Id id_;
};

} // namespace tessera::gpu
