#include <array>
#include <cassert>
#include <map>
#include <sstream>
#include <unordered_map>

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include "base/Error.h"
#include "scenes/import/Importers.h"
#include "scenes/import/ObjLines.h"
#include "scenes/import/ObjMaterials.h"
#include "scenes/import/ObjNormals.h"
#include "scenes/import/ObjText.h"

namespace tessera::scenes {
namespace {

using namespace obj;

/// Tells tinyobjloader which material a checked text's "usemtl 3" means: the third.
class NumberedMaterials : public tinyobj::MaterialReader {
public:
    explicit NumberedMaterials(std::size_t count) : count_(count) {}
    bool operator()(const std::string&, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* numbers, std::string*, std::string*) override {
        materials->resize(count_);
        for (std::size_t i = 0; i < count_; ++i) numbers->emplace(std::to_string(i), static_cast<int>(i));
        return true;
    }

private:
    std::size_t count_;
};

struct Parsed {
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
};

Parsed parse(const CheckedText& checked, const std::filesystem::path& file) {
    Parsed parsed;
    std::vector<tinyobj::material_t> materials;
    std::string warning; // what it would say has been said by the check
    std::string error;
    std::istringstream stream("mtllib numbered\n" + checked.text);
    NumberedMaterials reader(checked.materials.size());
    constexpr bool kTriangulate = false; // the checked text holds triangles only
    constexpr bool kWhiteWhereNoColor = false;
    if (!tinyobj::LoadObj(&parsed.attributes, &parsed.shapes, &materials, &warning, &error, &stream, &reader,
                          kTriangulate, kWhiteWhereNoColor))
        throw InputError(fmt::format("{}: cannot be read as OBJ: {}", file.string(), error));
    return parsed;
}

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
    MeshBuilder(const tinyobj::attrib_t& attributes, CornerNormals& normals)
        : attributes_(attributes), normals_(normals) {}

    void addTriangle(const tinyobj::mesh_t& source, std::size_t triangle) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const tinyobj::index_t& index = source.indices[triangle * 3 + corner];
            const CornerKey key{index.vertex_index, index.texcoord_index, normals_.indexAt(source, triangle, corner)};
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
        const auto at = [](int index, std::size_t stride) { return static_cast<std::size_t>(index) * stride; };
        const std::size_t position = at(key.position, 3);
        const std::vector<tinyobj::real_t>& xyz = attributes_.vertices;
        mesh_.positionsOS.emplace_back(xyz[position], xyz[position + 1], xyz[position + 2]);
        mesh_.normalsOS.push_back(normals_[key.normal]);
        if (const std::vector<tinyobj::real_t>& rgb = attributes_.colors; rgb.size() == xyz.size() && !rgb.empty())
            mesh_.colors.emplace_back(rgb[position], rgb[position + 1], rgb[position + 2], 1.0f);
        glm::vec2 uv(0.0f, 1.0f); // (0, 0) in the file
        if (key.texCoord >= 0) {
            // The file's origin is the bottom-left corner.
            const std::size_t texCoord = at(key.texCoord, 2);
            uv = {attributes_.texcoords[texCoord], 1.0f - attributes_.texcoords[texCoord + 1]};
        }
        (key.texCoord >= 0 ? hasTexCoords_ : lacksTexCoords_) = true;
        mesh_.texCoords[0].push_back(uv);
    }

    const tinyobj::attrib_t& attributes_;
    CornerNormals& normals_;
    std::unordered_map<CornerKey, std::uint32_t, CornerKeyHash> vertices_;
    Mesh mesh_;
    bool hasTexCoords_ = false;
    bool lacksTexCoords_ = false;
};

class ObjImporter {
public:
    ObjImporter(const std::filesystem::path& file, LoadLedger& ledger)
        : file_(file), ledger_(ledger), checked_(checkText(readText(file, ledger), file, ledger)),
          parsed_(parse(checked_, file)), normals_(parsed_.attributes, parsed_.shapes), materials_(scene_, ledger) {}

    Scene import() {
        scene_.name = file_.stem().string();
        scene_.warnings = checked_.warnings;
        mtl_ = findMaterials(checked_.materials, checked_.libraries, file_, scene_.warnings, ledger_);
        for (const tinyobj::shape_t& shape : parsed_.shapes) addShape(shape);
        warnOfLosses();
        return std::move(scene_);
    }

private:
    /// A shape is the part between two 'g' or 'o' statements: one node, with a mesh per material.
    void addShape(const tinyobj::shape_t& shape) {
        std::vector<std::pair<int, MeshBuilder>> builders; // in the order the materials are first used
        std::map<int, std::size_t> builderOfMaterial;
        const std::size_t triangles = shape.mesh.indices.size() / 3;
        for (std::size_t triangle = 0; triangle < triangles; ++triangle) {
            const int material = shape.mesh.material_ids[triangle];
            const auto [entry, isNew] = builderOfMaterial.try_emplace(material, builders.size());
            if (isNew) builders.emplace_back(material, MeshBuilder(parsed_.attributes, normals_));
            builders[entry->second].second.addTriangle(shape.mesh, triangle);
        }
        if (builders.empty()) return;

        Node node;
        node.name = shape.name.empty() ? scene_.name : shape.name;
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
        if (number < 0) return entry->second = materials_.addDefault("default");
        const MtlMaterial& mtl = mtl_[static_cast<std::size_t>(number)];
        const bool isDefined = !mtl.file.empty();
        return entry->second = isDefined ? materials_.add(mtl) : materials_.addDefault(mtl.name);
    }

    void warnOfLosses() {
        const auto warn = [&](const std::string& what) {
            scene_.warnings.push_back(fmt::format("{}: {}", file_.string(), what));
        };
        if (normals_.replacedZeroNormals()) warn("normals of zero length are replaced by the faces' own");
        if (lacksSomeTexCoords_) warn("corners without texture coordinates, beside others that have them, get (0, 0)");
    }

    const std::filesystem::path& file_;
    LoadLedger& ledger_;
    Scene scene_;
    CheckedText checked_;
    Parsed parsed_;
    CornerNormals normals_;
    MaterialConverter materials_;
    std::vector<MtlMaterial> mtl_;
    std::map<int, int> materialOfNumber_; ///< scene material by number in the checked text; -1 is none
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
