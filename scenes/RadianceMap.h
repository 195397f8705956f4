#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/Image.h"

/// Pictures as light: linear numbers that are radiance, or factors of it.
namespace tessera::scenes {

class LoadLedger;

/// How many numbers of a picture were no light.
struct Replaced {
    std::size_t nans = 0, negative = 0, infinite = 0, tooBright = 0;
};

struct RadianceMap {
    Image image;             ///< Rgba32Float, RGB 0 to kMostRadiance, A 1; called as its file is
    bool hasFewBits = false; ///< the file holds whole numbers, taken as sRGB
    Replaced replaced;
};

/// NaN and less than 0 are no light: 0 instead. Infinity becomes the brightest number of the map, and what is above
/// kMostRadiance that. Of RGBA in fp32, in place, since a map may take gigabytes; A becomes 1.
Replaced replaceNoLight(Image& map);

/// A file's picture after replaceNoLight. What is loaded is settled in the ledger. Throws InputError that names the
/// file and its fault.
RadianceMap readRadianceMap(const std::filesystem::path& file, LoadLedger& ledger);

/// A line for each kind of number that was replaced; `who` names the picture.
void warnOfReplaced(const std::string& who, const Replaced& replaced, std::vector<std::string>& warnings);

} // namespace tessera::scenes
