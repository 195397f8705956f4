#include "validation/bench/BenchPlan.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/ChooseCulling.h"
#include "engine/ChooseLighting.h"
#include "engine/PrepareView.h"
#include "renderer/frame/LightBuffer.h"
#include "renderer/frame/LightRange.h"
#include "scenes/Fingerprint.h"

namespace tessera::validation {

namespace {

using culling::Method;
using engine::Technique;

/// The list, or a single unset entry if it is empty.
template <typename T>
std::vector<std::optional<T>> orDefault(const std::vector<T>& list) {
    if (list.empty()) return {std::nullopt};
    return {list.begin(), list.end()};
}

std::string layoutName(const frame::GBufferLayout& layout) {
    for (const frame::LayoutInfo& info : frame::layoutTable()) {
        if (info.layout == layout) return std::string(info.name);
    }
    return "mixed";
}

/// Whether a range tolerance affects any light of the scene.
bool rangesMatter(const scenes::Scene& scene) {
    return std::any_of(scene.lights.begin(), scene.lights.end(),
                       [](const scenes::Light& light) { return light.enabled && frame::mayBeTruncated(light); });
}

void skip(BenchPlan& plan, const std::string& what, const std::string& why) {
    plan.skipped.push_back({what, why});
}

void removeDuplicates(std::vector<SkippedPoint>& skipped) {
    std::set<std::pair<std::string_view, std::string_view>> known;
    std::vector<SkippedPoint> once;
    for (const SkippedPoint& point : skipped)
        if (known.emplace(point.what, point.why).second) once.push_back(point);
    skipped = std::move(once);
}

/// The part of a group's points that all techniques share: a range tolerance and methods.
struct Variant {
    std::optional<double> range; ///< from the matrix
    frame::FrameSettings settings;
    std::vector<frame::ShadowFace> faces; ///< of its shadow maps
    MethodKeys methods{};
};

/// Whether two variants render the same frame: shadow map settings do not matter if the faces are equal.
bool isSameFrame(const Variant& a, const Variant& b) {
    const auto isSame = [&](const MethodKindInfo& info) {
        const auto &ofA = a.methods[std::size_t(info.kind)], &ofB = b.methods[std::size_t(info.kind)];
        if (!ofA || !ofB) return ofA == ofB;
        return ofA->name == ofB->name && std::ranges::all_of(info.settings, [&](const MethodSetting& row) {
                   const std::string *const textA = ofA->text(row.key), *const textB = ofB->text(row.key);
                   return row.decidesMapsOnly || (textA && textB ? *textA == *textB : textA == textB);
               });
    };
    return a.faces == b.faces && std::ranges::all_of(methodKindTable(), isSame);
}

struct Choice {
    std::string requested; ///< keys and values from the matrix; empty without any
    frame::FrameSettings settings;
};

/// The setting that a key of the matrix sets to a text.
const engine::Setting& settingFor(std::string_view key, const std::string& text) {
    for (const MethodKindInfo& info : methodKindTable())
        if (info.key == key)
            return engine::settingOf(text == info.off && !info.offSetting.empty() ? info.offSetting : info.setting);
    return engine::settingOf(key);
}

std::vector<Choice> choicesOf(const BenchMatrix& matrix, const frame::FrameSettings& settings) {
    std::vector<Choice> choices{{"", settings}};
    for (const auto& [key, texts] : matrix.settings) {
        std::vector<Choice> longer;
        for (const Choice& choice : choices) {
            for (const std::string& text : texts) {
                engine::ViewRequest request{.settings = choice.settings};
                settingFor(key, text).read(request, text);
                longer.push_back(
                    {fmt::format("{}{}{} {}", choice.requested, choice.requested.empty() ? "" : ", ", key, text),
                     request.settings});
            }
        }
        choices = std::move(longer);
    }
    return choices;
}

std::string whySame(const Variant& same) {
    const std::vector<std::string> texts = methodTexts(same.methods);
    return texts.empty() ? "there are no shadows, no material has a subsurface, no environment shines and no light in "
                           "view has a surface"
                         : fmt::format("it is the same frame as {}", fmt::join(texts, ", "));
}

/// The lights and maps of a frame, which are the same for all techniques.
frame::PreparedView preparedFor(const scenes::Scene& scene, frame::FrameSettings settings) {
    settings.culling = {};
    settings.lightOn.reset();
    return engine::prepareView(scene, Technique::Forward, settings);
}

std::string placeOf(const PlannedGroup& group) {
    return fmt::format("{} with {}", group.scene, frame::lightsText(std::size_t(group.lights)));
}

std::vector<Variant> variantsOf(BenchPlan& plan, const PlannedGroup& group, const BenchMatrix& matrix,
                                const scenes::Scene& scene) {
    std::vector<Variant> variants;
    for (const std::optional<double>& range : orDefault(matrix.rangeTolerances)) {
        frame::FrameSettings settings = group.settings;
        if (range) settings.rangeTolerance = *range;
        if (!rangesMatter(scene)) settings.rangeTolerance = 0.0;
        // Kinds of method that the truth's frame does not use stay unset.
        const frame::PreparedView whole = preparedFor(scene, settings);
        std::array<bool, kMethodKinds> isUsed{};
        for (const MethodKindInfo& info : methodKindTable())
            isUsed[std::size_t(info.kind)] = info.isUsed({scene, settings, whole});
        std::vector<Variant> ofRange;
        for (Choice& choice : choicesOf(matrix, settings)) {
            if (!isUsed[std::size_t(MethodKind::Environment)]) choice.settings.environment = settings.environment;
            const frame::PreparedView prepared = preparedFor(scene, choice.settings);
            Variant variant{range, choice.settings, prepared.shadowMaps.faces};
            for (const MethodKindInfo& info : methodKindTable())
                if (isUsed[std::size_t(info.kind)])
                    variant.methods[std::size_t(info.kind)] =
                        methodKeyOf(info.kind, {scene, variant.settings, prepared});
            const auto same =
                std::ranges::find_if(ofRange, [&](const Variant& other) { return isSameFrame(other, variant); });
            if (same == ofRange.end())
                ofRange.push_back(std::move(variant));
            else
                skip(plan, fmt::format("{} in {}", choice.requested, placeOf(group)), whySame(*same));
        }
        std::ranges::move(ofRange, std::back_inserter(variants));
    }
    return variants;
}

/// Adds the points of one technique, and its unsupported combinations as skipped, in the order of the matrix.
class TechniquePoints {
public:
    TechniquePoints(BenchPlan& plan, PlannedGroup& group, const BenchMatrix& matrix, const scenes::Scene& scene,
                    std::span<const Variant> variants, Technique technique)
        : plan_(plan), group_(group), matrix_(matrix), scene_(scene), variants_(variants), technique_(technique),
          info_(infoOf(technique)) {}

