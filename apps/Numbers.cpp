#include "apps/Numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "base/Error.h"

namespace tessera::app {

namespace {

template <typename Number>
std::optional<Number> parsed(const std::string& text) {
    Number value{};
    const char* end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || rest != end) return std::nullopt;
    return value;
}

std::optional<glm::dvec3> parsedPoint(const std::string& text) {
    glm::dvec3 point(0.0);
    const char* at = text.data();
    const char* const end = at + text.size();
    for (glm::length_t i = 0; i < 3; ++i) {
        if (i > 0 && (at == end || *at++ != ',')) return std::nullopt;
        const auto [rest, error] = std::from_chars(at, end, point[i]);
        if (error != std::errc() || !std::isfinite(point[i])) return std::nullopt;
        at = rest;
    }
    if (at != end) return std::nullopt;
    return point;
}

} // namespace

CLI::Option* addNumber(CLI::App& command, const std::string& flag, std::optional<double>& target,
                       const std::string& help, const std::string& type) {
    const auto read = [flag, &target](const std::string& text) {
        target = parsed<double>(text);
        if (!target || !std::isfinite(*target))
            throw InputError(fmt::format("{} '{}' is not a finite number, such as 1.5", flag, text));
    };
    return command.add_option_function<std::string>(flag, read, help)->type_name(type);
}

CLI::Option* addWholeNumber(CLI::App& command, const std::string& flag, std::optional<int>& target,
                            const std::string& help, const std::string& type) {
    const auto read = [flag, &target](const std::string& text) {
        target = parsed<int>(text);
        if (!target)
            throw InputError(fmt::format("{} '{}' is not a whole number of at most 2147483647, such as 8", flag, text));
    };
    return command.add_option_function<std::string>(flag, read, help)->type_name(type);
}

CLI::Option* addPoint(CLI::App& command, const std::string& flag, std::optional<glm::dvec3>& target,
                      const std::string& help, const std::string& type) {
    const auto read = [flag, &target](const std::string& text) {
        target = parsedPoint(text);
        if (!target) throw InputError(fmt::format("{} '{}' is not three finite numbers, such as 0,1.5,-2", flag, text));
    };
    return command.add_option_function<std::string>(flag, read, help)->type_name(type);
}

CLI::Option* addHookValues(CLI::App& command, const std::string& flag, std::vector<scenes::HookValue>& target,
                           const std::string& help, const std::string& type) {
    const auto read = [flag, &target](const std::vector<std::string>& texts) {
        target.clear();
        for (const std::string& text : texts) {
            const std::size_t equals = std::min(text.find('='), text.size());
            const auto value = equals < text.size() ? parsed<float>(text.substr(equals + 1)) : std::optional<float>();
            if (equals == 0 || !value || !std::isfinite(*value))
                throw InputError(
                    fmt::format("{} '{}' is not a name, = and a finite number, such as wind=1.5", flag, text));
            target.push_back({text.substr(0, equals), *value});
        }
    };
    return command.add_option_function<std::vector<std::string>>(flag, read, help)
        ->type_name(type)
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

} // namespace tessera::app
