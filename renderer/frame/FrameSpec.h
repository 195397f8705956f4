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
    LightingStage lightOn = LightingStage::Fragment; ///< where the technique has a lighting pass
    std::size_t lights = 0;                          ///< that the frame's pixels may visit
    std::size_t shadowedLights = 0;                  ///< those among them that casters may hide
    std::size_t areaLights = 0;                      ///< those among them that have a surface
    std::size_t shadowSamples = 0;                   ///< rays, or places of their disks, for all of those
    std::size_t iterations = 0;                      ///< of loops, to light a pixel that all lights reach
    glm::ivec2 shadowAtlasTexels{0};                 ///< where there are shadow maps
    std::size_t shadowFaces = 0;                     ///< in the atlas
    bool lightsEverywhere = false;                   ///< some lights reach everywhere, while others do not
    int samples = 1;                                 ///< that the pixels of render targets have
    glm::vec4 background{0.0f};                      ///< radiance where nothing is drawn; a is 0, the coverage
    std::optional<EnvironmentShape> environment;     ///< where it lights surfaces, or is seen
    bool showsEnvironment = false;                   ///< behind the scene
    std::optional<HookShape> hook;                   ///< of the scene, where it changes surfaces
    std::size_t seenLights = 0;                      ///< area lights whose surface the picture may show
    bool showsLightPictures = false;                 ///< some of them have one
    std::size_t lightPictureBytes = 0;               ///< of all pictures of the scene's lights
    bool showsBehindGlass = false;                   ///< bodies and rough sheets show opaque surfaces along their rays
    bool blursBehindGlass = false;                   ///< and some of them spread those rays
    bool scattersBySheets = false;                   ///< sheets spread light from opaque surfaces or the environment
    bool drawsFarSides = false;                      ///< of bodies, where rays leave them
    bool passesByLobes = false;                      ///< some surface that transmits may be rough: LobeTable.h

    /// Slots that materials have textures in and shaders have no room for, the last first.
    std::vector<scenes::TextureSlot> withoutTextures;
    bool hasNoRoomBehindGlass = false; ///< glass shows no surfaces for lack of textures, and would else

    /// By cell of the view's SpreadLightAtlas, what the texels of an object that light spreads over are lit with.
    std::vector<FrameSpec> spreadingViews;
    std::optional<LightSpread> spread; ///< of such an object's own spec
    int gutterTexels = 0;              ///< of its UV atlas (Diffusion.h)

    bool isInAtlas() const { return spread.has_value(); }
    /// Texels along the side of an object's UV atlas that light is spread in.
    int spreadTexels() const { return std::max(1, settings.diffusion.sideTexels / (settings.diffusion.half ? 2 : 1)); }
    SpreadLightAtlas spreadLightAtlas() const { return frame::spreadLightAtlas(spreadingViews.size(), spreadTexels()); }
    /// Bytes of the SpreadLightAtlas, and of each object's light that enters and the part of it that leaves at once.
    double spreadLightBytes() const {
        const glm::dvec2 texels(spreadLightAtlas().texels());
        const double side = double(spreadTexels());
        return double(sizeof(glm::vec4)) * (texels.x * texels.y + 2.0 * side * side * double(spreadingViews.size()));
    }

    bool usesEnvironmentMap() const;     ///< at full resolution
    bool lightsByEnvironmentMap() const; ///< surfaces, with samples or mirrors
    bool usesEnvironmentSamples() const;
    bool usesFilteredEnvironment() const;
    bool usesLobeTable() const;
    bool lightsByLobeTable() const; ///< surfaces, by area lights or an environment
    bool usesLobeShapes() const;
    bool usesAreaSamples() const;
    bool compensatesLobes() const;
    bool usesLightPictures() const { return features[Feature::LightPictures] || showsLightPictures; }

    /// Whether shadows follow rays through the casters.
    bool tracesShadows() const { return features[Feature::Shadows] && !features[Feature::ShadowMaps]; }
    /// Whether shadows and samples of area lights may take more iterations than Mesa lets loops make, so that pixels
    /// are NaN (LightRounds.h).
    bool mayCutLoops() const;

    /// Of the G-buffer, by attachment: its channels, and behind them the marks (markTable()) where there is room.
    std::vector<GBufferTexture> gbufferTextures() const;
    /// What shaders that write or read the G-buffer are compiled with.
    Defines gbufferDefines() const;
    int gbufferBytesPerPixel() const; ///< without depth
    /// A texture of the picture's size.
    graph::TextureDesc texture(graph::Format format) const {
        return {format, settings.sizePixels.x, settings.sizePixels.y, 1};
    }
    /// The coarser levels of what bodies show, one above the other (shaders/shared/refraction.h).
    graph::TextureDesc behindLevels() const;
    /// What geometry is drawn into: the same with the frame's samples.
    graph::TextureDesc renderTarget(graph::Format format) const {
        return {format, settings.sizePixels.x, settings.sizePixels.y, samples};
    }
};
FrameSpec makeFrameSpec(const scenes::Scene& scene, const PackedLights& lights, const FrameSettings& settings,
                        std::size_t seenLights = 0);

/// That of an object that light spreads over, as the view of `settings` needs it; the lights are those that reach it.
FrameSpec makeSpreadingSpec(const scenes::Scene& scene, const SpreadingObject& object, const PackedLights& lights,
                            const FrameSettings& settings);

/// Why there are no shadows, where there are none.
std::string whyNoShadows(const scenes::Scene& scene, const PackedLights& lights, const scenes::ShadowRequest& request);

/// How a pass that shades opaque or transparent surfaces finds its lights.
void addCursorDefines(const FrameSpec& spec, bool transparent, Defines& defines);

/// Tiles that light lists of the frame have, those of the transparent layer included.
std::size_t lightTileCount(const FrameSpec& spec);

/// A program of the frame; `extra` defines stand after the frame's.
shader::ProgramDesc frameProgram(const FrameSpec& spec, std::string name, std::string vertex, std::string fragment,
                                 const Defines& extra);

/// Those of a pass that draws depth alone. The first samples nothing and takes no material; a second one, where `masks`
/// and the frame has them, is for materials with holes.
std::vector<shader::ProgramDesc> depthPrograms(const FrameSpec& spec, const std::string& name,
                                               const std::string& fragment, bool masks, Defines extra);

/// What the spec leaves out and why, for a plan; bytes are those of G-buffer channels (where the technique has a
/// G-buffer), vertex streams and lights saved.
std::vector<graph::Plan::LeftOut> leftOut(const scenes::Scene& scene, const FrameSpec& spec, const PackedLights& lights,
                                          bool gbuffer);

} // namespace tessera::frame
