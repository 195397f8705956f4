#pragma once
#include <cstddef>
#include <vector>

#include "renderer/graph/Format.h"
#include "scenes/Scene.h"

namespace tessera::frame {

/// The texture format of an image. `srgb`: colours, which the format decodes if possible. Float images are linear
/// regardless of `srgb`; 16-bit sRGB is stored decoded, since OpenGL has no format for it.
graph::Format storedFormat(scenes::TexelFormat format, bool srgb);

/// Whether storedFormat() differs from the image's format, so that level 0 must be decodedTexels(). Alpha is always
/// linear.
bool isStoredDecoded(const scenes::Image& image, bool srgb);
std::vector<float> decodedTexels(const scenes::Image& image);

/// Whether some level has an odd side, whose reduction OpenGL leaves to drivers (OpenGL 4.5 core, section 8.14.4): Mesa
/// ignores a third of the texels of a side of three. If each level has exactly twice the size of the next, drivers take
/// the mean of 2 x 2.
bool hasOddLevel(int width, int height);

/// Mip levels from 1 to the last with one texel, in storedFormat(). A level has half the size of the one before,
/// rounded down; its texels are the area-weighted means of the texels that they cover there, in linear light.
std::vector<std::vector<std::byte>> smallerLevels(const scenes::Image& image, bool srgb);

} // namespace tessera::frame
