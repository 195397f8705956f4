#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include <glm/gtc/matrix_transform.hpp>

#include "scenes/import/GltfSteps.h"
#include "scenes/import/Importers.h"
#include "scenes/import/MadeImages.h"
#include "scenes/import/ObjMaterials.h"
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
        std::uint64_t hash = std::uint64_t(key.position) * 0x9e3779b97f4a7c15u;
        hash ^= (std::uint64_t(key.texCoord) + hash) * 0xc13fa9a902a6328fu;
        hash ^= (key.normal + (hash >> 29)) * 0x9e3779b97f4a7c15u;
        return hash ^ (hash >> 32);
    }
};

constexpr glm::vec3 kUp{0.0f, 1.0f, 0.0f};

glm::vec3 unitOr(const glm::dvec3& vector, const glm::vec3& otherwise) {
    const double length = glm::length(vector);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(vector / length) : otherwise;
}

/// A normal for every corner of every triangle. A missing normal is the triangle's outside smoothing groups; in one, it
/// is the mean over the group's triangles at that position, weighted by their corner angles, which is independent of
/// how polygons were triangulated. Source: Thuermer & Wuethrich 1998, "Computing Vertex Normals from Polygonal Facets".
class CornerNormals {
public:
    explicit CornerNormals(const ObjFile& obj) : obj_(obj) {
        normals_.reserve(obj.normalsOS.size());
        for (const glm::vec3& normalOS : obj.normalsOS) normals_.push_back(unitOr(normalOS, kUp));
        std::vector<glm::dvec3> sums; // of the normals that are stored after the file's
        for (const Group& group : obj.groups)
            for (const Triangle& triangle : group.triangles) {
                // A triangle with all normals needs none computed, and its neighbours in a file have them too.
                const auto lacksNormal = [](const Corner& corner) { return corner.normal == kNone; };
                if (triangle.smoothingGroup == 0 || std::ranges::none_of(triangle.corners, lacksNormal)) continue;
                const std::array<glm::dvec3, 3> normals = weightedNormals(triangle);
                for (std::size_t i = 0; i < 3; ++i) {
                    const std::uint64_t key = keyOf(triangle.corners[i].position, triangle.smoothingGroup);
                    const auto [entry, isNew] = smooth_.try_emplace(key, normals_.size() + sums.size());
                    if (isNew) sums.emplace_back(0.0);
                    sums[entry->second - normals_.size()] += normals[i];
                }
            }
        normals_.reserve(normals_.size() + sums.size());
        for (const glm::dvec3& sum : sums) normals_.push_back(unitOr(sum, kUp));
    }

    /// The index of a corner's normal: equal indices are equal normals.
    std::size_t indexAt(const Triangle& triangle, std::size_t corner) {
        const Corner& index = triangle.corners[corner];
        if (index.normal != kNone) return std::size_t(index.normal);
        if (triangle.smoothingGroup != 0) return smooth_.at(keyOf(index.position, triangle.smoothingGroup));
        if (flatTriangle_ != &triangle) {
            const std::array<glm::dvec3, 3> normals = weightedNormals(triangle);
            normals_.push_back(unitOr(normals[0] + normals[1] + normals[2], kUp));
            flatTriangle_ = &triangle;
        }
        return normals_.size() - 1;
    }

    /// A unit normal; +Y if a triangle has no area.
    const glm::vec3& operator[](std::size_t index) const { return normals_[index]; }

private:
    static std::uint64_t keyOf(int position, std::uint32_t smoothingGroup) {
        return std::uint64_t(position) << 32 | smoothingGroup;
    }

    /// The triangle's unit normal times its angle at each corner; zero without area.
    std::array<glm::dvec3, 3> weightedNormals(const Triangle& triangle) const {
        const auto at = [&](std::size_t i) { return obj_.positions[std::size_t(triangle.corners[i % 3].position)]; };
        std::array<glm::dvec3, 3> normals{};
        const glm::dvec3 areaNormal = glm::cross(at(1) - at(0), at(2) - at(0));
        const double length = glm::length(areaNormal);
        for (std::size_t i = 0; i < 3 && length > 0.0; ++i) {
            const glm::dvec3 toNext = at(i + 1) - at(i), toPrevious = at(i + 2) - at(i);
            const double angle = std::atan2(glm::length(glm::cross(toNext, toPrevious)), glm::dot(toNext, toPrevious));
            normals[i] = areaNormal / length * angle;
        }
        return normals;
    }

    const ObjFile& obj_;
    std::vector<glm::vec3> normals_;                        ///< those of the file first
    std::unordered_map<std::uint64_t, std::size_t> smooth_; ///< by position and smoothing group
    const Triangle* flatTriangle_ = nullptr;                ///< triangle of the last flat normal
};

/// Builds one mesh; equal corners share a vertex.
class MeshBuilder {
public:
    MeshBuilder(const ObjFile& obj, CornerNormals& normals) : obj_(obj), normals_(normals) {}

