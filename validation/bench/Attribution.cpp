#include "validation/bench/Attribution.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>

#include <fmt/format.h>

#include "engine/Rendering.h"
#include "renderer/frame/EnvironmentMap.h"
#include "renderer/frame/MaterialFeatures.h"
#include "scenes/InUse.h"
#include "scenes/Shadows.h"
#include "validation/compare/TechniqueCompare.h"
#include "validation/figures/ErrorFigures.h"

namespace tessera::validation {

namespace {

using engine::Technique;

std::optional<double> finite(double value) {
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

constexpr const char* kArithmetic = "fp32 arithmetic of forward";

AttributionLine lineOf(const std::string& cause, const std::string& what, const std::string& against,
                       const RadianceFigures& figures) {
    return {cause, what, against, finite(figures.relMse), finite(figures.p99Rel), finite(figures.bias)};
}

/// The scene and settings with only some causes of error active. Both the image and its truth are rendered from it.
struct Ground {
    scenes::Scene scene;
    frame::FrameSettings settings;
};

/// An approximated effect, exact only in the reference. Turned off, it is absent from the program's images and from the
/// truth.
struct Part {
    const char* cause;
    bool addsLight; ///< the effect adds light, so it is measured alone; else it alters the light of all sources
    bool (*isIn)(const Ground& whole);
    void (*turnOff)(Ground& ground);
    /// Name of the method, from the truth's settings after `take` has copied a point's.
    std::string (*text)(const scenes::Scene& scene, const frame::FrameSettings& settings);
    void (*take)(frame::FrameSettings& settings, const frame::FrameSettings& own);
};

/// Method text of kinds that depend on scene and settings alone.
std::string textOf(MethodKind kind, const scenes::Scene& scene, const frame::FrameSettings& settings) {
    const frame::PreparedView none{};
    return methodText(kind, methodKeyOf(kind, {scene, settings, none}));
}

bool isArea(const scenes::Light& light) {
    return scenes::infoOf(light.type).isArea;
}

/// Replaces glass by black without shadows: it covers the same pixels and, like glass, blocks no light.
void blackenGlass(scenes::Scene& scene) {
    for (scenes::Node& node : scene.nodes)
        for (scenes::MeshInstance& instance : node.instances)
            if (instance.material != scenes::kNone &&
                scenes::isTransmissive(scene.materials[std::size_t(instance.material)]))
                instance.castsShadow = false;
    for (scenes::Material& material : scene.materials) {
        if (!scenes::isTransmissive(material)) continue;
        scenes::Material black;
        black.name = material.name;
        black.model = scenes::MaterialModel::SingleColor;
        black.baseColor = {0.0f, 0.0f, 0.0f, 1.0f};
        black.doubleSided = material.doubleSided;
        material = black;
    }
}

/// Effects that add light come first. Each later effect is measured on top of all before it.
constexpr Part kParts[] = {
    {"noise", true,
     [](const Ground& whole) {
         return std::ranges::any_of(whole.scene.lights, [&](const scenes::Light& light) {
             const auto place = std::size_t(&light - whole.scene.lights.data());
             return light.enabled && !isArea(light) && scenes::hasSize(light) && scenes::hasCasters(whole.scene) &&
                    scenes::castsShadow(whole.scene, place, whole.settings.shadows);
         });
     },
     [](Ground& ground) {
         for (scenes::Light& light : ground.scene.lights)
             if (!isArea(light)) light.radiusMetres = light.angularRadiusRadians = 0.0f;
     },
     [](const scenes::Scene&, const frame::FrameSettings& settings) {
         return fmt::format("noise of {} rays to lights with a size", settings.shadowSamples);
     },
     [](frame::FrameSettings&, const frame::FrameSettings&) {}},
    {"area", true,
     [](const Ground& whole) {
         return std::ranges::any_of(whole.scene.lights,
                                    [](const scenes::Light& light) { return light.enabled && isArea(light); });
     },
     [](Ground& ground) {
         for (scenes::Light& light : ground.scene.lights)
             if (isArea(light)) light.enabled = false;
     },
     [](const scenes::Scene& scene, const frame::FrameSettings& settings) {
         return textOf(MethodKind::AreaLights, scene, settings);
     },
     [](frame::FrameSettings& settings, const frame::FrameSettings& own) { settings.area = own.area; }},
    {"environment", true, [](const Ground& whole) { return frame::isLitByEnvironment(whole.scene, whole.settings); },
     [](Ground& ground) { ground.settings.environment.light = frame::EnvironmentLight::Off; },
     [](const scenes::Scene& scene, const frame::FrameSettings& settings) {
         return textOf(MethodKind::Environment, scene, settings);
     },
     [](frame::FrameSettings& settings, const frame::FrameSettings& own) { settings.environment = own.environment; }},
    {"subsurface", false, [](const Ground& whole) { return scenes::anyScatters(whole.scene); },
     [](Ground& ground) { ground.settings.subsurface = scenes::SubsurfaceMethod::None; },
     [](const scenes::Scene& scene, const frame::FrameSettings& settings) {
         return textOf(MethodKind::Subsurface, scene, settings);
     },
     [](frame::FrameSettings& settings, const frame::FrameSettings& own) {
         settings.subsurface = own.subsurface;
         settings.diffusion = own.diffusion;
     }},
    {"glass", false,
     [](const Ground& whole) {
         return std::ranges::any_of(scenes::materialsInUse(whole.scene),
                                    [](const scenes::Material* material) { return scenes::isTransmissive(*material); });
     },
     [](Ground& ground) { blackenGlass(ground.scene); },
     [](const scenes::Scene&, const frame::FrameSettings& settings) {
         return fmt::format("glass, refraction {}", infoOf(settings.refraction).name);
     },
     [](frame::FrameSettings& settings, const frame::FrameSettings& own) { settings.refraction = own.refraction; }},
};

/// The difference of an image from its truth, per pixel and channel.
using Difference = std::vector<float>;

Difference operator-(Difference a, const Difference& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
    return a;
}

Difference differenceOf(const Picture& shown, const Picture& right) {
    Difference result;
    for (std::size_t i = 0; i < shown.rgba.size(); ++i)
        result.push_back(i % 4 == 3 ? 0.0f : shown.rgba[i] - right.rgba[i]); // alpha is coverage
    return result;
}

/// The causes of a group's error, found one by one.
class Causes {
public:
    Causes(gpu::Context& context, const GroupTruth& truth, const std::string& truthName,
           std::span<const BenchPoint> points)
        : context_(context), truth_(truth), truthName_(truthName),
          points_(points), whole_{truth.renderer().scene(), truth.settings()}, in_(partsOf(whole_)),
          exact_(truth.pictureOf(Technique::Forward, truth.settings())), right_(truth.pictureFor(exact_)) {}

    std::vector<AttributionLine> find() {
        addParts();
        addFilter();
        addShadows();
        addRanges();
        addLayouts();
        addWholes();
        return std::move(lines_);
    }

private:
    void add(const AttributionLine& line) { lines_.push_back(line); }
    /// Error figures of the truth plus a difference. Rounding ties in the truth are resolved as forward does.
    RadianceFigures figuresOf(const Difference& difference) const {
        Picture off = right_;
        for (std::size_t i = 0; i < difference.size(); ++i) off.rgba[i] += difference[i];
        return radianceFigures(off, right_, truth_.excluded());
    }
    void addPart(const char* cause, const std::string& what, const Difference& difference) {
        differences_[what] = difference;
        add(lineOf(cause, what, truthName_, figuresOf(difference)));
    }
    /// Records the error that a choice adds to that of forward.
    void addChoice(const char* cause, const std::string& what, const char* against, const Picture& shown) {
        const Difference added = differenceOf(shown, truth_.pictureFor(shown)) - differenceOf(exact_, right_);
        differences_[what] = added;
        add(lineOf(cause, what, against, figuresOf(added)));
    }

    /// Renders the ground with `settings` and subtracts the ground's truth.
    Difference differenceOn(engine::Renderer& renderer, const Ground& ground,
                            const frame::FrameSettings& settings) const {
        const Picture shown = toPicture(renderer.render(Technique::Forward, settings));
        // The group's truth is already rendered.
        return differenceOf(shown, &renderer == &truth_.renderer()
                                       ? truth_.pictureFor(shown)
                                       : truth_.pictureOn(renderer, ground.settings, shown));
    }

    /// A ground with its renderer: the group's renderer if all effects are on.
    struct Stage {
        Ground ground;
        std::unique_ptr<engine::Renderer> own = {};
    };
    template <typename IsOn>
    std::unique_ptr<Stage> stageOf(std::span<const Part* const> in, const IsOn& isOn) const {
        auto stage = std::make_unique<Stage>(Stage{whole_}); // on the heap: the renderer refers to its scene
        bool isWhole = true;
        for (const Part* part : in) {
            if (isOn(*part)) continue;
            part->turnOff(stage->ground);
            isWhole = false;
        }
        if (!isWhole) stage->own = std::make_unique<engine::Renderer>(context_, stage->ground.scene);
        return stage;
    }
    Difference differenceOn(const Stage& stage, const frame::FrameSettings& settings) const {
        return differenceOn(stage.own ? *stage.own : truth_.renderer(), stage.ground, settings);
    }

    static std::vector<const Part*> partsOf(const Ground& whole) {
        std::vector<const Part*> in;
        for (const Part& part : kParts)
            if (part.isIn(whole)) in.push_back(&part);
        return in;
    }

    /// `usual` with a point's methods for the effects before `part`, whose light the part alters.
    frame::FrameSettings settingsBefore(const Part& part, const frame::FrameSettings& own,
                                        frame::FrameSettings usual) const {
        for (const Part* before : in_)
            if (!part.addsLight && before < &part) before->take(usual, own);
        return usual;
    }
    /// The same, with the point's method for the part itself.
    frame::FrameSettings settingsOf(const Part& part, const frame::FrameSettings& own,
                                    const frame::FrameSettings& usual) const {
        frame::FrameSettings settings = settingsBefore(part, own, usual);
        part.take(settings, own);
        return settings;
    }

    /// Names a part's method, and earlier effects' methods that differ between points. Empty if it has none.
    std::string textOf(const Part& part, const frame::FrameSettings& own) const {
        const frame::FrameSettings settings = settingsOf(part, own, whole_.settings);
        std::string text = part.text(whole_.scene, settings);
        if (text.empty() || part.addsLight) return text;
        for (const Part* before : in_) {
            if (before >= &part) break;
            const auto nameOf = [&](const frame::FrameSettings& some) {
                return before->text(whole_.scene, settingsOf(part, some, whole_.settings));
            };
            const std::string name = nameOf(own);
            if (std::ranges::any_of(points_, [&](const BenchPoint& point) { return nameOf(point.settings) != name; }))
                text += ", " + name;
        }
        return text;
    }

    void addParts() {
        const std::unique_ptr<Stage> base = stageOf(in_, [](const Part&) { return false; });
        const Difference arithmetic = differenceOn(*base, base->ground.settings);
        // Forward has no error against itself. If the difference is 0 in all pixels, the base stage has no light.
        const bool isMeasured = std::ranges::any_of(arithmetic, [](float value) { return value != 0.0f; });
        if (truthName_ == "reference" && isMeasured) addPart("arithmetic", kArithmetic, arithmetic);
        for (const Part* own : in_) {
            const auto isBefore = [&](const Part& other) { return !own->addsLight && &other < own; };
            const auto isOn = [&](const Part& other) { return &other == own || isBefore(other); };
            const std::unique_ptr<Stage> with = stageOf(in_, isOn);
            const std::unique_ptr<Stage> without = own->addsLight ? nullptr : stageOf(in_, isBefore);
            std::set<std::string> done;
            for (const BenchPoint& point : points_) {
                const std::string text = textOf(*own, point.settings);
                if (text.empty() || !done.insert(text).second) continue;
                if (truthName_ != "reference" && text == textOf(*own, whole_.settings)) continue;
                const Difference before =
                    without ? differenceOn(*without, settingsBefore(*own, point.settings, without->ground.settings))
                            : arithmetic;
                addPart(own->cause, text,
                        differenceOn(*with, settingsOf(*own, point.settings, with->ground.settings)) - before);
            }
        }
    }

    void addFilter() {
        // Skipped unless timed frames filter by hardware and the truth exactly.
        if (points_.front().settings.filter == frame::TextureFilter::Exact ||
            truth_.filter() != frame::TextureFilter::Exact ||
            !frame::materialFeatures(truth_.renderer().scene()).textures())
            return;
        frame::FrameSettings hardware = truth_.settings();
        hardware.filter = frame::TextureFilter::Hardware;
        const engine::RenderedFrame frame = truth_.renderer().render(Technique::Forward, hardware);
        Picture filtered = exact_; // the same pixels are covered
        filtered.rgba = frame.radiance;
        add(lineOf(kFilterCause, "smaller texture levels, hardware filter", "level 0 alone, exact filter",
                   radianceFigures(filtered, exact_)));
    }

    /// Names how a point's shadows differ from traced shadows with enough rays; empty if they do not.
    static std::string shadowCause(const BenchPoint& point) {
        const std::optional<MethodKey>& shadows = point.key.method(MethodKind::Shadows);
        if (!shadows) return {};
        const bool isNone = shadows->name == kNoShadows;
        if (!isNone && !usesMaps(*shadows) && shadows->values.empty()) return {};
        return (isNone ? "" : "shadow filter ") + methodText(MethodKind::Shadows, *shadows);
    }

    void addShadows() {
        std::set<std::string> done;
        for (const BenchPoint& point : points_) {
            const std::string text = shadowCause(point);
            if (text.empty() || !done.insert(text).second) continue;
            frame::FrameSettings settings = truth_.settings();
            settings.shadows = point.settings.shadows;
            settings.shadowFilter = point.settings.shadowFilter;
            settings.shadowSamples = point.settings.shadowSamples;
            settings.shadowMaps = point.settings.shadowMaps;
            addChoice("shadow", text, "traced", truth_.pictureOf(Technique::Forward, settings));
        }
    }

    static std::string rangeCause(const BenchPoint& point) {
        if (point.settings.rangeTolerance == 0.0) return {};
        return fmt::format("range tolerance {:g}", point.settings.rangeTolerance);
    }

    void addRanges() {
        std::set<double> tolerances;
        for (const BenchPoint& point : points_) {
            if (rangeCause(point).empty() || !tolerances.insert(point.settings.rangeTolerance).second) continue;
            frame::FrameSettings settings = truth_.settings();
            settings.rangeTolerance = point.settings.rangeTolerance;
            addChoice("range", rangeCause(point), "no tolerance", truth_.pictureOf(Technique::Forward, settings));
        }
    }

    static std::string layoutCause(const BenchPoint& point) {
        return point.settings.layout == frame::exactLayout().layout ? std::string()
                                                                    : fmt::format("layout {}", point.key.layout);
    }

    /// The error of each channel of a layout is that of `tessera compare`.
    void addLayouts() {
        std::set<std::string> done;
        for (const BenchPoint& point : points_) {
            if (layoutCause(point).empty() || !done.insert(point.key.layout).second) continue;
            CompareRequest request;
            request.techniques = {Technique::TiledDeferred}; // draws once per channel: the fastest with a G-buffer
            request.settings = truth_.settings();
            request.settings.shadowSamples = point.settings.shadowSamples; // both sides have the same noise
            request.settings.layout = point.settings.layout;
            request.settings.display = true; // the comparison needs display images too
            const CompareResult compared = compareTechniques(truth_.renderer(), context_.capabilities(), request);
            const ComparePair& pair = compared.record.pairs.front();
            differences_[layoutCause(point)] = differenceOf(compared.pictures.front().picture, compared.truth.picture);
            add(lineOf("layout", layoutCause(point), "forward", pair.figures));
            for (const ChannelShare& channel : pair.channels)
                add({"layout",
                     fmt::format("{}: {}", point.key.layout, channel.channel),
                     "that channel in fp32",
                     channel.share,
                     {},
                     {}});
        }
    }

    /// The names of the lines whose errors make up a point's error.
    std::set<std::string> causesOf(const BenchPoint& point) const {
        std::set<std::string> names{kArithmetic, shadowCause(point), rangeCause(point), layoutCause(point)};
        for (const Part* part : in_) names.insert(textOf(*part, point.settings));
        return names;
    }

    /// Adds, per distinct set of causes, a point's total error and its cross term: relMse of the summed differences
    /// minus the sum of the causes' relMse. Errors in a pixel add up or cancel; with the cross term the causes sum to
    /// the total.
    void addWholes() {
        std::set<std::set<std::string>> done;
        for (const BenchPoint& point : points_) {
            const std::set<std::string> causes = causesOf(point);
            if (!done.insert(causes).second) continue;
            const Picture shown = truth_.pictureOf(point.technique, point.settings);
            add(lineOf(kWholeCause, pointName(point.key), truthName_,
                       radianceFigures(shown, truth_.pictureFor(shown), truth_.excluded())));
            Difference sum(shown.rgba.size(), 0.0f);
            double relMse = 0.0;
            for (const AttributionLine& line : lines_) {
                const auto known = differences_.find(line.what);
                if (!causes.contains(line.what) || known == differences_.end()) continue;
                const Difference& own = known->second;
                for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += own[i];
                relMse += line.relMse.value_or(0.0);
            }
            add({kCrossCause,
                 "cross term of " + pointName(point.key),
                 truthName_,
                 finite(figuresOf(sum).relMse - relMse),
                 {},
                 {}});
        }
    }

    gpu::Context& context_;
    const GroupTruth& truth_;
    const std::string& truthName_;
    std::span<const BenchPoint> points_;
    const Ground whole_;
    const std::vector<const Part*> in_; ///< effects in the scene, in table order
    const Picture exact_;               ///< forward's image with the truth's settings
    const Picture right_;               ///< the truth of exact_
    std::vector<AttributionLine> lines_;
    std::map<std::string, Difference> differences_; ///< by AttributionLine::what
};

} // namespace

std::vector<AttributionLine> attributeErrors(gpu::Context& context, const GroupTruth& truth,
                                             const std::string& truthName, std::span<const BenchPoint> points) {
    return Causes(context, truth, truthName, points).find();
}

} // namespace tessera::validation
