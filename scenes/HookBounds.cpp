#include "scenes/HookBounds.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scenes/Hook.h"
#include "scenes/HookNames.h"
#include "scenes/HookWords.h"

namespace tessera::scenes {
namespace hookbounds {
namespace {

using Tokens = std::span<const HookToken>;
using Places = std::multimap<std::string_view, std::size_t>;

/// Cost of a function; Calls::count() adds that of the called functions.
enum Amount : std::size_t { Words, ArrayNumbers, Branches, Operations, AmountCount };
using Amounts = std::array<std::size_t, AmountCount>;

void require(const Amounts& amounts, std::uint32_t line) {
    static constexpr std::pair<std::size_t, std::string_view> kMost[] = {
        {kMostHookSize, "words and signs"},
        {kMostHookArrays, "numbers in arrays"},
        {kMostHookBranches, "branches and loops"},
        {kMostHookOperations, "operations on numbers"}};
    for (std::size_t i = 0; i < AmountCount; ++i)
        if (amounts[i] > kMost[i].first)
            throw HookFault{line,
                            fmt::format("with the functions that it calls in their places it has more than {} {}; "
                                        "make it shorter, or call fewer",
                                        kMost[i].first, kMost[i].second)};
}

void add(Amounts& to, const Amounts& from) {
    for (std::size_t i = 0; i < AmountCount; ++i) to[i] = hookSum(to[i], from[i]);
}

/// Operations of a GLSL function per component of the widest value in its statement. Measured with Mesa 22.3.
std::size_t operationsOf(std::string_view function) {
    static const std::unordered_map<std::string_view, std::size_t> known{
        {"sin", 50},     {"cos", 50},      {"tan", 50},        {"asin", 25},       {"acos", 25},      {"atan", 60},
        {"sinh", 50},    {"cosh", 50},     {"tanh", 50},       {"asinh", 50},      {"acosh", 50},     {"atanh", 50},
        {"pow", 60},     {"exp", 30},      {"log", 30},        {"exp2", 30},       {"log2", 30},      {"mod", 5},
        {"modf", 5},     {"frexp", 15},    {"ldexp", 15},      {"refract", 15},    {"smoothstep", 8}, {"length", 4},
        {"distance", 4}, {"normalize", 5}, {"faceforward", 5}, {"determinant", 7}, {"inverse", 13}};
    const auto found = known.find(function);
    return found == known.end() ? 1 : found->second;
}

struct Function {
    std::string_view name;
    std::uint32_t line = 1;
    std::size_t order = 0; ///< index of its name's token
    Amounts amounts{};     ///< cost of the body; called functions are added later
    struct Call {
        std::string_view name;
        std::size_t order = 0;
    };
    std::vector<Call> calls;
    bool isCounted = false, isBeingCounted = false;
};

/// Finds functions and measures their contents.
class Reader {
public:
    explicit Reader(Tokens tokens) : tokens_(tokens), names_(tokens) {}

    /// The last entry covers the text outside of functions, since initialisers call functions too.
    std::vector<Function> functions() {
        Function global, local;
        for (at_ = 0; at_ < tokens_.size(); ++at_) {
            const HookToken& token = tokens_[at_];
            if (brackets_.empty() && isDeclaredFunction()) begin(local);
            Function& function = isInside_ ? local : global;
            function.amounts[ArrayNumbers] = hookSum(function.amounts[ArrayNumbers], names_.take(at_));
            ++function.amounts[Words];
            bracket(token);
            word(function);
            statement(function);
            if (token.is("}") && brackets_.empty() && isInside_) {
                functions_.push_back(std::exchange(local, {}));
                names_.leaveFunction();
                isInside_ = false;
            }
        }
        if (isInside_) functions_.push_back(std::move(local));
        functions_.push_back(std::move(global));
        return std::move(functions_);
    }
    const Places& prototypes() const { return prototypes_; }

private:
    bool is(std::size_t at, std::string_view text) const { return at < tokens_.size() && tokens_[at].is(text); }

    bool isDeclaredFunction() const {
        return at_ > 0 && tokens_[at_].isName() && is(at_ + 1, "(") &&
               (tokens_[at_ - 1].isName() || tokens_[at_ - 1].is("]"));
    }

    void begin(Function& function) {
        function = {};
        function.name = tokens_[at_].text;
        function.line = tokens_[at_].line;
        function.order = at_;
        isInside_ = is(behindBracket(tokens_, at_ + 1), "{");
        if (!isInside_) prototypes_.emplace(function.name, function.order);
    }

    void bracket(const HookToken& token) {
        if (opens(token)) {
            static const std::unordered_set<std::string_view> kStatements{"if",     "else",   "for",  "while",
                                                                          "switch", "return", "case", "do"};
            const bool isCall = token.is("(") && at_ > 0 && !kStatements.contains(tokens_[at_ - 1].text) &&
                                (tokens_[at_ - 1].isName() || tokens_[at_ - 1].is("]"));
            brackets_.push_back(isCall);
            if (brackets_.size() > kMostHookNesting)
                throw HookFault{token.line, fmt::format("more than {} brackets stand in each other here; use variables",
                                                        kMostHookNesting)};
        } else if (closes(token) && !brackets_.empty()) {
            brackets_.pop_back();
        }
    }

