#pragma once
#include <string_view>
#include <vector>

#include "renderer/frame/GBufferLayout.h"

/// Error bounds of stored G-buffer values, derived from the widths of their fields. A bound is one step, because
/// dithering selects which of the two nearest steps a pixel takes (shaders/lib/gbuffer/gbuffer_dither.glsl); half a
/// step for directions of tangents and coats, which are rounded. Derivations: docs/numerics.md. Rounding of the fp32
/// arithmetic before quantisation, some 1e-6, comes on top.
namespace tessera::frame {

struct FieldBound {
    Channel channel;
    std::string_view quantity; ///< the quantity that the error refers to
    std::string_view unit;     ///< empty: none
    double bound;              ///< the largest error
};
/// Bounds of every quantity of every channel in this encoding, in table order. The encoding must not be Exact.
std::vector<FieldBound> fieldBounds(Encoding encoding);

/// Emission is clamped to `most`; if the largest colour is below `least`, the error is that of `least`.
struct RadianceRange {
    double least;
    double most;
};
RadianceRange radianceRange(Encoding encoding);

} // namespace tessera::frame
