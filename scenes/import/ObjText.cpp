#include "scenes/import/ObjText.h"

#include <algorithm>
#include <array>
#include <iterator>
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

// Three copies of the text are made, and vectors that double hold their elements three times while they are copied.
constexpr std::size_t kCopies = 3;
/// A triangle makes three words of text, tinyobjloader's corners, and vertices with their entries in the table of
/// shared ones.
constexpr std::size_t kTriangleBytes = kCopies * 3 * 24 + 3 * 96 + 3 * (52 + 64);
/// An attribute makes text and numbers.
constexpr std::size_t kAttributeBytes = kCopies * 40 + 64;
/// A name that usemtl gives makes the parser's material, the library's and the scene's.
constexpr std::size_t kMaterialBytes = 2 * (sizeof(tinyobj::material_t) + sizeof(MtlMaterial) + sizeof(Material));
/// A material of a group makes a mesh, and may be the only one: then with the parser's shape and a node.
constexpr std::size_t kMeshBytes = kCopies * (sizeof(tinyobj::shape_t) + sizeof(Mesh) + sizeof(Node));

/// Corners that are looked at to cut all polygons of a file: a second or so.
constexpr std::uint64_t kMostSteps = 500'000'000;
/// Beside them, each corner of the file is granted so many: quads take fewer.
constexpr std::uint64_t kStepsACorner = 16;

class ObjChecker {
public:
    ObjChecker(std::string_view text, const std::filesystem::path& file, LoadLedger& ledger)
        : source_(text), file_(file), ledger_(ledger) {}

    CheckedText check() {
        forEachLine(source_, [&](const Line& line) { readAttribute(line); });
        defined_ = read_;
        read_ = {};
        forEachLine(source_, [&](const Line& line) { readElement(line); });
        if (faces_ == 0)
            throw InputError(
                fmt::format("{}: has no faces ('f' statements); export the model with its polygons", file_.string()));
        addWarnings();
        checked_.text = std::move(attributes_);
        checked_.text += elements_;
        return std::move(checked_);
    }

private:
    void readAttribute(const Line& line) {
        const auto found = std::ranges::find(kAttributeKeywords, line.keyword);
        if (found == kAttributeKeywords.end()) return;
        ++read_[static_cast<std::size_t>(found - kAttributeKeywords.begin())];
        const std::size_t needed = line.keyword == "vt" ? 1 : 3;
        if (line.words.size() < needed)
            failAt(file_, line.number,
                   fmt::format("'{}' has {} of the {} numbers it needs", line.keyword, line.words.size(), needed));
        charge(kAttributeBytes, line);
        attributes_ += line.keyword;
        glm::dvec3 first(0.0);
        glm::length_t count = 0;
        for (const std::string_view word : line.words) {
            const float value = finiteNumber(file_, line, word);
            fmt::format_to(std::back_inserter(attributes_), " {}", value);
            if (count < 3) first[count++] = static_cast<double>(value);
        }
        attributes_ += '\n';
        if (line.keyword == "v") positionsOS_.push_back(first);
    }

    void readElement(const Line& line) {
        const std::string_view keyword = line.keyword;
        if (const auto found = std::ranges::find(kAttributeKeywords, keyword); found != kAttributeKeywords.end()) {
            ++read_[static_cast<std::size_t>(found - kAttributeKeywords.begin())];
        } else if (keyword == "f") {
            readFace(line);
        } else if (keyword == "g" || keyword == "o") {
            charge(kCopies * (line.rest.size() + 3), line);
            groupNameBytes_ = line.rest.size();
            groupMaterials_.clear();
            elements_.append(keyword).append(" ").append(line.rest).append("\n");
        } else if (keyword == "s") {
            readSmoothing(line);
        } else if (keyword == "usemtl") {
            const auto [number, isNew] = materialNumbers_.try_emplace(std::string(line.rest), materialNumbers_.size());
            material_ = number->second;
            fmt::format_to(std::back_inserter(elements_), "usemtl {}\n", number->second);
            if (isNew) {
                charge(kMaterialBytes, line);
                checked_.materials.emplace_back(line.rest);
            }
        } else if (keyword == "mtllib") {
            checked_.libraries.emplace_back(line.rest);
        } else if (keyword == "l" || keyword == "p") {
            ++linesAndPoints_;
        } else if (std::ranges::find(kWithoutEffect, keyword) == kWithoutEffect.end()) {
            unknown_.emplace(keyword);
        }
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
        ++faces_;
        corners_ += line.words.size();
        // The group's name is that of its node and of each mesh.
        if (groupMaterials_.insert(material_).second) charge(kMeshBytes + kCopies * groupNameBytes_, line);
        charge((line.words.size() - 2) * kTriangleBytes, line);
        std::vector<std::array<std::size_t, 3>> corners;
        std::vector<glm::dvec3> positionsOS;
        for (const std::string_view word : line.words) {
            corners.push_back(readCorner(line, word));
            positionsOS.push_back(positionsOS_[corners.back()[0] - 1]);
        }
        const std::vector<std::array<std::size_t, 3>> triangles = cutPolygon(positionsOS, steps_);
        if (steps_ > kMostSteps + kStepsACorner * corners_)
            failAt(file_, line.number,
                   "the faces up to here take too long to cut into triangles; export the model with triangles");
        for (const std::array<std::size_t, 3>& triangle : triangles) {
            elements_ += 'f';
            for (const std::size_t corner : triangle) appendCorner(corners[corner]);
            elements_ += '\n';
        }
    }

