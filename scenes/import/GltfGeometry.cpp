#include "scenes/import/GltfSteps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scenes/Limits.h"

namespace tessera::scenes::gltf {
namespace {

/// Reads the attributes, morph targets, influences and corners of a primitive, and checks them against the
/// specification.
class PrimitiveReader {
public:
    PrimitiveReader(Context& context, const tiny::Primitive& primitive, std::string place, std::string meshName)
        : context_(context), primitive_(primitive), attributes_(&primitive.attributes), place_(std::move(place)),
          meshName_(std::move(meshName)) {}

    bool has(const std::string& attribute) const { return attributes_->contains(attribute); }

    /// Called first. Decodes KHR_draco_mesh_compression, which replaces the indices and the attributes it names.
    void decode() {
        if (dracoOf(primitive_) == nullptr) return;
        if (primitive_.mode == kFan || isThin(primitive_))
            context_.document.fail(place_ + "/mode",
                                   "is {}, {}; KHR_draco_mesh_compression holds lists or "
                                   "strips of triangles",
                                   primitive_.mode, isThin(primitive_) ? "points or lines" : "a fan");
        decoded_ = context_.streams.decode(primitive_, place_, meshName_);
    }

    /// Primitive mode of corners(); a Draco stream always gives a triangle list.
    int mode() const { return decoded_ ? kTriangles : primitive_.mode; }

    void fillVertices(Mesh& mesh) {
        const Elements positions = read("POSITION", {3});
        vertexCount_ = positions.count;
        mesh.positionsOS = vectors<glm::vec3>("POSITION", positions, false);
        findLost(mesh.positionsOS);
        take("NORMAL", mesh.normalsOS, false);
        take("TANGENT", mesh.tangentsOS, false);
        takeTexCoords(mesh.texCoords);
        takeColors(mesh.colors, 1.0f);
        // Source: glTF 2.0 specification, 3.7.2.1: each component must be clamped to [0, 1].
        for (glm::vec4& color : mesh.colors) color = glm::clamp(color, 0.0f, 1.0f);
    }

    void fillTargets(std::vector<MorphTarget>& targets) {
        context_.document.ledger.charge(2 * primitive_.targets.size() * sizeof(MorphTarget),
                                        [&] { return placeInFile(); });
        for (std::size_t i = 0; i < primitive_.targets.size(); ++i) {
            attributes_ = &primitive_.targets[i];
            inPlace_ = fmt::format("targets/{}", i);
            MorphTarget& target = targets.emplace_back();
            take("POSITION", target.positionsOS, true);
            take("NORMAL", target.normalsOS, true);
            take("TANGENT", target.tangentsOS, true);
            takeTexCoords(target.texCoords);
            takeColors(target.colors, 0.0f);
        }
        attributes_ = &primitive_.attributes;
        inPlace_ = "attributes";
    }

    void fillInfluences(Shape& shape) {
        if (context_.document.repairs.attempt("its skin is left out", [&] { readInfluences(shape); })) return;
        shape.influences = 0;
        shape.joints.clear();
        shape.weights.clear();
    }

    /// Vertex numbers in drawing order: the indices, or 0, 1, 2 ... without. Some may be out of range.
    std::vector<std::uint32_t> corners() {
        if (decoded_) return std::move(decoded_->corners);
        if (primitive_.indices >= 0) return context_.accessors.indices(primitive_.indices);
        if (vertexCount_ > std::numeric_limits<std::uint32_t>::max())
            fail("POSITION", "has more vertices than 32-bit indices can name");
        context_.document.ledger.charge(vertexCount_ * sizeof(std::uint32_t), [&] { return placeInFile(); });
        std::vector<std::uint32_t> all(vertexCount_);
        std::iota(all.begin(), all.end(), 0u);
        return all;
    }

