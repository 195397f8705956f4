#include "scenes/HookBounds.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "scenes/Hook.h"
#include "scenes/HookWords.h"

namespace tessera::scenes {
namespace hookbounds {
namespace {

using Tokens = std::span<const HookToken>;

/// Beyond every bound; sums and products end there.
constexpr std::size_t kHuge = std::numeric_limits<std::uint32_t>::max();
std::size_t sum(std::size_t a, std::size_t b) {
    return std::min(kHuge, a + b);
}
std::size_t product(std::size_t a, std::size_t b) {
    return a == 0 || b == 0 ? 0 : a > kHuge / b ? kHuge : a * b;
}

[[noreturn]] void refuse(const HookToken& token, const std::string& why) {
    throw HookFault{token.line, why};
}

bool opens(const HookToken& token) {
    return token.is("(") || token.is("[") || token.is("{");
}
bool closes(const HookToken& token) {
    return token.is(")") || token.is("]") || token.is("}");
}

/// Limits the depth of expression trees, estimated by the operators in all enclosing brackets since their last comma or
/// semicolon.
void requireShallowExpressions(Tokens tokens) {
    std::vector<std::size_t> levels(1);
    std::size_t operators = 0;
    for (const HookToken& token : tokens) {
        if (opens(token)) {
            levels.push_back(0);
            if (levels.size() > kMostHookNesting)
                refuse(token,
                       fmt::format("more than {} brackets stand in each other here; use variables", kMostHookNesting));
        } else if (closes(token)) {
            operators -= levels.back();
            if (levels.size() > 1)
                levels.pop_back();
            else
                levels.back() = 0;
        }
        if (token.is(",") || token.is(";") || token.is("{") || token.is("}"))
            operators -= std::exchange(levels.back(), 0);
        else if (token.kind == HookToken::Kind::Sign && !closes(token)) {
            ++levels.back();
            if (++operators > kMostHookOperators)
                refuse(token, fmt::format("this statement has more than {} operators; make several of it",
                                          kMostHookOperators));
        }
    }
}

/// Of a type: its numbers, and how deep structures stand in it.
struct TypeSize {
    std::size_t numbers = 1, depth = 0;
};

struct Function {
    std::string_view name;
    std::uint32_t line = 0;
    std::size_t order = 0; ///< place in the text
    /// Cost of the body alone; Calls::count() adds that of the called functions.
    std::size_t size = 0, branches = 0, arrays = 0, iterations = 0;
    struct Call {
        std::string_view name;
        std::size_t order = 0, times = 1; ///< iterations of the loops around it
    };
    std::vector<Call> calls;
    bool isCounted = false, isBeingCounted = false;
};

/// Reads declarations and statements as far as the bounds need. Every loop goes on by a token at least.
class Reader {
public:
    explicit Reader(Tokens tokens) : tokens_(tokens) {
        matches_.assign(tokens.size(), tokens.size());
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            if (opens(tokens[i])) open.push_back(i);
            if (!closes(tokens[i]) || open.empty()) continue;
            matches_[open.back()] = i;
            open.pop_back();
        }
        findNames();
    }

    std::vector<Function> functions() {
        Function global; // initialisers call functions too
        global.line = 1;
        for (at_ = 0; at_ < tokens_.size();) {
            if (is("struct")) {
                structure(global);
            } else if (const std::size_t parameters = functionParameters(); parameters < tokens_.size()) {
                function(parameters);
            } else {
                declarationOrExpression(global);
            }
        }
        functions_.push_back(std::move(global));
        return std::move(functions_);
    }
    const std::multimap<std::string_view, std::size_t>& prototypes() const { return prototypes_; }

private:
    bool is(std::string_view text, std::size_t ahead = 0) const {
        return at_ + ahead < tokens_.size() && tokens_[at_ + ahead].is(text);
    }
    std::size_t behindMatch(std::size_t open) const { return std::min(matches_[open] + 1, tokens_.size()); }

