#pragma once
#include <cstddef>
#include <vector>

#include "renderer/graph/Format.h"
#include "scenes/Scene.h"

namespace tessera::frame {

/// The format that stores a picture's texels; `srgb`: of colours that the format decodes where it can. Float pictures
/// hold linear colours whatever `srgb` says; 16-bit sRGB is stored decoded, since OpenGL has no format for it.
graph::Format storedFormat(scenes::TexelFormat format, bool srgb);

/// Whether storedFormat() differs from the picture's own, so that level 0 has to be decodedTexels(). Alpha is linear as
/// it is.
bool isStoredDecoded(const scenes::Image& image, bool srgb);
std::vector<float> decodedTexels(const scenes::Image& image);

/// Whether some level has an odd side, whose reduction OpenGL leaves to drivers (OpenGL 4.5 core, section 8.14.4):
/// Mesa's leaves out a third of the texels of three. Where each level has just twice the size of the next, drivers take
/// the mean of 2 x 2.
bool hasOddLevel(int width, int height);

/// Levels 1 and up, from the largest to one texel, as storedFormat() has them. A level has half the size of the one
/// before, rounded down, and its texels are the means of the texels that they cover there, by area, in linear light.
std::vector<std::vector<std::byte>> smallerLevels(const scenes::Image& image, bool srgb);

} // namespace tessera::frame
