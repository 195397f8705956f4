#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "scenes/import/MtlLibrary.h"
#include "scenes/import/ObjLines.h"

namespace tessera::scenes::obj {
namespace {

enum class Kind { Colour, Share, NotNegative, Illumination, Picture, WithoutEffect };

struct Keyword {
    const char* name; ///< in MTL's spelling
    Kind kind;
};

/// After the MTL specification (Wavefront, "Advanced Visualizer Manual", appendix B2) and its PBR extension
/// (Exocortex 2015, "Extending Wavefront MTL for physically-based rendering"). Ambient light and what only bends
/// rays have no counterpart in direct lighting.
constexpr Keyword kKeywords[] = {
    {"Kd", Kind::Colour},          {"Ks", Kind::Colour},        {"Ke", Kind::Colour},
    {"Ns", Kind::NotNegative},     {"Ni", Kind::NotNegative},   {"d", Kind::Share},
    {"Tr", Kind::Share},           {"Pr", Kind::Share},         {"Pm", Kind::Share},
    {"illum", Kind::Illumination}, {"map_Kd", Kind::Picture},   {"map_Ks", Kind::Picture},
    {"map_Ke", Kind::Picture},     {"map_d", Kind::Picture},    {"map_Pr", Kind::Picture},
    {"map_Pm", Kind::Picture},     {"norm", Kind::Picture},     {"map_bump", Kind::Picture},
    {"bump", Kind::Picture},       {"Ka", Kind::WithoutEffect}, {"map_Ka", Kind::WithoutEffect},
    {"Tf", Kind::WithoutEffect},   {"Kt", Kind::WithoutEffect}, {"sharpness", Kind::WithoutEffect},
};

struct TextureOption {
    const char* name;
    int mostNumbers; ///< -1: one word that is no number
    bool used;
};
constexpr TextureOption kTextureOptions[] = {
    {"-o", 3, true},
    {"-s", 3, true},
    {"-t", 3, false},
    {"-clamp", -1, true},
    {"-bm", 1, true},
    {"-mm", 2, false},
    {"-boost", 1, false},
    {"-blendu", -1, false},
    {"-blendv", -1, false},
    {"-cc", -1, false},
    {"-imfchan", -1, false},
    {"-texres", -1, false},
    {"-colorspace", -1, false},
    {"-type", -1, false},
};

bool equalsIgnoringCase(std::string_view a, std::string_view b) {
    return std::ranges::equal(a, b,
                              [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

class MtlChecker {
public:
    MtlChecker(const std::filesystem::path& file, std::vector<std::string>& warnings, LoadLedger& ledger)
        : file_(file), warnings_(warnings), ledger_(ledger) {}

    std::vector<MtlMaterial> read() {
        forEachLine(readText(file_, ledger_), [&](const Line& line) { readLine(line); });
        const auto warn = [&](const char* what, const std::set<std::string>& which) {
            if (!which.empty())
                warnings_.push_back(fmt::format("{}: {}: {}", file_.string(), what, fmt::join(which, ", ")));
        };
        warn("statements that are not supported are left out", unknown_);
        warn("texture options that are not supported are left out", unusedOptions_);
        parseValues();
        return std::move(materials_);
    }

private:
    void readLine(const Line& line) {
        if (line.keyword == "newmtl") {
            if (line.rest.empty()) failAt(file_, line.number, "'newmtl' gives no name");
            // The number distinguishes names with spaces and equal names, which the parser would merge.
            fmt::format_to(std::back_inserter(text_), "newmtl {}\n", materials_.size());
            // In the file's list, grown; in the parser's; and as those that are used.
            constexpr std::size_t kCopies = 4;
            ledger_.charge(kCopies * (sizeof(MtlMaterial) + sizeof(Material)),
                           [&] { return fmt::format("{}:{}", file_.string(), line.number); });
            materials_.emplace_back();
            materials_.back().name = line.rest;
            materials_.back().file = file_;
            return;
        }
        const auto keyword = std::ranges::find_if(
            kKeywords, [&](const Keyword& known) { return equalsIgnoringCase(known.name, line.keyword); });
        if (keyword == std::end(kKeywords)) {
            unknown_.emplace(line.keyword);
            return;
        }
        if (keyword->kind == Kind::WithoutEffect) return;
        if (materials_.empty())
            failAt(file_, line.number, fmt::format("'{}' stands before the first newmtl", line.keyword));
        if (line.words.empty()) failAt(file_, line.number, fmt::format("'{}' gives no value", line.keyword));
        if (keyword->kind == Kind::Picture)
            readPicture(line, keyword->name);
        else
            readNumbers(line, *keyword);
    }

    void readNumbers(const Line& line, const Keyword& keyword) {
        std::vector<std::string_view> words = line.words;
        if (words.front() == "spectral" || words.front() == "xyz") {
            unknown_.insert(fmt::format("{} {}", keyword.name, words.front()));
            return;
        }
        if (words.front() == "-halo") words.erase(words.begin()); // opacity that falls off at the silhouette
        const std::size_t count = keyword.kind == Kind::Colour ? 3 : 1;
        if (words.empty() || (count == 3 && words.size() == 2))
            failAt(file_, line.number,
                   fmt::format("'{}' needs {}", keyword.name, count == 3 ? "3 numbers" : "a number"));
        if (words.size() < count) words.resize(count, words.front()); // green and blue default to red

        text_ += keyword.name;
        for (std::size_t i = 0; i < count; ++i) {
            const float value = finiteNumber(file_, line, words[i]);
            if (value < 0.0f || (keyword.kind == Kind::Share && value > 1.0f))
                failAt(file_, line.number,
                       fmt::format("'{}' is {}; it must {}", keyword.name, words[i],
                                   keyword.kind == Kind::Share ? "lie between 0 and 1" : "not be negative"));
            if (keyword.kind == Kind::Illumination && !parseInteger(words[i]))
                failAt(file_, line.number, fmt::format("'illum' is {}; it must be a whole number", words[i]));
            fmt::format_to(std::back_inserter(text_), " {}", value);
        }
        text_ += '\n';
        materials_.back().stated.insert(keyword.name);
    }

    /// keyword -option values ... file name up to the line's end
    void readPicture(const Line& line, const char* keyword) {
        std::string options;
        std::size_t word = 0;
        while (word < line.words.size() && line.words[word].starts_with('-')) {
            const auto option = std::ranges::find(kTextureOptions, line.words[word], &TextureOption::name);
            if (option == std::end(kTextureOptions))
                failAt(file_, line.number, fmt::format("'{}' has the unknown option '{}'", keyword, line.words[word]));
            ++word;
            const std::string values = takeOptionValues(line, *option, word);
            if (option->used)
                options += fmt::format(" {}{}", option->name, values);
            else
                unusedOptions_.emplace(option->name);
        }
        if (word >= line.words.size()) failAt(file_, line.number, fmt::format("'{}' names no picture", keyword));
        const std::size_t nameStart = static_cast<std::size_t>(line.words[word].data() - line.rest.data());
        text_ += fmt::format("{}{} {}\n", keyword, options, line.rest.substr(nameStart));
        materials_.back().stated.insert(keyword);
    }

    /// The option's values as the parser wants them: always three numbers after -o and -s.
    std::string takeOptionValues(const Line& line, const TextureOption& option, std::size_t& word) {
        std::string values;
        if (option.mostNumbers < 0) {
            if (word < line.words.size()) values = fmt::format(" {}", line.words[word++]);
            return values;
        }
        const float missing = option.name == std::string_view("-s") ? 1.0f : 0.0f;
        int count = 0;
        while (count < option.mostNumbers && word < line.words.size() && parseNumber(line.words[word])) {
            values += fmt::format(" {}", finiteNumber(file_, line, line.words[word++]));
            ++count;
        }
        if (count == 0) failAt(file_, line.number, fmt::format("the option '{}' needs a number", option.name));
        for (; count < option.mostNumbers; ++count) values += fmt::format(" {}", missing);
        return values;
    }

    void parseValues() {
        if (materials_.empty()) return;
        std::istringstream stream(text_);
        std::map<std::string, int> numbers;
        std::vector<tinyobj::material_t> values;
        std::string warning;
        std::string error;
        tinyobj::LoadMtl(&numbers, &values, &stream, &warning, &error);
        if (values.size() != materials_.size())
            throw std::runtime_error(fmt::format("{}: tinyobjloader read {} of {} materials {}{}", file_.string(),
                                                 values.size(), materials_.size(), warning, error));
        for (std::size_t i = 0; i < values.size(); ++i) materials_[i].values = std::move(values[i]);
    }

    const std::filesystem::path& file_;
    std::vector<std::string>& warnings_;
    LoadLedger& ledger_;
    std::string text_;
    std::vector<MtlMaterial> materials_;
    std::set<std::string> unknown_;
    std::set<std::string> unusedOptions_;
};

} // namespace

std::vector<MtlMaterial> readMtl(const std::filesystem::path& file, std::vector<std::string>& warnings,
                                 LoadLedger& ledger) {
    return MtlChecker(file, warnings, ledger).read();
}

} // namespace tessera::scenes::obj
