#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "renderer/frame/GBufferLayout.h"

/// Debug views: quantities displayed in place of the lit image. One table serves the command line, the viewer and the
/// documentation. Elsewhere a "view" is a camera with an image size: ViewConstants (shaders/shared/frame.h).
namespace tessera::frame {

/// Values up to ShadowAtlas equal VIEW_* of shaders/shared/views.h. Views from Stored on display a G-buffer channel as
/// stored (storedDebugView).
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

/// Mapping of a view's values to display colours; values equal DISPLAY_* of shaders/shared/display.h.
enum class DisplayMapping : std::uint8_t {
    Radiance,   ///< exposure, tone map, sRGB
    Raw,        ///< code value = value
    Signed,     ///< code value = value / 2 + 1/2
    Distance,   ///< 1 at the eye, 1/2 at 10 m, 0 at infinity
    Count,      ///< the heat colours of shaders/shared/heat.h, logarithmic
    Ids,        ///< one colour per triangle
    Compressed, ///< x / (1 + x), then sRGB: for unbounded values
    Faults,     ///< compressed luminance in grey; NaN, infinite and negative values in colour (shaders/shared/faults.h)
    ShadowAtlas ///< y in grey, or the colour of face |z| (shaders/shared/face_colors.h); darkened where x is 0
};

struct DebugViewInfo {
    DebugView view;
    int key; ///< number key 1..7; 0: none
    std::string_view name;
    std::string_view meaning;
    DisplayMapping mapping;    ///< see displayMapping() for stored channels
    bool ofTechnique = false;  ///< depends on the technique, not on the scene alone
    bool needsGBuffer = false; ///< requires a technique with a G-buffer
};
std::span<const DebugViewInfo> debugViewTable();
const DebugViewInfo& debugViewInfo(DebugView view);

/// Components of a stored channel: its first three, or the fourth.
struct StoredComponents {
    Channel channel;
    bool fourth;
};
DebugView storedDebugView(StoredComponents components);
std::optional<StoredComponents> storedComponents(DebugView view);

/// Depends on the layout only for views of stored channels.
DisplayMapping displayMapping(DebugView view, const GBufferLayout& layout);

/// Default upper end of the heat scale of a count view, as a power of two.
int countScaleLog2(DebugView view);

/// Shows the lit image, with or without an overlay.
constexpr bool showsLitPicture(DebugView view) {
    return view == DebugView::Final || view == DebugView::Faults;
}
/// Shows the shadows of one light.
constexpr bool showsShadowsOfOne(DebugView view) {
    return view == DebugView::Shadow || view == DebugView::Cascades;
}
/// Sums over the lights.
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
/// VIEW of the shaders that shade or store surfaces. Views that a later pass derives from their output use the lit
/// image's programs.
int shaderView(DebugView view);

} // namespace tessera::frame
