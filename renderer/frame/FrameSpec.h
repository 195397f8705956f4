#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "renderer/frame/Diffusion.h"
#include "renderer/frame/EnvironmentMap.h"
#include "renderer/frame/FeatureDefines.h"
#include "renderer/frame/Features.h"
#include "renderer/frame/FrameSettings.h"
#include "renderer/frame/GBufferLayout.h"
#include "renderer/frame/HookConstants.h"
#include "renderer/frame/PackedLights.h"
#include "renderer/graph/Plan.h"
#include "renderer/shader/ProgramDesc.h"

namespace tessera::frame {

/// Everything that decides which passes run, with which programs and resources. Made without OpenGL, so that a plan can
/// be shown, and every program checked, without a context.
struct FrameSpec {
    FrameSettings settings;
    FeatureSet features;
    std::vector<Channel> channels; ///< of the G-buffer
    culling::Choice culling;
    LightingStage lightOn = LightingStage::Fragment; ///< for techniques with a lighting pass
    std::size_t lights = 0;                          ///< lights that pixels may visit
    std::size_t shadowedLights = 0;                  ///< those of them that cast shadows
    std::size_t areaLights = 0;                      ///< those of them with a surface
    std::size_t shadowSamples = 0;                   ///< shadow rays or disk samples of all shadowed lights
    std::size_t iterations = 0;                      ///< of loops, to light a pixel in range of all lights
    glm::ivec2 shadowAtlasTexels{0};                 ///< with shadow maps
    std::size_t shadowFaces = 0;                     ///< in the atlas
    bool lightsEverywhere = false;                   ///< some lights have unlimited range, others do not
    int samples = 1;                                 ///< per pixel of render targets
    glm::vec4 background{0.0f};                      ///< radiance where nothing is drawn; a is 0, the coverage
    std::optional<EnvironmentShape> environment;     ///< if it lights surfaces or is displayed
    bool showsEnvironment = false;                   ///< as the background
    std::optional<HookShape> hook;                   ///< the scene's hook, if it changes surfaces
    std::size_t seenLights = 0;                      ///< area lights whose surface may be visible
    bool showsLightPictures = false;                 ///< some of them are textured
    std::size_t lightPictureBytes = 0;               ///< of the textures of all the scene's lights
    bool showsBehindGlass = false; ///< refracted rays of volumes and rough sheets show opaque surfaces
    bool blursBehindGlass = false; ///< some of those rays are scattered
    bool scattersBySheets = false; ///< thin sheets scatter light from opaque surfaces or the environment
    bool drawsFarSides = false;    ///< draws back faces of volumes, where rays leave them
    bool passesByLobes = false;    ///< some transmissive surface may be rough: LobeTable.h

    /// Texture slots in use that are dropped for lack of texture units, lowest priority first.
    std::vector<scenes::TextureSlot> withoutTextures;
    bool hasNoRoomBehindGlass = false; ///< refraction omits surfaces only for lack of texture units

    /// By cell of the view's DiffusionAtlas: the specs that render irradiance into the texels of diffusing objects.
    std::vector<FrameSpec> diffusionViews;
    std::optional<DiffusionKernel> diffusionKernel; ///< set in the spec of a diffusing object
    int gutterTexels = 0;                           ///< of its UV atlas (Diffusion.h)

    bool isInAtlas() const { return diffusionKernel.has_value(); }
    /// Side of an object's UV atlas at the diffusion resolution, in texels.
    int diffusionTexels() const {
        return std::max(1, settings.diffusion.sideTexels / (settings.diffusion.half ? 2 : 1));
    }
    DiffusionAtlas diffusionAtlas() const { return frame::diffusionAtlas(diffusionViews.size(), diffusionTexels()); }
    /// Bytes of the DiffusionAtlas and, per object, of its irradiance and the undiffused part of it.
    double diffusionBytes() const {
        const glm::dvec2 texels(diffusionAtlas().texels());
        const double side = double(diffusionTexels());
        return double(sizeof(glm::vec4)) * (texels.x * texels.y + 2.0 * side * side * double(diffusionViews.size()));
    }

    bool usesEnvironmentMap() const;     ///< at full resolution
    bool lightsByEnvironmentMap() const; ///< lights surfaces, by samples or mirrors
    bool usesEnvironmentSamples() const;
    bool usesFilteredEnvironment() const;
    bool usesLobeTable() const;
    bool lightsByLobeTable() const; ///< lights surfaces, by area lights or an environment
    bool usesLobeShapes() const;
    bool usesAreaSamples() const;
    bool compensatesLobes() const;
    bool usesLightPictures() const { return features[Feature::LightPictures] || showsLightPictures; }

    /// Whether shadows are ray traced.
    bool tracesShadows() const { return features[Feature::Shadows] && !features[Feature::ShadowMaps]; }
    /// Warning: loops over shadows and samples of area lights may exceed Mesa's iteration limit, which turns pixels
    /// into NaN (LightRounds.h).
    bool mayCutLoops() const;

    /// G-buffer textures by attachment: its channels, then the flag bits (markTable()) if an attachment is left.
    std::vector<GBufferTexture> gbufferTextures() const;
    /// Defines of shaders that write or read the G-buffer.
    Defines gbufferDefines() const;
    int gbufferBytesPerPixel() const; ///< without depth
    /// A texture of the image's size.
    graph::TextureDesc texture(graph::Format format) const {
        return {format, settings.sizePixels.x, settings.sizePixels.y, 1};
    }
    /// The coarser levels of the image behind glass, stacked in one texture (shaders/shared/refraction.h).
    graph::TextureDesc behindLevels() const;
    /// A render target of geometry: texture() with the frame's sample count.
    graph::TextureDesc renderTarget(graph::Format format) const {
        return {format, settings.sizePixels.x, settings.sizePixels.y, samples};
    }
};
FrameSpec makeFrameSpec(const scenes::Scene& scene, const PackedLights& lights, const FrameSettings& settings,
                        std::size_t seenLights = 0);

/// The spec that renders the irradiance of a diffusing object for the view of `settings`, with the lights in range.
FrameSpec makeDiffusionSpec(const scenes::Scene& scene, const DiffusionObject& object, const PackedLights& lights,
                            const FrameSettings& settings);

/// Why there are no shadows.
std::string whyNoShadows(const scenes::Scene& scene, const PackedLights& lights, const scenes::ShadowRequest& request);

/// Defines of the light loop in a pass that shades opaque or transparent surfaces.
void addCursorDefines(const FrameSpec& spec, bool transparent, Defines& defines);

/// Number of tiles of the frame's light lists, including those of the transparent layer.
std::size_t lightTileCount(const FrameSpec& spec);

/// A program of the frame; `extra` defines follow the frame's.
shader::ProgramDesc frameProgram(const FrameSpec& spec, std::string name, std::string vertex, std::string fragment,
                                 const Defines& extra);

/// Programs of a depth-only pass. The first samples no textures and reads no materials. A second one, if `masks` and
/// the frame has alpha masks, is for masked materials.
std::vector<shader::ProgramDesc> depthPrograms(const FrameSpec& spec, const std::string& name,
                                               const std::string& fragment, bool masks, Defines extra);

/// What the spec leaves out and why, for a plan. Bytes are those of saved G-buffer channels (if the technique has a
/// G-buffer), vertex streams and lights.
std::vector<graph::Plan::LeftOut> leftOut(const scenes::Scene& scene, const FrameSpec& spec, const PackedLights& lights,
                                          bool gbuffer);

} // namespace tessera::frame
