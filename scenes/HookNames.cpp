#include "scenes/HookNames.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "scenes/Hook.h"
#include "scenes/HookBounds.h"
#include "scenes/HookWords.h"

namespace tessera::scenes {
namespace {

constexpr std::size_t kMostSwizzle = 4, kSurfaceNumbers = 8;
/// Operations of a mat4 product per component.
constexpr std::size_t kMatrixProduct = 7;
/// Operations of an integer division, and array components per operation of an index, which compiles to branches.
/// Measured with Mesa 22.3.
constexpr std::size_t kIntegerDivision = 40, kNumbersAnIndexOperation = 4;

/// Size of types such as vec3 and dmat4x2: digits are dimensions; a matrix with a single digit is square.
HookSize builtInSize(std::string_view type) {
    std::size_t numbers = 1, side = 0, sides = 0;
    for (const char c : type)
        if (c >= '2' && c <= '4') {
            side = std::size_t(c - '0');
            numbers *= side;
            ++sides;
        }
    const bool isMatrix = type.find("mat") != std::string_view::npos;
    if (isMatrix && sides == 1) numbers *= side;
    if (type.starts_with("Hook")) numbers = kSurfaceNumbers;
    if (type.starts_with("d")) numbers *= 2;
    const bool isInteger = type.starts_with("i") || type.starts_with("u");
    return {numbers, numbers, isMatrix ? kMatrixProduct : 1, isInteger ? kIntegerDivision : 1};
}

/// The widest type that a GLSL function returns or a member of the interface has.
std::string_view builtInType(std::string_view name) {
    if (name == "outerProduct" || name == "transpose" || name == "inverse") return "mat4";
    if (name == "color" || name == "emission" || name == "positionOS") return "vec3";
    if (name == "packDouble2x32") return "double";
    const bool isInteger = name.starts_with("bit") || name.starts_with("find") || name.starts_with("pack") ||
                           name.ends_with("Int") || name.ends_with("Uint") || name == "instance";
    return name.starts_with("unpack") ? "vec4" : isInteger ? "ivec4" : "float";
}

} // namespace

std::size_t hookSum(std::size_t a, std::size_t b) {
    return std::min(kHugeHookSize, a + b);
}
std::size_t hookProduct(std::size_t a, std::size_t b) {
    return a == 0 || b == 0 ? 0 : a > kHugeHookSize / b ? kHugeHookSize : a * b;
}

void HookSize::widen(const HookSize& other) {
    numbers = std::max(numbers, other.numbers);
    element = std::max(element, other.element);
    product = std::max(product, other.product);
    division = std::max(division, other.division);
    index = std::max(index, other.index);
    structs = std::max(structs, other.structs);
}

bool HookNames::isType(std::size_t at) const {
    return isName(at) && (at == 0 || !tokens_[at - 1].is(".")) &&
           (isHookType(tokens_[at].text) || types_.contains(tokens_[at].text));
}

std::size_t HookNames::behindArraySizes(std::size_t at) const {
    while (is(at, "[")) at = behindBracket(tokens_, at);
    return at;
}

std::size_t HookNames::arraySizeAt(std::size_t open) const {
    const auto value = is(open + 2, "]") ? wholeNumberOf(tokens_.subspan(open + 1, 1),
                                                         [&](std::string_view name) -> std::optional<std::int64_t> {
                                                             const auto found = constants_.find(name);
                                                             if (found == constants_.end()) return std::nullopt;
                                                             return found->second.times == 1 ? found->second.value : 0;
                                                         })
                                         : std::nullopt;
    if (!value || *value < 1)
        throw HookFault{tokens_[open].line, "an array's size is one whole number here, or the name of a const int that "
                                            "is declared once, as such a number; write one"};
    return std::size_t(std::min(*value, std::int64_t(kHugeHookSize)));
}

/// Number of values in a constructor's brackets: commas plus one, those of inner brackets included.
std::size_t HookNames::constructed(std::size_t open) const {
    const auto end = std::ptrdiff_t(behindBracket(tokens_, open));
    return 1 + std::size_t(std::count_if(tokens_.begin() + std::ptrdiff_t(open), tokens_.begin() + end,
                                         [](const HookToken& token) { return token.is(","); }));
}

/// Applies the array sizes at this place to the type. Only a constructor may omit the first one.
HookSize HookNames::arrayOf(HookSize type, std::size_t at) const {
    const std::size_t end = behindArraySizes(at);
    for (bool isFirst = true; is(at, "["); isFirst = false) {
        const bool isOpen = isFirst && is(at + 1, "]") && is(end, "(");
        const std::size_t size = isOpen ? constructed(end) : arraySizeAt(at);
        type.element = isFirst ? type.numbers : hookProduct(type.element, size);
        type.numbers = hookProduct(type.numbers, size);
        at += isOpen ? 2 : 3;
    }
    return type;
}

HookSize HookNames::typeAt(std::size_t at) const {
    const auto own = types_.find(tokens_[at].text);
    return arrayOf(own == types_.end() ? builtInSize(tokens_[at].text) : own->second, at + 1);
}

std::size_t HookNames::take(std::size_t at) {
    const HookToken& token = tokens_[at];
    Level& level = levels_.back();
    if (opens(token)) {
        levels_.emplace_back();
        if (token.is("{")) levels_.back().isStruct = std::exchange(isStructNext_, false);
        if (levels_.back().isStruct) levels_.back().structName = tokens_[at - 1].text;
    } else if (closes(token) && levels_.size() > 1) {
        const Level closed = std::move(level);
        levels_.pop_back();
        if (closed.isStruct) takeStruct(closed, at);
    } else if (token.is(";")) {
        level.isDeclaring = level.isNameNext = false;
    } else if (token.is(",")) {
        level.isNameNext = level.isDeclaring && isName(at + 1) && !isName(behindArraySizes(at + 2));
    } else if (token.is("struct")) {
        isStructNext_ = is(at + 1, "{") || is(at + 2, "{");
    } else if (token.isName() && std::exchange(level.isNameNext, false)) {
        return takeVariable(at);
    } else if (isType(at)) {
        return takeType(at);
    }
    return 0;
}

std::size_t HookNames::takeType(std::size_t at) {
    const HookSize size = typeAt(at);
    const bool isArray = is(at + 1, "[");
    if (!isName(behindArraySizes(at + 1))) return isArray ? size.numbers : 0;
    Level& level = levels_.back();
    level.isDeclaring = level.isNameNext = true;
    level.type = size;
    return 0;
}

std::size_t HookNames::takeVariable(std::size_t at) {
    Level& level = levels_.back();
    const std::string_view name = tokens_[at].text;
    const HookSize size = arrayOf(level.type, at + 1);
    if (level.isStruct) {
        level.members.numbers = hookSum(level.members.numbers, size.numbers);
        HookSize member = size;
        member.numbers = member.element = hookSum(level.members.numbers, size.numbers);
        ++member.structs;
        level.members.widen(member);
    } else {
        Constant& constant = constants_[name];
        ++constant.times;
        if (is(at + 1, "=") && at + 3 < tokens_.size() && (is(at + 3, ",") || is(at + 3, ";")))
            constant.value = wholeNumberOf(tokens_.subspan(at + 2, 1), [](std::string_view) {
                                 return std::optional<std::int64_t>();
                             }).value_or(0);
    }
    Sizes& sizes = level.isStruct || levels_.size() == 1 ? globals_ : locals_;
    sizes.try_emplace(name, size).first->second.widen(size);
    const bool counts = !level.isStruct && (size.element < size.numbers || size.structs > 0);
    return counts ? size.numbers : 0;
}

void HookNames::takeStruct(const Level& closed, std::size_t at) {
    if (closed.members.structs > kMostStructNesting)
        throw HookFault{tokens_[at].line,
                        fmt::format("more than {} structures stand in each other; take some out", kMostStructNesting)};
    types_.try_emplace(closed.structName, closed.members).first->second.widen(closed.members);
    Level& level = levels_.back();
    level.isDeclaring = level.isNameNext = isName(at + 1);
    level.type = closed.members;
}

HookSize HookNames::sizeAt(std::size_t at) const {
    const std::string_view word = tokens_[at].text;
    if (is(at + 1, ".")) return {};
    if (!tokens_[at].isName()) return builtInSize(word.ends_with("lf") || word.ends_with("LF") ? "double" : "float");
    HookSize size = isType(at) ? typeAt(at) : builtInSize(builtInType(word));
    bool isKnown = false;
    for (const Sizes* sizes : {&globals_, &locals_})
        if (const auto found = sizes->find(word); found != sizes->end()) {
            size.widen(found->second);
            isKnown = true;
        }
    if (is(at + 1, "[")) {
        size.index = size.numbers / kNumbersAnIndexOperation;
        size.numbers = size.element;
    }
    if (!isKnown && at > 0 && tokens_[at - 1].is("."))
        size.numbers = std::max(size.numbers, std::min(kMostSwizzle, word.size()));
    return size;
}

} // namespace tessera::scenes