    /// Removes elements of `each` corners if a corner has no vertex with a finite position. 0: elements share corners,
    /// so this throws InputError.
    void leaveOutLost(std::vector<std::uint32_t>& corners, std::size_t each) const {
        const auto isLost = [&](std::uint32_t corner) { return this->isLost(corner); };
        const auto first = std::ranges::find_if(corners, isLost);
        if (first == corners.end()) return;
        const std::string what =
            *first < vertexCount_
                ? fmt::format("vertex {} of mesh '{}' has a position that is not finite, or above {:g}", *first,
                              meshName_, kFarthestMetres)
                : fmt::format("index {} of mesh '{}' is no vertex; there are {}", *first, meshName_, vertexCount_);
        if (each == 0) context_.document.fail(place_, what);
        context_.document.repair(place_, "what it would be a corner of is left out", "{}", what);
        std::size_t kept = 0;
        for (std::size_t element = 0; element + each <= corners.size(); element += each) {
            const auto begin = corners.begin() + std::ptrdiff_t(element), end = begin + std::ptrdiff_t(each);
            if (std::any_of(begin, end, isLost)) continue;
            std::copy(begin, end, corners.begin() + std::ptrdiff_t(kept));
            kept += each;
        }
        corners.resize(kept);
    }

    void warnOfUnused() {
        for (const auto& [name, accessor] : primitive_.attributes) {
            const bool isExtraSet = (name.starts_with("TEXCOORD_") && name != "TEXCOORD_0" && name != "TEXCOORD_1") ||
                                    (name.starts_with("COLOR_") && name != "COLOR_0");
            if (isExtraSet)
                context_.warn("vertex attribute {} is left out (only TEXCOORD_0, TEXCOORD_1 and "
                              "COLOR_0 are supported)",
                              name);
        }
    }

private:
    template <typename Vector>
    void take(const std::string& attribute, std::vector<Vector>& values, bool mustBeFinite) {
        if (!has(attribute)) return;
        context_.document.repairs.attempt(kAttributeLeftOut, [&] {
            values = vectors<Vector>(attribute, readVertices(attribute, {Vector::length()}), mustBeFinite);
        });
    }
    void takeTexCoords(auto& texCoords) {
        for (std::size_t set = 0; set < texCoords.size(); ++set)
            take(fmt::format("TEXCOORD_{}", set), texCoords[set], true);
    }
    void takeColors(std::vector<glm::vec4>& values, float alpha) {
        if (!has("COLOR_0")) return;
        context_.document.repairs.attempt(kAttributeLeftOut,
                                          [&] { values = vectors<glm::vec4>("COLOR_0", colors(alpha), true); });
    }

    bool isLost(std::uint32_t corner) const { return corner >= vertexCount_ || (!isLost_.empty() && isLost_[corner]); }

    void findLost(std::vector<glm::vec3>& positions) {
        for (std::size_t i = 0; i < positions.size(); ++i) {
            if (isNearEnough(positions[i])) continue;
            isLost_.resize(positions.size());
            isLost_[i] = true;
            positions[i] = {};
        }
    }

    /// Reads joints and weights of both sets. Weights that are negative or not finite count as 0, and joints without
    /// weight as joint 0: some files have invalid values there.
    void readInfluences(Shape& shape) {
        constexpr std::size_t kSet = 4;
        bool hasNonsense = false;
        const std::size_t sets = has("JOINTS_0") ? (has("JOINTS_1") ? 2 : 1) : 0;
        shape.influences = kSet * sets;
        context_.document.ledger.charge(vertexCount_ * shape.influences * (sizeof(std::uint32_t) + sizeof(float)),
                                        [&] { return placeInFile(); });
        shape.joints.resize(vertexCount_ * shape.influences);
        shape.weights.resize(shape.joints.size());
        for (std::size_t set = 0; set < sets; ++set) {
            const std::string jointsName = fmt::format("JOINTS_{}", set), weightsName = fmt::format("WEIGHTS_{}", set);
            if (!has(weightsName))
                context_.document.fail(fmt::format("{}/attributes", place_), "has {} but no {}", jointsName,
                                       weightsName);
            const Elements joints = readVertices(jointsName, {4});
            const bool areIntegers = joints.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                                     joints.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
            if (!areIntegers || joints.normalized)
                fail(jointsName, "names joints, so it must be of UNSIGNED_BYTE or UNSIGNED_SHORT, not normalized");
            const std::vector<glm::vec4> weights =
                vectors<glm::vec4>(weightsName, readVertices(weightsName, {4}), false);
            for (std::size_t v = 0; v < vertexCount_; ++v)
                for (std::size_t i = 0; i < kSet; ++i) {
                    const float weight = weights[v][glm::length_t(i)];
                    const bool counts = weight >= 0.0f && std::isfinite(weight);
                    hasNonsense = hasNonsense || !counts;
                    const std::size_t at = v * shape.influences + set * kSet + i;
                    if (!counts || weight == 0.0f) continue;
                    shape.weights[at] = weight;
                    shape.joints[at] = std::uint32_t(joints.values[v * kSet + i]);
                }
        }
        if (hasNonsense) context_.warn("{}: weights of joints that are negative or not finite count as 0", place_);
        if (has("JOINTS_2")) context_.warn("{}: JOINTS_2 and further are left out; a vertex follows 8 joints", place_);
    }

