#include "scenes/import/ObjText.h"

#include <algorithm>
#include <set>
#include <unordered_map>

#include "scenes/Limits.h"
#include "scenes/import/GltfSteps.h"
#include "scenes/import/ObjLines.h"
#include "scenes/import/ObjMaterials.h"

namespace tessera::scenes::obj {
namespace {

using gltf::kLines;
using gltf::kPoints;

/// Statements that change nothing in a triangle mesh: levels of detail, interpolation switches, ray tracing helpers.
constexpr std::array<std::string_view, 8> kWithoutEffect = {"lod", "bevel",      "c_interp",  "d_interp",
                                                            "mg",  "shadow_obj", "trace_obj", "vw"};

/// The parts of a corner in the order it is written: i, i/j, i//k or i/j/k.
enum Attribute : std::size_t { kPosition, kTexCoord, kNormal, kAttributeCount };
struct AttributeInfo {
    std::string_view keyword, name;
    std::size_t numbers; ///< number of values read
    std::size_t needed;
    std::string_view repair; ///< of an element that uses an invalid one
};
constexpr std::array<AttributeInfo, kAttributeCount> kAttributes{
    {{"v", "position", 3, 3, "elements that use it are left out"},
     {"vt", "texture coordinate", 2, 1, "the number is taken as 0"},
     {"vn", "normal", 3, 3, "faces that use it get their own normals"}}};
constexpr std::string_view kLeftOut = "the element is left out";
constexpr std::string_view kWithoutIt = "the corner is drawn without it";

// Bytes charged for the results of the text, up to the scene.
/// Any corner may get a separate vertex (position, normal, texture coordinate, colour, index), looked up by three
/// indices, and a smooth normal, looked up by position and group. Only one of the vertices' vectors grows at a time.
constexpr std::size_t kVertexBytes =
    2 * sizeof(glm::vec3) + sizeof(glm::vec2) + sizeof(glm::vec4) + sizeof(std::uint32_t);
constexpr std::size_t kCornerBytes = kRoom * kVertexBytes + sizeof(glm::vec4) + kNodeBytes<std::array<std::size_t, 3>> +
                                     sizeof(glm::vec3) + kNodeBytes<std::array<std::size_t, 2>>;
constexpr std::size_t kTriangleBytes = kGrown * sizeof(Triangle) + 3 * kCornerBytes;
/// A point or a segment becomes a solid.
constexpr std::size_t kThinBytes =
    kGrown * 2 * sizeof(Corner) + gltf::kCornersOfSolid * (kRoom * kVertexBytes + sizeof(glm::vec4));
/// A position may have a colour; normals are normalised in a separate list.
constexpr std::size_t kAttributeBytes = kGrown * (sizeof(glm::dvec3) + sizeof(glm::vec3));
/// A name after usemtl becomes a material of the libraries, or a warning, and one or two materials of the scene.
constexpr std::size_t kMaterialBytes = kGrown * (sizeof(MtlMaterial) + 2 * sizeof(Material) + 4 * sizeof(std::string));
/// A material of a group becomes a mesh, the group a node. The memory counted for group and node covers the mesh
/// builders of further materials.
constexpr std::size_t kMeshBytes = kGrown * (sizeof(Group) + sizeof(Mesh) + sizeof(Node) + sizeof(MeshInstance));

/// Limit of corners visited to triangulate all polygons of a file: a second or so.
constexpr std::uint64_t kMostSteps = 500'000'000;
/// Additional steps per corner of the file: quads take fewer.
constexpr std::uint64_t kStepsACorner = 64;

class ObjReader {
public:
    ObjReader(const std::filesystem::path& file, LoadLedger& ledger, Repairs& repairs)
        : file_(file.string()), ledger_(ledger), repairs_(repairs) {}

    ObjFile read() {
        const std::string text = readText(file_, ledger_);
        // A face may precede its vertices.
        forEachLine(text, [&](const Line& line) { readAttribute(line); });
        isUsed_.resize(obj_.positions.size());
        forEachLine(text, [&](const Line& line) { readElement(line); });
        if (!hasElements_) addVertices();
        if (obj_.groups.empty())
            throw InputError(!repairs_.first().empty()
                                 ? repairs_.first()
                                 : file_ + ": has nothing to draw ('f', 'l', 'p' or 'v' statements); export the model "
                                           "with its polygons");
        obj_.colors = colours_.take(file_, ledger_.importOptions().objColours, isUsed_, repairs_);
        placeOrigin();
        if (!unknown_.empty())
            obj_.warnings.push_back(fmt::format("{}: statements that are not supported are left out: {}", file_,
                                                fmt::join(unknown_, ", ")));
        return std::move(obj_);
    }

private:
    struct Flaw {
        int line;
        std::string text;
        bool isNoted = false;
    };

