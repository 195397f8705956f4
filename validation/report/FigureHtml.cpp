#include "validation/report/FigureHtml.h"

#include <cmath>

#include <fmt/format.h>

#include "validation/figures/FigureText.h"
#include "validation/report/Html.h"

namespace tessera::validation {

std::string figureHtml(double value) {
    const std::string text = figureText(value);
    const std::size_t e = text.find('e');
    if (e == std::string::npos) return text == "-" ? "&ndash;" : escapedHtml(text);
    const bool isNegative = text[0] == '-';
    const int exponent = std::stoi(text.substr(e + 1));
    const std::string mantissa = (isNegative ? "&minus;" : "") + text.substr(isNegative, e - isNegative);
    if (exponent == 0) return mantissa;
    return fmt::format("<span class=\"whole\">{}&#8239;&times;&#8239;10<sup>{}{}</sup></span>", mantissa,
                       exponent < 0 ? "&minus;" : "", std::abs(exponent));
}

std::string figureHtml(const std::optional<double>& value) {
    return value ? figureHtml(*value) : "&ndash;";
}

std::string shareHtml(double share) {
    return std::isnan(share) ? "&ndash;" : escapedHtml(shareText(share));
}

std::string countText(std::uint64_t count) {
    std::string text = std::to_string(count);
    for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
    return text;
}

} // namespace tessera::validation
