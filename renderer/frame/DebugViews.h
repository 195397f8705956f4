#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "renderer/frame/GBufferLayout.h"

/// The debug views: quantities that a frame can show in place of the lit picture. One table for the command line, the
/// viewer and the documentation. A view, without debug, is a camera with a picture: ViewConstants
/// (shaders/shared/frame.h).
namespace tessera::frame {

/// Up to ShadowAtlas the value is VIEW_* of shaders/shared/views.h. From Stored on a view shows a channel of the
/// G-buffer as it is stored (storedDebugView).
enum class DebugView : std::uint8_t {
    Final,
    Diffuse,
    NormalTexel,
    Normal,
    Distribution,
    Geometry,
    Fresnel,
    Depth,
    Lights,
    Ids,
    NormalView,
    NormalObject,
    Shadow,
    Cascades,
    MovedTooFar,
    Overdraw,
    Faults,
    ShadowAtlas,
    Stored
};

/// How a view's values become a display picture; its value is DISPLAY_* of shaders/shared/display.h.
enum class DisplayMapping : std::uint8_t {
    Radiance,   ///< exposure, tone map, sRGB
    Raw,        ///< code value = value
    Signed,     ///< code value = value / 2 + 1/2
    Distance,   ///< 1 at the eye, 1/2 at 10 m, 0 at infinity
    Count,      ///< the heat colours of shaders/shared/heat.h, logarithmic
    Ids,        ///< a colour of its own for every triangle
    Compressed, ///< x / (1 + x), then sRGB: for values without an upper bound
    Faults,     ///< the luminance so compressed, in grey; NaN, infinite and negative painted (shaders/shared/faults.h)
    ShadowAtlas ///< y in grey, or the colour of face |z| (shaders/shared/face_colors.h): darker where x is 0
};

struct DebugViewInfo {
    DebugView view;
    int key; ///< 1..7, or 0 for a view without a number
    std::string_view name;
    std::string_view meaning;
    DisplayMapping mapping;    ///< of views that show a stored channel: displayMapping()
    bool ofTechnique = false;  ///< shows what the technique does, not the scene: techniques differ in it
    bool needsGBuffer = false; ///< only techniques with a G-buffer have it
};
std::span<const DebugViewInfo> debugViewTable();
const DebugViewInfo& debugViewInfo(DebugView view);

/// A channel as it is stored: its first three components, or the fourth.
struct StoredComponents {
    Channel channel;
    bool fourth;
};
DebugView storedDebugView(StoredComponents components);
std::optional<StoredComponents> storedComponents(DebugView view);

/// By the layout where the view shows a stored channel.
DisplayMapping displayMapping(DebugView view, const GBufferLayout& layout);

/// The end of the display picture's scale where the view shows counts, as a power of two.
int countScaleLog2(DebugView view);

/// The lit picture, whatever is painted over it.
constexpr bool showsLitPicture(DebugView view) {
    return view == DebugView::Final || view == DebugView::Faults;
}
/// Shows the shadows of one light.
constexpr bool showsShadowsOfOne(DebugView view) {
    return view == DebugView::Shadow || view == DebugView::Cascades;
}
/// Adds something up over the lights.
constexpr bool sumsOverLights(DebugView view) {
    return showsLitPicture(view) || view == DebugView::Lights;
}
/// Shows shadow maps.
constexpr bool showsMaps(DebugView view) {
    return view == DebugView::Cascades || view == DebugView::ShadowAtlas;
}
/// Its values depend on shadows.
constexpr bool showsShadows(DebugView view) {
    return showsLitPicture(view) || showsShadowsOfOne(view) || showsMaps(view);
}
/// Needs the channel normal_texel, which lighting does not read.
bool needsNormalTexel(DebugView view);
/// VIEW of the shaders that shade or store surfaces: views that another pass makes of their output take the lit
/// picture's programs.
int shaderView(DebugView view);

} // namespace tessera::frame
