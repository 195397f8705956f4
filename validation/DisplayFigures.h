#pragma once
#include <optional>
#include <span>
#include <string>

#include "validation/Picture.h"
#include "validation/PixelErrors.h"

namespace tessera::validation {

/// How a pair differs on an 8 bit display, over its compared pixels. A figure that is not there has a reason.
struct DisplayFigures {
    /// Peak signal to noise in dB; none when the bytes are identical, where it is infinite.
    std::optional<double> psnr;
    std::optional<double> flip; ///< mean of flipErrors(): 0 (the same) to 1
    std::string psnrReason, flipReason;
};

/// `state` has one entry per pixel. The pictures must be of one size.
DisplayFigures displayFigures(const DisplayImage& a, const DisplayImage& b, std::span<const PixelState> state);

} // namespace tessera::validation
