#include "renderer/frame/FrameSettings.h"

#include "shaders/shared/display.h"

namespace tessera::frame {

namespace {

constexpr ToneMapInfo kToneMaps[] = {
    {ToneMap::None, "none", "clamps to 0..1"},
    {ToneMap::KhronosNeutral, "khronos_neutral", "keeps base colours, bends highlights (Khronos PBR Neutral)"},
    {ToneMap::Aces, "aces", "filmic contrast (Hill's fit of ACES)"},
    {ToneMap::Agx, "agx", "soft, hues go to white (AgX base look)"},
};
static_assert(static_cast<unsigned>(ToneMap::KhronosNeutral) == TONEMAP_KHRONOS_NEUTRAL);
static_assert(static_cast<unsigned>(ToneMap::Aces) == TONEMAP_ACES &&
              static_cast<unsigned>(ToneMap::Agx) == TONEMAP_AGX);

constexpr TextureFilterInfo kTextureFilters[] = {{TextureFilter::Hardware, "hardware"},
                                                 {TextureFilter::Exact, "exact"}};
constexpr LightingSpaceInfo kLightingSpaces[] = {{LightingSpace::World, "world"}, {LightingSpace::View, "view"}};

} // namespace

std::span<const ToneMapInfo> toneMapTable() {
    return kToneMaps;
}

std::span<const TextureFilterInfo> textureFilterTable() {
    return kTextureFilters;
}

std::span<const LightingSpaceInfo> lightingSpaceTable() {
    return kLightingSpaces;
}

} // namespace tessera::frame
