#pragma once
#include <vector>

#include "renderer/frame/GBufferLayout.h"
#include "tests/gpu/gbuffer/GBufferTest.h"

/// Surfaces that ask everything of the G-buffer's encodings.
namespace tessera::test {

/// All over the range of every value.
std::vector<StoredSurface> randomSurfaces(int count);

/// Between two steps of a layout's fields, where rounding is worst.
std::vector<StoredSurface> surfacesBetweenSteps(frame::Encoding encoding, int count);

/// Ends of ranges, and where something could be divided by nothing or change its sign.
std::vector<StoredSurface> surfacesAtTheEnds();

glm::vec3 fromOctahedral(double x, double y);

} // namespace tessera::test
