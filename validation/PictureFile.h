#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "scenes/LoadLedger.h"
#include "validation/Picture.h"

namespace tessera::validation {

/// Writes a linear picture as OpenEXR: channels R, G, B, A in fp32, losslessly compressed, Rec.709 primaries, no
/// transfer function; A holds the coverage (1 or 0) and is no premultiplication. Every bit of R, G and B survives, NaN,
/// infinities and denormals included. Written whole or not at all; throws std::runtime_error naming the path and the
/// reason.
void writeExr(const std::string& path, const Picture& picture);

/// Writes a display image as PNG of 8 bits per channel. Written whole or not at all; throws as writeExr does.
void writePng(const std::string& path, const DisplayImage& image);

/// The bytes of that PNG. Throws std::runtime_error when they cannot be made.
std::vector<std::uint8_t> encodePng(const DisplayImage& image);

/// Reads a picture of any format that textures may have (scenes/import/Importers.h) as linear radiance. Floating-point
/// pixels are taken as they are; integer pixels are decoded from sRGB, unless the file declares itself linear. One
/// channel is read as grey. Covered is where alpha > 0; everywhere when the file has no alpha, or when a file not
/// written by Tessera has alpha 0 throughout. The ledger is charged for it. Throws InputError naming the file and what
/// is wrong with it.
Picture readPicture(const std::string& path, scenes::LoadLedger& ledger);

} // namespace tessera::validation