    static constexpr std::string_view kAttributeLeftOut = "the attribute is left out";

    std::string placeInFile() const { return fmt::format("{}: {}", context_.document.file, place_); }

    template <typename... Values>
    [[noreturn]] void fail(const std::string& attribute, fmt::format_string<Values...> what, Values&&... values) const {
        context_.document.fail(fmt::format("{}/{}/{}", place_, inPlace_, attribute), "accessor {} of mesh '{}' {}",
                               attributes_->at(attribute), meshName_,
                               fmt::format(what, std::forward<Values>(values)...));
    }

    /// The elements of an attribute in the Draco stream, else nothing. The stream never holds morph targets.
    std::span<const std::byte> decoded(const std::string& attribute) const {
        if (!decoded_ || attributes_ != &primitive_.attributes) return {};
        const auto found = decoded_->attributes.find(attribute);
        return found == decoded_->attributes.end() ? std::span<const std::byte>() : found->second;
    }

    /// Checks an attribute before reading it, because many may be flawed. `count`: expected elements, if known.
    Elements read(const std::string& attribute, std::initializer_list<int> components,
                  std::optional<std::size_t> count = {}) {
        const int index = attributes_->at(attribute);
        const tiny::Accessor& accessor = elementAt(context_.document.model.accessors, index);
        const int width = componentsOf(accessor);
        if (width != 0 && std::ranges::find(components, width) == components.end())
            fail(attribute, "has {} components an element; {} needs {}", width, attribute,
                 components.size() == 1 ? fmt::format("{}", *components.begin()) : "3 or 4");
        if (count && accessor.count != *count)
            fail(attribute, "has {} elements, but there are {} positions", accessor.count, *count);
        return context_.accessors.elements(index, decoded(attribute));
    }

    Elements readVertices(const std::string& attribute, std::initializer_list<int> components) {
        return read(attribute, components, vertexCount_);
    }

    /// Reads colours; RGB gets the given alpha. Integers not marked normalised cannot mean 0..255, so they are read as
    /// normalised.
    Elements colors(float alpha) {
        Elements elements = readVertices("COLOR_0", {3, 4});
        if (!elements.normalized && elements.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT) {
            const double largest = std::exp2(8.0 * double(bytesOf(elements.componentType))) - 1.0;
            for (float& value : elements.values) value = float(value / largest);
            context_.warn("{}/{}/COLOR_0: holds integers that are not marked normalized; read as if they were", place_,
                          inPlace_);
        }
        if (elements.components == 4) return elements;
        context_.document.charge(elements.count * sizeof(glm::vec4), "accessors", attributes_->at("COLOR_0"));
        std::vector<float> withAlpha;
        withAlpha.reserve(elements.count * 4);
        for (std::size_t i = 0; i < elements.count; ++i) {
            withAlpha.insert(withAlpha.end(), &elements.values[i * 3], &elements.values[i * 3] + 3);
            withAlpha.push_back(alpha);
        }
        elements.values = std::move(withAlpha);
        elements.components = 4;
        return elements;
    }

    template <typename Vector>
    std::vector<Vector> vectors(const std::string& attribute, const Elements& elements, bool mustBeFinite) const {
        constexpr int kWidth = Vector::length();
        std::vector<Vector> result(elements.count);
        for (std::size_t i = 0; i < elements.count; ++i)
            for (int c = 0; c < kWidth; ++c) {
                const float value = elements.values[i * std::size_t(kWidth) + std::size_t(c)];
                if (mustBeFinite && !std::isfinite(value))
                    fail(attribute, "holds {} in element {}; every {} must be finite", value, i, attribute);
                result[i][c] = value;
            }
        return result;
    }

