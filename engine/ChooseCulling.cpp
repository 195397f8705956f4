#include "engine/ChooseCulling.h"

#include <algorithm>

#include <fmt/format.h>

namespace tessera::engine {

namespace {

using culling::Method;

/// Invocations that build a tile's lists together: a full subgroup on hardware; one on software rasterisers, which run
/// the invocations of a group in turn.
constexpr int kLanes = 64;
constexpr int kSoftwareLanes = 1;

const char* builderReason(bool softwareBackend) {
    return softwareBackend ? "measured fastest on software rasterisers: shaders run on the same cores, and test each "
                             "tile and light without the CPU's early outs"
                           : "the lists stay on the GPU: only their size is read back, not the depth buffer";
}

/// Why lists of a frame are not culled by normals; empty: they may be.
std::string_view whyNotByNormals(Technique technique, bool prune, const frame::FeatureSet& features,
                                 const culling::Choice& choice) {
    if (!infoOf(choice.method).mayCullByNormals) return "the bitmasks of zbin are of all a tile or a bin shows";
    if (!listsFromGBuffer(technique)) return "the technique stores no normals before it builds lists";
    if (choice.builder != culling::Builder::Cpu) return "only the builder cpu reads normals";
    if (!prune) return "a frame that is not pruned expects clear coats, which light from behind the surface changes";
    if (features.litFromBehind())
        return "light from behind the shading normal may change a surface, as that of a clear coat";
    return "";
}

/// Whether culling can remove anything: needs a bounded light and a lit surface.
bool canCull(const frame::FeatureSet& features, const frame::PackedLights& lights) {
    return features.litModels() && lights.everywhere < lights.texels.size();
}

} // namespace

bool supportsMethod(Technique technique, Method method) {
    const std::span<const Method> methods = infoOf(technique).methods;
    return std::find(methods.begin(), methods.end(), method) != methods.end();
}

bool hasLightLists(Technique technique) {
    return infoOf(technique).methods.front() != Method::None;
}

bool listsFromGBuffer(Technique technique) {
    return hasLightLists(technique) && infoOf(technique).usesGBuffer();
}

culling::Choice chooseCulling(Technique technique, const frame::FrameSettings& settings,
                              const frame::FeatureSet& features, const frame::PackedLights& lights) {
    const TechniqueInfo& info = infoOf(technique);
    culling::Choice choice;
    choice.method = settings.culling.method.value_or(info.methods.front());
    if (settings.prune && !canCull(features, lights)) choice.method = Method::None;
    choice.tilePixels = settings.culling.tilePixels.value_or(culling::kUsualTilePixels);
    choice.builder =
        settings.culling.builder.value_or(settings.softwareBackend ? culling::Builder::Cpu : culling::Builder::Compute);
    if (whyNotByNormals(technique, settings.prune, features, choice).empty())
        choice.normals = settings.culling.normals.value_or(culling::NormalTest::WhereWorth);
    choice.lanes = settings.culling.lanes.value_or(settings.softwareBackend ? kSoftwareLanes : kLanes);
    return choice;
}

std::vector<graph::Plan::Choice> cullingChoices(Technique technique, const frame::FrameSettings& settings,
                                                const frame::FeatureSet& features, const culling::Choice& choice) {
    if (!hasLightLists(technique)) return {};
    const auto why = [](bool isSet, std::string_view setting, const std::string& otherwise) {
        return isSet ? fmt::format("chosen by the setting {}; automatic restores the default", setting) : otherwise;
    };
    const bool nothingToCull = choice.method == Method::None && settings.culling.method != Method::None;
    std::vector<graph::Plan::Choice> choices{
        {"culling", std::string(infoOf(choice.method).name),
         nothingToCull ? "no light ends inside the view, or nothing is lit"
                       : why(settings.culling.method.has_value(), "culling", "the technique's tightest")}};
    if (choice.method == Method::None) return choices;
    choices.push_back(
        {"tile", fmt::format("{} pixels", choice.tilePixels),
         why(settings.culling.tilePixels.has_value(), "tile", "measured fastest or nearly so at 64 to 4096 lights")});
    choices.push_back({"lists built by", std::string(infoOf(choice.builder).name),
                       why(settings.culling.builder.has_value(), "cull-on", builderReason(settings.softwareBackend))});
    const std::string_view whyNot = whyNotByNormals(technique, settings.prune, features, choice);
    choices.push_back({"cull by normals", std::string(infoOf(choice.normals).name),
                       whyNot.empty() ? why(settings.culling.normals.has_value(), "cull-normals",
                                            fmt::format("read back where lists hold {} lights or more on average",
                                                        culling::kLightsWorthNormals))
                                      : std::string(whyNot)});
    return choices;
}

} // namespace tessera::engine
