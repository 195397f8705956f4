#include "scenes/import/SceneJsonParts.h"

#include <algorithm>
#include <numeric>
#include <unordered_set>

namespace tessera::scenes::scenejson {
namespace {

/// Looks up elements by name.
template <typename Element>
class ByName {
public:
    explicit ByName(std::span<const Element> elements) : elements_(elements), sorted_(elements.size()) {
        std::iota(sorted_.begin(), sorted_.end(), std::size_t{0});
        std::ranges::stable_sort(sorted_, {}, [this](std::size_t i) { return nameOf(i); });
    }

    /// The indices of the elements with a name, ascending.
    std::span<const std::size_t> called(std::string_view name) const {
        const auto byName = [this](std::size_t i) { return nameOf(i); };
        // Not equal_range(), whose result clang 14 cannot take with the GNU library.
        return {std::ranges::lower_bound(sorted_, name, {}, byName),
                std::ranges::upper_bound(sorted_, name, {}, byName)};
    }

    /// Distinct names, in the elements' order.
    std::vector<std::string_view> names() const {
        std::vector<std::string_view> names;
        std::unordered_set<std::string_view> known;
        for (const Element& element : elements_)
            if (known.insert(element.name).second) names.push_back(element.name);
        return names;
    }

    std::size_t size() const { return elements_.size(); }
    std::string_view nameOf(std::size_t i) const { return elements_[i].name; }

private:
    std::span<const Element> elements_;
    std::vector<std::size_t> sorted_; ///< indices, sorted by name
};

class Overrides {
public:
    Overrides(Scene& scene, std::size_t ownMaterials, Images& images)
        : scene_(scene), images_(images), nodes_(scene.nodes), materials_(scene.materials),
          included_(std::span(scene.materials).first(ownMaterials)), materialBinding_(scene.nodes.size(), kNone),
          shadowBinding_(scene.nodes.size(), kNone), isDrawn_(scene.nodes.size(), false) {
        for (std::size_t i = scene.nodes.size(); i-- > 0;) {
            if (!scene.nodes[i].instances.empty()) isDrawn_[i] = true;
            if (isDrawn_[i] && scene.nodes[i].parent != kNone) isDrawn_[std::size_t(scene.nodes[i].parent)] = true;
        }
    }

    void apply(const JsonValue& value) {
        JsonObject object = value.object();
        if (const auto node = object.find("node")) return bindNodes(object, *node);
        const std::optional<JsonValue> material = object.find("material");
        if (!material) value.fail("names neither a 'node' nor a 'material' to override");
        changeMaterials(value, *material);
    }

    /// Applies bindings to nodes and their descendants: the last override counts.
    void bind() {
        for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
            Node& node = scene_.nodes[i];
            for (std::vector<int>* binding : {&materialBinding_, &shadowBinding_}) {
                // A parent precedes its children, so its bindings are final.
                if (node.parent != kNone) (*binding)[i] = std::max((*binding)[i], (*binding)[std::size_t(node.parent)]);
            }
            for (MeshInstance& instance : node.instances) {
                if (materialBinding_[i] != kNone)
                    instance.material = *bound_[std::size_t(materialBinding_[i])].material;
                if (shadowBinding_[i] != kNone)
                    instance.castsShadow = *bound_[std::size_t(shadowBinding_[i])].castsShadow;
            }
        }
    }

private:
    /// Properties that an override binds to nodes.
    struct Bound {
        std::optional<int> material;
        std::optional<bool> castsShadow;
    };

    void bindNodes(JsonObject& object, const JsonValue& pattern) {
        Bound bound;
        if (const auto material = object.find("material")) bound.material = materialCalled(*material);
        if (const auto casts = object.find("castsShadow")) bound.castsShadow = casts->boolean();
        object.done("an override of a node");
        if (!bound.material && !bound.castsShadow)
            pattern.fail("is overridden by nothing; add a 'material' or 'castsShadow'");
        const std::vector<std::size_t> matches = matching(nodes_, pattern);
        if (matches.empty()) pattern.failUnknown("node", pattern.text(), nodes_.names());
        if (std::ranges::none_of(matches, [&](std::size_t node) { return isDrawn_[node]; }))
            pattern.fail("nothing is drawn at or below the nodes '{}'; name one that has a mesh", pattern.text());
        for (const std::size_t node : matches) {
            if (bound.material) materialBinding_[node] = int(bound_.size());
            if (bound.castsShadow) shadowBinding_[node] = int(bound_.size());
        }
        bound_.push_back(bound);
    }

    /// The material to bind: the document's local one of that name, else the first included one.
    int materialCalled(const JsonValue& value) const {
        const std::string name = value.text();
        const std::span<const std::size_t> called = materials_.called(name);
        if (called.empty()) value.failUnknown("material", name, materials_.names());
        const auto own = std::ranges::lower_bound(called, included_.size());
        return int(own != called.end() ? *own : called.front());
    }

    void changeMaterials(const JsonValue& value, const JsonValue& pattern) {
        const std::vector<std::size_t> matches = matching(included_, pattern);
        if (matches.empty()) pattern.failUnknown("included material", pattern.text(), included_.names());
        charge(kStepsAChange * matches.size(), pattern);
        for (const std::size_t material : matches) {
            JsonObject object = value.object(); // a new one per material, because models have different keys
            object.find("material");
            changeMaterial(object, scene_.materials[material], images_);
        }
    }

