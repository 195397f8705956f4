#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/Image.h"

/// Images as light: linear values that are radiance, or factors of it.
namespace tessera::scenes {

class LoadLedger;

/// Counts of an image's invalid numbers.
struct Replaced {
    std::size_t nans = 0, negative = 0, infinite = 0, tooBright = 0;
};

struct RadianceMap {
    Image image;             ///< Rgba32Float, RGB 0 to kMostRadiance, A 1; named like its file
    bool hasFewBits = false; ///< the file has an integer format, taken as sRGB
    Replaced replaced;
};

/// Replaces invalid radiance: NaN and negative numbers by 0, infinity by the map's brightest number, and numbers above
/// kMostRadiance by that. Sets A to 1. `map` is RGBA in fp32, changed in place, since it may take gigabytes.
Replaced replaceNoLight(Image& map);

/// Reads an image file and applies replaceNoLight(). Charges the ledger for the result. Throws InputError that names
/// the file and its fault.
RadianceMap readRadianceMap(const std::filesystem::path& file, LoadLedger& ledger);

/// Adds a warning for each kind of number that was replaced; `who` names the image.
void warnOfReplaced(const std::string& who, const Replaced& replaced, std::vector<std::string>& warnings);

} // namespace tessera::scenes
