#pragma once
#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::reference {

enum class Transfer { Linear, Srgb };

/// The transfer function of a slot's colours; alpha is always linear.
Transfer transferOf(scenes::TextureSlot slot);

/// The linear value of an sRGB code value, both 0..1. Source: IEC 61966-2-1:1999.
double linearFromSrgb(double code);

/// One texel as linear values; float pictures hold linear colours whatever the transfer function. `column` and `row`
/// must lie inside.
glm::dvec4 texelAt(const scenes::Image& image, Transfer transfer, int column, int row);

/// A texel index brought inside 0 .. size - 1.
int wrapped(long long index, int size, scenes::Wrap wrap);

/// Bilinear between the texels of the picture itself, decoded before they are weighted: what --filter exact means.
/// Texel centres lie at (index + 1/2) / size. The sampler's filters are not looked at, its wrapping is.
glm::dvec4 sampleBilinear(const scenes::Image& image, Transfer transfer, const scenes::Sampler& sampler,
                          const glm::dvec2& texCoord);

/// offset + rotation(scale * uv), after KHR_texture_transform.
glm::dvec2 transformed(const scenes::TextureTransform& transform, const glm::dvec2& uv);

} // namespace tessera::reference
