#include "scenes/import/ObjText.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <unordered_map>

#include <fmt/format.h>

#include "base/Error.h"
#include "scenes/import/MtlLibrary.h"
#include "scenes/import/ObjLines.h"
#include "scenes/import/ObjPolygon.h"

namespace tessera::scenes::obj {
namespace {

/// Statements that change nothing in a triangle mesh: levels of detail, interpolation switches, ray tracing helpers.
constexpr std::array<std::string_view, 8> kWithoutEffect = {"lod", "bevel",      "c_interp",  "d_interp",
                                                            "mg",  "shadow_obj", "trace_obj", "vw"};

/// What a face's corner refers to, in the order it is written: i, i/j, i//k or i/j/k.
constexpr std::array<std::string_view, 3> kAttributes = {"position", "texture coordinate", "normal"};
constexpr std::array<std::string_view, 3> kAttributeKeywords = {"v", "vt", "vn"};

// Bytes that are charged for what the text makes, up to the scene.
/// Any corner may get a vertex of its own (position, normal, texture coordinate, colour, index), found by three
/// indices, and a smooth normal, found by position and group. One of the vertices' vectors grows at a time.
constexpr std::size_t kVertexBytes =
    2 * sizeof(glm::vec3) + sizeof(glm::vec2) + sizeof(glm::vec4) + sizeof(std::uint32_t);
constexpr std::size_t kCornerBytes = kRoom * kVertexBytes + sizeof(glm::vec4) + kNodeBytes<std::array<std::size_t, 3>> +
                                     sizeof(glm::vec3) + kNodeBytes<std::array<std::size_t, 2>>;
constexpr std::size_t kTriangleBytes = kGrown * sizeof(Triangle) + 3 * kCornerBytes;
/// A position may have a colour; a normal is brought to unit length in a list of its own.
constexpr std::size_t kAttributeBytes = kGrown * 2 * sizeof(glm::vec3);
/// A name that usemtl gives becomes a material of the libraries, or a warning, and one of the scene.
constexpr std::size_t kMaterialBytes = kGrown * (sizeof(MtlMaterial) + sizeof(Material) + 4 * sizeof(std::string));
/// A material of a group becomes a mesh, the group a node. Where a group has many, their builders are in the place of
/// groups and nodes.
constexpr std::size_t kMeshBytes = kGrown * (sizeof(Group) + sizeof(Mesh) + sizeof(Node) + sizeof(MeshInstance));

/// Corners that are looked at to cut all polygons of a file: a second or so.
constexpr std::uint64_t kMostSteps = 500'000'000;
/// Beside them, each corner of the file is granted so many: quads take fewer.
constexpr std::uint64_t kStepsACorner = 16;

class ObjReader {
public:
    ObjReader(const std::filesystem::path& file, LoadLedger& ledger) : file_(file), ledger_(ledger) {}

    ObjFile read() {
        const std::string text = readText(file_, ledger_);
        // A face may stand before its vertices.
        forEachLine(text, [&](const Line& line) { readAttribute(line); });
        if (obj_.colors.size() != obj_.positionsOS.size()) obj_.colors.clear();
        forEachLine(text, [&](const Line& line) { readElement(line); });
        if (obj_.groups.empty())
            throw InputError(fmt::format(
                "{}: has no face of three corners or more ('f' statements); export the model with its polygons",
                file_.string()));
        addWarnings();
        return std::move(obj_);
    }

private:
    void readAttribute(const Line& line) {
        if (std::ranges::find(kAttributeKeywords, line.keyword) == kAttributeKeywords.end()) return;
        const std::size_t needed = line.keyword == "vt" ? 1 : 3;
        if (line.words.size() < needed)
            failAt(file_, line.number,
                   fmt::format("'{}' has {} of the {} numbers it needs", line.keyword, line.words.size(), needed));
        charge(kAttributeBytes, line);
        std::array<float, 6> numbers{}; // x y z r g b, or u v
        for (std::size_t i = 0; i < line.words.size(); ++i) {
            const float number = finiteNumber(file_, line, line.words[i]);
            if (i < numbers.size()) numbers[i] = number;
        }
        if (line.keyword == "vt") {
            obj_.texCoords.emplace_back(numbers[0], numbers[1]);
        } else if (line.keyword == "vn") {
            obj_.normalsOS.emplace_back(numbers[0], numbers[1], numbers[2]);
        } else {
            obj_.positionsOS.emplace_back(numbers[0], numbers[1], numbers[2]);
            if (line.words.size() >= numbers.size()) obj_.colors.emplace_back(numbers[3], numbers[4], numbers[5]);
        }
    }

