#include "renderer/frame/FrameSpec.h"

#include <algorithm>

#include <fmt/format.h>

#include "renderer/frame/EnvironmentMap.h"
#include "renderer/frame/FrameDefines.h"
#include "renderer/frame/LightBuffer.h"
#include "renderer/frame/LightRounds.h"
#include "renderer/frame/MaterialFeatures.h"
#include "renderer/frame/RefineLayout.h"
#include "renderer/frame/SeenLights.h"
#include "renderer/frame/ShadowMaps.h"
#include "renderer/frame/TextureRoom.h"
#include "scenes/ClosedBodies.h"
#include "scenes/InUse.h"
#include "scenes/Shadows.h"
#include "shaders/shared/refraction.h"

namespace tessera::frame {

namespace {

std::size_t vertexCount(const scenes::Scene& scene) {
    std::size_t count = 0;
    for (const scenes::Mesh* mesh : scenes::meshesInUse(scene)) count += mesh->positionsOS.size();
    return count;
}

/// Bytes per vertex saved by the absence of a feature.
std::size_t bytesWithout(Feature feature, const FeatureSet& features) {
    switch (feature) {
    case Feature::TangentSpaceNormals:
        return features.tangents() ? 0 : sizeof(glm::vec4); // others may need them
    case Feature::TexCoord1:
        return sizeof(glm::vec2);
    case Feature::VertexColor:
        return sizeof(glm::vec4);
    default:
        return 0;
    }
}

bool isSoft(const scenes::Light& light, const FrameSettings& settings) {
    return scenes::hasSize(light) && infoOf(settings.shadowFilter).usesSizes;
}

/// Shadow rays, or samples of the light's disk, per pixel.
std::size_t shadowSamples(const scenes::Light& light, const FrameSettings& settings) {
    return isSoft(light, settings) ? std::size_t(settings.shadowSamples) : 1;
}

/// Rays per shadowed light that measure the path length inside transmitting objects.
std::size_t passingRays(const FrameSpec& spec) {
    return spec.features[Feature::SubsurfacePassage] ? 1 : 0;
}

/// Most loop iterations for a light's shadow: pixels that run together may use all its cascades.
std::size_t shadowIterations(const FrameSpec& spec, const scenes::Light& light) {
    const FrameSettings& settings = spec.settings;
    const std::size_t samples = shadowSamples(light, settings);
    if (spec.tracesShadows()) return (samples + passingRays(spec)) * rayIterations(casterSteps(spec.shadowSamples));
    const std::size_t faces = scenes::infoOf(light.type).hasPosition() ? 1 : std::size_t(settings.shadowMaps.cascades);
    const std::size_t ofFilter = infoOf(settings.shadowFilter).usesWidth
                                     ? pcfIterations(std::size_t(settings.shadowMaps.widthTexels))
                                 : isSoft(light, settings) ? pcssIterations(samples)
                                                           : 0;
    return faces * (1 + ofFilter);
}

/// Why no shadow is soft.
std::string whyNotSoft(const FrameSpec& spec) {
    if (spec.shadowedLights == 0) return "there are no shadows";
    const ShadowFilterInfo& filter = infoOf(spec.settings.shadowFilter);
    if (!filter.usesSizes) return fmt::format("the shadow filter {} ignores the sizes of lights", filter.name);
    return "no light in view that casts shadows has a size";
}

/// Why the scene's environment lights nothing.
std::string whyNoEnvironmentLight(const scenes::Scene& scene, const FrameSpec& spec) {
    if (spec.settings.environment.light == EnvironmentLight::Off) return "it is switched off";
    if (spec.settings.soloLight) return "one light is shown alone";
    if (!isLitByEnvironment(scene, spec.settings)) return "its intensity is 0";
    return spec.features.litModels() ? "the view shows no lit surfaces" : "every surface is unlit";
}

bool anyOpaque(const scenes::Scene& scene) {
    return std::ranges::any_of(scenes::materialsInUse(scene),
                               [](const scenes::Material* material) { return !scenes::isTransparent(*material); });
}

/// Whether refracted rays may hit surfaces, including those of area lights.
bool showsAnyOpaque(const scenes::Scene& scene, const FrameSpec& spec) {
    return spec.seenLights > 0 || anyOpaque(scene);
}

/// Whether rays may leave any volume through back faces.
bool mayLeaveByBackFaces(const scenes::Scene& scene, const FrameSettings& settings) {
    if (!settings.prune || infoOf(settings.refraction).farSide == RefractionInfo::FarSide::BackFaces) return true;
    if (settings.hasClosedBodies) return *settings.hasClosedBodies;
    scenes::ClosedMeshes meshes;
    return scenes::hasClosedBodies(scene, meshes);
}

/// Decides what refraction shows. Requires the features of surfaces and the number of visible light surfaces.
void decideRefraction(const scenes::Scene& scene, FrameSpec& spec) {
    const FrameSettings& settings = spec.settings;
    const auto mayBe = [&](bool (*isOne)(const scenes::Material&)) {
        return !settings.prune || std::ranges::any_of(scenes::materialsInUse(scene),
                                                      [&](const scenes::Material* one) { return isOne(*one); });
    };
    const bool isLit = settings.view == DebugView::Final;
    const bool mayBend = isLit && mayBe(scenes::hasBody);
    const bool maySheetScatter =
        isLit && mayBe([](const scenes::Material& one) { return !scenes::hasBody(one) && mayScatter(one); });
    const RefractionInfo& refraction = infoOf(settings.refraction);
    spec.showsBehindGlass = (mayBend || maySheetScatter) && refraction.showsScene && showsAnyOpaque(scene, spec);
    spec.drawsFarSides = mayBend && refraction.seesBackFaces() && mayLeaveByBackFaces(scene, settings);
    spec.blursBehindGlass = spec.showsBehindGlass && mayBe(mayScatter);
    spec.scattersBySheets =
        maySheetScatter && refraction.showsScene && (spec.showsBehindGlass || spec.features[Feature::Environment]);
}

/// Decides whether rough surfaces may transmit light, which requires the lobe table for their reflectance. A hook may
/// make any surface rough.
void decidePassing(const scenes::Scene& scene, FrameSpec& spec) {
    const auto mayPass = [](const scenes::Material* material) { return mayPassByLobe(*material); };
    spec.passesByLobes =
        spec.settings.view == DebugView::Final && spec.features[Feature::Transmission] &&
        (!spec.settings.prune || spec.hook.has_value() || std::ranges::any_of(scenes::materialsInUse(scene), mayPass));
}

/// Why refracted rays show no surfaces.
std::string whyNothingBehindGlass(const scenes::Scene& scene, const FrameSpec& spec) {
    if (!mayLookBehindGlass(scene)) return "no material that transmits has a thickness or is rough";
    if (!infoOf(spec.settings.refraction).showsScene) return "bodies are to show the environment alone";
    if (!showsAnyOpaque(scene, spec)) return "every surface is transparent, and no light is seen";
    if (spec.settings.view != DebugView::Final) return "the view is not the lit picture";
    return "a shader of this driver samples too few textures";
}

/// Why rays leave no volume through back faces.
std::string whyNoBackFaces(const FrameSpec& spec) {
    if (!infoOf(spec.settings.refraction).seesBackFaces()) return "rays are not to leave bodies there";
    if (spec.settings.view != DebugView::Final) return "the view is not the lit picture";
    if (spec.hasNoRoomBehindGlass) return "a shader of this driver samples too few textures";
    return "no body that is drawn has closed meshes alone";
}

/// Why a feature is left out.
std::string whyAbsent(const FeatureInfo& info, const scenes::Scene& scene, const FrameSpec& spec,
                      const PackedLights& lights) {
    if (info.feature == Feature::Shadows) return whyNoShadows(scene, lights, spec.settings.shadows);
    if (info.feature == Feature::SoftShadows) return whyNotSoft(spec);
    if (info.feature == Feature::Environment && scene.environment) return whyNoEnvironmentLight(scene, spec);
    if (info.feature == Feature::Mirrors && !spec.features[Feature::Environment])
        return "no environment lights surfaces";
    if (info.feature == Feature::SubsurfacePassage && materialFeatures(scene, spec.settings.subsurface)[info.feature])
        return "no light casts shadows, by which the way inside is found";
    const auto isLacking = [&](scenes::TextureSlot slot) { return featureOf(slot) == info.feature; };
    if (std::ranges::any_of(spec.withoutTextures, isLacking)) return "a shader of this driver samples too few textures";
    return info.absent;
}

void addLights(std::vector<graph::Plan::LeftOut>& out, const FeatureSet& features, std::size_t count, const char* why) {
    if (count == 0) return;
    out.push_back({lightsText(count), why, lightBytes(features, count), {}});
}

} // namespace

std::string whyNoShadows(const scenes::Scene& scene, const PackedLights& lights, const scenes::ShadowRequest& request) {
    using Kind = scenes::ShadowRequest::Kind;
    if (lights.texels.empty()) return "no light is on and in view";
    const bool isRequested = std::ranges::any_of(
        lights.sceneIndex, [&](int light) { return scenes::castsShadow(scene, std::size_t(light), request); });
    if (isRequested) {
        const std::size_t transparent = scenes::casterCounts(scene).transparent;
        return transparent == 0 ? "no surface casts any" : "no surface casts any; " + transparentText(transparent);
    }
    if (request.kind == Kind::None || (request.kind == Kind::First && request.lights == 0))
        return "no light is to cast any";
    if (request.kind == Kind::Scene) return "no light in view has castsShadow";
    return fmt::format("none of the first {} is on and in view", lightsText(std::size_t(request.lights)));
}

namespace {

FrameSpec makeSpec(const scenes::Scene& scene, const PackedLights& lights, const FrameSettings& settings,
                   const FeatureSet& surfaces, std::size_t seenLights) {
    FrameSpec spec;
    spec.settings = settings;
    spec.seenLights = seenLights;
    spec.lights = lights.texels.size();
    spec.shadowedLights = lights.shadowed;
    spec.features = surfaces;
    if (settings.prune) {
        spec.features.has |= lights.features.has;
        const scenes::Camera& camera = scene.cameras[std::size_t(settings.camera)];
        spec.features.add(Feature::OrthographicCamera, camera.projection == scenes::Projection::Orthographic);
    }
    if (settings.shadowTerminator == ShadowTerminator::Softened)
        spec.features.add(Feature::ShadowLift, spec.features[Feature::Shadows]);
    else
        spec.features.has.reset(std::size_t(Feature::ShadowLift));
    if (settings.prune && !spec.features[Feature::Shadows])
        spec.features.has.reset(std::size_t(Feature::SubsurfacePassage));
    // Environment maps and samples exist only if they light surfaces.
    if (isLitByEnvironment(scene, settings) && showsLitPicture(settings.view) && spec.features.litModels())
        spec.features.add(Feature::Environment);
    else
        spec.features.has.reset(std::size_t(Feature::Environment));
    // Only environment lighting uses occlusion and mirrors; each needs a texture unit that not every driver has.
    if (!spec.features[Feature::Environment]) {
        spec.features.has.reset(std::size_t(featureOf(scenes::TextureSlot::Occlusion)));
        spec.features.has.reset(std::size_t(Feature::Mirrors));
    }
    if (scene.hook && scene.hook->changesSurfaces) spec.hook = hookShape(*scene.hook);
    spec.showsEnvironment = showsEnvironment(scene, settings);
    if (spec.features[Feature::Environment] || spec.showsEnvironment)
        spec.environment = environmentShape(scene.environment->map);
    if (lights.pictures.empty()) spec.features.has.reset(std::size_t(Feature::LightPictures));
    spec.lightPictureBytes = lightPictureBytes(lights.pictures);
    // Without pruning all features are set, but this one selects the shadow algorithm.
    if (!infoOf(settings.shadowFilter).usesMaps) spec.features.has.reset(std::size_t(Feature::ShadowMaps));
    decideRefraction(scene, spec);
    decidePassing(scene, spec);
    if (sampledTextures(spec) > std::size_t(settings.texturesAStage))
        leaveOutTextures(spec, settings.prune ? surfaces : materialFeatures(scene, settings.subsurface));
    // A displayed channel is stored itself, neither replaced by a material number nor in another channel.
    spec.features.add(Feature::VaryingMaterials, storedComponents(settings.view).has_value());
    spec.settings.layout = refined(settings.layout, scene, settings.subsurface);
    spec.channels = neededChannels(spec.features, spec.settings.layout, needsNormalTexel(settings.view));
    spec.iterations = loopIterations(spec.lights, lightsPerRound(spec.lights));
    const auto shadowed = [&](std::size_t i) -> const scenes::Light& {
        return scene.lights[std::size_t(lights.sceneIndex[i])];
    };
    for (std::size_t i = 0; i < lights.shadowed; ++i)
        spec.shadowSamples += shadowSamples(shadowed(i), spec.settings) + passingRays(spec);
    for (std::size_t i = 0; i < lights.shadowed; ++i) spec.iterations += 1 + shadowIterations(spec, shadowed(i));
    if (spec.usesEnvironmentSamples()) spec.iterations += std::size_t(settings.environment.samples);
    spec.areaLights = std::size_t(std::ranges::count_if(
        lights.sceneIndex, [&](int light) { return scenes::infoOf(scene.lights[std::size_t(light)].type).isArea; }));
    if (spec.usesAreaSamples()) spec.iterations += spec.areaLights * std::size_t(1 + settings.area.samples);
    // Rays of three colours inside and behind a volume. At most every other step passes behind a surface and bisects.
    if (spec.showsBehindGlass || spec.drawsFarSides)
        spec.iterations += 6 * REFRACTION_STEPS * (1 + REFRACTION_HALVINGS / 2);
    return spec;
}

} // namespace

FrameSpec makeFrameSpec(const scenes::Scene& scene, const PackedLights& lights, const FrameSettings& settings,
                        std::size_t seenLights) {
    FeatureSet surfaces = surfaceFeatures(scene, settings.prune, settings.subsurface);
    // Without objects to diffuse there is no atlas, so the feature is removed even without pruning.
    if (!showsLitPicture(settings.view) || !scenes::anyDiffuses(scene, settings.subsurface))
        surfaces.has.reset(std::size_t(Feature::SubsurfaceDiffusion));
    return makeSpec(scene, lights, settings, surfaces, seenLights);
}

FrameSpec makeDiffusionSpec(const scenes::Scene& scene, const DiffusionObject& object, const PackedLights& lights,
                            const FrameSettings& settings) {
    FeatureSet surfaces = settings.prune ? enteringFeatures(scene, object.material, object.mesh) : allFeatures();
    surfaces.has.reset(std::size_t(Feature::SubsurfaceDiffusion));
    FrameSpec spec = makeSpec(scene, lights, settings, surfaces, 0);
    spec.features.add(Feature::OrthographicCamera); // unused; the view constants are orthographic
    spec.channels.clear();
    spec.showsEnvironment = false;
    spec.showsBehindGlass = spec.blursBehindGlass = spec.scattersBySheets = false;
    spec.drawsFarSides = spec.passesByLobes = false;
    const auto kernelWithBorder = [&](int border) {
        return diffusionKernel(scene.materials[std::size_t(object.material)].subsurface, settings.diffusion.gaussians,
                               texelMetresOf(object.sideMetres, spec.diffusionTexels(), border),
                               settings.diffusion.half);
    };
    // Border and texel size depend on each other. Without a border texels are smallest, and the diffusion radius in
    // texels is largest.
    const DiffusionKernel widest = kernelWithBorder(0);
    spec.gutterTexels = frame::gutterTexels(widest.levels, widest.texelMetres);
    spec.diffusionKernel = kernelWithBorder(borderTexels(spec.gutterTexels, spec.diffusionTexels()));
    return spec;
}

graph::TextureDesc FrameSpec::behindLevels() const {
    const glm::ivec2 size = settings.sizePixels;
    return {graph::Format::Rgba32Float, shared::behindTexels(size.x, 1), shared::behindRow(size.y, BEHIND_COARSEST + 1),
            1};
}

std::vector<GBufferTexture> FrameSpec::gbufferTextures() const {
    std::vector<GBufferTexture> textures = frame::gbufferTextures(settings.layout, channels);
    const std::vector<Mark> marks = neededMarks(features, settings.layout, channels);
    if (std::optional<GBufferTexture> held = markTexture(settings.layout, channels, marks))
        textures.push_back(std::move(*held));
    return textures;
}

Defines FrameSpec::gbufferDefines() const {
    Defines defines = channelDefines(settings.layout, channels);
    const Defines marks = markDefines(settings.layout, channels, neededMarks(features, settings.layout, channels));
    defines.insert(defines.end(), marks.begin(), marks.end());
    return defines;
}

bool FrameSpec::usesEnvironmentSamples() const {
    return features[Feature::Environment] && settings.environment.light == EnvironmentLight::Sampled;
}

bool FrameSpec::lightsByEnvironmentMap() const {
    return usesEnvironmentSamples() || features[Feature::Mirrors];
}

bool FrameSpec::usesEnvironmentMap() const {
    return lightsByEnvironmentMap() || (showsEnvironment && settings.environment.backdrop == Backdrop::Sharp);
}

bool FrameSpec::usesLobeTable() const {
    return lightsByLobeTable() || passesByLobes;
}

bool FrameSpec::lightsByLobeTable() const {
    return usesLobeShapes() || (features[Feature::Environment] && (!usesEnvironmentSamples() || compensatesLobes()));
}

bool FrameSpec::usesLobeShapes() const {
    return features.areaLights() && !usesAreaSamples();
}

bool FrameSpec::usesAreaSamples() const {
    return features.areaLights() && infoOf(settings.area.lights).usesSamples;
}

bool FrameSpec::compensatesLobes() const {
    return features[Feature::Environment] && settings.environment.compensates &&
           features[scenes::MaterialModel::MetallicRoughness];
}

bool FrameSpec::usesFilteredEnvironment() const {
    return (features[Feature::Environment] && !usesEnvironmentSamples()) ||
           (showsEnvironment && settings.environment.backdrop == Backdrop::Blurred);
}

bool FrameSpec::mayCutLoops() const {
    return settings.softwareBackend && (shadowedLights > 0 || usesAreaSamples()) && showsLitPicture(settings.view) &&
           iterations > kMostLoopIterations - kOtherLoopIterations;
}

int FrameSpec::gbufferBytesPerPixel() const {
    int bytes = 0;
    for (const GBufferTexture& texture : gbufferTextures()) bytes += graph::formatInfo(texture.format).bytes;
    return bytes;
}

void addCursorDefines(const FrameSpec& spec, bool transparent, Defines& defines) {
    using culling::Method;
    const char* const cursor = spec.culling.method == Method::None   ? "LIGHT_CURSOR_ALL"
                               : spec.culling.method == Method::Zbin ? "LIGHT_CURSOR_BITS"
                                                                     : "LIGHT_CURSOR_LIST";
    defines.emplace_back("LIGHT_CURSOR", cursor);
    defines.emplace_back("ONE_LIST_A_TILE", culling::infoOf(spec.culling.method).oneListATile ? "1" : "0");
    if (spec.culling.method == Method::None) return;
    defines.emplace_back("LIGHT_LAYER", transparent ? "LIGHT_LAYER_TRANSPARENT" : "LIGHT_LAYER_OPAQUE");
    defines.emplace_back("HAS_LIGHTS_EVERYWHERE", spec.lightsEverywhere ? "1" : "0");
}

std::size_t lightTileCount(const FrameSpec& spec) {
    const auto along = [&](int pixels) {
        return std::size_t(pixels + spec.culling.tilePixels - 1) / std::size_t(spec.culling.tilePixels);
    };
    return along(spec.settings.sizePixels.x) * along(spec.settings.sizePixels.y) *
           (spec.features[Feature::Blend] ? 2 : 1);
}

shader::ProgramDesc frameProgram(const FrameSpec& spec, std::string name, std::string vertex, std::string fragment,
                                 const Defines& extra) {
    shader::ProgramDesc program;
    program.name = std::move(name);
    program.vertex = std::move(vertex);
    program.fragment = std::move(fragment);
    // A lighting or display pass draws no triangles of the scene.
    const bool drawsScene = program.vertex == "passes/geometry.vert";
    if (drawsScene && spec.settings.filter == TextureFilter::Exact && !spec.isInAtlas())
        program.geometry = "passes/triangle.geom";
    program.defines = frameDefines(spec);
    program.defines.insert(program.defines.end(), extra.begin(), extra.end());
    return program;
}

std::vector<shader::ProgramDesc> depthPrograms(const FrameSpec& spec, const std::string& name,
                                               const std::string& fragment, bool masks, Defines extra) {
    extra.emplace_back("DEPTH_ONLY", "1");
    FrameSpec bare = spec;
    bare.features = {};
    bare.features.add(Feature::OrthographicCamera, spec.features[Feature::OrthographicCamera]);
    std::vector<shader::ProgramDesc> programs{frameProgram(bare, name, "passes/geometry.vert", fragment, extra)};
    if (masks && spec.features[Feature::AlphaMask])
        programs.push_back(frameProgram(spec, name + "_masked", "passes/geometry.vert", fragment, extra));
    return programs;
}

std::vector<graph::Plan::LeftOut> leftOut(const scenes::Scene& scene, const FrameSpec& spec, const PackedLights& lights,
                                          bool gbuffer) {
    std::vector<graph::Plan::LeftOut> out;
    const std::size_t pixels = std::size_t(spec.settings.sizePixels.x) * std::size_t(spec.settings.sizePixels.y);
    // Channels that pixels would store without material numbers.
    FeatureSet varying = spec.features;
    varying.add(Feature::VaryingMaterials);
    const std::vector<Channel> stored =
        neededChannels(varying, spec.settings.layout, needsNormalTexel(spec.settings.view));
    const auto contain = [](const std::vector<Channel>& channels, Channel channel) {
        return std::find(channels.begin(), channels.end(), channel) != channels.end();
    };
    for (const ChannelInfo& info : channelTable()) {
        if (!gbuffer) break;
        if (contain(spec.channels, info.channel)) continue;
        std::vector<Channel> more = spec.channels;
        more.push_back(info.channel);
        const auto bytes =
            std::size_t(bytesPerPixel(spec.settings.layout, more) - bytesPerPixel(spec.settings.layout, spec.channels));
        const bool tabled = contain(stored, info.channel);
        out.push_back({fmt::format("G-buffer channel {}", info.name),
                       tabled ? "no material varies over a surface, so lighting reads it by its number"
                              : fmt::format("needed only by {}", info.needed),
                       pixels * bytes,
                       {}});
    }
    for (const FeatureInfo& info : featureTable()) {
        if (spec.features[info.feature]) continue;
        out.push_back({std::string(info.what),
                       whyAbsent(info, scene, spec, lights),
                       vertexCount(scene) * bytesWithout(info.feature, spec.features),
                       {}});
    }
    if (spec.seenLights == 0) out.push_back({"surfaces of area lights", whyNoSeenLights(scene, spec.settings), 0, {}});
    if (!spec.showsBehindGlass) out.push_back({"surfaces behind glass", whyNothingBehindGlass(scene, spec), 0, {}});
    if (spec.features[Feature::Volume] && !spec.drawsFarSides)
        out.push_back({"back faces of glass", whyNoBackFaces(spec), 0, {}});
    addLights(out, lights.features, lights.off, "off, or not the solo light");
    addLights(out, lights.features, lights.dark, "no intensity, range, cone or surface");
    addLights(out, lights.features, lights.unseen, "their range ends outside the view");
    return out;
}

} // namespace tessera::frame
