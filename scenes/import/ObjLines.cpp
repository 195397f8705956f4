#include "scenes/import/ObjLines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "base/Srgb.h"
#include "scenes/import/Files.h"
#include "scenes/import/ObjText.h"

namespace tessera::scenes::obj {
namespace {

constexpr std::string_view kBlank = " \t\r\v\f";

std::string_view trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// Returns the line at `at`, trimmed, and advances `at` past it; line ends are LF, CR LF or CR.
std::string_view takeLine(std::string_view text, std::size_t& at) {
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    const std::string_view line = text.substr(at, end - at);
    at = end;
    if (at < text.size()) at += text.substr(at, 2) == "\r\n" ? 2 : 1;
    return trimmed(line);
}

bool isContinued(std::string_view line) {
    return line.ends_with('\\') && withoutComment(line).size() == line.size();
}

/// Removes a comment after numbers, which needs no blank before it. Some compilers write NaN as "1.#IND".
std::string_view withoutCommentOfNumbers(std::string_view text) {
    for (std::size_t at = text.find('#'); at != std::string_view::npos; at = text.find('#', at + 1))
        if (at == 0 || text[at - 1] != '.') return text.substr(0, at);
    return text;
}

template <typename Value>
std::optional<Value> parseWhole(std::string_view word) {
    if (word.size() > 1 && word.front() == '+' && word[1] != '-') word.remove_prefix(1);
    Value value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size()) return std::nullopt;
    if constexpr (std::numeric_limits<Value>::has_infinity) {
        // Underflow becomes 0; overflow has a positive exponent.
        const std::size_t exponent = word.find_first_of("eE");
        const bool isTiny = exponent != std::string_view::npos && word.substr(exponent + 1, 1) == "-";
        if (error == std::errc::result_out_of_range) return isTiny ? Value{} : std::numeric_limits<Value>::infinity();
    }
    return error == std::errc() ? std::optional(value) : std::nullopt;
}

void appendUtf8(std::string& text, std::uint32_t c) {
    const std::uint32_t size = c < 0x80 ? 1 : c < 0x800 ? 2 : c < 0x10000 ? 3 : 4;
    constexpr std::uint32_t kLead[] = {0x00, 0xc0, 0xe0, 0xf0};
    text.push_back(char(kLead[size - 1] | c >> 6 * (size - 1)));
    for (std::uint32_t i = size - 1; i-- > 0;) text.push_back(char(0x80 | (c >> 6 * i & 0x3f)));
}

/// Converts UTF-16 to UTF-8; an unpaired surrogate becomes U+FFFD.
std::string utf8OfUtf16(std::string_view bytes, bool isBigEndian) {
    const auto unitAt = [&](std::size_t at) -> std::uint32_t {
        const auto first = static_cast<unsigned char>(bytes[at]), second = static_cast<unsigned char>(bytes[at + 1]);
        return isBigEndian ? first << 8u | second : second << 8u | first;
    };
    std::string text;
    text.reserve(bytes.size() / 2 * 3);
    for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
        std::uint32_t c = unitAt(at);
        if (c >> 10 == 0x36 && at + 3 < bytes.size() && unitAt(at + 2) >> 10 == 0x37) {
            c = 0x10000 + ((c & 0x3ff) << 10 | (unitAt(at + 2) & 0x3ff));
            at += 2;
        }
        appendUtf8(text, c >> 11 == 0x1b ? 0xfffd : c);
    }
    return text;
}

const glm::vec3 kMissing(std::numeric_limits<float>::quiet_NaN());
/// Rounding can lift colours of 0..1 above 1, but never this far.
constexpr float kLeastByte = 2.0f;
constexpr float kMostByte = 255.0f;

bool isMissing(const glm::vec3& colour) {
    return std::isnan(colour.x);
}
float largestOf(const glm::vec3& colour) {
    return std::max({colour.x, colour.y, colour.z});
}

} // namespace

void forEachLine(std::string_view text, const std::function<void(const Line&)>& visit) {
    Line line;
    std::string joined;
    int number = 0;
    for (std::size_t at = 0; at < text.size();) {
        std::string_view content = takeLine(text, at);
        line.number = ++number;
        if (isContinued(content) && at < text.size()) {
            joined.clear();
            while (isContinued(content) && at < text.size()) {
                joined.append(content.substr(0, content.size() - 1)).append(" ");
                content = takeLine(text, at);
                ++number;
            }
            joined.append(content.substr(0, content.size() - (isContinued(content) ? 1 : 0)));
            content = trimmed(joined);
        }
        if (content.empty() || content.front() == '#') continue;
        const std::size_t keywordEnd = std::min(content.find_first_of(kBlank), content.size());
        line.keyword = content.substr(0, keywordEnd);
        line.rest = trimmed(content.substr(keywordEnd));
        line.words.clear();
        addWords(withoutCommentOfNumbers(line.rest), line.words);
        visit(line);
    }
}

