#pragma once
#include <glm/glm.hpp>

#include "scenes/Scene.h"

namespace tessera::reference {

enum class Transfer { Linear, Srgb };

/// The transfer function of a slot's colours; alpha is always linear.
Transfer transferOf(scenes::TextureSlot slot);

/// The linear value of an sRGB code value, both 0..1. Source: IEC 61966-2-1:1999.
double linearFromSrgb(double code);

/// The code value of a linear one, both 0..1.
double srgbFromLinear(double linear);

/// One texel as linear values; float images hold linear colours whatever the transfer function. `column` and `row` must
/// lie inside.
glm::dvec4 texelAt(const scenes::Image& image, Transfer transfer, int column, int row);

/// Wraps a texel index into 0 .. size - 1.
int wrapped(long long index, int size, scenes::Wrap wrap);

/// offset + rotation(scale * uv), after KHR_texture_transform.
glm::dvec2 transformed(const scenes::TextureTransform& transform, const glm::dvec2& uv);

} // namespace tessera::reference