    void addTriangle(const Triangle& triangle) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Corner& corner = triangle.corners[i];
            const CornerKey key{corner.position, corner.texCoord, normals_.indexAt(triangle, i)};
            const auto [entry, isNew] = vertices_.try_emplace(key, std::uint32_t(mesh_.positionsOS.size()));
            if (isNew) addVertex(corner, normals_[key.normal]);
            mesh_.indices.push_back(entry->second);
        }
    }

    /// Adds points or segments, whose solids share no vertices. sizeThinSolids() gives them size and normals.
    void addThin(int mode, const std::vector<Corner>& ends) {
        std::vector<std::uint32_t> elements(ends.size());
        std::iota(elements.begin(), elements.end(), 0u);
        for (const std::uint32_t end : gltf::cornersOfSolids(mode, elements)) {
            mesh_.indices.push_back(std::uint32_t(mesh_.positionsOS.size()));
            addVertex(ends[end], kUp);
        }
    }

    bool lacksSomeTexCoords() const { return hasTexCoords_ && lacksTexCoords_; }

    Mesh take() {
        if (!hasTexCoords_) mesh_.texCoords[0].clear();
        return std::move(mesh_);
    }

private:
    void addVertex(const Corner& corner, const glm::vec3& normalOS) {
        const auto position = std::size_t(corner.position);
        mesh_.positionsOS.emplace_back(obj_.positions[position] - obj_.origin);
        mesh_.normalsOS.push_back(normalOS);
        if (!obj_.colors.empty()) mesh_.colors.emplace_back(obj_.colors[position], 1.0f);
        glm::vec2 uv(0.0f); // of a corner without, if others have them
        if (corner.texCoord != kNone) uv = obj_.texCoords[std::size_t(corner.texCoord)];
        (corner.texCoord != kNone ? hasTexCoords_ : lacksTexCoords_) = true;
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
        : file_(file), repairs_(ledger.importOptions().isStrict), ledger_(ledger),
          obj_(readObj(file, ledger, repairs_)), normals_(obj_), materials_(scene_, repairs_, ledger) {}

    Scene import() {
        scene_.name = file_.stem().string();
        scene_.warnings = std::move(obj_.warnings);
        mtl_ = findMaterials(obj_.materials, obj_.libraries, file_, repairs_, ledger_);
        for (const Group& group : obj_.groups) addGroup(group);
        materials_.finish();
        gltf::sizeThinSolids(scene_, thinModes_);
        if (lacksSomeTexCoords_)
            repairs_.note(file_.string(), 0, "they get (0, 0)",
                          "corners have no texture coordinates, beside others that have them");
        std::ranges::move(repairs_.warnings(), std::back_inserter(scene_.warnings));
        return std::move(scene_);
    }

private:
    /// Adds one node, with a mesh for each kind of element and material.
    void addGroup(const Group& group) {
        using Part = std::pair<int, int>;                   // mode and material
        std::vector<std::pair<Part, MeshBuilder>> builders; // in the order the materials are first used
        std::map<Part, std::size_t> builderOfPart;
        const auto builderOf = [&](const Part& part) -> MeshBuilder& {
            const auto [entry, isNew] = builderOfPart.try_emplace(part, builders.size());
            if (isNew) builders.emplace_back(part, MeshBuilder(obj_, normals_));
            return builders[entry->second].second;
        };
        for (const Triangle& triangle : group.triangles)
            builderOf({gltf::kTriangles, triangle.material}).addTriangle(triangle);
        for (const auto& [part, ends] : group.thin) builderOf(part).addThin(part.first, ends);

        Node node;
        node.name = group.name.empty() ? scene_.name : group.name;
        node.parentFromNode = glm::translate(glm::dmat4(1.0), obj_.origin);
        for (auto& [part, builder] : builders) {
            const bool isThin = part.first != gltf::kTriangles;
            const int material = materialOf(part.second, isThin);
            lacksSomeTexCoords_ = lacksSomeTexCoords_ || builder.lacksSomeTexCoords();
            Mesh mesh = builder.take();
            mesh.name = builders.size() == 1
                            ? node.name
                            : fmt::format("{}, {}", node.name, scene_.materials[std::size_t(material)].name);
            const auto isPicture = [](const TextureUse& use) { return use.image != kNone; };
            if (!isThin && mesh.texCoords[0].empty() &&
                std::ranges::any_of(scene_.materials[std::size_t(material)].textures, isPicture)) {
                ledger_.charge(mesh.positionsOS.size() * sizeof(glm::vec2), [&] { return mesh.name; });
                mesh.texCoords[0] = boxCoordinates(mesh);
                repairs_.note(file_.string(), 0, "its pictures are projected along the axes",
                              "'{}' has no texture coordinates", mesh.name);
            }
            const int index = int(scene_.meshes.size());
            if (isThin) thinModes_[index] = part.first;
            node.instances.push_back({index, material});
            scene_.meshes.push_back(std::move(mesh));
        }
        scene_.nodes.push_back(std::move(node));
    }

    /// Materials are converted, and their images read, when the first element uses them.
    int materialOf(int number, bool isUnlit) {
        const MtlMaterial* mtl = number == kNone ? nullptr : &mtl_[std::size_t(number)];
        const auto [entry, isNew] = materialOfName_.try_emplace({mtl ? mtl->name : "", mtl != nullptr, isUnlit}, kNone);
        if (isNew) entry->second = materials_.add(mtl, isUnlit);
        return entry->second;
    }

    const std::filesystem::path& file_;
    Repairs repairs_;
    LoadLedger& ledger_;
    Scene scene_;
    ObjFile obj_;
    CornerNormals normals_;
    MaterialConverter materials_;
    std::vector<MtlMaterial> mtl_; ///< in the order of ObjFile::materials
    /// Scene materials by name, whether an MTL material exists, and whether they are unlit.
    std::map<std::tuple<std::string, bool, bool>, int> materialOfName_;
    std::map<int, int> thinModes_; ///< the glTF modes of meshes that draw points or lines
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