void addWords(std::string_view text, std::vector<std::string_view>& words) {
    for (std::size_t i = text.find_first_not_of(kBlank); i < text.size();) {
        const std::size_t end = std::min(text.find_first_of(kBlank, i), text.size());
        words.push_back(text.substr(i, end - i));
        i = text.find_first_not_of(kBlank, end);
    }
}

std::string_view withoutComment(std::string_view name) {
    for (std::size_t at = name.find('#'); at != std::string_view::npos; at = name.find('#', at + 1))
        if (at == 0 || kBlank.find(name[at - 1]) != std::string_view::npos) return trimmed(name.substr(0, at));
    return name;
}

std::optional<double> parseNumber(std::string_view word) {
    return parseWhole<double>(word);
}

std::optional<long long> parseInteger(std::string_view word) {
    return parseWhole<long long>(word);
}

std::optional<double> finiteNumber(std::string_view keyword, std::string_view word, std::string& flaw) {
    const std::optional<double> number = parseNumber(word);
    if (number && std::isfinite(*number) && std::abs(*number) <= std::numeric_limits<float>::max()) return number;
    flaw = number ? fmt::format("'{}' is given {}, which is not a finite number in single precision", keyword, word)
                  : fmt::format("'{}' needs a number, not '{}'", keyword, word);
    return std::nullopt;
}

std::string readText(const std::filesystem::path& file, LoadLedger& ledger) {
    const std::vector<std::byte> bytes = readFileBytes(file, ledger);
    ledger.charge(bytes.size(), [&] { return file.string(); }); // a second copy as text
    std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const bool hasMark = text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
    const auto isZero = [&](std::size_t i) { return text[i] == '\0'; };
    const bool alternates =
        text.size() > 3 && isZero(0) != isZero(1) && isZero(0) == isZero(2) && isZero(1) == isZero(3);
    if (hasMark || alternates) {
        ledger.charge(2 * bytes.size(), [&] { return file.string(); });
        const bool isBigEndian = isZero(0) || text[0] == '\xfe';
        text = utf8OfUtf16(std::string_view(text).substr(hasMark ? 2 : 0), isBigEndian);
    }
    if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
    if (text.empty()) throw InputError(file.string() + ": the file is empty; export the model again");
    return text;
}

void VertexColours::read(const Line& line, std::size_t position) {
    constexpr std::size_t kFirst = 3, kCount = 3;
    if (line.words.size() < kFirst + kCount) return; // five numbers are a position and no colour
    glm::vec3 colour;
    std::string flaw;
    for (std::size_t i = 0; i < kCount; ++i)
        colour[glm::length_t(i)] = float(finiteNumber(line.keyword, line.words[kFirst + i], flaw).value_or(0.0));
    if (!flaw.empty()) {
        if (flaw_.empty()) flawLine_ = line.number, flaw_ = flaw;
        return;
    }
    if (largeLine_ == 0 && largestOf(colour) >= kLeastByte) largeLine_ = line.number;
    colours_.resize(position, kMissing);
    colours_.push_back(colour);
}

std::vector<glm::vec3> VertexColours::take(const std::string& file, ObjColours encoding,
                                           const std::vector<bool>& isUsed, Repairs& repairs) {
    if (colours_.empty()) return {};
    colours_.resize(isUsed.size(), kMissing);
    std::size_t missing = 0, used = 0;
    float largest = 0.0f;
    for (std::size_t i = 0; i < isUsed.size(); ++i) {
        if (!isUsed[i]) continue;
        ++used;
        if (isMissing(colours_[i]))
            ++missing;
        else
            largest = std::max(largest, largestOf(colours_[i]));
    }
    if (missing == used) return {};
    if (missing > 0)
        repairs.note(file, flawLine_, "these are white", "{} of {} vertices have no colour{}{}", missing, used,
                     flaw_.empty() ? "" : ": ", flaw_);
    const bool isBytes = largest >= kLeastByte;
    if (isBytes)
        repairs.note(file, largeLine_, "they are divided by 255", "colours of vertices are up to {}, not 0 to 1",
                     largest);
    for (std::size_t i = 0; i < isUsed.size(); ++i) {
        glm::vec3& colour = colours_[i];
        if (isMissing(colour)) colour = glm::vec3(isBytes ? kMostByte : 1.0f);
        const glm::vec3 written = isBytes ? colour / kMostByte : colour;
        colour = glm::clamp(written, 0.0f, 1.0f);
        if (isUsed[i] && colour != written)
            repairs.note(file, 0, "the nearest bound is taken", "the colour {} {} {} of vertex {} is not within {}",
                         written.x, written.y, written.z, i + 1, isBytes ? "0 to 255" : "0 to 1");
        if (encoding == ObjColours::Linear) continue;
        for (glm::length_t c = 0; c < 3; ++c) colour[c] = float(linearFromSrgb(double(colour[c])));
    }
    return std::move(colours_);
}

} // namespace tessera::scenes::obj