    /// Constants, the larger where two have one name, and structures.
    void findNames() {
        for (std::size_t i = 0; i + 3 < tokens_.size(); ++i) {
            if (tokens_[i].is("struct") && tokens_[i + 1].isName()) types_.try_emplace(tokens_[i + 1].text);
            if (!tokens_[i].is("const") || !(tokens_[i + 1].is("int") || tokens_[i + 1].is("uint"))) continue;
            for (std::size_t name = i + 2; name + 2 < tokens_.size() && tokens_[name + 1].is("=");) {
                std::size_t end = name + 2;
                while (end < tokens_.size() && !tokens_[end].is(",") && !tokens_[end].is(";"))
                    end = opens(tokens_[end]) ? behindMatch(end) : end + 1;
                if (const auto value = constant(tokens_.subspan(name + 2, end - name - 2))) {
                    std::int64_t& known = constants_.try_emplace(tokens_[name].text, *value).first->second;
                    known = std::max(known, *value);
                }
                if (end == tokens_.size() || tokens_[end].is(";")) break;
                name = end + 1;
            }
        }
    }

    std::optional<std::int64_t> constant(Tokens expression) const {
        return wholeNumberOf(expression, [&](std::string_view name) -> std::optional<std::int64_t> {
            const auto found = constants_.find(name);
            if (found == constants_.end()) return std::nullopt;
            return found->second;
        });
    }

    bool isType(const HookToken& token) const { return isHookType(token.text) || types_.contains(token.text); }
    TypeSize sizeOf(std::string_view type) const {
        if (const auto own = types_.find(type); own != types_.end()) return own->second;
        // vec3, dmat4x2: digits are sides, of square matrices one of two.
        std::size_t numbers = 1, sides = 0;
        for (const char c : type)
            if (c >= '2' && c <= '4') {
                numbers *= std::size_t(c - '0');
                ++sides;
            }
        if (sides == 1 && type.find("mat") != std::string_view::npos) numbers *= numbers;
        if (type.starts_with("HookedSurface") || type.starts_with("HookInputs")) numbers = 8;
        return {type.starts_with("d") ? 2 * numbers : numbers, 0};
    }

    /// Counts the values of an initialiser in [at, end); with `isDeep` those of nested brackets too.
    std::size_t valuesIn(std::size_t at, std::size_t end, bool isDeep) const {
        while (at < end && !tokens_[at].is("(") && !tokens_[at].is("{"))
            at = tokens_[at].is("[") ? behindMatch(at) : at + 1;
        const std::size_t close = at < end ? std::min(matches_[at], end) : end;
        std::size_t values = 1;
        for (++at; at < close; at = opens(tokens_[at]) && !isDeep ? behindMatch(at) : at + 1)
            values += tokens_[at].is(",");
        return values;
    }

    /// The product of the array sizes from a [ on, behind which `at` then is.
    std::size_t dimensions(std::size_t& at, std::size_t end, bool isInitialised) const {
        std::size_t numbers = 1;
        bool isFirst = true;
        while (at < end && tokens_[at].is("[")) {
            const std::size_t close = std::min(matches_[at], end);
            const Tokens size = tokens_.subspan(at + 1, close - at - 1);
            const std::optional<std::int64_t> value = constant(size);
            if (!size.empty() && (!value || *value < 1))
                refuse(tokens_[at], "an array's size is a whole number here, of const int at most; write one");
            // Without a size it has as many as its initialiser has values.
            const std::size_t initial = isInitialised ? valuesIn(close + 1, end, !isFirst) : 1;
            numbers = product(numbers, size.empty() ? initial : std::size_t(*value));
            isFirst = false;
            at = close + 1;
        }
        return numbers;
    }

    /// Where a declaration begins, the place behind its qualifiers, its type and that one's array sizes; none else.
    struct Declared {
        TypeSize type;
        std::size_t dimensions = 1, names = 0;
    };
    std::optional<Declared> declaredAt(std::size_t at, std::size_t end) const {
        while (at < end && isHookQualifier(tokens_[at].text)) ++at;
        if (at + 1 >= end || !isType(tokens_[at])) return std::nullopt;
        const std::size_t behind = at + 1;
        if (!tokens_[behind].isName() && !tokens_[behind].is("[")) return std::nullopt;
        Declared declared{sizeOf(tokens_[at].text)};
        at = behind;
        while (at < end && tokens_[at].is("[")) at = behindMatch(at);
        if (at >= end || !tokens_[at].isName()) return std::nullopt; // float[2](...) is an expression
        at = behind;
        declared.dimensions = dimensions(at, end, false);
        declared.names = at;
        return declared;
    }