    void add() {
        const std::vector<std::optional<frame::LayoutInfo>> layouts = layoutsTaken();
        const std::vector<std::optional<frame::LightingStage>> stages = stagesTaken();
        for (const Method method : methods()) {
            const bool hasTiles = method != Method::None;
            for (const std::optional<int>& tile : hasTiles ? orDefault(matrix_.tilesPixels) : orDefault<int>({})) {
                for (const std::optional<frame::LayoutInfo>& layout : layouts)
                    for (const std::optional<frame::LightingStage>& stage : stages)
                        for (const Variant& variant : variants_) add(method, tile, layout, stage, variant);
            }
        }
    }

private:
    std::vector<Method> methods() {
        if (matrix_.methods.empty()) {
            const std::optional<Method>& requested = group_.settings.culling.method;
            if (requested && engine::supportsMethod(technique_, *requested)) return {*requested};
            if (matrix_.preferredMethodsOnly) return {info_.methods.front()};
            return {info_.methods.begin(), info_.methods.end()};
        }
        std::vector<Method> methods;
        for (const Method method : matrix_.methods) {
            if (engine::supportsMethod(technique_, method))
                methods.push_back(method);
            else
                skip(plan_, fmt::format("{}, {}", info_.name, infoOf(method).name),
                     "the technique does not support this culling method");
        }
        return methods;
    }

    /// A technique without a G-buffer is measured once for all layouts, for comparison with the others.
    std::vector<std::optional<frame::LayoutInfo>> layoutsTaken() {
        if (info_.usesGBuffer()) return orDefault(matrix_.layouts);
        for (const frame::LayoutInfo& layout : matrix_.layouts) {
            if (!(layout.layout == frame::exactLayout().layout))
                skip(plan_, fmt::format("{}, {}", info_.name, layout.name), "the technique has no G-buffer to lay out");
        }
        return {frame::exactLayout()};
    }

    /// As layoutsTaken().
    std::vector<std::optional<frame::LightingStage>> stagesTaken() {
        if (info_.choosesStage) return orDefault(matrix_.stages);
        for (const frame::LightingStage stage : matrix_.stages) {
            if (stage != frame::LightingStage::Fragment)
                skip(plan_, fmt::format("{}, {}", info_.name, infoOf(stage).name),
                     "the technique lights in fragment shaders only");
        }
        return {std::nullopt};
    }

