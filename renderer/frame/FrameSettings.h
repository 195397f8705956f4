#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>

#include <glm/glm.hpp>

#include "renderer/culling/CullingMethod.h"
#include "renderer/frame/DebugViews.h"
#include "renderer/frame/GBufferLayout.h"
#include "renderer/frame/LightingStage.h"
#include "scenes/Fields.h"
#include "scenes/Shadows.h"
#include "shaders/shared/slots.h"

/// A user's settings of a frame, other than its technique; rows of engine/Settings.cpp. Names are those of the command
/// line; the tables are the only lists.
namespace tessera::frame {

enum class ToneMap : std::uint8_t { None, KhronosNeutral, Aces, Agx };
struct ToneMapInfo {
    ToneMap toneMap; ///< its value is TONEMAP_* of shaders/shared/display.h
    std::string_view name;
    std::string_view summary;
};
std::span<const ToneMapInfo> toneMapTable();

enum class TextureFilter : std::uint8_t { Hardware, Exact };
struct TextureFilterInfo {
    TextureFilter filter;
    std::string_view name;
};
std::span<const TextureFilterInfo> textureFilterTable();

enum class LightingSpace : std::uint8_t { World, View };
struct LightingSpaceInfo {
    LightingSpace space;
    std::string_view name;
};
std::span<const LightingSpaceInfo> lightingSpaceTable();

/// Shadow visibility algorithm.
enum class ShadowFilter : std::uint8_t { Traced, Hard, Pcf, Pcss };
struct ShadowFilterInfo {
    ShadowFilter filter; ///< for map filters the value is SHADOW_FILTER_* of shaders/shared/shadow_maps.h
    std::string_view name;
    std::string_view summary;
    bool usesMaps;  ///< samples depth maps; else traces rays
    bool usesSizes; ///< lights with a size have soft shadows
    bool usesWidth; ///< averages over ShadowMapSettings::widthTexels
};
std::span<const ShadowFilterInfo> shadowFilterTable();
const ShadowFilterInfo& infoOf(ShadowFilter filter);

/// Start of shadow rays on smooth-shaded triangles.
enum class ShadowTerminator : std::uint8_t { Exact, Softened };
struct ShadowTerminatorInfo {
    ShadowTerminator terminator;
    std::string_view name;
    std::string_view summary;
};
std::span<const ShadowTerminatorInfo> shadowTerminatorTable();

/// Settings of shadow maps, for all filters but traced.
struct ShadowMapSettings {
    int widthTexels = 3;                 ///< side of the square that pcf averages, one of kShadowWidths
    std::optional<int> resolutionTexels; ///< face side, one of kShadowResolutions; unset: by light extent in the image
    double budgetMiB = 64.0;             ///< of all faces together; faces are scaled down to fit
    int cascades = 4;                    ///< faces of a directional light, 1 to kMostShadowCascades
    bool operator==(const ShadowMapSettings&) const = default;
};
inline constexpr int kShadowWidths[] = {1, 3, 5, 7};
inline constexpr int kShadowResolutions[] = {64, 128, 256, 512, 1024, 2048, 4096, 8192};
inline constexpr int kMostShadowCascades = 4;

/// Settings of texture-space diffusion (docs/skin.md).
struct DiffusionSettings {
    int sideTexels = 1024; ///< side of an object's atlas, one of kDiffusionSides
    int gaussians = 8;     ///< maximum; neighbours in longer profiles are merged
    bool half = false;     ///< diffuses at half the resolution of the irradiance
    bool operator==(const DiffusionSettings&) const = default;
};
/// All members, in order, by the keys of their settings.
inline constexpr std::tuple kDiffusionFields{
    scenes::Field{"diffusionTexels", &DiffusionSettings::sideTexels},
    scenes::Field{"diffusionGaussians", &DiffusionSettings::gaussians},
    scenes::Field{"diffusionHalf", &DiffusionSettings::half},
};
static_assert(std::tuple_size_v<decltype(kDiffusionFields)> == scenes::detail::memberCount<DiffusionSettings>(),
              "kDiffusionFields lacks a member of DiffusionSettings");
inline constexpr int kDiffusionSides[] = {1, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096};

/// Environment lighting algorithm.
enum class EnvironmentLight : std::uint8_t { Off, SplitSum, Sampled };
struct EnvironmentLightInfo {
    EnvironmentLight light; ///< its value is ENVIRONMENT_* of shaders/shared/environment.h
    std::string_view name;
    std::string_view summary;
    bool lights;      ///< lights surfaces
    bool usesSamples; ///< uses EnvironmentSettings::samples
};
std::span<const EnvironmentLightInfo> environmentLightTable();
const EnvironmentLightInfo& infoOf(EnvironmentLight light);

/// Area lighting algorithm (docs/area-lights.md).
enum class AreaLights : std::uint8_t { Ltc, Sampled };
struct AreaLightsInfo {
    AreaLights lights;
    std::string_view name;
    std::string_view summary;
    bool usesSamples; ///< uses AreaSettings::samples
};
std::span<const AreaLightsInfo> areaLightsTable();
const AreaLightsInfo& infoOf(AreaLights lights);

struct AreaSettings {
    AreaLights lights = AreaLights::Ltc;
    int samples = 16; ///< per pixel, light and sampling strategy, one of kAreaSamples
    bool operator==(const AreaSettings&) const = default;
};
inline constexpr int kAreaSamples[] = {1, 4, 16, 64, 256, 1024};

/// Refraction model of transmissive volumes (docs/glass.md).
enum class Refraction : std::uint8_t { Environment, OneSide, TwoSides, BackFaces, ClosedMeshes };
struct RefractionInfo {
    Refraction refraction;
    std::string_view name;
    std::string_view summary;
    bool showsScene; ///< refracted rays show opaque surfaces; else the environment alone
    /// Where rays leave a volume. BackFacesOfClosed: back faces of closed meshes (scenes/ClosedBodies.h), else None.
    enum class FarSide : std::uint8_t { None, Parallel, BackFaces, BackFacesOfClosed } farSide;
    bool seesBackFaces() const { return farSide == FarSide::BackFaces || farSide == FarSide::BackFacesOfClosed; }
};
std::span<const RefractionInfo> refractionTable();
inline constexpr int kGlassDepths[] = {0, 1, 2, 4, 8};
const RefractionInfo& infoOf(Refraction refraction);

/// Background of the scene.
enum class Backdrop : std::uint8_t { Sharp, Blurred, Off };
struct BackdropInfo {
    Backdrop backdrop;
    std::string_view name;
    std::string_view summary;
};
std::span<const BackdropInfo> backdropTable();

/// Settings of environment lighting (docs/environment.md).
struct EnvironmentSettings {
    EnvironmentLight light = EnvironmentLight::SplitSum;
    int samples = 64;             ///< per pixel and sampling strategy, one of kEnvironmentSamples
    bool compensates = false;     ///< adds multiple scattering to rough lobes of metallic_roughness
    float rotationDegrees = 0.0f; ///< added to the scene's rotation
    float intensity = 1.0f;       ///< >= 0, multiplies the scene's intensity
    Backdrop backdrop = Backdrop::Sharp;
    bool operator==(const EnvironmentSettings&) const = default;
};
inline constexpr int kEnvironmentSamples[] = {1,   4,    16,  64,
                                              256, 1024, 4096}; // powers of 2, for evenly distributed runs

/// Limit that keeps the exposure factor 2^EV within fp32, 2^-126 to 2^128.
inline constexpr float kMostExposureEV = 120.0f; ///< positive or negative

/// Valid sample counts per pixel; a driver may use more.
inline constexpr int kSampleCounts[] = {1, 2, 4};

/// Largest valid side of an image, in pixels.
inline constexpr int kLargestSidePixels = 16384;
/// Parses a size such as "1280x720". Empty if the text is no size or a side is out of range.
std::optional<glm::ivec2> sizeIn(std::string_view text);

inline constexpr int kMostShadowSamples = 1024;

struct FrameSettings {
    glm::ivec2 sizePixels{1280, 720};
    std::optional<glm::ivec2> wholePixels; ///< size of the full image if this is a reduced preview; sets the shadow map
                                           ///< resolution; unset: this is the full image
    int samples = 1;                       ///< per pixel, one of kSampleCounts
    std::vector<glm::vec2> samplePlaces;   ///< the driver's sample positions, `samples` or more; none without a driver
    int camera = 0;                        ///< index into Scene::cameras
    double timeSeconds = 0.0;
    glm::dvec3 eyeOffsetWS{0.0};  ///< metres, added to the camera's position: benchmarks move the eye between frames
    glm::vec2 offsetPixels{0.0f}; ///< subpixel shift of the image to the right and up
    GBufferLayout layout;
    DebugView view = DebugView::Final;
    bool idsOfNearest = false; ///< the view `ids` treats transparent surfaces as opaque, for outlines
    TextureFilter filter = TextureFilter::Hardware;
    LightingSpace space = LightingSpace::World;
    bool prune = true;
    bool specular = true;
    double rangeTolerance = 0.0;   ///< level at which A B C and area lights are truncated (LightRange.h); 0: never
    std::optional<int> soloLight;  ///< index into Scene::lights of the only light that shines; excludes the environment
    scenes::ShadowRequest shadows; ///< which lights cast shadows
    ShadowFilter shadowFilter = ShadowFilter::Traced;
    int shadowSamples = 16; ///< rays or lookups per pixel and light with a size, 1 to kMostShadowSamples
    ShadowMapSettings shadowMaps;
    ShadowTerminator shadowTerminator = ShadowTerminator::Softened;
    scenes::SubsurfaceRequest subsurface;
    DiffusionSettings diffusion;
    EnvironmentSettings environment;
    AreaSettings area;
    Refraction refraction = Refraction::ClosedMeshes;
    int glassDepth = 0; ///< reference only (its Settings.h): volumes that a refracted ray may meet; one of kGlassDepths
    culling::Settings culling;
    std::optional<LightingStage> lightOn; ///< for techniques with a lighting pass; unset: fragment shaders
    float snapPixels = 0.0f;              ///< gpu::Capabilities::snapPixels; set by the renderer
    /// gpu::Capabilities::texturesAStage; set by the renderer.
    int texturesAStage = TEXTURE_UNITS_A_STAGE;
    /// Whether the scene has a volume with closed meshes; set by the renderer. Unset: computed from the scene.
    std::optional<bool> hasClosedBodies;
    bool softwareBackend = true; ///< decides unset options; set by the renderer
    bool display = true;         ///< false: omits the display pass; no display code values are needed
    float exposureEV = 0.0f;
    ToneMap toneMap = ToneMap::None;

    bool operator==(const FrameSettings&) const = default;
};

} // namespace tessera::frame