    static std::optional<Attribute> attributeOf(std::string_view keyword) {
        const auto found = std::ranges::find(kAttributes, keyword, &AttributeInfo::keyword);
        if (found == kAttributes.end()) return std::nullopt;
        return static_cast<Attribute>(found - kAttributes.begin());
    }

    void readAttribute(const Line& line) {
        const std::optional<Attribute> attribute = attributeOf(line.keyword);
        if (!attribute) return;
        const AttributeInfo& info = kAttributes[*attribute];
        charge(kAttributeBytes, line);
        std::string flaw;
        if (line.words.size() < info.needed)
            flaw = fmt::format("'{}' has {} of the {} numbers it needs", line.keyword, line.words.size(), info.needed);
        glm::dvec3 numbers(0.0);
        for (std::size_t i = 0; i < std::min(line.words.size(), info.numbers); ++i)
            numbers[glm::length_t(i)] = finiteNumber(line.keyword, line.words[i], flaw).value_or(0.0);
        if (*attribute == kNormal && flaw.empty() && glm::vec3(numbers) == glm::vec3(0.0f))
            flaw = "the normal has no length";
        if (*attribute == kPosition && flaw.empty() && !isNearEnough(numbers))
            flaw = fmt::format("the position lies more than {:g} m away", kFarthestMetres);
        if (!flaw.empty()) {
            charge(kNodeBytes<std::pair<std::size_t, Flaw>> + kRoom * flaw.size(), line);
            flaws_[*attribute].emplace(sizeOf(*attribute), Flaw{line.number, std::move(flaw)});
        }
        if (*attribute == kTexCoord) {
            obj_.texCoords.emplace_back(numbers);
        } else if (*attribute == kNormal) {
            obj_.normalsOS.emplace_back(numbers);
        } else {
            colours_.read(line, obj_.positions.size());
            obj_.positions.push_back(numbers);
        }
    }

    std::size_t sizeOf(Attribute attribute) const {
        if (attribute == kPosition) return obj_.positions.size();
        return attribute == kTexCoord ? obj_.texCoords.size() : obj_.normalsOS.size();
    }

    void readElement(const Line& line) {
        const std::string_view keyword = line.keyword;
        if (const std::optional<Attribute> attribute = attributeOf(keyword)) {
            ++above_[*attribute];
        } else if (keyword == "f") {
            readFace(line);
        } else if (keyword == "l" || keyword == "p") {
            readThin(line, keyword == "l" ? kLines : kPoints);
        } else if (keyword == "g") {
            std::vector<std::string_view> names; // several form one name
            addWords(withoutComment(line.rest), names);
            beginGroup(fmt::to_string(fmt::join(names, " ")));
        } else if (keyword == "o") {
            beginGroup(std::string(withoutComment(line.rest)));
        } else if (keyword == "s") {
            readSmoothing(line);
        } else if (keyword == "usemtl") {
            nextMaterial_ = line.rest;
        } else if (keyword == "mtllib") {
            charge(keptTextBytes(line.rest), line);
            obj_.libraries.emplace_back(line.rest);
        } else if (std::ranges::find(kWithoutEffect, keyword) == kWithoutEffect.end()) {
            if (unknown_.emplace(keyword).second) charge(keptTextBytes(keyword), line);
        }
    }

    void beginGroup(std::string name) {
        groupName_ = std::move(name);
        groupMeshes_.clear();
    }

    /// Called for drawn elements: a material without one is not looked up.
    void useMaterial(const Line& line) {
        if (!nextMaterial_) return;
        const auto [entry, isNew] = materialOfName_.try_emplace(*nextMaterial_, int(obj_.materials.size()));
        material_ = entry->second;
        if (isNew) {
            charge(kMaterialBytes + kGrown * nextMaterial_->size() + file_.size(), line);
            obj_.materials.push_back(*nextMaterial_);
        }
        nextMaterial_.reset();
    }

