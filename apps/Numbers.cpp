#include "apps/Numbers.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "scenes/Error.h"

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
        if (!target) throw InputError(fmt::format("{} '{}' is not a whole number, such as 8", flag, text));
    };
    return command.add_option_function<std::string>(flag, read, help)->type_name(type);
}

} // namespace tessera::app