    Context& context_;
    const tiny::Primitive& primitive_;
    const std::map<std::string, int>* attributes_; ///< the primitive's, or a target's
    std::string inPlace_ = "attributes";
    std::string place_;
    std::string meshName_;
    std::size_t vertexCount_ = 0;
    std::vector<bool> isLost_; ///< by vertex: its position is not finite or too far; empty if all are good
    std::optional<DracoGeometry> decoded_;
};

/// Turns points and lines into triangles of thin solids, still without size and normals (GltfThinSolids.cpp).
void makeThin(Context& context, const std::string& place, int mode, std::vector<std::uint32_t> corners,
              const Deforms& deforms, Mesh& mesh) {
    const auto who = [&] { return fmt::format("{}: {}", context.document.file, place); };
    LoadLedger& ledger = context.document.ledger;
    constexpr std::size_t kEnds = 2;
    ledger.charge(kEnds * (corners.size() + 1) * sizeof(std::uint32_t), who);
    const std::vector<std::uint32_t> elements =
        thinElements(mode, std::move(corners), mesh.positionsOS, deforms.byTargets || deforms.byJoints);
    const std::size_t solids = elements.size() / (mode == kPoints ? 1 : kEnds);
    if (!canBeIndexed(solids))
        context.document.fail(place,
                              "draws {} points or lines, whose solids have more corners than 32-bit "
                              "indices can name; split the mesh",
                              solids);
    ledger.charge(solids * kCornersOfSolid * sizeof(std::uint32_t), who);
    mesh.indices = cornersOfSolids(mode, elements);
    mesh.normalsOS.clear();
    mesh.tangentsOS.clear();
}

std::optional<Shape> readPrimitive(Context& context, int meshIndex, int primitiveIndex, Deforms deforms) {
    const tiny::Mesh& stored = elementAt(context.document.model.meshes, meshIndex);
    const tiny::Primitive& primitive = stored.primitives[std::size_t(primitiveIndex)];
    const std::string place = fmt::format("/meshes/{}/primitives/{}", meshIndex, primitiveIndex);
    Shape shape;
    Mesh& mesh = shape.rest;
    mesh.name = nameOr(stored.name, "mesh", meshIndex);
    if (stored.primitives.size() > 1) mesh.name += fmt::format(" primitive {}", primitiveIndex);

    LoadLedger& ledger = context.document.ledger;
    const auto heldBytes = [&context] { return context.buffers.heldBytes() + context.streams.heldBytes(); };
    const std::uint64_t mark = ledger.usedBytes() - heldBytes();
    PrimitiveReader reader(context, primitive, place, mesh.name);
    if (!reader.has("POSITION")) {
        context.warn("{}: mesh '{}' has no POSITION and is left out", place, mesh.name);
        return std::nullopt;
    }
    reader.decode();
    reader.fillVertices(mesh);
    if (deforms.byTargets) reader.fillTargets(shape.targets);
    if (deforms.byJoints) reader.fillInfluences(shape);
    std::vector<std::uint32_t> corners = reader.corners();
    const std::size_t each = reader.mode() == kTriangles ? 3 : reader.mode() == kLines ? 2 : 1;
    if (corners.size() % each != 0)
        context.warn("{}: mesh '{}' has {} corners, which is no multiple of {}; the last {} is left out", place,
                     mesh.name, corners.size(), each, each == 3 ? "triangle" : "line");
    if (isThin(primitive)) {
        reader.leaveOutLost(corners, each == 1 && primitive.mode != kPoints ? 0 : each);
        makeThin(context, place, primitive.mode, std::move(corners), deforms, mesh);
    } else {
        if (reader.mode() != kTriangles) // three corners for every one after the second
            ledger.charge(2 * 3 * corners.size() * sizeof(std::uint32_t),
                          [&] { return fmt::format("{}: {}", context.document.file, place); });
        mesh.indices = trianglesOf(reader.mode(), std::move(corners));
        reader.leaveOutLost(mesh.indices, 3);
    }
    reader.warnOfUnused();
    finishNormals(context, place, shape);
    ledger.settle(mark, heldBytes() + bytesOf(shape));
    if (mesh.indices.empty()) {
        context.warn("{}: mesh '{}' has no {} and is left out", place, mesh.name,
                     !isThin(primitive)          ? "triangle"
                     : primitive.mode == kPoints ? "point"
                                                 : "line of any length");
        return std::nullopt;
    }
    return shape;
}

} // namespace

std::optional<Shape> importPrimitive(Context& context, int mesh, int primitive, Deforms deforms) {
    std::optional<Shape> shape;
    context.document.repairs.attempt("the primitive is left out",
                                     [&] { shape = readPrimitive(context, mesh, primitive, deforms); });
    return shape;
}

} // namespace tessera::scenes::gltf
