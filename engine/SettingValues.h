#pragma once
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/Error.h"
#include "base/Names.h"
#include "engine/Settings.h"

/// Building blocks of the settings table: access to values, and kinds of values.
namespace tessera::engine {

// ---- Where a value is ----------------------------------------------------------------------------------------------

template <typename Value>
auto in(Value frame::ShadowMapSettings::*member) {
    return [member](auto& request) -> auto& {
        return request.settings.shadowMaps.*member;
    };
}
template <typename Value>
auto in(Value frame::DiffusionSettings::*member) {
    return [member](auto& request) -> auto& {
        return request.settings.diffusion.*member;
    };
}
template <typename Value>
auto in(Value frame::EnvironmentSettings::*member) {
    return [member](auto& request) -> auto& {
        return request.settings.environment.*member;
    };
}
template <typename Value>
auto in(Value frame::AreaSettings::*member) {
    return [member](auto& request) -> auto& {
        return request.settings.area.*member;
    };
}
inline auto in(Technique ViewRequest::*member) {
    return [member](auto& request) -> auto& {
        return request.*member;
    };
}
template <typename Value>
auto in(Value frame::FrameSettings::*member) {
    return [member](auto& request) -> auto& {
        return request.settings.*member;
    };
}
template <typename Value>
auto in(Value culling::Settings::*member) {
    return [member](auto& request) -> auto& {
        return request.settings.culling.*member;
    };
}

// Values that may be unset are optional.
template <typename Value>
const Value* given(const Value& value) {
    return &value;
}
template <typename Value>
const Value* given(const std::optional<Value>& value) {
    return value ? &*value : nullptr;
}
template <typename Value>
constexpr bool kIsOptional = false;
template <typename Value>
constexpr bool kIsOptional<std::optional<Value>> = true;

// ---- Numbers as text ------------------------------------------------------------------------------------------------

/// Parses the whole text as a number; none if it is something else.
template <typename Number>
std::optional<Number> parsed(const std::string& text) {
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || rest != end) return std::nullopt;
    return value;
}

/// The shortest text that parses to the same number, to the last bit.
std::string numberText(double value);
std::string numberText(int value);
std::string numberText(float value);

/// "1 to 1024", "0 or more".
std::string boundsText(const NumberKind& kind);

/// Parses a whole number of any size; none if the text is something else.
std::optional<double> wholeNumberIn(const std::string& text);
/// The same. Throws InputError if the text is something else.
double wholeNumber(const std::string& text, const TextSource& source);
/// Throws InputError with the valid range if the value is outside of it. Whole numbers must also fit into an int.
void requireBounds(const NumberKind& kind, double value, const TextSource& source);

// ---- Kinds of values -----------------------------------------------------------------------------------------------

inline constexpr std::string_view kOpen = "automatic";

/// Makes a setting value of any kind. `textOf` and `valueOf` convert values that are set.
template <typename Get, typename TextOf, typename ValueOf>
SettingValue valueIn(Get get, SettingKind kind, TextOf textOf, ValueOf valueOf, std::string_view open = kOpen) {
    using Value = std::remove_reference_t<decltype(get(std::declval<ViewRequest&>()))>;
    SettingValue value{std::move(kind), kIsOptional<Value> ? open : "", {}, {}, {}, {}};
    value.text = [get, textOf, open](const ViewRequest& request, const scenes::Scene*) {
        const auto* const now = given(get(request));
        return now ? textOf(*now) : std::string(open);
    };
    value.read = [=](ViewRequest& request, const std::string& text, const TextSource& source) {
        if constexpr (kIsOptional<Value>) {
            if (text == open) {
                get(request).reset();
                return;
            }
        }
        get(request) = valueOf(text, source);
    };
    value.equal = [get](const ViewRequest& a, const ViewRequest& b) { return get(a) == get(b); };
    value.copy = [get](ViewRequest& to, const ViewRequest& from) { get(to) = get(from); };
    return value;
}

/// The description in a table's row.
template <typename Row>
std::string_view meaningOf(const Row& row) {
    if constexpr (requires { row.summary; })
        return row.summary;
    else if constexpr (requires { row.meaning; })
        return row.meaning;
    else if constexpr (requires { row.lighting; })
        return row.lighting;
    else
        return "";
}

/// A choice among a table's rows; `key` is the row's value, and `open` the text of an unset value.
template <typename Get, typename Row, typename Key>
SettingValue choice(Get get, std::span<const Row> table, Key Row::*key, std::string_view open = kOpen) {
    ChoiceKind kind;
    for (const Row& row : table) kind.entries.push_back({std::string(row.name), std::string(row.name), meaningOf(row)});
    const auto textOf = [table, key](const Key& value) {
        const auto row = std::ranges::find(table, value, key);
        return row == table.end() ? std::string() : std::string(row->name);
    };
    const auto valueOf = [table, key](const std::string& text, const TextSource& source) {
        std::vector<std::string_view> names;
        for (const Row& row : table) {
            if (row.name == text) return row.*key;
            names.push_back(row.name);
        }
        throw InputError(fmt::format("unknown {} '{}': {}", source.name, text, suggestNames(text, names)));
    };
    return valueIn(get, std::move(kind), textOf, valueOf, open);
}

/// A choice among whole numbers.
template <typename Get>
SettingValue choice(Get get, std::span<const int> numbers, std::string_view unit = "") {
    ChoiceKind kind{{}, true};
    const std::string_view ofOne = unit.ends_with('s') ? unit.substr(0, unit.size() - 1) : unit;
    for (const int number : numbers)
        kind.entries.push_back({numberText(number), numberText(number) + std::string(number == 1 ? ofOne : unit), ""});
    const auto valueOf = [numbers](const std::string& text, const TextSource& source) {
        const double value = wholeNumber(text, source);
        const auto found = std::ranges::find(numbers, value);
        if (found == numbers.end())
            throw InputError(fmt::format("{} {}: give one of {}", source.called, value, fmt::join(numbers, ", ")));
        return *found;
    };
    return valueIn(
        get, std::move(kind), [](int value) { return numberText(value); }, valueOf);
}

/// A float or a double.
template <typename Get>
SettingValue number(Get get, const NumberKind& kind) {
    using Value = std::remove_reference_t<decltype(get(std::declval<ViewRequest&>()))>;
    const auto valueOf = [kind](const std::string& text, const TextSource& source) {
        const std::optional<double> value = parsed<double>(text);
        if (!value || !std::isfinite(*value))
            throw InputError(fmt::format("{} '{}' is not a finite number, such as 1.5", source.called, text));
        requireBounds(kind, *value, source);
        if (!std::isfinite(static_cast<Value>(*value)))
            throw InputError(
                fmt::format("{} '{}' is more than single precision holds; give less", source.called, text));
        return static_cast<Value>(*value);
    };
    return valueIn(
        get, kind, [](Value value) { return numberText(value); }, valueOf);
}

/// An int.
template <typename Get>
SettingValue wholeNumber(Get get, const NumberKind& kind) {
    const auto valueOf = [kind](const std::string& text, const TextSource& source) {
        const double value = wholeNumber(text, source);
        requireBounds(kind, value, source);
        return int(value);
    };
    return valueIn(
        get, kind, [](int value) { return numberText(value); }, valueOf);
}

SettingValue onOff(bool frame::FrameSettings::*member);
SettingValue onOff(bool frame::DiffusionSettings::*member);
SettingValue onOff(bool frame::EnvironmentSettings::*member);
SettingValue pictureSize();

} // namespace tessera::engine
