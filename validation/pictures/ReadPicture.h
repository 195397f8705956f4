#pragma once
#include <string>

#include "base/Picture.h"
#include "scenes/LoadLedger.h"

namespace tessera::validation {

/// Reads a picture of any format that textures may have (scenes/import/Importers.h) as linear radiance. Floating-point
/// pixels are taken as they are; integer pixels are decoded from sRGB, unless the file declares itself linear. One
/// channel is read as grey. Covered is where alpha > 0; everywhere when the file has no alpha, or when a file not
/// written by Tessera has alpha 0 throughout. The ledger is charged for it. Throws InputError naming the file and what
/// is wrong with it.
Picture readPicture(const std::string& path, scenes::LoadLedger& ledger);

} // namespace tessera::validation
