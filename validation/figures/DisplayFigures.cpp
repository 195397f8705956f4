#include "validation/figures/DisplayFigures.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "validation/figures/Flip.h"

namespace tessera::validation {

DisplayFigures displayFigures(const DisplayImage& a, const DisplayImage& b, std::span<const PixelState> state) {
    assert(state.size() == a.pixelCount() && state.size() == b.pixelCount());
    DisplayFigures figures;
    const auto compared = double(std::count(state.begin(), state.end(), PixelState::Compared));
    if (compared == 0.0) {
        figures.psnrReason = figures.flipReason = "no pixel could be compared";
        return figures;
    }
    const std::vector<float> errors = flipErrors(a, b);
    double squares = 0.0, flip = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (state[i] != PixelState::Compared) continue;
        flip += double(errors[i]);
        for (std::size_t c = 0; c < 3; ++c) {
            const double difference = double(a.rgb[3 * i + c]) - double(b.rgb[3 * i + c]);
            squares += difference * difference;
        }
    }
    figures.flip = flip / compared;
    if (squares == 0.0)
        figures.psnrReason = "infinite: the pictures are identical on an 8 bit display";
    else
        figures.psnr = 10.0 * std::log10(255.0 * 255.0 / (squares / (3.0 * compared)));
    return figures;
}

} // namespace tessera::validation