    /// Numbers of the arrays and structures that variables or members from `at` to `end` have; of all, with `isMember`.
    std::size_t declaredNumbers(const Declared& declared, std::size_t end, bool isMember) const {
        std::size_t numbers = 0;
        for (std::size_t at = declared.names; at < end; ++at) {
            ++at; // the name
            const bool isArray = declared.dimensions > 1 || (at < end && tokens_[at].is("["));
            std::size_t close = at;
            while (close < end && tokens_[close].is("[")) close = behindMatch(close);
            const bool isInitialised = close < end && tokens_[close].is("=");
            const std::size_t each = product(declared.dimensions, dimensions(at, end, isInitialised));
            const bool counts = isMember || isArray || declared.type.depth > 0;
            if (counts) numbers = sum(numbers, product(each, declared.type.numbers));
            while (at < end && !tokens_[at].is(",")) at = opens(tokens_[at]) ? behindMatch(at) : at + 1;
        }
        return numbers;
    }

    void structure(Function& function) {
        const HookToken& keyword = tokens_[at_++];
        const std::string_view name = at_ < tokens_.size() && tokens_[at_].isName() ? tokens_[at_++].text : "";
        if (!is("{")) return;
        const std::size_t end = matches_[at_];
        TypeSize size{0, 1};
        for (++at_; at_ < end; ++at_) {
            std::size_t semicolon = at_;
            while (semicolon < end && !tokens_[semicolon].is(";")) ++semicolon;
            if (const auto declared = declaredAt(at_, semicolon)) {
                size.numbers = sum(size.numbers, declaredNumbers(*declared, semicolon, true));
                size.depth = std::max(size.depth, declared->type.depth + 1);
            }
            at_ = semicolon;
        }
        if (size.depth > kMostStructNesting)
            refuse(keyword,
                   fmt::format("more than {} structures stand in each other; take some out", kMostStructNesting));
        if (!name.empty()) {
            TypeSize& known = types_[name];
            known = {std::max(known.numbers, size.numbers), std::max(known.depth, size.depth)};
        }
        at_ = std::min(end + 1, tokens_.size());
        Declared variables{size};
        variables.names = at_;
        skipStatement(function);
        function.arrays = sum(function.arrays, declaredNumbers(variables, std::max(variables.names, at_ - 1), false));
    }

    /// Where a function begins, the bracket of its parameters; else the number of tokens.
    std::size_t functionParameters() const {
        for (std::size_t i = at_; i + 1 < tokens_.size(); ++i) {
            if (tokens_[i].is("["))
                i = behindMatch(i) - 1;
            else if (tokens_[i].isName() && tokens_[i + 1].is("(") && i > at_)
                return i + 1;
            else if (!tokens_[i].isName())
                break;
        }
        return tokens_.size();
    }

    void function(std::size_t parameters) {
        Function function;
        function.name = tokens_[parameters - 1].text;
        function.line = tokens_[parameters - 1].line;
        function.order = parameters;
        const std::size_t begin = at_, end = std::min(matches_[parameters], tokens_.size());
        for (std::size_t i = begin; i < end; ++i) // a result or a parameter may be an array
            if (tokens_[i].is("[")) {
                function.arrays = sum(function.arrays, dimensions(i, end, false));
                --i;
            }
        at_ = std::min(end + 1, tokens_.size());
        if (!is("{")) {
            prototypes_.emplace(function.name, function.order);
            return skipStatement(function);
        }
        const std::size_t close = std::min(matches_[at_], tokens_.size());
        function.size = close - begin;
        times_ = 1;
        for (++at_; at_ < close;) statement(function, 0);
        at_ = std::min(close + 1, tokens_.size());
        functions_.push_back(std::move(function));
    }

