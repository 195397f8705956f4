#include "validation/bench/BenchPlan.h"

#include <algorithm>

#include <fmt/format.h>

#include "engine/ChooseCulling.h"
#include "engine/PrepareView.h"
#include "renderer/frame/LightBuffer.h"
#include "scenes/Fingerprint.h"

namespace tessera::validation {

namespace {

using culling::Method;
using engine::Technique;

/// The list, or one entry that says nothing.
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

/// Ranges say something only of lights that fall off by A B C.
bool rangesMatter(const scenes::Scene& scene) {
    return std::any_of(scene.lights.begin(), scene.lights.end(), [](const scenes::Light& light) {
        return light.enabled && light.falloff == scenes::Falloff::Attenuation;
    });
}

void skip(BenchPlan& plan, const std::string& what, const std::string& why) {
    const bool isKnown = std::any_of(plan.skipped.begin(), plan.skipped.end(), [&](const SkippedPoint& skipped) {
        return skipped.what == what && skipped.why == why;
    });
    if (!isKnown) plan.skipped.push_back({what, why});
}

/// The points of one technique, and what it does not take, in the order of the matrix.
class TechniquePoints {
public:
    TechniquePoints(BenchPlan& plan, PlannedGroup& group, const BenchMatrix& matrix, const scenes::Scene& scene,
                    const frame::FrameSettings& settings, Technique technique)
        : plan_(plan), group_(group), matrix_(matrix), scene_(scene), settings_(settings), technique_(technique),
          info_(infoOf(technique)) {}

    void add() {
        const std::vector<std::optional<frame::LayoutInfo>> layouts = layoutsTaken();
        for (const Method method : methods()) {
            const bool hasTiles = method != Method::None;
            for (const std::optional<int>& tile : hasTiles ? orDefault(matrix_.tilesPixels) : orDefault<int>({})) {
                for (const std::optional<frame::LayoutInfo>& layout : layouts) {
                    for (const std::optional<double>& range : orDefault(matrix_.rangeTolerances))
                        add(method, tile, layout, range);
                }
            }
        }
    }

private:
    std::vector<Method> methods() {
        if (matrix_.methods.empty()) {
            if (settings_.culling.method && engine::takesMethod(technique_, *settings_.culling.method))
                return {*settings_.culling.method};
            if (matrix_.preferredMethodsOnly) return {info_.methods.front()};
            return {info_.methods.begin(), info_.methods.end()};
        }
        std::vector<Method> methods;
        for (const Method method : matrix_.methods) {
            if (engine::takesMethod(technique_, method))
                methods.push_back(method);
            else
                skip(plan_, fmt::format("{}, {}", info_.name, infoOf(method).name),
                     "the technique does not take this culling method");
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

    void add(Method method, const std::optional<int>& tile, const std::optional<frame::LayoutInfo>& layout,
             const std::optional<double>& range) {
        BenchPoint point;
        point.technique = technique_;
        point.settings = settings_;
        point.settings.culling.method = method;
        if (method == Method::None) point.settings.culling.tilePixels.reset();
        if (!engine::hasLightLists(technique_)) point.settings.culling.builder.reset();
        if (!engine::listsFromGBuffer(technique_)) point.settings.culling.normals.reset();
        if (tile) point.settings.culling.tilePixels = *tile;
        if (layout) point.settings.layout = layout->layout;
        if (range) point.settings.rangeTolerance = *range;
        if (!rangesMatter(scene_)) point.settings.rangeTolerance = 0.0;
        const culling::Choice choice =
            engine::prepareView(scene_, technique_, point.settings).spec.culling; // the culling that this scene needs
        point.key = {std::string(info_.name),
                     std::string(infoOf(choice.method).name),
                     {},
                     layoutName(point.settings.layout),
                     point.settings.rangeTolerance};
        if (choice.method != Method::None) point.key.tilePixels = choice.tilePixels;
        const bool isKnown = std::any_of(group_.points.begin(), group_.points.end(),
                                         [&](const BenchPoint& other) { return other.key == point.key; });
        if (!isKnown) return group_.points.push_back(std::move(point));
        std::string what = fmt::format("{}, {}", info_.name, infoOf(method).name);
        if (tile) what += fmt::format(" {}", *tile);
        if (range && *range > 0.0) what += fmt::format(", range {:g}", *range);
        skip(plan_, fmt::format("{} in {} with {}", what, group_.scene, frame::lightsText(std::size_t(group_.lights))),
             "it is the same frame as " + pointName(point.key));
    }

    BenchPlan& plan_;
    PlannedGroup& group_;
    const BenchMatrix& matrix_;
    const scenes::Scene& scene_;
    const frame::FrameSettings& settings_;
    Technique technique_;
    const engine::TechniqueInfo& info_;
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
                               false};
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
            for (const Technique technique : techniques)
                TechniquePoints(plan, group, matrix, scene, common, technique).add();
            if (!group.points.empty()) plan.groups.push_back(std::move(group));
        }
    }
    choosePictures(plan, sceneName);
}

} // namespace tessera::validation