    void readElement(const Line& line) {
        const std::string_view keyword = line.keyword;
        if (const auto found = std::ranges::find(kAttributeKeywords, keyword); found != kAttributeKeywords.end()) {
            ++read_[static_cast<std::size_t>(found - kAttributeKeywords.begin())];
        } else if (keyword == "f") {
            readFace(line);
        } else if (keyword == "g") {
            beginGroup(fmt::to_string(fmt::join(line.words, " "))); // several names are one
        } else if (keyword == "o") {
            beginGroup(std::string(line.rest));
        } else if (keyword == "s") {
            readSmoothing(line);
        } else if (keyword == "usemtl") {
            useMaterial(line);
        } else if (keyword == "mtllib") {
            charge(keptTextBytes(line.rest), line);
            obj_.libraries.emplace_back(line.rest);
        } else if (keyword == "l" || keyword == "p") {
            ++linesAndPoints_;
        } else if (std::ranges::find(kWithoutEffect, keyword) == kWithoutEffect.end()) {
            if (unknown_.emplace(keyword).second) charge(keptTextBytes(keyword), line);
        }
    }

    void beginGroup(std::string name) {
        groupName_ = std::move(name);
        groupMaterials_.clear();
    }

    void useMaterial(const Line& line) {
        const auto [entry, isNew] =
            materialOfName_.try_emplace(std::string(line.rest), static_cast<int>(obj_.materials.size()));
        material_ = entry->second;
        if (!isNew) return;
        charge(kMaterialBytes + kGrown * line.rest.size() + file_.native().size(), line);
        obj_.materials.emplace_back(line.rest);
    }

    void readFace(const Line& line) {
        if (line.words.size() < 3) {
            if (++degenerateFaces_ == 1) firstDegenerateLine_ = line.number;
            return;
        }
        constexpr std::size_t kMostCorners = 1024;
        if (line.words.size() > kMostCorners)
            failAt(file_, line.number,
                   fmt::format("the face has {} corners, more than {}; cut it into smaller polygons", line.words.size(),
                               kMostCorners));
        corners_ += line.words.size();
        if (const bool isFirst = groupMaterials_.empty(); groupMaterials_.insert(material_).second) {
            // Group, node and mesh have the group's name, and one of several meshes that of the material too.
            const std::size_t materialBytes = material_ == kNone ? 0 : obj_.materials[index(material_)].size();
            charge(kMeshBytes + kGrown * groupName_.size() + materialBytes, line);
            if (isFirst) obj_.groups.push_back({groupName_, {}});
        }
        charge((line.words.size() - 2) * kTriangleBytes, line);
        faceCorners_.clear();
        facePositionsOS_.clear();
        for (const std::string_view word : line.words) {
            faceCorners_.push_back(readCorner(line, word));
            facePositionsOS_.emplace_back(obj_.positionsOS[index(faceCorners_.back().position)]);
        }
        const std::vector<std::array<std::size_t, 3>> triangles = cutPolygon(facePositionsOS_, steps_);
        if (steps_ > kMostSteps + kStepsACorner * corners_)
            failAt(file_, line.number,
                   "the faces up to here take too long to cut into triangles; export the model with triangles");
        for (const auto& [a, b, c] : triangles)
            obj_.groups.back().triangles.push_back(
                {{faceCorners_[a], faceCorners_[b], faceCorners_[c]}, material_, smoothingGroup_});
    }

    static std::size_t index(int number) { return static_cast<std::size_t>(number); }

    void charge(std::uint64_t bytes, const Line& line) const {
        ledger_.charge(bytes, [&] { return fmt::format("{}:{}", file_.string(), line.number); });
    }

