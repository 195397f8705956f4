#include "scenes/import/GltfVariants.h"

#include <algorithm>
#include <span>
#include <string_view>
#include <unordered_set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tessera::scenes::gltf {

void importVariant(Context& context, Materials& materials) {
    const std::optional<std::string>& wish = context.document.ledger.wishes().variant;
    std::vector<std::string>& names = context.scene.variants;
    std::unordered_set<std::string_view> known;
    const tiny::Value* const variants = valueAt(context.document.model.extensions, "KHR_materials_variants/variants");
    for (const tiny::Value& variant : elementsOf(variants)) {
        const std::string& name = variant.Get("name").Get<std::string>();
        if (!known.insert(name).second) continue;
        context.document.ledger.charge(2 * (sizeof(std::string) + name.size()),
                                       [&] { return context.document.file + ": its variants"; });
        names.push_back(name);
    }
    if (names.empty()) return;
    constexpr std::size_t kMostTold = 20;
    const std::span<const std::string> told = std::span(names).first(std::min(names.size(), kMostTold));
    context.scene.notes.push_back(fmt::format("{}; its variants are {}{}",
                                              wish && known.contains(*wish)
                                                  ? fmt::format("shows the variant '{}'", *wish)
                                                  : "shows its materials as they are without a variant",
                                              fmt::join(told, ", "), told.size() < names.size() ? ", ..." : ""));
    for (const auto& [sceneMesh, shown] : context.variantMaterials) materials.material(shown);
}

void bindVariant(Context& context, Materials& materials) {
    if (context.variantMaterials.empty()) return;
    for (Node& node : context.scene.nodes)
        for (MeshInstance& instance : node.instances) {
            const auto found = context.variantMaterials.find(instance.mesh);
            if (found != context.variantMaterials.end()) instance.material = materials.material(found->second);
        }
}

} // namespace tessera::scenes::gltf
