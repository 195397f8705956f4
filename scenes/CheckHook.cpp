#include "scenes/CheckHook.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/CheckElement.h"
#include "scenes/Limits.h"

namespace tessera::scenes {
namespace {

/// Requires that all materials of a moved mesh belong to the hook, since its instances share the vertices.
void checkMovedMeshes(const Scene& scene, const auto& require) {
    const std::set<std::size_t> moved = hookedMeshes(scene);
    for (const Node& node : scene.nodes)
        for (const MeshInstance& instance : node.instances) {
            const auto mesh = std::size_t(instance.mesh);
            require(scene.hook->changes(std::size_t(instance.material)) || !moved.contains(mesh),
                    fmt::format("the mesh '{}' is drawn with a material that its hook changes and with one that it "
                                "leaves alone, and its vertices cannot be in two places; give both to the hook",
                                scene.meshes[mesh].name));
        }
}

} // namespace

void checkHook(const Scene& scene) {
    if (!scene.hook) return;
    const auto require = [&](bool holds, const std::string& problem) {
        if (!holds) throw InputError(fmt::format("scene '{}': {}", scene.name, problem));
    };
    const Hook& hook = *scene.hook;
    const auto isMaterial = [&](int i) { return i >= 0 && std::size_t(i) < scene.materials.size(); };
    require(std::ranges::all_of(hook.materials, isMaterial), "its hook changes a material that is not there");
    require(std::ranges::adjacent_find(hook.materials, std::greater_equal<>()) == hook.materials.end(),
            "the materials that its hook changes must ascend");
    require(hook.parameters.size() <= kMostHookParameters,
            fmt::format("its hook has {} parameters, and at most {} can be given", hook.parameters.size(),
                        kMostHookParameters));
    require(between(hook.mayMoveMetres, 0.0, kFarthestMetres),
            fmt::format("mayMoveMetres of its hook must lie between 0 and {:g}", kFarthestMetres));
    if (hook.movesVertices) checkMovedMeshes(scene, require);
    std::set<std::string_view> names;
    for (const HookParameter& parameter : hook.parameters) {
        require(isHookParameterName(parameter.name) && names.insert(parameter.name).second,
                fmt::format("'{}' names no parameter of its hook; give letters and digits, each name once",
                            parameter.name));
        require(std::isfinite(parameter.least) && std::isfinite(parameter.most) && parameter.allows(parameter.value),
                fmt::format("the parameter '{}' of its hook is {:g}, and must lie between {:g} and {:g}",
                            parameter.name, parameter.value, parameter.least, parameter.most));
    }
}

} // namespace tessera::scenes