    void statement(Function& function, std::size_t depth) {
        const HookToken& first = tokens_[at_];
        if (depth > kMostHookNesting)
            refuse(first,
                   fmt::format("more than {} statements stand in each other here; write functions", kMostHookNesting));
        const bool isLabel = first.is("case") || first.is("default");
        function.branches += isLabel || first.is("if") || first.is("break") || first.is("continue");
        if (isLabel) {
            while (at_ < tokens_.size() && !is(":") && !is(";") && !is("}")) ++at_;
            if (!is("}")) at_ = std::min(at_ + 1, tokens_.size());
        } else if (first.is("{")) {
            const std::size_t close = std::min(matches_[at_], tokens_.size());
            for (++at_; at_ < close;) statement(function, depth + 1);
            at_ = std::min(close + 1, tokens_.size());
        } else if (first.is("for")) {
            loop(function, depth, roundsAt(at_));
        } else if (first.is("while")) {
            loop(function, depth, 1);
        } else if (first.is("do")) {
            ++function.branches;
            ++at_;
            if (at_ < tokens_.size()) statement(function, depth + 1);
            skipStatement(function); // while (...);
        } else if (first.is("if") || first.is("switch")) {
            ++at_;
            bracket(function);
            if (at_ < tokens_.size()) statement(function, depth + 1);
            if (first.is("if") && is("else") && ++at_ < tokens_.size()) statement(function, depth + 1);
        } else if (first.is("struct")) {
            structure(function);
        } else {
            declarationOrExpression(function);
        }
    }

    void loop(Function& function, std::size_t depth, std::size_t rounds) {
        const HookToken& first = tokens_[at_];
        ++function.branches;
        const std::size_t before = times_;
        times_ = product(times_, rounds);
        function.iterations = sum(function.iterations, times_);
        requireRounds(first.line, function.iterations);
        ++at_;
        bracket(function);
        if (at_ < tokens_.size()) statement(function, depth + 1);
        times_ = before;
    }

    static void requireRounds(std::uint32_t line, std::size_t rounds) {
        if (rounds > kMostHookIterations)
            throw HookFault{
                line, fmt::format("loops make more than {} iterations here, after which software rasterisers truncate "
                                  "them silently; shorten them, or end them by break",
                                  kMostHookIterations)};
    }

    /// How often a for loop runs, where it counts by a constant to a constant and nothing in it leaves it; else 1.
    std::size_t roundsAt(std::size_t loop) const {
        const std::size_t open = loop + 1;
        if (open >= tokens_.size() || !tokens_[open].is("(") || matches_[open] == tokens_.size()) return 1;
        const std::size_t close = matches_[open];
        std::vector<std::size_t> ends;
        for (std::size_t i = open + 1; i < close; ++i)
            if (tokens_[i].is(";")) ends.push_back(i);
        if (ends.size() != 2) return 1;
        Tokens begin = tokens_.subspan(open + 1, ends[0] - open - 1);
        const Tokens condition = tokens_.subspan(ends[0] + 1, ends[1] - ends[0] - 1);
        const Tokens change = tokens_.subspan(ends[1] + 1, close - ends[1] - 1);
        while (!begin.empty() && (isType(begin[0]) || isHookQualifier(begin[0].text))) begin = begin.subspan(1);
        if (begin.size() < 3 || condition.size() < 3 || change.size() < 2 || !begin[1].is("=")) return 1;
        const std::string_view name = begin[0].text;
        const auto from = constant(begin.subspan(2)), to = constant(condition.subspan(2));
        std::optional<std::int64_t> step;
        const bool isCounted = change.size() == 2;
        if (isCounted && (change[0].is("++") || change[1].is("++"))) step = 1;
        if (isCounted && (change[0].is("--") || change[1].is("--"))) step = -1;
        if (!isCounted && change[1].is("+=")) step = constant(change.subspan(2));
        if (!isCounted && change[1].is("-=") && (step = constant(change.subspan(2)))) step = -*step;
        const bool isNamed = condition[0].is(name) && (change[0].is(name) || change[1].is(name));
        constexpr std::int64_t kFar = std::int64_t(1) << 40;
        const auto isFar = [](std::int64_t value) { return value > kFar || value < -kFar; };
        if (!from || !to || !step || *step == 0 || !isNamed || isFar(*from) || isFar(*to) || isFar(*step)) return 1;
        std::size_t last = close + 1;
        while (last < tokens_.size() && !tokens_[last].is(";") && !tokens_[last].is("{"))
            last = opens(tokens_[last]) ? behindMatch(last) : last + 1;
        if (last < tokens_.size() && tokens_[last].is("{")) last = behindMatch(last);
        for (std::size_t i = close + 1; i < last; ++i) {
            if (tokens_[i].is("break") || tokens_[i].is("return")) return 1;
            const bool changes = tokens_[i].is(name) && i + 1 < tokens_.size() &&
                                 (tokens_[i + 1].text.ends_with("=") || tokens_[i + 1].is("++") ||
                                  tokens_[i + 1].is("--") || tokens_[i - 1].is("++") || tokens_[i - 1].is("--"));
            const bool compares = i + 1 < tokens_.size() && (tokens_[i + 1].is("==") || tokens_[i + 1].is("!=") ||
                                                             tokens_[i + 1].is("<=") || tokens_[i + 1].is(">="));
            if (changes && !compares) return 1;
        }
        const std::int64_t distance = *step > 0 ? *to - *from : *from - *to, stride = *step > 0 ? *step : -*step;
        const std::string_view sign = condition[1].text;
        const bool isUp = sign == "<" || sign == "<=", isDown = sign == ">" || sign == ">=";
        if ((isUp && *step < 0) || (isDown && *step > 0)) return distance < 0 ? kHuge : 1;
        if (!isUp && !isDown && sign != "!=") return 1;
        const std::int64_t covered = distance + (sign == "<=" || sign == ">=" ? 1 : 0);
        if (covered <= 0) return 1;
        return std::min(kHuge, std::size_t((covered + stride - 1) / stride));
    }

