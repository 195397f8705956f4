#include "scenes/import/MtlLibrary.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <map>
#include <set>
#include <system_error>
#include <variant>

#include <fmt/format.h>

#include "scenes/import/ObjLines.h"

namespace tessera::scenes::obj {
namespace {

enum class NumberRange { NotNegative, Share, WholeNumber };

struct NumberValue {
    std::optional<float> MtlMaterial::*member;
    NumberRange range;
};
using ColourValue = std::optional<glm::vec3> MtlMaterial::*;
using PictureValue = std::optional<MtlPicture> MtlMaterial::*;
using WithoutEffect = std::monostate;

struct Keyword {
    const char* name; ///< in MTL's spelling
    std::variant<ColourValue, NumberValue, PictureValue, WithoutEffect> value;
};

/// After the MTL specification (Wavefront, "Advanced Visualizer Manual", appendix B2) and its PBR extension
/// (Exocortex 2015, "Extending Wavefront MTL for physically-based rendering"). Ambient light and what only bends
/// rays have no counterpart in direct lighting.
constexpr Keyword kKeywords[] = {
    {"Kd", &MtlMaterial::diffuse},
    {"Ks", &MtlMaterial::specular},
    {"Ke", &MtlMaterial::emission},
    {"Ns", NumberValue{&MtlMaterial::exponent, NumberRange::NotNegative}},
    {"Ni", NumberValue{&MtlMaterial::ior, NumberRange::NotNegative}},
    {"d", NumberValue{&MtlMaterial::opacity, NumberRange::Share}},
    {"Tr", NumberValue{&MtlMaterial::transparency, NumberRange::Share}},
    {"Pr", NumberValue{&MtlMaterial::perceptualRoughness, NumberRange::Share}},
    {"Pm", NumberValue{&MtlMaterial::metalness, NumberRange::Share}},
    {"illum", NumberValue{&MtlMaterial::illumination, NumberRange::WholeNumber}},
    {"map_Kd", &MtlMaterial::diffusePicture},
    {"map_Ks", &MtlMaterial::specularPicture},
    {"map_Ke", &MtlMaterial::emissionPicture},
    {"map_d", &MtlMaterial::opacityPicture},
    {"map_Pr", &MtlMaterial::roughnessPicture},
    {"map_Pm", &MtlMaterial::metalnessPicture},
    {"norm", &MtlMaterial::normalPicture},
    {"map_bump", &MtlMaterial::bumpPicture},
    {"bump", &MtlMaterial::bumpPicture},
    {"Ka", WithoutEffect()},
    {"map_Ka", WithoutEffect()},
    {"Tf", WithoutEffect()},
    {"Kt", WithoutEffect()},
    {"sharpness", WithoutEffect()},
};

/// Those that readPicture() takes over, and others that only warn.
struct TextureOption {
    std::string_view name;
    std::size_t mostNumbers; ///< 0: one word that is no number
};
constexpr TextureOption kTextureOptions[] = {
    {"-o", 3},      {"-s", 3},      {"-clamp", 0}, {"-bm", 1},      {"-t", 3},      {"-mm", 2},         {"-boost", 1},
    {"-blendu", 0}, {"-blendv", 0}, {"-cc", 0},    {"-imfchan", 0}, {"-texres", 0}, {"-colorspace", 0}, {"-type", 0},
};

bool equalsIgnoringCase(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b,
                              [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// Reads one MTL file, in its order.
class MtlReader {
public:
    MtlReader(const std::filesystem::path& file, std::vector<std::string>& warnings, LoadLedger& ledger)
        : file_(file), warnings_(warnings), ledger_(ledger) {}

    std::vector<MtlMaterial> read() {
        forEachLine(readText(file_, ledger_), [&](const Line& line) { readLine(line); });
        const auto warn = [&](const char* what, const std::set<std::string>& which) {
            if (!which.empty())
                warnings_.push_back(fmt::format("{}: {}: {}", file_.string(), what, fmt::join(which, ", ")));
        };
        warn("statements that are not supported are left out", unknown_);
        warn("texture options that are not supported are left out", unusedOptions_);
        return std::move(materials_);
    }

private:
    void readLine(const Line& line) {
        if (line.keyword == "newmtl") {
            beginMaterial(line);
            return;
        }
        const auto keyword = std::ranges::find_if(
            kKeywords, [&](const Keyword& known) { return equalsIgnoringCase(known.name, line.keyword); });
        if (keyword == std::end(kKeywords)) {
            if (unknown_.emplace(line.keyword).second) charge(keptTextBytes(line.keyword), line);
            return;
        }
        if (std::holds_alternative<WithoutEffect>(keyword->value)) return;
        if (materials_.empty())
            failAt(file_, line.number, fmt::format("'{}' stands before the first newmtl", line.keyword));
        if (line.words.empty()) failAt(file_, line.number, fmt::format("'{}' gives no value", line.keyword));
        if (const PictureValue* picture = std::get_if<PictureValue>(&keyword->value))
            readPicture(line, keyword->name, materials_.back().*(*picture));
        else if (line.words.front() == "spectral" || line.words.front() == "xyz")
            unknown_.insert(fmt::format("{} {}", keyword->name, line.words.front()));
        else
            readNumbers(line, *keyword);
    }

    void beginMaterial(const Line& line) {
        if (line.rest.empty()) failAt(file_, line.number, "'newmtl' gives no name");
        // In the file's list, and after that among those of all files.
        constexpr std::size_t kBytes = kGrown * sizeof(MtlMaterial) + kNodeBytes<MtlMaterial>;
        charge(kBytes + keptTextBytes(file_.native()) + keptTextBytes(line.rest), line);
        materials_.emplace_back();
        materials_.back().name = line.rest;
        materials_.back().file = file_.string();
    }

    void readNumbers(const Line& line, const Keyword& keyword) {
        std::vector<std::string_view> words = line.words;
        if (words.front() == "-halo") words.erase(words.begin()); // opacity that falls off at the silhouette
        const NumberValue* number = std::get_if<NumberValue>(&keyword.value);
        if (words.empty() || (number == nullptr && words.size() == 2))
            failAt(file_, line.number,
                   fmt::format("'{}' needs {}", keyword.name, number == nullptr ? "3 numbers" : "a number"));
        MtlMaterial& material = materials_.back();
        if (number != nullptr) {
            material.*(number->member) = readNumber(line, keyword.name, words[0], number->range);
            return;
        }
        words.resize(std::max<std::size_t>(words.size(), 3), words.front()); // green and blue default to red
        glm::vec3 colour;
        for (glm::length_t i = 0; i < 3; ++i)
            colour[i] = readNumber(line, keyword.name, words[static_cast<std::size_t>(i)], NumberRange::NotNegative);
        material.*std::get<ColourValue>(keyword.value) = colour;
    }

    float readNumber(const Line& line, const char* keyword, std::string_view word, NumberRange range) {
        const float value = finiteNumber(file_, line, word);
        if (value < 0.0f || (range == NumberRange::Share && value > 1.0f))
            failAt(file_, line.number,
                   fmt::format("'{}' is {}; it must {}", keyword, word,
                               range == NumberRange::Share ? "lie between 0 and 1" : "not be negative"));
        if (range == NumberRange::WholeNumber && !parseInteger(word))
            failAt(file_, line.number, fmt::format("'{}' is {}; it must be a whole number", keyword, word));
        return value;
    }

    /// keyword -option values ... file name up to the line's end. Options of an earlier statement of the material that
    /// this one does not give stay.
    void readPicture(const Line& line, const char* keyword, std::optional<MtlPicture>& stated) {
        MtlPicture picture = stated.value_or(MtlPicture{});
        std::size_t word = 0;
        while (word < line.words.size() && line.words[word].starts_with('-')) {
            const auto option = std::ranges::find(kTextureOptions, line.words[word], &TextureOption::name);
            if (option == std::end(kTextureOptions))
                failAt(file_, line.number, fmt::format("'{}' has the unknown option '{}'", keyword, line.words[word]));
            ++word;
            if (option->name == "-o") {
                picture.offset = glm::vec2(takeNumbers(line, *option, word, 0.0f));
            } else if (option->name == "-s") {
                picture.scale = glm::vec2(takeNumbers(line, *option, word, 1.0f));
            } else if (option->name == "-bm") {
                picture.bumpMultiplier = takeNumbers(line, *option, word, 1.0f).x;
            } else if (option->name == "-clamp") {
                picture.clamp = !takeWord(line, word).starts_with("off");
            } else {
                unusedOptions_.emplace(option->name);
                if (option->mostNumbers == 0)
                    takeWord(line, word);
                else
                    takeNumbers(line, *option, word, 0.0f);
            }
        }
        if (word >= line.words.size()) failAt(file_, line.number, fmt::format("'{}' names no picture", keyword));
        const std::size_t nameStart = static_cast<std::size_t>(line.words[word].data() - line.rest.data());
        picture.keyword = keyword;
        picture.name = line.rest.substr(nameStart);
        stated = std::move(picture);
    }

    std::string_view takeWord(const Line& line, std::size_t& word) const {
        return word < line.words.size() ? line.words[word++] : std::string_view();
    }

    /// The numbers that follow the option, as many as it may have.
    glm::vec3 takeNumbers(const Line& line, const TextureOption& option, std::size_t& word, float missing) const {
        glm::vec3 numbers(missing);
        std::size_t count = 0;
        while (count < option.mostNumbers && word < line.words.size() && parseNumber(line.words[word]))
            numbers[static_cast<glm::length_t>(count++)] = finiteNumber(file_, line, line.words[word++]);
        if (count == 0) failAt(file_, line.number, fmt::format("the option '{}' needs a number", option.name));
        return numbers;
    }

    void charge(std::uint64_t bytes, const Line& line) const {
        ledger_.charge(bytes, [&] { return fmt::format("{}:{}", file_.string(), line.number); });
    }

    const std::filesystem::path& file_;
    std::vector<std::string>& warnings_;
    LoadLedger& ledger_;
    std::vector<MtlMaterial> materials_;
    std::set<std::string> unknown_;
    std::set<std::string> unusedOptions_;
};

bool isFile(const std::filesystem::path& path) {
    std::error_code failure;
    return std::filesystem::is_regular_file(path, failure);
}

/// The files an mtllib statement names: one name that may hold spaces, or several without.
std::vector<std::string> fileNamesOf(const std::string& statement, const std::filesystem::path& folder) {
    if (isFile(folder / statement)) return {statement};
    std::vector<std::string> names;
    forEachLine("mtllib " + statement, [&](const Line& line) { names.assign(line.words.begin(), line.words.end()); });
    // If there is no file of that name, a message should show the whole statement.
    const bool someExist = std::ranges::any_of(names, [&](const std::string& name) { return isFile(folder / name); });
    return someExist ? names : std::vector<std::string>{statement};
}

} // namespace

std::vector<MtlMaterial> findMaterials(const std::vector<std::string>& names, const std::vector<std::string>& libraries,
                                       const std::filesystem::path& objFile, std::vector<std::string>& warnings,
                                       LoadLedger& ledger) {
    std::map<std::string, MtlMaterial> defined;
    std::set<std::string> visited;
    for (const std::string& statement : libraries) {
        for (const std::string& name : fileNamesOf(statement, objFile.parent_path())) {
            if (!visited.insert(name).second) continue;
            const std::filesystem::path file = objFile.parent_path() / name;
            if (!isFile(file)) {
                warnings.push_back(fmt::format("{}: its material library '{}' is missing; default materials are used",
                                               objFile.string(), name));
                continue;
            }
            for (MtlMaterial& material : MtlReader(file, warnings, ledger).read())
                defined.emplace(material.name, std::move(material));
        }
    }
    std::vector<MtlMaterial> found;
    for (const std::string& name : names) {
        if (const auto material = defined.find(name); material != defined.end()) {
            found.push_back(std::move(material->second));
            continue;
        }
        warnings.push_back(fmt::format("{}: no material library defines '{}'; a default material of that name is used",
                                       objFile.string(), name));
        MtlMaterial undefined;
        undefined.name = name;
        found.push_back(std::move(undefined));
    }
    return found;
}

} // namespace tessera::scenes::obj
