#include "scenes/import/GltfInstances.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "scenes/Transform.h"

namespace tessera::scenes::gltf {
namespace {

/// Reads the attributes that place the instances of one node.
class InstanceReader {
public:
    InstanceReader(Context& context, int node)
        : context_(context),
          attributes_(integersByName(valueAt(context.document.model.nodes[static_cast<std::size_t>(node)].extensions,
                                             "EXT_mesh_gpu_instancing/attributes"))),
          place_(fmt::format("/nodes/{}/extensions/EXT_mesh_gpu_instancing/attributes", node)) {
        if (attributes_.empty()) context_.document.fail(place_, "holds nothing that says how many instances there are");
        const auto& [name, accessor] = *attributes_.begin();
        count_ = context_.document.model.accessors[static_cast<std::size_t>(accessor)].count;
    }

    std::vector<glm::dmat4> read() {
        const std::optional<Elements> translations = elements("TRANSLATION", 3), rotations = elements("ROTATION", 4),
                                      scales = elements("SCALE", 3);
        context_.document.ledger.charge(count_ * sizeof(glm::dmat4),
                                        [&] { return fmt::format("{}: {}", context_.document.file, place_); });
        std::vector<glm::dmat4> transforms;
        transforms.reserve(count_);
        for (std::size_t i = 0; i < count_; ++i) {
            const auto vector = [&](const std::optional<Elements>& stored, glm::dvec3 otherwise) {
                return stored ? glm::dvec3(stored->values[3 * i], stored->values[3 * i + 1], stored->values[3 * i + 2])
                              : otherwise;
            };
            glm::dvec4 rotation(0.0, 0.0, 0.0, 1.0);
            for (glm::length_t c = 0; rotations && c < 4; ++c)
                rotation[c] = rotations->values[4 * i + static_cast<std::size_t>(c)];
            if (glm::dot(rotation, rotation) == 0.0)
                context_.document.fail(place_ + "/ROTATION",
                                       fmt::format("element {} is the zero quaternion, which is no rotation", i));
            transforms.push_back(
                transformOf(vector(translations, glm::dvec3(0.0)), rotation, vector(scales, glm::dvec3(1.0))));
            for (glm::length_t entry = 0; entry < 16; ++entry)
                if (!std::isfinite(transforms.back()[entry / 4][entry % 4]))
                    context_.document.fail(place_, fmt::format("the transform of instance {} is not finite", i));
        }
        return transforms;
    }

private:
    std::optional<Elements> elements(const char* name, int components) {
        const auto found = attributes_.find(name);
        if (found == attributes_.end()) return std::nullopt;
        Elements read = context_.accessors.elements(found->second);
        const auto fail = [&](const std::string& what) {
            context_.document.fail(fmt::format("{}/{}", place_, name),
                                   fmt::format("accessor {} has {}", found->second, what));
        };
        if (read.components != components)
            fail(fmt::format("{} components an element; {} needs {}", read.components, name, components));
        if (read.count != count_) fail(fmt::format("{} elements, but there are {} instances", read.count, count_));
        return read;
    }

    Context& context_;
    const std::map<std::string, int> attributes_;
    std::string place_;
    std::size_t count_ = 0;
};

} // namespace

std::vector<glm::dmat4> instanceTransforms(Context& context, int node) {
    return InstanceReader(context, node).read();
}

} // namespace tessera::scenes::gltf