    void charge(std::uint64_t bytes, const Line& line) const {
        ledger_.charge(bytes, [&] { return fmt::format("{}:{}", file_.string(), line.number); });
    }

    void appendCorner(const std::array<std::size_t, 3>& index) {
        fmt::format_to(std::back_inserter(elements_), " {}", index[0]);
        if (index[1] != 0 || index[2] != 0) elements_ += '/';
        if (index[1] != 0) fmt::format_to(std::back_inserter(elements_), "{}", index[1]);
        if (index[2] != 0) fmt::format_to(std::back_inserter(elements_), "/{}", index[2]);
    }

    /// Indices in the order of kAttributes, from 1; 0 is absent.
    std::array<std::size_t, 3> readCorner(const Line& line, std::string_view word) {
        std::array<std::size_t, 3> index{};
        std::string_view left = word;
        for (std::size_t i = 0; i < index.size(); ++i) {
            const std::size_t slash = std::min(left.find('/'), left.size());
            const std::string_view part = left.substr(0, slash);
            if (!part.empty()) index[i] = absoluteIndex(line, part, i);
            left.remove_prefix(slash);
            if (left.empty()) break;
            left.remove_prefix(1);
            if (i + 1 == index.size() || word.back() == '/')
                failAt(file_, line.number,
                       fmt::format("the face's corner '{}' is not of the form v, v/vt, v//vn or "
                                   "v/vt/vn",
                                   word));
        }
        if (index[0] == 0) failAt(file_, line.number, fmt::format("the face's corner '{}' has no position", word));
        return index;
    }

    std::size_t absoluteIndex(const Line& line, std::string_view part, std::size_t attribute) {
        const std::optional<long long> written = parseInteger(part);
        if (!written) failAt(file_, line.number, fmt::format("the face's index '{}' is not a whole number", part));
        if (*written == 0) failAt(file_, line.number, "a face's index is 0; indices count from 1");
        const long long defined = static_cast<long long>(defined_[attribute]);
        const long long before = static_cast<long long>(read_[attribute]);
        const long long index = *written > 0 ? *written : before + 1 + *written;
        if (*written > 0 ? index > defined : index < 1)
            failAt(file_, line.number,
                   fmt::format("the face refers to {} {}, but {} {} defined {}", kAttributes[attribute], *written,
                               *written > 0 ? defined : before, (*written > 0 ? defined : before) == 1 ? "is" : "are",
                               *written > 0 ? "in the file" : "above it"));
        return static_cast<std::size_t>(index);
    }

    void readSmoothing(const Line& line) {
        const std::string_view word = line.words.empty() ? "off" : line.words.front();
        long long group = word == "on" ? 1 : 0;
        if (word != "on" && word != "off") {
            const std::optional<long long> number = parseInteger(word);
            if (!number || *number < 0 || *number > 0x7fffffff)
                failAt(file_, line.number,
                       fmt::format("the smoothing group '{}' is neither a number from 0 nor on or off", word));
            group = *number;
        }
        fmt::format_to(std::back_inserter(elements_), "s {}\n", group);
    }

    void addWarnings() {
        const auto warn = [&](const std::string& what) {
            checked_.warnings.push_back(fmt::format("{}: {}", file_.string(), what));
        };
        if (degenerateFaces_ > 0)
            warn(fmt::format("{} face(s) with fewer than three corners are left out, the first at line {}",
                             degenerateFaces_, firstDegenerateLine_));
        if (linesAndPoints_ > 0)
            warn(fmt::format("{} line and point element(s) are left out; only faces are drawn", linesAndPoints_));
        if (!unknown_.empty())
            warn(fmt::format("statements that are not supported are left out: {}", fmt::join(unknown_, ", ")));
    }

    std::string_view source_;
    const std::filesystem::path& file_;
    LoadLedger& ledger_;
    CheckedText checked_;
    std::vector<glm::dvec3> positionsOS_;
    std::string attributes_;
    std::string elements_;
    std::array<std::size_t, 3> read_{};    ///< attributes read so far, in the order of kAttributes
    std::array<std::size_t, 3> defined_{}; ///< in the whole file
    std::unordered_map<std::string, std::size_t> materialNumbers_;
    std::size_t groupNameBytes_ = 0;                      ///< of the group that faces belong to
    std::optional<std::size_t> material_;                 ///< in use
    std::set<std::optional<std::size_t>> groupMaterials_; ///< that faces of the group have
    std::size_t faces_ = 0, corners_ = 0;
    std::uint64_t steps_ = 0; ///< of cutting polygons
    std::size_t degenerateFaces_ = 0;
    int firstDegenerateLine_ = 0;
    std::size_t linesAndPoints_ = 0;
    std::set<std::string> unknown_;
};

} // namespace

CheckedText checkText(std::string_view text, const std::filesystem::path& file, LoadLedger& ledger) {
    return ObjChecker(text, file, ledger).check();
}

} // namespace tessera::scenes::obj
