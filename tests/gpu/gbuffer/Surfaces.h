#pragma once
#include <vector>

#include "renderer/frame/GBufferLayout.h"
#include "tests/gpu/gbuffer/GBufferTest.h"

/// Surfaces that exercise all of the G-buffer's encodings.
namespace tessera::test {

/// Surfaces with random values over the whole range of every quantity.
std::vector<StoredSurface> randomSurfaces(int count);

/// Surfaces with values between two steps of a layout's fields, where rounding is worst.
std::vector<StoredSurface> surfacesBetweenSteps(frame::Encoding encoding, int count);

/// Surfaces at the ends of ranges, and where a divisor could be zero or a sign could change.
std::vector<StoredSurface> surfacesAtTheEnds();

glm::vec3 fromOctahedral(double x, double y);

} // namespace tessera::test