    /// What stands in the brackets of an if or a loop.
    void bracket(Function& function) {
        if (!is("(")) return;
        const std::size_t end = std::min(matches_[at_], tokens_.size());
        noteCalls(at_, end, function);
        if (const auto declared = declaredAt(at_ + 1, end)) {
            std::size_t semicolon = at_;
            while (semicolon < end && !tokens_[semicolon].is(";")) ++semicolon;
            function.arrays = sum(function.arrays, declaredNumbers(*declared, semicolon, false));
        }
        at_ = std::min(end + 1, tokens_.size());
    }

    void noteCalls(std::size_t begin, std::size_t end, Function& function) const {
        for (std::size_t i = begin; i + 1 < end; ++i)
            if (tokens_[i].isName() && tokens_[i + 1].is("(")) function.calls.push_back({tokens_[i].text, i, times_});
    }

    void skipStatement(Function& function) {
        const std::size_t begin = at_;
        while (at_ < tokens_.size() && !is(";") && !is("}")) at_ = opens(tokens_[at_]) ? behindMatch(at_) : at_ + 1;
        noteCalls(begin, at_, function);
        if (at_ == begin || is(";")) at_ = std::min(at_ + 1, tokens_.size());
    }

    void declarationOrExpression(Function& function) {
        const std::size_t begin = at_;
        skipStatement(function);
        if (const auto declared = declaredAt(begin, at_)) {
            const std::size_t end = at_ > begin && tokens_[at_ - 1].is(";") ? at_ - 1 : at_;
            function.arrays = sum(function.arrays, declaredNumbers(*declared, end, false));
        }
    }

    Tokens tokens_;
    std::vector<std::size_t> matches_; ///< of an opening bracket where it closes; else the number of tokens
    std::size_t at_ = 0;
    std::size_t times_ = 1; ///< iterations of the enclosing loops, multiplied
    std::unordered_map<std::string_view, std::int64_t> constants_;
    std::unordered_map<std::string_view, TypeSize> types_;
    std::vector<Function> functions_;
    std::multimap<std::string_view, std::size_t> prototypes_; ///< places of them by name
};

/// Adds the cost of called functions to their callers. Among the overloads that are declared before a call, the largest
/// counts.
class Calls {
public:
    Calls(std::vector<Function>& functions, const std::multimap<std::string_view, std::size_t>& prototypes)
        : functions_(functions), prototypes_(prototypes) {
        for (std::size_t i = 0; i < functions.size(); ++i) named_[functions[i].name].push_back(i);
    }