    /// The group that an element of a glTF mode is added to. Charges the ledger for the meshes of its elements.
    Group& group(int mode) {
        if (const bool isFirst = groupMeshes_.empty(); groupMeshes_.insert({mode, material_}).second) {
            // Group, node and mesh have the group's name; several meshes also have the names of their materials.
            const std::size_t materialBytes = material_ == kNone ? 0 : obj_.materials[index(material_)].size();
            ledger_.charge(kMeshBytes + kGrown * groupName_.size() + materialBytes,
                           [&] { return fmt::format("{}: group '{}'", file_, groupName_); });
            if (isFirst) obj_.groups.push_back({groupName_, {}, {}});
        }
        return obj_.groups.back();
    }

    void readFace(const Line& line) {
        if (!readCorners(line, 3)) return;
        if (badSmoothing_) repairs_.note(file_, badSmoothing_->line, "its faces are flat", "{}", badSmoothing_->text);
        charge((corners_.size() - 2) * kTriangleBytes, line);
        cornersOfFile_ += corners_.size();
        facePositions_.clear();
        for (const Corner& corner : corners_) facePositions_.push_back(obj_.positions[index(corner.position)]);
        const std::uint64_t mostSteps = kMostSteps + kStepsACorner * cornersOfFile_;
        const std::vector<std::array<std::size_t, 3>> cut = cutPolygon(facePositions_, steps_, mostSteps);
        if (steps_ > mostSteps)
            repairs_.note(file_, line.number, "the rest is cut as if they were convex",
                          "the faces up to here take too long to cut into triangles; export the model with triangles");
        Group& group = this->group(gltf::kTriangles);
        for (const auto& [a, b, c] : cut)
            group.triangles.push_back({{corners_[a], corners_[b], corners_[c]}, material_, smoothingGroup_});
    }

    void readThin(const Line& line, int mode) {
        if (!readCorners(line, mode == kLines ? 2 : 1)) return;
        charge(corners_.size() * kThinBytes, line);
        const std::size_t each = mode == kLines ? 2 : 1;
        for (std::size_t i = 0; i + each <= corners_.size(); ++i) {
            const auto at = [&](std::size_t end) { return obj_.positions[index(corners_[end].position)]; };
            if (mode == kLines && at(i) == at(i + 1)) continue; // draws nothing
            std::vector<Corner>& thin = group(mode).thin[{mode, material_}];
            thin.insert(thin.end(), corners_.begin() + std::ptrdiff_t(i), corners_.begin() + std::ptrdiff_t(i + each));
        }
    }

    /// Draws a file that has only vertices as a point cloud.
    void addVertices() {
        for (std::size_t i = 0; i < obj_.positions.size(); ++i) {
            if (flaws_[kPosition].contains(i)) continue;
            ledger_.charge(kThinBytes, [&] { return file_ + ": its vertices as points"; });
            isUsed_[i] = true;
            group(kPoints).thin[{kPoints, material_}].push_back({int(i), kNone, kNone});
        }
        if (!obj_.groups.empty())
            repairs_.note(file_, 0, "its vertices are drawn as points",
                          "has no faces, lines or points ('f', 'l' or 'p' statements)");
    }

    static std::size_t index(int number) { return std::size_t(number); }

    void charge(std::uint64_t bytes, const Line& line) const {
        ledger_.charge(bytes, [&] { return fmt::format("{}:{}", file_, line.number); });
    }

    /// Fills corners_. Returns false, and notes it, if the element cannot be drawn.
    bool readCorners(const Line& line, std::size_t fewest) {
        hasElements_ = true;
        corners_.clear();
        const auto leaveOut = [&](const std::string& flaw) {
            repairs_.note(file_, line.number, kLeftOut, "{}", flaw);
            return false;
        };
        if (line.words.size() < fewest)
            return leaveOut(
                fmt::format("'{}' has {} of the {} corners it needs", line.keyword, line.words.size(), fewest));
        for (const std::string_view word : line.words) {
            Corner& corner = corners_.emplace_back();
            int* const members[] = {&corner.position, &corner.texCoord, &corner.normal};
            std::string_view left = word;
            for (std::size_t i = 0; i < kAttributeCount; ++i) {
                const std::string_view part = left.substr(0, left.find('/'));
                left.remove_prefix(std::min(left.size(), part.size() + 1));
                std::string flaw;
                if (!part.empty()) *members[i] = indexFromStart(part, static_cast<Attribute>(i), flaw);
                if (i == kPosition && part.empty()) flaw = fmt::format("the corner '{}' has no position", word);
                if (!flaw.empty() && i == kPosition) return leaveOut(flaw);
                if (!flaw.empty()) repairs_.note(file_, line.number, kWithoutIt, "{}", flaw);
                if (!isUsable(static_cast<Attribute>(i), *members[i])) return false;
            }
            if (!left.empty()) return leaveOut(fmt::format("the corner '{}' has more than three parts", word));
        }
        for (const Corner& corner : corners_) isUsed_[index(corner.position)] = true;
        useMaterial(line);
        return true;
    }

