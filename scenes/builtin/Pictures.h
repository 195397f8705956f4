#pragma once
#include <functional>
#include <string>

#include "scenes/Scene.h"

/// Images drawn by functions of their texels (x, y), which are called from several threads.
namespace tessera::scenes::builtin {

/// An 8-bit image of linear colours; RGB is stored with the sRGB transfer function (IEC 61966-2-1), opacity is 1.
Image drawColors(const std::string& name, int width, int height,
                 const std::function<glm::dvec3(int, int)>& linearColor);

/// An 8-bit image that stores 0..1 linearly, opacity 1.
Image drawValues(const std::string& name, int width, int height, const std::function<glm::dvec3(int, int)>& value);

/// A 16-bit image of unit vectors, stored as n/2 + 1/2.
Image drawNormals(const std::string& name, int width, int height, const std::function<glm::dvec3(int, int)>& normal);

/// An image of linear fp32 values, opacity 1. `progress`, unless empty, is called from any thread with the fraction
/// done.
Image drawRadiance(const std::string& name, int width, int height, const std::function<glm::dvec3(int, int)>& radiance,
                   const std::function<void(double)>& progress = {});

/// The tangent-space normals of a height field that repeats in both directions (x right, y up: against the rows).
/// `texelMetres` is the height field's spacing, heights are in metres.
Image normalsFromHeights(const std::string& name, int size, double texelMetres,
                         const std::function<double(int, int)>& heightMetres);

} // namespace tessera::scenes::builtin
