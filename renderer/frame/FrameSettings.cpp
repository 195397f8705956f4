#include "renderer/frame/FrameSettings.h"

#include <algorithm>
#include <charconv>

#include "base/EnumTable.h"
#include "shaders/shared/display.h"
#include "shaders/shared/environment.h"
#include "shaders/shared/shadow_maps.h"

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

constexpr ShadowFilterInfo kShadowFilters[] = {
    {ShadowFilter::Traced, "traced", "rays through the triangles themselves: no bias, no resolution", false, true,
     false},
    {ShadowFilter::Hard, "hard", "one texel of a depth map", true, false, false},
    {ShadowFilter::Pcf, "pcf", "the mean over a square of texels of a depth map", true, false, true},
    {ShadowFilter::Pcss, "pcss", "the mean over as many texels as the penumbra of the light's size is wide", true, true,
     false},
};
static_assert(isInOrder(kShadowFilters, &ShadowFilterInfo::filter, std::size(kShadowFilters)));
static_assert(int(ShadowFilter::Hard) == SHADOW_FILTER_HARD && int(ShadowFilter::Pcf) == SHADOW_FILTER_PCF &&
              int(ShadowFilter::Pcss) == SHADOW_FILTER_PCSS);

constexpr ShadowTerminatorInfo kShadowTerminators[] = {
    {ShadowTerminator::Exact, "exact", "on the triangles themselves"},
    {ShadowTerminator::Softened, "softened", "on the curved surface that their vertex normals imply"},
};

constexpr EnvironmentLightInfo kEnvironmentLights[] = {
    {EnvironmentLight::Off, "off", "it lights nothing", false, false},
    {EnvironmentLight::SplitSum, "split_sum", "from maps filtered beforehand, one look-up for each lobe", true, false},
    {EnvironmentLight::Sampled, "sampled", "by samples of each pixel, which converge to the truth", true, true},
};
static_assert(isInOrder(kEnvironmentLights, &EnvironmentLightInfo::light, std::size(kEnvironmentLights)));
static_assert(int(EnvironmentLight::Off) == ENVIRONMENT_OFF &&
              int(EnvironmentLight::SplitSum) == ENVIRONMENT_SPLIT_SUM &&
              int(EnvironmentLight::Sampled) == ENVIRONMENT_SAMPLED);

constexpr AreaLightsInfo kAreaLights[] = {
    {AreaLights::Ltc, "ltc", "in closed form, by linearly transformed cosines in place of lobes", false},
    {AreaLights::Sampled, "sampled", "by samples of each pixel, which converge to the truth", true},
};
static_assert(isInOrder(kAreaLights, &AreaLightsInfo::lights, std::size(kAreaLights)));

using FarSide = RefractionInfo::FarSide;
constexpr RefractionInfo kRefractions[] = {
    {Refraction::Environment, "environment", "the environment alone", false, FarSide::None},
    {Refraction::OneSide, "one_side", "surfaces along rays that bend once", true, FarSide::None},
    {Refraction::TwoSides, "two_sides", "the same along rays that bend back at a parallel far side", true,
     FarSide::Parallel},
    {Refraction::BackFaces, "back_faces", "the same along rays that bend again at the back faces of meshes", true,
     FarSide::BackFaces},
    {Refraction::ClosedMeshes, "closed_meshes", "back_faces of bodies whose meshes are closed, one_side of others",
     true, FarSide::BackFacesOfClosed},
};
static_assert(isInOrder(kRefractions, &RefractionInfo::refraction, std::size(kRefractions)));

constexpr BackdropInfo kBackdrops[] = {
    {Backdrop::Sharp, "sharp", "the map as it is"},
    {Backdrop::Blurred, "blurred", "as a rough mirror would show it"},
    {Backdrop::Off, "off", "the scene's background colour"},
};

} // namespace

std::span<const EnvironmentLightInfo> environmentLightTable() {
    return kEnvironmentLights;
}

const EnvironmentLightInfo& infoOf(EnvironmentLight light) {
    return kEnvironmentLights[std::size_t(light)];
}

std::span<const AreaLightsInfo> areaLightsTable() {
    return kAreaLights;
}

const AreaLightsInfo& infoOf(AreaLights lights) {
    return kAreaLights[std::size_t(lights)];
}

std::span<const RefractionInfo> refractionTable() {
    return kRefractions;
}

const RefractionInfo& infoOf(Refraction refraction) {
    return kRefractions[std::size_t(refraction)];
}

std::span<const BackdropInfo> backdropTable() {
    return kBackdrops;
}

std::span<const ShadowFilterInfo> shadowFilterTable() {
    return kShadowFilters;
}

std::span<const ShadowTerminatorInfo> shadowTerminatorTable() {
    return kShadowTerminators;
}

const ShadowFilterInfo& infoOf(ShadowFilter filter) {
    return kShadowFilters[std::size_t(filter)];
}

std::span<const ToneMapInfo> toneMapTable() {
    return kToneMaps;
}

std::span<const TextureFilterInfo> textureFilterTable() {
    return kTextureFilters;
}

std::span<const LightingSpaceInfo> lightingSpaceTable() {
    return kLightingSpaces;
}

std::optional<glm::ivec2> sizeIn(std::string_view text) {
    glm::ivec2 size(0);
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.x);
    if (width.ec != std::errc() || width.ptr == end || (*width.ptr != 'x' && *width.ptr != 'X')) return std::nullopt;
    const auto height = std::from_chars(width.ptr + 1, end, size.y);
    if (height.ec != std::errc() || height.ptr != end) return std::nullopt;
    const bool fits = std::min(size.x, size.y) >= 1 && std::max(size.x, size.y) <= kLargestSidePixels;
    return fits ? std::optional(size) : std::nullopt;
}

} // namespace tessera::frame
