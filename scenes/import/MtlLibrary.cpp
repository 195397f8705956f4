#include "scenes/import/ObjMaterials.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <limits>
#include <sstream>
#include <system_error>
#include <variant>

#include "base/Lowercase.h"
#include "scenes/Material.h"
#include "scenes/import/Files.h"
#include "scenes/import/ObjLines.h"

namespace tessera::scenes::obj {
namespace {

/// Below kMostEmission, and exact in single precision.
constexpr double kMostGlow = 0x1p99;

/// Numbers from 0 to `most`.
struct NumberValue {
    std::optional<float> MtlMaterial::*member;
    double most = 1.0;
};
struct ColourValue {
    std::optional<glm::vec3> MtlMaterial::*member;
    double most = kMostColor;
};
using PictureValue = std::optional<MtlPicture> MtlMaterial::*;
using WithoutEffect = std::monostate;

struct Keyword {
    const char* name; ///< in MTL's spelling
    std::variant<ColourValue, NumberValue, PictureValue, WithoutEffect> value;
};

/// After the MTL specification (Wavefront, "Advanced Visualizer Manual", appendix B2) and its PBR extension (Exocortex
/// 2015, "Extending Wavefront MTL for physically-based rendering"). Ambient light, transmission filters and reflection
/// sharpness have no counterpart in direct lighting.
constexpr Keyword kKeywords[] = {
    {"Kd", ColourValue{&MtlMaterial::diffuse}},
    {"Ks", ColourValue{&MtlMaterial::specular, 1.0}},
    {"Ke", ColourValue{&MtlMaterial::emission, kMostGlow}},
    {"Ns", NumberValue{&MtlMaterial::exponent, std::numeric_limits<float>::max()}},
    {"Ni", NumberValue{&MtlMaterial::ior, kMostIor}},
    {"d", NumberValue{&MtlMaterial::opacity}},
    {"Tr", NumberValue{&MtlMaterial::transparency}},
    {"Pr", NumberValue{&MtlMaterial::perceptualRoughness}},
    {"Pm", NumberValue{&MtlMaterial::metalness}},
    {"illum", NumberValue{&MtlMaterial::illumination, 10.0}},
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

/// Texture options that takeOptions() applies, and others that are left out.
struct TextureOption {
    std::string_view name;
    std::size_t mostNumbers; ///< 0: one word that is no number
};
constexpr TextureOption kTextureOptions[] = {
    {"-o", 3},      {"-s", 3},      {"-clamp", 0}, {"-bm", 1},      {"-t", 3},      {"-mm", 2},         {"-boost", 1},
    {"-blendu", 0}, {"-blendv", 0}, {"-cc", 0},    {"-imfchan", 0}, {"-texres", 0}, {"-colorspace", 0}, {"-type", 0},
};

constexpr std::string_view kStatementLeftOut = "the statement is left out";

/// Reads one MTL file in order.
class MtlReader {
public:
    MtlReader(const std::filesystem::path& file, Repairs& repairs, LoadLedger& ledger)
        : folder_(file.parent_path()), file_(file.string()), repairs_(repairs), ledger_(ledger) {}

    std::vector<MtlMaterial> read(const std::string& text) {
        forEachLine(text, [&](const Line& line) { readLine(line); });
        return std::move(materials_);
    }

private:
    void readLine(const Line& line) {
        if (isSameWord(line.keyword, "newmtl")) {
            beginMaterial(line);
            return;
        }
        const auto keyword =
            std::ranges::find_if(kKeywords, [&](const Keyword& known) { return isSameWord(known.name, line.keyword); });
        const bool isKnown = keyword != std::end(kKeywords);
        if (isKnown && std::holds_alternative<WithoutEffect>(keyword->value)) return;
        if (materials_.empty())
            repairs_.note(file_, line.number, kStatementLeftOut, "'{}' stands before the first newmtl", line.keyword);
        else if (!isKnown)
            addUnsupported(line, std::string(line.keyword));
        else if (const PictureValue* picture = std::get_if<PictureValue>(&keyword->value))
            readPicture(line, keyword->name, materials_.back().*(*picture));
        else if (!line.words.empty() && (line.words.front() == "spectral" || line.words.front() == "xyz"))
            addUnsupported(line, fmt::format("{} {}", keyword->name, line.words.front()));
        else
            readNumbers(line, *keyword);
    }

    void beginMaterial(const Line& line) {
        // In the file's list, then in the list of all files, indexed by one or two names.
        constexpr std::size_t kBytes = kGrown * sizeof(MtlMaterial) + 2 * kNodeBytes<std::string>;
        charge(kBytes + keptTextBytes(file_) + 2 * keptTextBytes(line.rest), line);
        materials_.emplace_back();
        materials_.back().name = line.rest;
        materials_.back().file = file_;
        materials_.back().line = line.number;
        if (line.rest.empty()) addFlaw(line, "'newmtl' gives no name", "it is drawn where 'usemtl' gives none either");
    }

    void addUnsupported(const Line& line, const std::string& what) {
        if (materials_.back().unsupported.insert(what).second) charge(keptTextBytes(what), line);
    }

    void addFlaw(const Line& line, std::string text, std::string_view repair) {
        charge(kGrown * sizeof(MtlFlaw) + kRoom * text.size(), line);
        materials_.back().flaws.push_back({line.number, std::move(text), repair});
    }

    void readNumbers(const Line& line, const Keyword& keyword) {
        std::vector<std::string_view> words = line.words;
        if (!words.empty() && words.front() == "-halo") words.erase(words.begin()); // fades opacity at the silhouette
        const auto* number = std::get_if<NumberValue>(&keyword.value);
        const auto* colour = std::get_if<ColourValue>(&keyword.value);
        if (colour != nullptr && words.size() == 1) words.resize(3, words.front()); // green and blue default to red
        const std::optional<glm::vec3> value =
            readValues(line, keyword.name, words, number ? 1 : 3, number ? number->most : colour->most);
        if (value && number) materials_.back().*(number->member) = value->x;
        if (value && colour) materials_.back().*(colour->member) = *value;
    }

    /// The numbers, clamped to 0..`most`; none, with a recorded flaw, if a word is missing or not a number.
    std::optional<glm::vec3> readValues(const Line& line, const char* keyword, std::span<const std::string_view> words,
                                        std::size_t count, double most) {
        const bool isModel = keyword == std::string_view("illum");
        std::string flaw;
        if (words.size() < count) flaw = fmt::format("'{}' needs {}", keyword, count == 1 ? "a number" : "3 numbers");
        glm::vec3 values(0.0f);
        for (std::size_t i = 0; i < count && flaw.empty(); ++i) {
            const double number = parseNumber(words[i]).value_or(std::nan(""));
            if (!std::isfinite(number)) {
                finiteNumber(keyword, words[i], flaw);
            } else if (isModel && (number < 0.0 || number > most || number != std::floor(number))) {
                flaw = fmt::format("'illum' is {}; it must be a whole number from 0 to {}", words[i], most);
            } else if (number < 0.0) {
                addFlaw(line, fmt::format("'{}' is {}; it must not be negative", keyword, words[i]), "0 is taken");
            } else if (number > most) {
                addFlaw(line, fmt::format("'{}' is {}; it must not exceed {:g}", keyword, words[i], most),
                        "that bound is taken");
            }
            values[glm::length_t(i)] = float(std::clamp(number, 0.0, most));
        }
        if (flaw.empty()) return values;
        addFlaw(line, std::move(flaw), kStatementLeftOut);
        return std::nullopt;
    }

    /// Reads `keyword -option values ... file name -option values ...`: options may stand on both sides of the name.
    /// Options that are not given keep the values of an earlier statement of the material.
    void readPicture(const Line& line, const char* keyword, std::optional<MtlPicture>& stated) {
        MtlPicture picture = stated.value_or(MtlPicture{});
        // A name may begin like an option.
        const std::size_t first = isFile(line.rest) ? 0 : takeOptions(line, 0, picture);
        if (first >= line.words.size())
            return addFlaw(line, fmt::format("'{}' names no picture", keyword), kStatementLeftOut);
        std::string_view name = line.rest.substr(offsetOf(line, first));
        if (!isFile(name)) name = withoutComment(name);
        const auto isOption = [](std::string_view word) {
            return std::ranges::find(kTextureOptions, word, &TextureOption::name) != std::end(kTextureOptions);
        };
        const auto words = std::span(line.words).subspan(first + 1);
        const auto option = isFile(name) ? words.end() : std::ranges::find_if(words, isOption);
        if (option != words.end()) {
            const std::string_view& last = *(&*option - 1);
            name = name.substr(0, std::size_t(last.data() + last.size() - name.data()));
            takeOptions(line, std::size_t(&*option - line.words.data()), picture);
        }
        picture.keyword = keyword;
        picture.line = line.number;
        picture.name = name;
        stated = std::move(picture);
    }

    static std::size_t offsetOf(const Line& line, std::size_t word) {
        return std::size_t(line.words[word].data() - line.rest.data());
    }

    bool isFile(std::string_view name) const {
        std::error_code failure;
        return !name.empty() && std::filesystem::is_regular_file(folder_ / name, failure);
    }

    /// Reads the options that begin at a word, and returns the word after them.
    std::size_t takeOptions(const Line& line, std::size_t word, MtlPicture& picture) {
        while (word < line.words.size() && line.words[word].starts_with('-')) {
            const std::string_view name = line.words[word++];
            const auto option = std::ranges::find(kTextureOptions, name, &TextureOption::name);
            const bool isKnown = option != std::end(kTextureOptions);
            std::string_view value;
            if (isKnown && option->mostNumbers == 0 && word < line.words.size()) value = line.words[word++];
            glm::vec3 numbers(name == "-s" || name == "-bm" ? 1.0f : 0.0f);
            std::size_t count = 0;
            std::string flaw;
            for (const std::size_t most = isKnown ? option->mostNumbers : 3;
                 count < most && word < line.words.size() && parseNumber(line.words[word]); ++count, ++word)
                numbers[glm::length_t(count)] = float(finiteNumber(line.keyword, line.words[word], flaw).value_or(0.0));
            if (isKnown && option->mostNumbers > 0 && count == 0)
                flaw = fmt::format("the option '{}' needs a number", name);
            if (!flaw.empty())
                addFlaw(line, flaw, "the option is left out");
            else if (name == "-o")
                picture.offset = glm::vec2(numbers);
            else if (name == "-s")
                picture.scale = glm::vec2(numbers);
            else if (name == "-bm")
                picture.bumpMultiplier = numbers.x;
            else if (name == "-clamp")
                picture.clamp = !value.starts_with("off");
            else
                addUnsupported(line, fmt::format("the option {}", name));
        }
        return word;
    }

    void charge(std::uint64_t bytes, const Line& line) const {
        ledger_.charge(bytes, [&] { return fmt::format("{}:{}", file_, line.number); });
    }

    const std::filesystem::path folder_;
    const std::string file_;
    Repairs& repairs_;
    LoadLedger& ledger_;
    std::vector<MtlMaterial> materials_;
};

/// The files named after mtllib: one name that may contain spaces and '#', or several without or in quotes.
std::vector<NamedFile> librariesOf(const std::string& statement, const std::filesystem::path& folder) {
    const std::string name(withoutComment(statement));
    for (const std::string& whole : {statement, name})
        if (NamedFile file = fileNamed(folder, whole); file.isFound) return {file};
    std::vector<NamedFile> files;
    std::istringstream words(name);
    for (std::string word; words >> std::quoted(word, '"', '\0');) files.push_back(fileNamed(folder, word));
    // If no such file exists, messages should show the whole statement.
    if (std::ranges::any_of(files, &NamedFile::isFound)) return files;
    return {{folder / name, false}};
}

/// The materials of all libraries, by name; a name that ends in a comment is also found without it.
class Definitions {
public:
    Definitions(const std::filesystem::path& objFile, Repairs& repairs, LoadLedger& ledger)
        : objFile_(objFile), repairs_(repairs), ledger_(ledger) {}

    void read(const std::string& statement) {
        if (withoutComment(statement).empty())
            return repairs_.note(objFile_.string(), 0, kStatementLeftOut, "'mtllib' names no file");
        for (const NamedFile& file : librariesOf(statement, objFile_.parent_path())) {
            if (!visited_.insert(file.path.string()).second) continue;
            const auto note = [&](std::string_view repair, const std::string& flaw) {
                repairs_.note(objFile_.string(), 0, repair, "{}", flaw);
            };
            const std::string name = file.path.lexically_relative(objFile_.parent_path()).string();
            if (!file.isFound) {
                note("default materials are used", fmt::format("its material library '{}' is missing", name));
                continue;
            }
            if (!file.isAsNamed)
                note("that one is read", fmt::format("its material library '{}' is there as '{}'", statement, name));
            std::string text;
            try {
                text = readText(file.path, ledger_);
            } catch (const MemoryRefused&) {
                throw;
            } catch (const InputError& error) {
                note("default materials are used",
                     fmt::format("its material library cannot be read: {}", error.what()));
            }
            add(MtlReader(file.path, repairs_, ledger_).read(text));
        }
    }

    /// The material named by a text after usemtl, with the name used there.
    std::optional<MtlMaterial> named(const std::string& text) const {
        for (const std::string& name : {text, std::string(withoutComment(text))})
            if (const auto found = byName_.find(name); found != byName_.end()) {
                MtlMaterial material = materials_[found->second];
                material.name = name;
                return material;
            }
        return std::nullopt;
    }

private:
    void add(std::vector<MtlMaterial> materials) {
        for (MtlMaterial& material : materials) {
            const std::string name = material.name, file = material.file;
            const int line = material.line;
            const auto [known, isNew] = byName_.try_emplace(name, materials_.size());
            MtlMaterial& first = isNew ? materials_.emplace_back(std::move(material)) : materials_[known->second];
            if (isNew)
                byName_.try_emplace(std::string(withoutComment(name)), known->second);
            else if (first.file == file && first.name == name)
                first.flaws.push_back(
                    {line, fmt::format("'{}' is defined again", name), "the first definition counts"});
        }
    }

    const std::filesystem::path& objFile_;
    Repairs& repairs_;
    LoadLedger& ledger_;
    std::set<std::string> visited_;
    std::vector<MtlMaterial> materials_;
    std::map<std::string, std::size_t> byName_;
};

} // namespace

std::vector<MtlMaterial> findMaterials(const std::vector<std::string>& names, const std::vector<std::string>& libraries,
                                       const std::filesystem::path& objFile, Repairs& repairs, LoadLedger& ledger) {
    Repairs unused(false); // discards notes if no drawn element has a material
    Definitions definitions(objFile, names.empty() ? unused : repairs, ledger);
    for (const std::string& statement : libraries) definitions.read(statement);
    std::vector<MtlMaterial> found;
    for (const std::string& name : names) {
        MtlMaterial undefined;
        undefined.name = withoutComment(name);
        std::optional<MtlMaterial> material = definitions.named(name);
        if (!material && undefined.name.empty())
            repairs.note(objFile.string(), 0, "a default material is used", "'usemtl' gives no name");
        else if (!material)
            repairs.note(objFile.string(), 0, "a default material of that name is used",
                         "no material library defines '{}'", undefined.name);
        found.push_back(material ? std::move(*material) : std::move(undefined));
    }
    return found;
}

} // namespace tessera::scenes::obj
