#pragma once
#include <string_view>
#include <vector>

#include "renderer/frame/GBufferLayout.h"

/// How far a stored value may lie from the surface's, derived from the widths of its field: one step, since which of
/// the two nearest steps a pixel takes is dithered (shaders/lib/gbuffer/gbuffer_dither.glsl); half of one for
/// the directions of tangents and coats, which are rounded. The derivations stand in docs/numerics.md. Rounding of the
/// fp32 arithmetic before a step is taken, some 1e-6, comes on top.
namespace tessera::frame {

struct FieldBound {
    Channel channel;
    std::string_view quantity; ///< what the error is of
    std::string_view unit;     ///< empty: none
    double bound;              ///< the largest error
};
/// In table order, of every quantity in a channel with this encoding, which is not Exact.
std::vector<FieldBound> fieldBounds(Encoding encoding);

/// Emission is held at `most`; where the largest colour is below `least`, the error is that of `least`.
struct RadianceRange {
    double least;
    double most;
};
RadianceRange radianceRange(Encoding encoding);

} // namespace tessera::frame
