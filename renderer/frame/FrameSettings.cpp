#include "renderer/frame/FrameSettings.h"

#include <algorithm>

#include "shaders/shared/display.h"

namespace tessera::frame {

namespace {

constexpr ViewInfo kViews[] = {
    {View::Final, 7, "final", "the lit picture", DisplayMapping::Radiance},
    {View::Diffuse, 1, "diffuse", "base colour or k_d, textures included", DisplayMapping::Radiance},
    {View::NormalTexel, 2, "normal_texel", "the normal map's texel as stored", DisplayMapping::Raw},
    {View::Normal, 3, "normal", "the normal that is lit, world space", DisplayMapping::Signed},
    {View::Distribution, 4, "distribution", "D of one light: --solo N, else the first", DisplayMapping::Radiance},
    {View::Geometry, 5, "geometry", "G of one light", DisplayMapping::Radiance},
    {View::Fresnel, 6, "fresnel", "F of one light", DisplayMapping::Radiance},
    {View::Depth, 0, "depth", "distance along the view axis in metres", DisplayMapping::Distance},
    {View::Lights, 0, "lights", "how many lights the pixel visits, as heat colours with a legend",
     DisplayMapping::Count},
    {View::Ids, 0, "ids", "which triangle each pixel shows: mesh instance, triangle, and a sum over transparent ones",
     DisplayMapping::Ids},
};

constexpr ToneMapInfo kToneMaps[] = {
    {ToneMap::None, "none", "clamps to 0..1"},
    {ToneMap::KhronosNeutral, "khronos_neutral", "keeps base colours, bends highlights (Khronos PBR Neutral)"},
    {ToneMap::Aces, "aces", "filmic contrast (Hill's fit of ACES)"},
    {ToneMap::Agx, "agx", "soft, hues go to white (AgX base look)"},
};
static_assert(static_cast<unsigned>(ToneMap::KhronosNeutral) == TONEMAP_KHRONOS_NEUTRAL);
static_assert(static_cast<unsigned>(ToneMap::Aces) == TONEMAP_ACES &&
              static_cast<unsigned>(ToneMap::Agx) == TONEMAP_AGX);
static_assert(static_cast<unsigned>(DisplayMapping::Raw) == DISPLAY_RAW);
static_assert(static_cast<unsigned>(DisplayMapping::Signed) == DISPLAY_SIGNED);
static_assert(static_cast<unsigned>(DisplayMapping::Distance) == DISPLAY_DISTANCE);
static_assert(static_cast<unsigned>(DisplayMapping::Count) == DISPLAY_COUNT);
static_assert(static_cast<unsigned>(DisplayMapping::Ids) == DISPLAY_IDS);

} // namespace

std::span<const ViewInfo> viewTable() {
    return kViews;
}
std::span<const ToneMapInfo> toneMapTable() {
    return kToneMaps;
}
const ViewInfo& viewInfo(View view) {
    return *std::find_if(std::begin(kViews), std::end(kViews),
                         [view](const ViewInfo& info) { return info.view == view; });
}

} // namespace tessera::frame
