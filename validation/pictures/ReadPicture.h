#pragma once
#include <string>

#include "base/Picture.h"
#include "scenes/LoadLedger.h"

namespace tessera::validation {

/// Reads an image of any format that textures may have (scenes/import/Importers.h) as linear radiance. Floating-point
/// pixels are taken unchanged; integer pixels are decoded from sRGB, unless the file declares itself linear. One
/// channel is read as grey. Pixels are covered where alpha > 0; all are if the file has no alpha, or if a file not
/// written by Tessera has alpha 0 throughout. Charges its memory to the ledger. Throws InputError naming the file and
/// what is wrong with it.
Picture readPicture(const std::string& path, scenes::LoadLedger& ledger);

} // namespace tessera::validation
