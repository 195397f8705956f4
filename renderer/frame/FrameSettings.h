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

/// What a user may ask of a frame besides its technique, by rows of engine/Settings.cpp. Names are those of the
/// command line; the tables are the only lists.
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

/// How a point is asked whether casters hide a light from it.
enum class ShadowFilter : std::uint8_t { Traced, Hard, Pcf, Pcss };
struct ShadowFilterInfo {
    ShadowFilter filter; ///< of a map its value is SHADOW_FILTER_* of shaders/shared/shadow_maps.h
    std::string_view name;
    std::string_view summary;
    bool usesMaps;   ///< it looks depth maps up; else it follows rays
    bool heedsSizes; ///< lights with a size have soft shadows
    bool heedsWidth; ///< it averages over ShadowMapSettings::widthTexels
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

/// Of the depth maps that filters other than traced look up.
struct ShadowMapSettings {
    int widthTexels = 3;                 ///< side of the square that pcf averages, one of kShadowWidths
    std::optional<int> resolutionTexels; ///< side of every face, one of kShadowResolutions; open: by what the light
                                         ///< reaches in the picture
    double budgetMiB = 64.0;             ///< of all faces together; those that exceed it are made smaller
    int cascades = 4;                    ///< faces of a directional light, 1 to kMostShadowCascades
    bool operator==(const ShadowMapSettings&) const = default;
};
inline constexpr int kShadowWidths[] = {1, 3, 5, 7};
inline constexpr int kShadowResolutions[] = {64, 128, 256, 512, 1024, 2048, 4096, 8192};
inline constexpr int kMostShadowCascades = 4;

/// Of light that spreads over surfaces (docs/skin.md).
struct DiffusionSettings {
    int sideTexels = 1024; ///< of an object's atlas, one of kDiffusionSides
    int gaussians = 8;     ///< at most; neighbours of a profile that has more become one
    bool half = false;     ///< light is spread at half the resolution that it is computed at
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

/// How the light of an environment on a surface is found.
enum class EnvironmentLight : std::uint8_t { Off, SplitSum, Sampled };
struct EnvironmentLightInfo {
    EnvironmentLight light; ///< its value is ENVIRONMENT_* of shaders/shared/environment.h
    std::string_view name;
    std::string_view summary;
    bool lights;       ///< surfaces
    bool takesSamples; ///< EnvironmentSettings::samples of them
};
std::span<const EnvironmentLightInfo> environmentLightTable();
const EnvironmentLightInfo& infoOf(EnvironmentLight light);

/// How the light of area lights on a surface is found (docs/area-lights.md).
enum class AreaLights : std::uint8_t { Ltc, Sampled };
struct AreaLightsInfo {
    AreaLights lights;
    std::string_view name;
    std::string_view summary;
    bool takesSamples; ///< AreaSettings::samples of them
};
std::span<const AreaLightsInfo> areaLightsTable();
const AreaLightsInfo& infoOf(AreaLights lights);

struct AreaSettings {
    AreaLights lights = AreaLights::Ltc;
    int samples = 16; ///< of a pixel for each light, of each kind, one of kAreaSamples
    bool operator==(const AreaSettings&) const = default;
};
inline constexpr int kAreaSamples[] = {1, 4, 16, 64, 256, 1024};

/// What bodies of glass show (docs/glass.md).
enum class Refraction : std::uint8_t { Environment, OneSide, TwoSides, BackFaces, ClosedMeshes };
struct RefractionInfo {
    Refraction refraction;
    std::string_view name;
    std::string_view summary;
    bool showsScene; ///< opaque surfaces along the rays that bodies bend; else the environment alone
    /// Where rays leave a body; of closed ones those whose meshes are (scenes/ClosedBodies.h), and others nowhere.
    enum class FarSide : std::uint8_t { None, Parallel, BackFaces, BackFacesOfClosed } farSide;
    bool seesBackFaces() const { return farSide == FarSide::BackFaces || farSide == FarSide::BackFacesOfClosed; }
};
std::span<const RefractionInfo> refractionTable();
inline constexpr int kGlassDepths[] = {0, 1, 2, 4, 8};
const RefractionInfo& infoOf(Refraction refraction);

/// What of an environment is seen behind the scene.
enum class Backdrop : std::uint8_t { Sharp, Blurred, Off };
struct BackdropInfo {
    Backdrop backdrop;
    std::string_view name;
    std::string_view summary;
};
std::span<const BackdropInfo> backdropTable();

/// Of light from everywhere (docs/environment.md).
struct EnvironmentSettings {
    EnvironmentLight light = EnvironmentLight::SplitSum;
    int samples = 64;             ///< of a pixel of each kind, one of kEnvironmentSamples
    bool compensates = false;     ///< rough lobes of metallic_roughness for light that meets them more than once
    float rotationDegrees = 0.0f; ///< added to the scene's own
    float intensity = 1.0f;       ///< >= 0, multiplies the scene's own
    Backdrop backdrop = Backdrop::Sharp;
    bool operator==(const EnvironmentSettings&) const = default;
};
inline constexpr int kEnvironmentSamples[] = {1,   4,    16,  64,
                                              256, 1024, 4096}; // powers of 2, so that runs of them are even

/// 2^EV must be a number that a picture can be multiplied by: fp32 spans 2^-126 to 2^128.
inline constexpr float kMostExposureEV = 120.0f; ///< either way

/// Valid sample counts per pixel; a driver may use more.
inline constexpr int kSampleCounts[] = {1, 2, 4};

/// Largest valid side of a picture, in pixels.
inline constexpr int kLargestSidePixels = 16384;
/// The size that a text such as "1280x720" names; nothing where it names none, or one with a side that cannot be.
std::optional<glm::ivec2> sizeIn(std::string_view text);

inline constexpr int kMostShadowSamples = 1024;

struct FrameSettings {
    glm::ivec2 sizePixels{1280, 720};
    std::optional<glm::ivec2> wholePixels; ///< of the picture that this one stands in for while something moves; shadow
                                           ///< maps are as fine as for that one; open: it is whole itself
    int samples = 1;                       ///< of a pixel, one of kSampleCounts
    std::vector<glm::vec2>
        samplePlaces; ///< as the driver places them, `samples` or more; none where no driver was asked
    int camera = 0;   ///< index into Scene::cameras
    double timeSeconds = 0.0;
    glm::dvec3 eyeOffsetWS{0.0};  ///< metres, added to the camera's place: benchmarks move the eye between frames
    glm::vec2 offsetPixels{0.0f}; ///< shifts the picture to the right and up, by parts of a pixel
    GBufferLayout layout;
    DebugView view = DebugView::Final;
    bool idsOfNearest = false; ///< the view ids tells transparent surfaces as if they were opaque: for outlines
    TextureFilter filter = TextureFilter::Hardware;
    LightingSpace space = LightingSpace::World;
    bool prune = true;
    bool specular = true;
    double rangeTolerance = 0.0;   ///< A B C and area lights end where they fall to it (LightRange.h); 0: nowhere
    std::optional<int> soloLight;  ///< index into Scene::lights: only this one shines, not the environment
    scenes::ShadowRequest shadows; ///< which lights cast shadows
    ShadowFilter shadowFilter = ShadowFilter::Traced;
    int shadowSamples = 16; ///< rays or look-ups of a pixel for a light with a size, 1 to kMostShadowSamples
    ShadowMapSettings shadowMaps;
    ShadowTerminator shadowTerminator = ShadowTerminator::Softened;
    scenes::SubsurfaceRequest subsurface;
    DiffusionSettings diffusion;
    EnvironmentSettings environment;
    AreaSettings area;
    Refraction refraction = Refraction::ClosedMeshes;
    int glassDepth = 0; ///< of the reference alone (its Settings.h): glass behind glass; one of kGlassDepths
    culling::Settings culling;
    std::optional<LightingStage> lightOn; ///< of the techniques that light in a pass of its own; open: fragment shaders
    float snapPixels = 0.0f; ///< gpu::Capabilities::snapPixels of the renderer's own backend, which it sets
    /// gpu::Capabilities::texturesAStage of the renderer's own backend, which it sets.
    int texturesAStage = TEXTURE_UNITS_A_STAGE;
    /// Whether the scene has any body whose meshes are closed; open: to be found. The renderer sets it, which knows.
    std::optional<bool> hasClosedBodies;
    bool softwareBackend = true; ///< decides the choices left open; the renderer sets it to its own backend
    bool display = true;         ///< false: display code values are not needed, and the display pass is left out
    float exposureEV = 0.0f;
    ToneMap toneMap = ToneMap::None;

    bool operator==(const FrameSettings&) const = default;
};

} // namespace tessera::frame
