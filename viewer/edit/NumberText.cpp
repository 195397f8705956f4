#include "viewer/edit/NumberText.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace tessera::viewer {
namespace {

/// Long enough for any double with a few decimals: 309 digits before the point.
using PrintedNumber = std::array<char, 400>;

PrintedNumber printed(const char* format, double value) {
    PrintedNumber text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text;
}

} // namespace

double shownNumber(const char* format, double value) {
    if (!std::isfinite(value) || !std::signbit(value)) return value;
    return std::strpbrk(printed(format, value).data(), "123456789") == nullptr ? -value : value;
}

std::string numberText(const char* format, double value) {
    return printed(format, shownNumber(format, value)).data();
}

} // namespace tessera::viewer