    Corner readCorner(const Line& line, std::string_view word) const {
        std::array<int, 3> indices{kNone, kNone, kNone}; // in the order of kAttributes
        std::string_view left = word;
        for (std::size_t i = 0; i < indices.size(); ++i) {
            const std::size_t slash = std::min(left.find('/'), left.size());
            const std::string_view part = left.substr(0, slash);
            if (!part.empty()) indices[i] = indexFromStart(line, part, i);
            left.remove_prefix(slash);
            if (left.empty()) break;
            left.remove_prefix(1);
            if (i + 1 == indices.size() || word.back() == '/')
                failAt(file_, line.number,
                       fmt::format("the face's corner '{}' is not of the form v, v/vt, v//vn or "
                                   "v/vt/vn",
                                   word));
        }
        if (indices[0] == kNone)
            failAt(file_, line.number, fmt::format("the face's corner '{}' has no position", word));
        return {indices[0], indices[1], indices[2]};
    }

    int indexFromStart(const Line& line, std::string_view part, std::size_t attribute) const {
        const std::optional<long long> written = parseInteger(part);
        if (!written) failAt(file_, line.number, fmt::format("the face's index '{}' is not a whole number", part));
        if (*written == 0) failAt(file_, line.number, "a face's index is 0; indices count from 1");
        const std::size_t inFile[] = {obj_.positionsOS.size(), obj_.texCoords.size(), obj_.normalsOS.size()};
        const long long defined = static_cast<long long>(*written > 0 ? inFile[attribute] : read_[attribute]);
        const long long found = *written > 0 ? *written - 1 : defined + *written;
        if (found < 0 || found >= defined)
            failAt(file_, line.number,
                   fmt::format("the face refers to {} {}, but {} {} defined {}", kAttributes[attribute], *written,
                               defined, defined == 1 ? "is" : "are", *written > 0 ? "in the file" : "above it"));
        return static_cast<int>(found);
    }

    void readSmoothing(const Line& line) {
        const std::string_view word = line.words.empty() ? "off" : line.words.front();
        smoothingGroup_ = word == "on" ? 1 : 0;
        if (word == "on" || word == "off") return;
        const std::optional<long long> number = parseInteger(word);
        if (!number || *number < 0 || *number > 0x7fffffff)
            failAt(file_, line.number,
                   fmt::format("the smoothing group '{}' is neither a number from 0 nor on or off", word));
        smoothingGroup_ = static_cast<std::uint32_t>(*number);
    }

    void addWarnings() {
        const auto warn = [&](const std::string& what) {
            obj_.warnings.push_back(fmt::format("{}: {}", file_.string(), what));
        };
        if (degenerateFaces_ > 0)
            warn(fmt::format("{} face(s) with fewer than three corners are left out, the first at line {}",
                             degenerateFaces_, firstDegenerateLine_));
        if (linesAndPoints_ > 0)
            warn(fmt::format("{} line and point element(s) are left out; only faces are drawn", linesAndPoints_));
        if (!unknown_.empty())
            warn(fmt::format("statements that are not supported are left out: {}", fmt::join(unknown_, ", ")));
    }

    const std::filesystem::path& file_;
    LoadLedger& ledger_;
    ObjFile obj_;
    std::array<std::size_t, 3> read_{}; ///< attributes above the element being read, in the order of kAttributes
    std::unordered_map<std::string, int> materialOfName_;
    // What the next face belongs to.
    std::string groupName_;
    std::set<int> groupMaterials_; ///< that faces of the group have
    int material_ = kNone;
    std::uint32_t smoothingGroup_ = 0;
    // One face's, kept for their memory.
    std::vector<Corner> faceCorners_;
    std::vector<glm::dvec3> facePositionsOS_;
    std::size_t corners_ = 0; ///< of all faces
    std::uint64_t steps_ = 0; ///< of cutting polygons
    std::size_t degenerateFaces_ = 0;
    int firstDegenerateLine_ = 0;
    std::size_t linesAndPoints_ = 0;
    std::set<std::string> unknown_;
};

} // namespace

ObjFile readObj(const std::filesystem::path& file, LoadLedger& ledger) {
    return ObjReader(file, ledger).read();
}

} // namespace tessera::scenes::obj