    void word(Function& function) {
        static const std::unordered_map<std::string_view, std::size_t> kBranches{
            {"if", 1},      {"?", 1},     {"&&", 1},       {"||", 1},   {"case", 1},
            {"default", 1}, {"break", 1}, {"continue", 1}, {"for", 20}, {"while", 20}}; // while ends do loops too
        const HookToken& token = tokens_[at_];
        if (const auto found = kBranches.find(token.text); found != kBranches.end())
            function.amounts[Branches] += found->second;
        if (!token.isName() || !is(at_ + 1, "(") || function.order == at_) return;
        function.calls.push_back({token.text, at_});
        operations_ += operationsOf(token.text);
    }

    /// Adds up the cost of a statement, delimited by ; { }
    void statement(Function& function) {
        const HookToken& token = tokens_[at_];
        const bool ends = token.is(";") || token.is("{") || token.is("}");
        if (token.kind != HookToken::Kind::Sign) {
            widest_.widen(names_.sizeAt(at_));
            variables_ += token.isName() && !names_.isType(at_);
        } else if (!ends && !closes(token) && !(token.is(",") && !brackets_.empty() && brackets_.back())) {
            ++operators_;
            products_ += token.is("*") || token.is("*=");
            divisions_ += token.is("/") || token.is("/=") || token.is("%") || token.is("%=");
            indices_ += token.is("[");
            constructs_ = constructs_ || (token.is("(") && at_ > 0 && tokens_[at_ - 1].is("]"));
            compares_ = compares_ || token.is("==") || token.is("!=");
        }
        if (operators_ > kMostHookOperators)
            throw HookFault{token.line, fmt::format("this statement has more than {} operators; make several of it",
                                                    kMostHookOperators)};
        if (!ends) return;
        if (compares_ && widest_.numbers > kMostComparedNumbers)
            throw HookFault{token.line, fmt::format("this statement compares, and names a value of more than {} "
                                                    "numbers; compare elements, in a statement by itself",
                                                    kMostComparedNumbers)};
        operations_ += operators_ + products_ * widest_.product + divisions_ * widest_.division +
                       (indices_ + (constructs_ ? variables_ : 0)) * widest_.index;
        function.amounts[Operations] = hookSum(function.amounts[Operations], hookProduct(operations_, widest_.numbers));
        operations_ = operators_ = products_ = divisions_ = indices_ = variables_ = 0;
        compares_ = constructs_ = false;
        widest_ = {};
    }

    Tokens tokens_;
    HookNames names_;
    std::size_t at_ = 0;
    std::vector<bool> brackets_; ///< open brackets; true: around arguments of a call
    bool isInside_ = false;      ///< in a function, or between its name and its body
    std::vector<Function> functions_;
    Places prototypes_; ///< by name
    /// State of the current statement:
    std::size_t operations_ = 0, operators_ = 0, products_ = 0, divisions_ = 0, indices_ = 0, variables_ = 0;
    bool compares_ = false, constructs_ = false;
    HookSize widest_;
};

/// Adds the cost of called functions to their callers. Among the overloads that are declared before a call, the largest
/// counts.
class Calls {
public:
    Calls(std::vector<Function>& functions, const Places& prototypes) : functions_(functions), prototypes_(prototypes) {
        for (std::size_t i = 0; i < functions.size(); ++i) named_[functions[i].name].push_back(i);
    }

    void count() {
        for (std::size_t i = 0; i < functions_.size(); ++i) count(i, 0);
        Amounts all{}; // functions that nothing calls are compiled too
        for (const Function& one : functions_) {
            if (called_.contains(one.name)) continue;
            add(all, one.amounts);
            require(all, one.line);
        }
    }

private:
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
        for (const Function::Call& call : std::vector(one.calls)) addCall(at, call, depth);
        require(one.amounts, one.line);
        one.isBeingCounted = false;
        one.isCounted = true;
    }

    void addCall(std::size_t caller, const Function::Call& call, std::size_t depth) {
        const auto found = named_.find(call.name);
        if (found == named_.end()) return;
        const auto [first, last] = prototypes_.equal_range(call.name);
        const bool isAnnounced = std::any_of(first, last, [&](const auto& one) { return one.second < call.order; });
        Amounts most{};
        for (const std::size_t i : found->second) {
            if (i == caller || (functions_[i].order > call.order && !isAnnounced)) continue; // the driver reports it
            count(i, depth + 1);
            called_.insert(call.name);
            for (std::size_t k = 0; k < AmountCount; ++k) most[k] = std::max(most[k], functions_[i].amounts[k]);
        }
        add(functions_[caller].amounts, most);
        require(functions_[caller].amounts, functions_[caller].line);
    }

    std::vector<Function>& functions_;
    const Places& prototypes_;
    std::unordered_map<std::string_view, std::vector<std::size_t>> named_;
    std::unordered_set<std::string_view> called_;
};

} // namespace
} // namespace hookbounds

void requireBounds(std::span<const HookToken> tokens) {
    using namespace hookbounds;
    if (tokens.size() > kMostHookSize)
        throw HookFault{
            tokens[kMostHookSize].line,
            fmt::format("with its macros this hook has more than {} words and signs; make it shorter", kMostHookSize)};
    Reader reader(tokens);
    std::vector<Function> functions = reader.functions();
    Calls(functions, reader.prototypes()).count();
}

} // namespace tessera::scenes
