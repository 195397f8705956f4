#pragma once
#include <span>

#include <glm/glm.hpp>

/// Linearly transformed cosines fitted to GGX lobes, for area lights (docs/area-lights.md). Source: Heitz, Dupuy, Hill,
/// Neubelt 2016, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines".
namespace tessera::frame {

/// LOBE_SHAPES_SIDE squared entries of four numbers, row by row from the smallest alpha on:
/// shaders/shared/lobe_shapes.h. They fit the lobe with height-correlated masking and without Fresnel, times the
/// light's cosine.
std::span<const glm::vec4> lobeShapes();

} // namespace tessera::frame