    template <typename Element>
    std::vector<std::size_t> matching(const ByName<Element>& elements, const JsonValue& pattern) {
        const std::string text = pattern.text();
        if (text.find_first_of("*?") == std::string::npos) {
            const std::span<const std::size_t> called = elements.called(text);
            charge(kStepsALook * called.size(), pattern);
            return {called.begin(), called.end()};
        }
        std::vector<std::size_t> matches;
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const PatternMatch match = matchesPattern(text, elements.nameOf(i));
            charge(kStepsALook + match.steps, pattern);
            if (match) matches.push_back(i);
        }
        return matches;
    }

    /// Steps of about a nanosecond: 1 per character compared with a pattern, 10 per visited element, 1000 per changed
    /// material.
    static constexpr std::size_t kStepsALook = 10, kStepsAChange = 1000, kMostSteps = 1'000'000'000;

    /// Limits the time of many overrides with many matches, and of patterns that start again at every character.
    void charge(std::size_t steps, const JsonValue& pattern) {
        if ((steps_ += steps) > kMostSteps)
            pattern.fail("the overrides up to here take more than {} steps to find and change nodes and "
                         "materials; give fewer, or names without * and ?",
                         kMostSteps);
    }

    Scene& scene_;
    Images& images_;
    ByName<Node> nodes_;
    ByName<Material> materials_, included_;
    std::vector<Bound> bound_;                         ///< by override of nodes, in order
    std::vector<int> materialBinding_, shadowBinding_; ///< index in bound_ by node; kNone is none
    std::vector<bool> isDrawn_;                        ///< whether a mesh is drawn at or below a node
    std::size_t steps_ = 0;
};

/// Removes all other elements. Returns the new index of each element, kNone if removed.
template <typename Element>
std::vector<int> keepOnly(std::vector<Element>& elements, const std::vector<bool>& isKept) {
    std::vector<int> newIndex(elements.size(), kNone);
    std::vector<Element> kept;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        if (!isKept[i]) continue;
        newIndex[i] = int(kept.size());
        kept.push_back(std::move(elements[i]));
    }
    elements = std::move(kept);
    return newIndex;
}

} // namespace

PatternMatch matchesPattern(std::string_view pattern, std::string_view name) {
    std::size_t at = 0;
    std::size_t star = std::string_view::npos; // the last '*', which matches all that the rest does not
    std::size_t taken = 0;
    std::size_t steps = 0;
    for (std::size_t i = 0; i < name.size(); ++steps) {
        if (at < pattern.size() && pattern[at] == '*') {
            star = at++;
            taken = i;
        } else if (at < pattern.size() && (pattern[at] == '?' || pattern[at] == name[i])) {
            ++at;
            ++i;
        } else if (star != std::string_view::npos) {
            at = star + 1;
            i = ++taken;
        } else {
            return {false, steps};
        }
    }
    const std::size_t rest = std::min(pattern.find_first_not_of('*', at), pattern.size());
    return {rest == pattern.size(), steps + (rest - at)};
}

void applyOverrides(const std::vector<JsonValue>& overrides, Scene& scene, std::size_t ownMaterials, Images& images) {
    if (overrides.empty()) return;
    Overrides all(scene, ownMaterials, images);
    for (const JsonValue& override : overrides) all.apply(override);
    all.bind();
}

std::vector<bool> usedMaterials(const Scene& scene) {
    std::vector<bool> used(scene.materials.size(), false);
    for (const Node& node : scene.nodes)
        for (const MeshInstance& instance : node.instances) used[std::size_t(instance.material)] = true;
    return used;
}

void dropReplacedMaterials(Scene& scene, std::size_t ownMaterials, const std::vector<bool>& wasUsed,
                           const std::filesystem::path& file) {
    const std::vector<bool> used = usedMaterials(scene);
    std::vector<bool> materialIsKept(scene.materials.size(), true), imageIsKept(scene.images.size(), true);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        if (i < ownMaterials && wasUsed[i] && !used[i]) {
            materialIsKept[i] = false;
            for (const TextureUse& use : material.textures)
                if (use.image != kNone) imageIsKept[std::size_t(use.image)] = false;
        } else if (i >= ownMaterials && !used[i]) {
            scene.warnings.push_back(
                fmt::format("{}: nothing is drawn with the material '{}'", file.string(), material.name));
        }
    }
    const std::vector<int> newMaterial = keepOnly(scene.materials, materialIsKept);
    for (Node& node : scene.nodes)
        for (MeshInstance& instance : node.instances) instance.material = newMaterial[std::size_t(instance.material)];
    for (RestNumber& rest : scene.rig.numbers)
        if (isOfMaterial(infoOf(rest.property).owner) && rest.element != kNone)
            rest.element = newMaterial[std::size_t(rest.element)];

    for (const Material& material : scene.materials)
        for (const TextureUse& use : material.textures)
            if (use.image != kNone) imageIsKept[std::size_t(use.image)] = true;
    const std::vector<int> newImage = keepOnly(scene.images, imageIsKept);
    for (Material& material : scene.materials)
        for (TextureUse& use : material.textures)
            if (use.image != kNone) use.image = newImage[std::size_t(use.image)];
}

} // namespace tessera::scenes::scenejson