    /// Returns kNone, with the reason in `flaw`, if no attribute has the index.
    int indexFromStart(std::string_view part, Attribute attribute, std::string& flaw) const {
        const std::optional<long long> written = parseInteger(part);
        if (!written || *written == 0) {
            flaw = !written ? fmt::format("the index '{}' is not a whole number", part)
                            : "an index is 0; indices count from 1";
            return kNone;
        }
        const auto defined = static_cast<long long>(*written > 0 ? sizeOf(attribute) : above_[attribute]);
        const long long found = *written > 0 ? *written - 1 : defined + *written;
        if (found >= 0 && found < defined) return int(found);
        flaw = fmt::format("the {} {} is used, but {} {} defined {}", kAttributes[attribute].name, *written, defined,
                           defined == 1 ? "is" : "are", *written > 0 ? "in the file" : "above it");
        return kNone;
    }

    /// Notes the flaw of a used attribute; drops a flawed normal from its corner. Returns false for a flawed position.
    bool isUsable(Attribute attribute, int& used) {
        if (used == kNone || flaws_[attribute].empty()) return true;
        const auto flaw = flaws_[attribute].find(index(used));
        if (flaw == flaws_[attribute].end()) return true;
        if (!std::exchange(flaw->second.isNoted, true))
            repairs_.note(file_, flaw->second.line, kAttributes[attribute].repair, "{}", flaw->second.text);
        if (attribute == kNormal) used = kNone;
        return attribute != kPosition;
    }

    void readSmoothing(const Line& line) {
        const std::string_view word = line.words.empty() ? "off" : line.words.front();
        const std::optional<long long> number = parseInteger(word);
        const bool isNumber = number && *number >= 0 && *number <= 0xffffffff;
        smoothingGroup_ = word == "on" ? 1 : isNumber ? std::uint32_t(*number) : 0;
        badSmoothing_.reset();
        if (!isNumber && word != "on" && word != "off")
            badSmoothing_ = {line.number,
                             fmt::format("the smoothing group '{}' is neither a number from 0 nor on or off", word)};
    }

    /// Chooses an origin among positions far from 0, as in surveys, so that offsets from it keep their precision.
    void placeOrigin() {
        Box3 box;
        for (std::size_t i = 0; i < obj_.positions.size(); ++i)
            if (isUsed_[i]) box.extend(obj_.positions[i]);
        const auto largest = [](const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); };
        const double size = largest(box.max - box.min);
        constexpr double kFar = 16.0; // in model sizes: single precision loses 4 of its 24 bits
        if (size > 0.0 && largest(glm::max(glm::abs(box.min), glm::abs(box.max))) > kFar * size) {
            const double step = std::exp2(std::floor(std::log2(size))); // so that differences from it are exact
            obj_.origin = glm::round(0.5 * (box.min + box.max) / step) * step;
        }
    }

    const std::string file_;
    LoadLedger& ledger_;
    Repairs& repairs_;
    ObjFile obj_;
    VertexColours colours_;
    std::array<std::unordered_map<std::size_t, Flaw>, kAttributeCount>
        flaws_;                                        ///< of attributes, noted when one is used
    std::array<std::size_t, kAttributeCount> above_{}; ///< attributes above the current element
    std::vector<bool> isUsed_;                         ///< by position
    std::unordered_map<std::string, int> materialOfName_;
    // State of the next element.
    std::string groupName_;
    std::set<std::pair<int, int>> groupMeshes_; ///< modes and materials of the group's elements
    int material_ = kNone;
    std::optional<std::string> nextMaterial_; ///< named since the last element
    std::uint32_t smoothingGroup_ = 0;
    std::optional<Flaw> badSmoothing_;
    // Buffers of one element, kept for reuse.
    std::vector<Corner> corners_;
    std::vector<glm::dvec3> facePositions_;
    std::uint64_t cornersOfFile_ = 0; ///< in all faces
    std::uint64_t steps_ = 0;         ///< of triangulation
    bool hasElements_ = false;
    std::set<std::string> unknown_;
};

} // namespace

ObjFile readObj(const std::filesystem::path& file, LoadLedger& ledger, Repairs& repairs) {
    return ObjReader(file, ledger, repairs).read();
}

} // namespace tessera::scenes::obj