    void count() {
        for (std::size_t i = 0; i < functions_.size(); ++i) count(i, 0);
        Function all; // functions that nothing calls are compiled too
        for (const Function& one : functions_) {
            const bool isCalled = called_.contains(one.name);
            if (isCalled) continue;
            all.size = sum(all.size, one.size);
            all.branches = sum(all.branches, one.branches);
            all.arrays = sum(all.arrays, one.arrays);
            require(all, one.line);
        }
    }

private:
    static void require(const Function& one, std::uint32_t line) {
        const auto demand = [&](std::size_t found, std::size_t most, std::string_view what) {
            if (found > most)
                throw HookFault{line,
                                fmt::format("with the functions that it calls in their places it has more than {} {}; "
                                            "make it shorter, or call fewer",
                                            most, what)};
        };
        demand(one.size, kMostHookSize, "words and signs");
        demand(one.branches, kMostHookBranches, "branches and loops");
        demand(one.arrays, kMostHookArrays, "numbers in arrays");
        if (one.iterations > kMostHookIterations)
            throw HookFault{line,
                            fmt::format("the loops that it calls make more than {} iterations, after which software "
                                        "rasterisers truncate them silently; shorten them, or end them by break",
                                        kMostHookIterations)};
    }

    void count(std::size_t at, std::size_t depth) {
        Function& one = functions_[at];
        if (one.isCounted) return;
        if (one.isBeingCounted)
            throw HookFault{one.line, fmt::format("{} calls itself by way of others, or may seem to, and GLSL has no "
                                                  "recursion; give functions of one name different ones",
                                                  one.name)};
        if (depth > kMostHookNesting)
            throw HookFault{one.line, fmt::format("more than {} functions call each other in turn; make fewer of them",
                                                  kMostHookNesting)};
        one.isBeingCounted = true;
        for (const Function::Call& call : std::vector(one.calls)) add(at, call, depth);
        require(one, one.line);
        one.isBeingCounted = false;
        one.isCounted = true;
    }

    void add(std::size_t caller, const Function::Call& call, std::size_t depth) {
        const auto found = named_.find(call.name);
        if (found == named_.end()) return;
        const auto [first, last] = prototypes_.equal_range(call.name);
        const bool isAnnounced = std::any_of(first, last, [&](const auto& one) { return one.second < call.order; });
        Function most;
        for (const std::size_t i : found->second) {
            if (i == caller || (functions_[i].order > call.order && !isAnnounced)) continue; // the driver reports it
            count(i, depth + 1);
            called_.emplace(call.name, true);
            most.size = std::max(most.size, functions_[i].size);
            most.branches = std::max(most.branches, functions_[i].branches);
            most.arrays = std::max(most.arrays, functions_[i].arrays);
            most.iterations = std::max(most.iterations, functions_[i].iterations);
        }
        Function& one = functions_[caller];
        one.size = sum(one.size, most.size);
        one.branches = sum(one.branches, most.branches);
        one.arrays = sum(one.arrays, most.arrays);
        one.iterations = sum(one.iterations, product(call.times, most.iterations));
        require(one, one.line);
    }

    std::vector<Function>& functions_;
    const std::multimap<std::string_view, std::size_t>& prototypes_;
    std::unordered_map<std::string_view, std::vector<std::size_t>> named_;
    std::unordered_map<std::string_view, bool> called_; ///< names
};

} // namespace
} // namespace hookbounds

void requireBounds(std::span<const HookToken> tokens) {
    using namespace hookbounds;
    if (tokens.size() > kMostHookSize)
        refuse(tokens[kMostHookSize], fmt::format("with its macros this hook has more than {} words and signs; make it "
                                                  "shorter",
                                                  kMostHookSize));
    requireShallowExpressions(tokens);
    Reader reader(tokens);
    std::vector<Function> functions = reader.functions();
    Calls(functions, reader.prototypes()).count();
}

} // namespace tessera::scenes