    void add(Method method, const std::optional<int>& tile, const std::optional<frame::LayoutInfo>& layout,
             const std::optional<frame::LightingStage>& stage, const Variant& variant) {
        BenchPoint point;
        point.technique = technique_;
        point.settings = variant.settings;
        point.settings.culling.method = method;
        if (method == Method::None) point.settings.culling.tilePixels.reset();
        if (!engine::hasLightLists(technique_)) point.settings.culling.builder.reset();
        if (!engine::listsFromGBuffer(technique_)) point.settings.culling.normals.reset();
        if (tile) point.settings.culling.tilePixels = *tile;
        if (layout) point.settings.layout = layout->layout;
        if (stage) point.settings.lightOn = *stage;
        if (!info_.choosesStage) point.settings.lightOn.reset();
        const culling::Choice choice =
            engine::prepareView(scene_, technique_, point.settings).spec.culling; // the culling that this scene needs
        point.key = {std::string(info_.name),
                     std::string(infoOf(choice.method).name),
                     {},
                     layoutName(point.settings.layout),
                     point.settings.rangeTolerance,
                     variant.methods,
                     {}};
        if (info_.choosesStage) point.key.lightOn = infoOf(engine::chooseLighting(point.settings)).name;
        if (choice.method != Method::None) point.key.tilePixels = choice.tilePixels;
        if (known_.emplace(pointName(point.key), point.key.rangeTolerance).second) // the name rounds the range
            return group_.points.push_back(std::move(point));
        std::string what = fmt::format("{}, {}", info_.name, infoOf(method).name);
        if (tile) what += fmt::format(" {}", *tile);
        if (variant.range && *variant.range > 0.0) what += fmt::format(", range {:g}", *variant.range);
        skip(plan_, fmt::format("{} in {}", what, placeOf(group_)), "it is the same frame as " + pointName(point.key));
    }

    BenchPlan& plan_;
    PlannedGroup& group_;
    const BenchMatrix& matrix_;
    const scenes::Scene& scene_;
    std::span<const Variant> variants_;
    Technique technique_;
    const engine::TechniqueInfo& info_;
    std::set<std::pair<std::string, double>> known_;
};

double workOf(const PlannedGroup& group) {
    return double(group.sizePixels.x) * double(group.sizePixels.y) * (1.0 + double(group.lights));
}

void choosePictures(BenchPlan& plan, const std::string& scene) {
    PlannedGroup* most = nullptr;
    for (PlannedGroup& group : plan.groups) {
        if (group.scene != scene) continue;
        group.keepsPictures = false;
        if (!most || workOf(group) > workOf(*most)) most = &group;
    }
    if (most) most->keepsPictures = true;
}

} // namespace

void addToPlan(BenchPlan& plan, const BenchMatrix& matrix, const std::string& sceneName, std::optional<int> lights,
               const frame::FrameSettings& settings, const SceneLoader& load) {
    std::vector<Technique> techniques = matrix.techniques;
    if (techniques.empty())
        for (const engine::TechniqueInfo& info : engine::techniqueTable()) techniques.push_back(info.technique);
    for (const std::optional<int>& count : orDefault(matrix.lights)) {
        const std::optional<int> lightsToLoad = count ? count : lights;
        const scenes::Scene scene = load(lightsToLoad);
        const std::uint64_t fingerprint = scenes::fingerprint(scene);
        for (const std::optional<glm::ivec2>& size : orDefault(matrix.sizesPixels)) {
            frame::FrameSettings common = settings;
            common.display = false;
            if (size) common.sizePixels = *size;
            PlannedGroup group{sceneName,
                               lightsToLoad,
                               int(scene.lights.size()),
                               scenes::triangleCount(scene),
                               fingerprint,
                               common.sizePixels,
                               {},
                               false,
                               common};
            const bool isKnown = std::any_of(plan.groups.begin(), plan.groups.end(), [&](const PlannedGroup& other) {
                return other.scene == sceneName && other.lights == group.lights && other.sizePixels == group.sizePixels;
            });
            if (isKnown) {
                skip(plan,
                     fmt::format("{} with {} at {}x{}, again", sceneName, frame::lightsText(std::size_t(group.lights)),
                                 group.sizePixels.x, group.sizePixels.y),
                     "it is measured already");
                continue;
            }
            const std::vector<Variant> variants = variantsOf(plan, group, matrix, scene);
            for (const Technique technique : techniques)
                TechniquePoints(plan, group, matrix, scene, variants, technique).add();
            if (!group.points.empty()) plan.groups.push_back(std::move(group));
        }
    }
    removeDuplicates(plan.skipped);
    choosePictures(plan, sceneName);
}

} // namespace tessera::validation
