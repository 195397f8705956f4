#include <algorithm>
#include <limits>
#include <map>
#include <unordered_map>

#include <fmt/format.h>

#include "scenes/import/Importers.h"
#include "scenes/import/ObjMaterials.h"
#include "scenes/import/ObjNormals.h"
#include "scenes/import/ObjText.h"

namespace tessera::scenes {
namespace {

using namespace obj;

struct CornerKey {
    int position;
    int texCoord;
    std::size_t normal;
    bool operator==(const CornerKey&) const = default;
};

struct CornerKeyHash {
    std::size_t operator()(const CornerKey& key) const {
        // Odd constants with well-mixed bits, 2^64 divided by the golden ratio and by the plastic number.
        std::uint64_t hash = static_cast<std::uint64_t>(key.position) * 0x9e3779b97f4a7c15u;
        hash ^= (static_cast<std::uint64_t>(key.texCoord) + hash) * 0xc13fa9a902a6328fu;
        hash ^= (key.normal + (hash >> 29)) * 0x9e3779b97f4a7c15u;
        return hash ^ (hash >> 32);
    }
};

/// One mesh as it grows: equal corners share a vertex.
class MeshBuilder {
public:
    MeshBuilder(const ObjFile& obj, CornerNormals& normals) : obj_(obj), normals_(normals) {}

    void addTriangle(const Triangle& triangle) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Corner& corner = triangle.corners[i];
            const CornerKey key{corner.position, corner.texCoord, normals_.indexAt(triangle, i)};
            const auto [entry, isNew] =
                vertices_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positionsOS.size()));
            if (isNew) addVertex(key);
            mesh_.indices.push_back(entry->second);
        }
    }

    bool lacksSomeTexCoords() const { return hasTexCoords_ && lacksTexCoords_; }

    Mesh take() {
        if (!hasTexCoords_) mesh_.texCoords[0].clear();
        return std::move(mesh_);
    }

private:
    void addVertex(const CornerKey& key) {
        const auto position = static_cast<std::size_t>(key.position);
        mesh_.positionsOS.push_back(obj_.positionsOS[position]);
        mesh_.normalsOS.push_back(normals_[key.normal]);
        if (!obj_.colors.empty()) mesh_.colors.emplace_back(obj_.colors[position], 1.0f);
        glm::vec2 uv(0.0f); // of a corner without, beside others that have them
        if (key.texCoord != kNone) uv = obj_.texCoords[static_cast<std::size_t>(key.texCoord)];
        (key.texCoord != kNone ? hasTexCoords_ : lacksTexCoords_) = true;
        mesh_.texCoords[0].emplace_back(uv.x, 1.0f - uv.y); // the file's origin is the bottom-left corner
    }

    const ObjFile& obj_;
    CornerNormals& normals_;
    std::unordered_map<CornerKey, std::uint32_t, CornerKeyHash> vertices_;
    Mesh mesh_;
    bool hasTexCoords_ = false;
    bool lacksTexCoords_ = false;
};

class ObjImporter {
public:
    ObjImporter(const std::filesystem::path& file, LoadLedger& ledger)
        : file_(file), ledger_(ledger), obj_(readObj(file, ledger)), normals_(obj_), materials_(scene_, ledger) {}

    Scene import() {
        scene_.name = file_.stem().string();
        scene_.warnings = obj_.warnings;
        mtl_ = findMaterials(obj_.materials, obj_.libraries, file_, scene_.warnings, ledger_);
        for (const Group& group : obj_.groups) addGroup(group);
        warnOfLosses();
        return std::move(scene_);
    }

private:
    /// One node, with a mesh per material.
    void addGroup(const Group& group) {
        std::vector<std::pair<int, MeshBuilder>> builders; // in the order the materials are first used
        std::map<int, std::size_t> builderOfMaterial;
        for (const Triangle& triangle : group.triangles) {
            const auto [entry, isNew] = builderOfMaterial.try_emplace(triangle.material, builders.size());
            if (isNew) builders.emplace_back(triangle.material, MeshBuilder(obj_, normals_));
            builders[entry->second].second.addTriangle(triangle);
        }

        Node node;
        node.name = group.name.empty() ? scene_.name : group.name;
        for (auto& [number, builder] : builders) {
            const int material = materialOf(number);
            lacksSomeTexCoords_ = lacksSomeTexCoords_ || builder.lacksSomeTexCoords();
            Mesh mesh = builder.take();
            mesh.name = builders.size() == 1 ? node.name
                                             : fmt::format("{}, {}", node.name,
                                                           scene_.materials[static_cast<std::size_t>(material)].name);
            node.instances.push_back({static_cast<int>(scene_.meshes.size()), material});
            scene_.meshes.push_back(std::move(mesh));
        }
        scene_.nodes.push_back(std::move(node));
    }

    /// Materials are converted, and their pictures read, when the first triangle uses them.
    int materialOf(int number) {
        const auto [entry, isNew] = materialOfNumber_.try_emplace(number, kNone);
        if (!isNew) return entry->second;
        if (number == kNone) return entry->second = materials_.addDefault("default");
        const MtlMaterial& mtl = mtl_[static_cast<std::size_t>(number)];
        const bool isDefined = !mtl.file.empty();
        return entry->second = isDefined ? materials_.add(mtl) : materials_.addDefault(mtl.name);
    }

    void warnOfLosses() {
        const auto warn = [&](const std::string& what) {
            scene_.warnings.push_back(fmt::format("{}: {}", file_.string(), what));
        };
        if (normals_.replacedZeroNormals()) warn("normals of zero length are replaced by the faces' own");
        const auto largest = [](const glm::vec3& v) { return std::max({v.x, v.y, v.z}); };
        glm::vec3 least(std::numeric_limits<float>::max()), most(std::numeric_limits<float>::lowest());
        for (const glm::vec3& position : obj_.positionsOS) {
            least = glm::min(least, position);
            most = glm::max(most, position);
        }
        const float farthest = largest(glm::max(glm::abs(least), glm::abs(most)));
        const float step = farthest * std::numeric_limits<float>::epsilon();
        constexpr float kVisibleShare = 1e-4f; // of the model's size
        if (step > kVisibleShare * largest(most - least))
            warn(fmt::format("lies {:.3g} from its origin, where single precision has steps of {:.2g}; move it to the "
                             "origin before exporting it",
                             farthest, step));
        if (lacksSomeTexCoords_) warn("corners without texture coordinates, beside others that have them, get (0, 0)");
    }

    const std::filesystem::path& file_;
    LoadLedger& ledger_;
    Scene scene_;
    ObjFile obj_;
    CornerNormals normals_;
    MaterialConverter materials_;
    std::vector<MtlMaterial> mtl_;        ///< in the order of ObjFile::materials
    std::map<int, int> materialOfNumber_; ///< scene material by number in ObjFile::materials, or kNone
    bool lacksSomeTexCoords_ = false;
};

} // namespace

Scene importObj(const std::filesystem::path& file, LoadLedger& ledger) {
    const std::uint64_t mark = ledger.usedBytes();
    Scene scene = ObjImporter(file, ledger).import();
    ledger.settle(mark, bytesOf(scene));
    return scene;
}

} // namespace tessera::scenes
